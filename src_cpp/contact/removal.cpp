/// Elements that are deleted leave the surface.
#include <algorithm>
#include <limits>
#include <string>

#include "cdfp/contact.hpp"
#include "contact/stages.hpp"
#include "core/numbered.hpp"
#include "core/require.hpp"

namespace cdfp {

/// Pairs of what is no more end here; their springs go with them, which the next forces book.
void SurfaceContact::Stages::let_go_of_removed() {
  const auto lost = [&](const TouchingPair& pair) {
    const bool edges = pair.first_count == 2;
    const bool gone = edges ? surface.is_removed_edge(pair.first) || surface.is_removed_edge(pair.second)
                            : surface.is_removed(pair.second) || !surface.on_surface(pair.first);
    if (gone && !pair.ignored && pair.stored > 0) removed_pairs.push_back(pair);
    return gone;
  };
  for (Piece& piece : pieces) std::erase_if(piece.touches, lost);
  std::erase_if(edge_touches, [&](const GrippedPair& edges) { return lost(edges.pair); });
  for (std::size_t row = 0; row < holds.size(); ++row) {
    const Index segment = holds[row].segment;
    if (segment == kNone) continue;
    if (surface.is_removed(segment) || !surface.on_surface(static_cast<Index>(row))) holds[row] = Hold{};
  }
  std::erase_if(active_segments, [this](Index segment) { return surface.is_removed(segment); });
  bar_removed();
}

/// Their planes are infinitely far below everything and stay so: candidates of them end at once.
void SurfaceContact::Stages::bar_removed() {
  if (surface.removed_count() == 0) return;
  for (std::size_t segment = 0; segment < planes.size(); ++segment) {
    if (!surface.is_removed(static_cast<Index>(segment))) continue;
    planes[segment] = Plane{};
    planes[segment].warp = -std::numeric_limits<double>::infinity();
    is_partner[segment] = 1;
  }
}

void SurfaceContact::remove_element(Index element) {
  require(element >= 0,
          "element " + numbered(element) + " cannot leave the surface; elements count from " + numbered(0));
  if (stages_->surface.remove(element)) stages_->let_go_of_removed();
}

Index SurfaceContact::removed_count() const {
  return stages_->surface.removed_count();
}

}  // namespace cdfp
