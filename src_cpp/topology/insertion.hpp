/// Cohesive insertion: decide which nodes come apart, then apply. The work is local to the facet's nodes.
#pragma once

#include <array>
#include <vector>

#include "topology/store.hpp"
#include "topology/visited.hpp"

namespace cdfp {

/// Keeps its scratch from one insertion to the next.
class Inserter {
 public:
  void insert(TopologyStore& store, FacetUse use, Insertion& report);

 private:
  struct Cut {
    Index cohesive;
    FacetUse lower;
    FacetUse upper;
  };
  /// The uses of one node that have been reached so far from one side of the cut.
  struct Side {
    std::vector<VertexUse> uses;
    std::size_t next = 0;
    Visited visited;

    void start(VertexUse use);
    bool exhausted() const { return next == uses.size(); }
    Index lowest() const;
  };
  enum class Fate { joined, lower_moves, upper_moves };

  static bool edge_holds(const TopologyStore& store, const Cut& cut, Index lower_edge);
  Fate vertex_fate(const TopologyStore& store, Index node, VertexUse lower, VertexUse upper);
  static bool grow(const TopologyStore& store, Side& side, const Side& other);
  void decide(TopologyStore& store, const Cut& cut, Insertion& report);
  void apply(TopologyStore& store, const Cut& cut, Insertion& report);

  Side lower_;
  Side upper_;
  std::vector<VertexUse> moves_;         ///< the uses that change their node, by corner of the facet
  std::size_t start_ = 0;                ///< the lower facet's first corner, as a corner of the upper facet
  std::array<std::size_t, 5> ranges_{};  ///< where the moves of each corner begin
};

}  // namespace cdfp
