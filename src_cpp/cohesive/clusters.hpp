/// Which points must be solved together: those whose node pairs share nodes. Pairs only stand between copies
/// of one node, so that a cluster is never larger than the elements around it.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cdfp/topology.hpp"
#include "core/archive.hpp"

namespace cdfp {

struct NodePair {
  Index upper = kNone;
  Index lower = kNone;
};

class Clusters {
 public:
  struct Slot {
    Index point;
    std::int32_t upper;  ///< into the cluster's nodes
    std::int32_t lower;
  };
  struct Cluster {
    std::uint32_t first_slot = 0;
    std::uint32_t slots = 0;
    std::uint32_t first_node = 0;
    std::uint32_t nodes = 0;
  };

  /// `node` became a copy of `mother`.
  void copy(Index node, Index mother);
  /// `point` stands at `node` and its copies.
  void add(Index point, Index node);
  /// The points at `node` and its copies changed.
  void touch(Index node);

  /// Brings the clusters up to date. `pair(point)` gives the two nodes, the same twice if the point takes no
  /// part.
  template <class Pair>
  void update(Pair&& pair) {
    if (touched_.empty()) return;
    for (const Index f : touched_) {
      Family& family = families_[f];
      family.touched = false;
      gather_.clear();
      for (const Index point : family.points) gather_.push_back({point, pair(point)});
      replace(family);
    }
    touched_.clear();
    if (dead_ > 64 && 2 * dead_ > clusters_.size()) compact();
  }

  void archive(Archive& a);

  std::span<const Cluster> all() const { return clusters_; }  ///< some may be empty
  std::span<const Slot> slots(const Cluster& c) const { return {&slots_[c.first_slot], c.slots}; }
  std::span<const Index> nodes(const Cluster& c) const { return {&nodes_[c.first_node], c.nodes}; }

 private:
  struct Family {
    std::vector<Index> points;
    std::vector<std::uint32_t> clusters;
    bool touched = false;
  };
  struct Gathered {
    Index point;
    NodePair pair;
  };
  Index family(Index node);
  void replace(Family& family);
  void compact();

  std::vector<Index> family_of_node_;
  std::vector<Family> families_;
  std::vector<Index> touched_;
  std::vector<Cluster> clusters_;
  std::vector<Slot> slots_;
  std::vector<Index> nodes_;
  std::size_t dead_ = 0;
  std::vector<Gathered> gather_;
  std::vector<std::pair<Index, Index>> label_;  ///< node and the cluster that it is in so far
};

}  // namespace cdfp
