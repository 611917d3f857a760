#include "output/undeformed.hpp"

#include <algorithm>
#include <utility>

namespace cdfp {

Index UndeformedNodes::root(Index node) {
  auto& tied = tied_to_;
  while (tied[static_cast<std::size_t>(node)] != node) {
    Index& next = tied[static_cast<std::size_t>(node)];
    next = tied[static_cast<std::size_t>(next)];
    node = next;
  }
  return node;
}

void UndeformedNodes::tie(Index a, Index b) {
  a = root(a);
  b = root(b);
  if (a > b) std::swap(a, b);
  tied_to_[static_cast<std::size_t>(b)] = a;
}

void UndeformedNodes::update(const Frame& frame) {
  const std::size_t known = tied_to_.size(), nodes = frame.positions.size() / 3;
  for (std::size_t node = known; node < nodes; ++node) tied_to_.push_back(static_cast<Index>(node));
  for (const CrackFacet& facet : frame.cracks)
    for (std::size_t c = 0; c < static_cast<std::size_t>(facet.corners); ++c)
      tie(facet.upper[c], facet.lower[c]);
  positions_.insert(positions_.end(), frame.positions.begin() + static_cast<std::ptrdiff_t>(3 * known),
                    frame.positions.end());
  for (std::size_t node = known; node < nodes; ++node) {
    const auto mother = static_cast<std::size_t>(root(static_cast<Index>(node)));
    std::copy_n(positions_.begin() + static_cast<std::ptrdiff_t>(3 * mother), 3,
                positions_.begin() + static_cast<std::ptrdiff_t>(3 * node));
  }
}

}  // namespace cdfp
