#include "cohesive/clusters.hpp"

#include <algorithm>

namespace cdfp {

Index Clusters::family(Index node) {
  if (static_cast<std::size_t>(node) >= family_of_node_.size()) family_of_node_.resize(node + 1, kNone);
  Index& f = family_of_node_[node];
  if (f == kNone) {
    f = static_cast<Index>(families_.size());
    families_.emplace_back();
  }
  return f;
}

void Clusters::copy(Index node, Index mother) {
  const Index f = family(mother);
  if (static_cast<std::size_t>(node) >= family_of_node_.size()) family_of_node_.resize(node + 1, kNone);
  family_of_node_[node] = f;
}

void Clusters::add(Index point, Index node) {
  families_[family(node)].points.push_back(point);
  touch(node);
}

void Clusters::touch(Index node) {
  const Index f = family(node);
  if (families_[f].touched) return;
  families_[f].touched = true;
  touched_.push_back(f);
}

/// The clusters of `gather_` take the place of the family's old ones.
void Clusters::replace(Family& family) {
  for (const std::uint32_t c : family.clusters) clusters_[c].slots = 0;
  dead_ += family.clusters.size();
  family.clusters.clear();
  std::erase_if(gather_, [](const Gathered& g) { return g.pair.upper == g.pair.lower; });

  label_.clear();
  const auto label = [this](Index node) -> Index& {
    for (auto& [n, l] : label_) {
      if (n == node) return l;
    }
    label_.emplace_back(node, static_cast<Index>(label_.size()));
    return label_.back().second;
  };
  for (const Gathered& g : gather_) {
    const Index a = label(g.pair.upper);
    const Index b = label(g.pair.lower);
    for (auto& [n, l] : label_) {
      if (l == std::max(a, b)) l = std::min(a, b);
    }
  }
  for (Index l = 0; l < static_cast<Index>(label_.size()); ++l) {
    Cluster cluster{static_cast<std::uint32_t>(slots_.size()), 0, static_cast<std::uint32_t>(nodes_.size()),
                    0};
    for (const auto& [node, own] : label_) {
      if (own == l) nodes_.push_back(node);
    }
    cluster.nodes = static_cast<std::uint32_t>(nodes_.size() - cluster.first_node);
    if (cluster.nodes == 0) continue;
    const std::span<const Index> members = nodes(cluster);
    const auto place = [&](Index node) {
      return static_cast<std::int32_t>(std::find(members.begin(), members.end(), node) - members.begin());
    };
    for (const Gathered& g : gather_) {
      if (label(g.pair.upper) != l) continue;
      slots_.push_back({g.point, place(g.pair.upper), place(g.pair.lower)});
    }
    cluster.slots = static_cast<std::uint32_t>(slots_.size() - cluster.first_slot);
    family.clusters.push_back(static_cast<std::uint32_t>(clusters_.size()));
    clusters_.push_back(cluster);
  }
}

void Clusters::compact() {
  std::vector<Cluster> clusters;
  std::vector<Slot> slots;
  std::vector<Index> nodes;
  for (Family& family : families_) {
    for (std::uint32_t& c : family.clusters) {
      const Cluster old = clusters_[c];
      c = static_cast<std::uint32_t>(clusters.size());
      clusters.push_back({static_cast<std::uint32_t>(slots.size()), old.slots,
                          static_cast<std::uint32_t>(nodes.size()), old.nodes});
      slots.insert(slots.end(), slots_.begin() + old.first_slot, slots_.begin() + old.first_slot + old.slots);
      nodes.insert(nodes.end(), nodes_.begin() + old.first_node, nodes_.begin() + old.first_node + old.nodes);
    }
  }
  clusters_ = std::move(clusters);
  slots_ = std::move(slots);
  nodes_ = std::move(nodes);
  dead_ = 0;
}

void Clusters::archive(Archive& a) {
  a("clusters.family_of_node", family_of_node_);
  std::uint64_t families = families_.size();
  a("clusters.families", families);
  families_.resize(families);
  std::vector<Index> points;
  std::vector<std::uint32_t> clusters, sizes;
  for (const Family& family : families_) {
    points.insert(points.end(), family.points.begin(), family.points.end());
    clusters.insert(clusters.end(), family.clusters.begin(), family.clusters.end());
    sizes.push_back(static_cast<std::uint32_t>(family.points.size()));
    sizes.push_back(static_cast<std::uint32_t>(family.clusters.size()));
  }
  a("clusters.sizes", sizes);
  a("clusters.points", points);
  a("clusters.clusters", clusters);
  if (a.reads()) {
    auto point = points.begin();
    auto cluster = clusters.begin();
    for (std::size_t f = 0; f < families_.size(); ++f) {
      families_[f].points.assign(point, point + sizes[2 * f]);
      families_[f].clusters.assign(cluster, cluster + sizes[2 * f + 1]);
      families_[f].touched = false;
      point += sizes[2 * f], cluster += sizes[2 * f + 1];
    }
  }
  a("clusters.touched", touched_);
  for (const Index f : touched_) families_[f].touched = true;
  a("clusters.all", clusters_);
  a("clusters.slots", slots_);
  a("clusters.nodes", nodes_);
  a("clusters.dead", dead_);
}

}  // namespace cdfp
