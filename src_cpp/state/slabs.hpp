/// How threads share a body out: in slabs across one axis, nodes and elements alike, so that what a thread
/// writes at one stage of a step it finds in its own caches at the next.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "core/parallel.hpp"

namespace cdfp {

/// Nodes of consecutive numbers that one thread works on at a time.
inline constexpr std::int64_t kNodePiece = 1024;

struct PieceExtent {
  std::array<double, 3> low, high;
};

inline std::vector<PieceExtent> extents_of_pieces(std::span<const double> coordinates) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<PieceExtent> pieces;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (i % (3 * kNodePiece) == 0) pieces.push_back({{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}});
    PieceExtent& piece = pieces.back();
    piece.low[i % 3] = std::min(piece.low[i % 3], coordinates[i]);
    piece.high[i % 3] = std::max(piece.high[i % 3], coordinates[i]);
  }
  return pieces;
}

/// The longest axis along which pieces of nodes are short.
inline int slab_axis(const std::vector<PieceExtent>& pieces) {
  constexpr double kShort = 0.25;  // of the whole
  int axis = 0;
  double longest = -1;
  for (int d = 0; d < 3; ++d) {
    double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PieceExtent& piece : pieces) {
      sum += piece.high[d] - piece.low[d];
      low = std::min(low, piece.low[d]);
      high = std::max(high, piece.high[d]);
    }
    if (sum < kShort * (high - low) * static_cast<double>(pieces.size()) && high - low > longest) {
      longest = high - low;
      axis = d;
    }
  }
  return axis;
}

/// The pieces of nodes in the order in which threads share them out.
class NodePieces {
 public:
  explicit NodePieces(std::span<const double> coordinates) {
    const std::vector<PieceExtent> pieces = extents_of_pieces(coordinates);
    const int axis = slab_axis(pieces);
    order_.resize(pieces.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
      return pieces[a].low[axis] + pieces[a].high[axis] < pieces[b].low[axis] + pieces[b].high[axis];
    });
  }

  /// `body(begin, end)` for all of `nodes`, of which the last may be new. One thread keeps to their numbers.
  template <class Body>
  void for_each(std::int64_t nodes, const Threads& threads, Body&& body) const {
    const std::int64_t known = threads.count() > 1 ? std::ssize(order_) : 0;
    threads.for_each((nodes + kNodePiece - 1) / kNodePiece, [&](std::int64_t i) {
      const std::int64_t piece = i < known ? order_[i] : i;
      body(piece * kNodePiece, std::min(nodes, (piece + 1) * kNodePiece));
    });
  }

 private:
  std::vector<std::int32_t> order_;
};

}  // namespace cdfp
