/// What the topology must say, by brute force from the initial mesh and the list of cut facets: nothing is
/// shared with the code under test but the numbering of corners, facets and edges.
#pragma once

#include <map>
#include <numeric>
#include <set>

#include "cdfp/topology.hpp"
#include "meshes.hpp"

namespace cdfp::test {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) { parent_[std::max(root(i), root(j))] = std::min(root(i), root(j)); }

 private:
  std::vector<int> parent_;
};

class Oracle {
 public:
  explicit Oracle(const SmallMesh& mesh) : mesh_(mesh) {
    std::map<std::set<Index>, FacetUse> open;
    mates_.resize(mesh.types.size());
    for (Index e = 0; e < mesh.element_count(); ++e) {
      first_corner_.push_back(corner_count_);
      corner_count_ += static_cast<int>(mesh.elements[e].size());
      first_edge_.push_back(edge_count_);
      edge_count_ += shape(e).edge_count;
      mates_[e].resize(shape(e).facet_count);
      for (Index f = 0; f < shape(e).facet_count; ++f) {
        const auto [place, is_new] = open.try_emplace(nodes_of(FacetUse{e, f}), FacetUse{e, f});
        if (is_new) continue;
        mates_[e][f] = place->second;
        mates_[place->second.element][place->second.facet] = {e, f};
      }
    }
    UnionFind parts = corners_joined(false);
    for (int i = 0; i < corner_count_; ++i) part_.push_back(parts.root(i));
  }

  const SmallMesh& mesh() const { return mesh_; }
  const ElementTemplate& shape(Index e) const { return element_template(mesh_.types[e]); }
  FacetUse mate(FacetUse use) const { return mates_[use.element][use.facet]; }
  bool is_cut(FacetUse use) const { return cut_.contains(use); }
  int corner_count() const { return corner_count_; }
  int corner(Index e, Index c) const { return first_corner_[e] + c; }
  int edge(Index e, Index k) const { return first_edge_[e] + k; }
  int part(int corner) const { return part_[corner]; }

  std::set<Index> nodes_of(FacetUse use) const {
    std::set<Index> nodes;
    for (const int c : shape(use.element).facet(use.facet)) nodes.insert(mesh_.elements[use.element][c]);
    return nodes;
  }
  std::set<Index> nodes_of(EdgeUse use) const {
    const auto [a, b] = shape(use.element).edges[use.edge];
    return {mesh_.elements[use.element][a], mesh_.elements[use.element][b]};
  }

  std::vector<FacetUse> inner_facets() const {
    std::vector<FacetUse> inner;
    each_facet([&](FacetUse use) {
      if (use < mate(use)) inner.push_back(use);
    });
    return inner;
  }

  /// The cohesive element is `cohesive`.
  void cut(FacetUse use, Index cohesive) {
    cut_[use] = cohesive;
    cut_[mate(use)] = cohesive;
  }
  Index cohesive_at(FacetUse use) const { return cut_.at(use); }

  template <class Visit>
  void each_facet(Visit&& visit) const {
    for (Index e = 0; e < mesh_.element_count(); ++e) {
      for (Index f = 0; f < shape(e).facet_count; ++f) visit(FacetUse{e, f});
    }
  }
  template <class Visit>
  void each_edge(Visit&& visit) const {
    for (Index e = 0; e < mesh_.element_count(); ++e) {
      for (Index k = 0; k < shape(e).edge_count; ++k) visit(EdgeUse{e, k});
    }
  }
  template <class Visit>
  void each_corner(Visit&& visit) const {
    for (Index e = 0; e < mesh_.element_count(); ++e) {
      for (Index c = 0; c < shape(e).corner_count; ++c) visit(VertexUse{e, c});
    }
  }

  /// Corners joined through facets that are not cut.
  UnionFind corners_joined(bool with_cuts) const {
    UnionFind corners(corner_count_);
    each_facet([&](FacetUse use) {
      const FacetUse other = mate(use);
      if (other.element == kNone || (with_cuts && is_cut(use))) return;
      for (const int c : shape(use.element).facet(use.facet)) {
        for (const int d : shape(other.element).facet(other.facet)) {
          if (mesh_.elements[use.element][c] == mesh_.elements[other.element][d]) {
            corners.join(corner(use.element, c), corner(other.element, d));
          }
        }
      }
    });
    return corners;
  }

  /// The corners that share a node now: those joined, and the lowest ones of parts that met from the start.
  UnionFind node_classes() const {
    UnionFind corners = corners_joined(true);
    std::map<Index, int> first;
    each_corner([&](VertexUse use) {
      const int c = corner(use.element, use.corner);
      if (part_[c] != c) return;
      corners.join(c, first.try_emplace(mesh_.elements[use.element][use.corner], c).first->second);
    });
    return corners;
  }

  Index nodes_without_elements() const {
    std::set<Index> used;
    for (const auto& corners : mesh_.elements) used.insert(corners.begin(), corners.end());
    return mesh_.node_count() - static_cast<Index>(used.size());
  }

  /// Edge uses joined around their edge, through all facets or uncut ones only.
  UnionFind edges_joined(bool with_cuts) const {
    UnionFind edges(edge_count_);
    each_facet([&](FacetUse use) {
      const FacetUse other = mate(use);
      if (other.element == kNone || (with_cuts && is_cut(use))) return;
      for (const int k : edges_on(use)) {
        for (const int l : edges_on(other)) {
          if (nodes_of(EdgeUse{use.element, k}) == nodes_of(EdgeUse{other.element, l})) {
            edges.join(edge(use.element, k), edge(other.element, l));
          }
        }
      }
    });
    return edges;
  }

  std::vector<int> edges_on(FacetUse use) const {
    const std::set<Index> facet = nodes_of(use);
    std::vector<int> found;
    for (int k = 0; k < shape(use.element).edge_count; ++k) {
      const std::set<Index> ends = nodes_of(EdgeUse{use.element, k});
      if (std::includes(facet.begin(), facet.end(), ends.begin(), ends.end())) found.push_back(k);
    }
    return found;
  }

 private:
  const SmallMesh& mesh_;
  std::vector<std::vector<FacetUse>> mates_;
  std::map<FacetUse, Index> cut_;
  std::vector<int> first_corner_;
  std::vector<int> first_edge_;
  std::vector<int> part_;  ///< of each corner: the lowest corner that facets join with it in the initial mesh
  int corner_count_ = 0;
  int edge_count_ = 0;
};

inline Topology make_topology(const SmallMesh& mesh) {
  return Topology(mesh.node_count(), mesh.types, mesh.connectivity());
}

}  // namespace cdfp::test
