/// Where each node was in the undeformed body, also for nodes that insertions made.
#pragma once

#include <span>
#include <vector>

#include "cdfp/results.hpp"

namespace cdfp {

/// Takes the first frame that it sees as undeformed. A node made later lies where its mother lay: copies of
/// one node are tied by the corners of the cohesive elements between them, so the smallest number among those
/// tied is the mother's.
class UndeformedNodes {
 public:
  void update(const Frame& frame);
  std::span<const double> positions() const { return positions_; }

 private:
  Index root(Index node);
  void tie(Index a, Index b);

  std::vector<double> positions_;
  std::vector<Index> tied_to_;
};

}  // namespace cdfp
