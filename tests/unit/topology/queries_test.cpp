// Adjacency queries against brute force, on whole and on partly cut meshes.
#include <gtest/gtest.h>

#include "oracle.hpp"

namespace cdfp::test {
namespace {

struct Cut {
  SmallMesh mesh;
  Topology topology;
  Oracle oracle;

  Cut(SmallMesh m, double share, std::mt19937& random)
      : mesh(std::move(m)), topology(make_topology(mesh)), oracle(mesh) {
    Insertion report;
    std::vector<FacetUse> facets = oracle.inner_facets();
    std::shuffle(facets.begin(), facets.end(), random);
    facets.resize(static_cast<std::size_t>(share * static_cast<double>(facets.size())));
    for (const FacetUse use : facets) {
      topology.insert_cohesive(use, report);
      oracle.cut(use, report.cohesive_element);
    }
  }
  Cut(const Cut&) = delete;

  bool is_bulk(Index e) const { return e < mesh.element_count(); }

  /// The bulk edge that an edge of a cohesive element lies on.
  EdgeUse bulk(EdgeUse use) const {
    if (is_bulk(use.element)) return use;
    const auto ends = topology.edge_nodes(use);
    const FacetUse face{use.element, use.edge < topology.edge_count(use.element) / 2 ? 0 : 1};
    const FacetUse on = topology.mate(face);
    for (const int k : oracle.edges_on(on)) {
      const auto [a, b] = topology.edge_nodes({on.element, k});
      if (std::set{a, b} == std::set{ends[0], ends[1]}) return {on.element, k};
    }
    ADD_FAILURE() << "an edge of a cohesive element lies on no bulk edge";
    return {};
  }
};

class Queries : public testing::TestWithParam<std::tuple<unsigned, double>> {
 protected:
  std::mt19937 random{std::get<0>(GetParam())};
  double share = std::get<1>(GetParam());

  template <class Test>
  void on_meshes(Test&& test) {
    RecordProperty("seed", static_cast<int>(std::get<0>(GetParam())));
    test(Cut(shuffled(box(3, 3, 3, Cell::hexahedron), 0, random), share, random));
    test(Cut(shuffled(mixed_box(3, 3, 2, random), 0, random), share, random));
    test(Cut(shuffled(mixed_box(3, 3, 3, random), 0.35, random), share, random));
    test(Cut(shuffled(fan(40), 0, random), share, random));
  }
};
INSTANTIATE_TEST_SUITE_P(SeedsAndShares, Queries,
                         testing::Combine(testing::Values(11u, 12u), testing::Values(0.0, 0.3, 1.0)));

TEST_P(Queries, Mates) {
  on_meshes([](const Cut& cut) {
    cut.oracle.each_facet([&](FacetUse use) {
      const FacetUse mate = cut.topology.mate(use);
      if (cut.oracle.mate(use).element == kNone) {
        EXPECT_EQ(mate, FacetUse{});
        EXPECT_TRUE(cut.topology.is_boundary(use));
        return;
      }
      EXPECT_FALSE(cut.topology.is_boundary(use));
      EXPECT_EQ(cut.topology.mate(mate), use);
      if (!cut.oracle.is_cut(use)) {
        EXPECT_EQ(mate, cut.oracle.mate(use));
        return;
      }
      EXPECT_EQ(mate.element, cut.oracle.cohesive_at(use));
      EXPECT_EQ(cut.topology.mate({mate.element, 1 - mate.facet}), cut.oracle.mate(use));
    });
  });
}

TEST_P(Queries, ElementsAroundAnEdge) {
  on_meshes([](const Cut& cut) {
    UnionFind rings = cut.oracle.edges_joined(false);
    std::map<int, std::set<Index>> bulk_of_ring;
    std::map<int, std::set<Index>> cohesive_of_ring;
    std::set<int> open;
    cut.oracle.each_edge([&](EdgeUse use) {
      const int ring = rings.root(cut.oracle.edge(use.element, use.edge));
      bulk_of_ring[ring].insert(use.element);
      for (Index f = 0; f < cut.oracle.shape(use.element).facet_count; ++f) {
        const FacetUse facet{use.element, f};
        const auto edges = cut.oracle.edges_on(facet);
        if (std::find(edges.begin(), edges.end(), use.edge) == edges.end()) continue;
        if (cut.oracle.mate(facet).element == kNone) open.insert(ring);
        if (cut.oracle.is_cut(facet)) cohesive_of_ring[ring].insert(cut.oracle.cohesive_at(facet));
      }
    });

    const auto centre = [&](Index e) {
      Vec3 sum;
      for (const Index node : cut.mesh.elements[e]) sum += cut.mesh.points[node];
      return sum / static_cast<double>(cut.mesh.elements[e].size());
    };
    std::vector<EdgeUse> around;
    cut.oracle.each_edge([&](EdgeUse use) {
      const int ring = rings.root(cut.oracle.edge(use.element, use.edge));
      cut.topology.elements_around(use, around);
      std::set<Index> bulk;
      std::set<Index> cohesive;
      std::vector<Index> turn;  // the bulk elements in cyclic order
      for (const EdgeUse other : around) {
        (cut.is_bulk(other.element) ? bulk : cohesive).insert(other.element);
        if (cut.is_bulk(other.element)) turn.push_back(other.element);
        EXPECT_EQ(cut.oracle.nodes_of(cut.bulk(other)), cut.oracle.nodes_of(use));
      }
      EXPECT_EQ(bulk, bulk_of_ring[ring]);
      EXPECT_EQ(cohesive, cohesive_of_ring[ring]);
      EXPECT_EQ(around.size(), bulk.size() + cohesive.size());
      EXPECT_EQ(cut.topology.is_boundary(use), open.contains(ring));
      if (!open.contains(ring)) {
        EXPECT_EQ(around.front(), use);
      }

      // Right-handed about the edge as the use directs it.
      const auto [a, b] = cut.oracle.shape(use.element).edges[use.edge];
      const auto& corners = cut.mesh.elements[use.element];
      const Vec3 from = cut.mesh.points[corners[a]];
      const Vec3 axis = cut.mesh.points[corners[b]] - from;
      for (std::size_t i = 0; i + 1 < turn.size(); ++i) {
        EXPECT_GT(dot(axis, cross(centre(turn[i]) - from, centre(turn[i + 1]) - from)), 0);
      }

      std::vector<FacetUse> facets;
      cut.topology.facets_around(use, facets);
      EXPECT_EQ(facets.size(), around.size() + (open.contains(ring) ? 1 : 0));
      EXPECT_EQ(std::set(facets.begin(), facets.end()).size(), facets.size());
      for (const FacetUse facet : facets) {
        EXPECT_EQ(cut.topology.anchor(facet), facet);
        const auto outer = cut.oracle.nodes_of(facet);
        const auto inner = cut.oracle.nodes_of(use);
        EXPECT_TRUE(std::includes(outer.begin(), outer.end(), inner.begin(), inner.end()));
      }
      // Each element stands between the facet before it and the facet behind it.
      const std::size_t offset = open.contains(ring) ? 1 : 0;
      for (std::size_t i = 0; i < around.size(); ++i) {
        const FacetUse ahead = facets[i + offset];
        EXPECT_TRUE(ahead.element == around[i].element ||
                    cut.topology.mate(ahead).element == around[i].element);
      }
    });

    // A cohesive element's own edges find the same cycle.
    for (Index e = cut.mesh.element_count(); e < cut.topology.element_count(); ++e) {
      for (Index k = 0; k < cut.topology.edge_count(e); ++k) {
        const EdgeUse bulk = cut.bulk({e, k});
        const int ring = rings.root(cut.oracle.edge(bulk.element, bulk.edge));
        cut.topology.elements_around(EdgeUse{e, k}, around);
        EXPECT_EQ(around.size(), bulk_of_ring[ring].size() + cohesive_of_ring[ring].size());
        if (!open.contains(ring)) {
          EXPECT_EQ(around.front(), (EdgeUse{e, k}));
        }
      }
    }
  });
}

TEST_P(Queries, AroundANode) {
  on_meshes([](const Cut& cut) {
    std::map<Index, std::vector<VertexUse>> elements;
    for (Index e = 0; e < cut.topology.element_count(); ++e) {
      const auto nodes = cut.topology.nodes(e);
      for (Index c = 0; c < static_cast<Index>(nodes.size()); ++c) elements[nodes[c]].push_back({e, c});
    }
    std::map<Index, std::vector<FacetUse>> facets;
    std::set<Index> boundary;
    cut.topology.for_each_facet([&](FacetUse use) {
      const FacetNodes nodes = cut.topology.facet_nodes(use);
      for (const Index node : nodes.view()) {
        facets[node].push_back(use);
        if (cut.topology.is_boundary(use)) boundary.insert(node);
      }
    });
    std::map<Index, std::vector<EdgeUse>> edges;
    cut.topology.for_each_edge([&](EdgeUse use) {
      for (const Index node : cut.topology.edge_nodes(use)) edges[node].push_back(use);
    });

    std::vector<VertexUse> star;
    std::vector<FacetUse> facet_star;
    std::vector<EdgeUse> edge_star;
    for (Index node = 0; node < cut.topology.node_count(); ++node) {
      cut.topology.elements_around_node(node, star);
      EXPECT_EQ(star, elements[node]);
      cut.topology.facets_around_node(node, facet_star);
      EXPECT_EQ(facet_star, facets[node]);
      cut.topology.edges_around_node(node, edge_star);
      EXPECT_EQ(edge_star, edges[node]);
      EXPECT_EQ(cut.topology.is_boundary_node(node), boundary.contains(node));
    }
  });
}

TEST_P(Queries, AroundAVertexAsTheUncutMeshHadIt) {
  on_meshes([](const Cut& cut) {
    std::map<int, std::set<Index>> parts;
    cut.oracle.each_corner([&](VertexUse use) {
      const int part = cut.oracle.part(cut.oracle.corner(use.element, use.corner));
      parts[part].insert(use.element);
      for (Index f = 0; f < cut.oracle.shape(use.element).facet_count; ++f) {
        const auto corners = cut.oracle.shape(use.element).facet(f);
        if (std::find(corners.begin(), corners.end(), use.corner) == corners.end()) continue;
        if (cut.oracle.is_cut({use.element, f})) parts[part].insert(cut.oracle.cohesive_at({use.element, f}));
      }
    });
    std::vector<VertexUse> around;
    cut.oracle.each_corner([&](VertexUse use) {
      cut.topology.elements_around_vertex(use, around);
      EXPECT_EQ(around.front(), use);
      std::set<Index> found;
      for (const VertexUse other : around) found.insert(other.element);
      EXPECT_EQ(found.size(), around.size());
      EXPECT_EQ(found, parts[cut.oracle.part(cut.oracle.corner(use.element, use.corner))]);
      for (const VertexUse other : around) {
        if (!cut.is_bulk(other.element)) continue;
        EXPECT_EQ(cut.mesh.elements[other.element][other.corner], cut.mesh.elements[use.element][use.corner]);
      }
    });
  });
}

TEST_P(Queries, EachFacetEdgeAndVertexOnce) {
  on_meshes([](const Cut& cut) {
    std::vector<FacetUse> facets;
    cut.topology.for_each_facet([&](FacetUse use) { facets.push_back(use); });
    std::vector<FacetUse> expected;
    cut.oracle.each_facet([&](FacetUse use) {
      const FacetUse mate = cut.oracle.mate(use);
      const bool alone = mate.element == kNone || cut.oracle.is_cut(use);
      EXPECT_EQ(cut.topology.anchor(use), alone ? use : std::min(use, mate));
      if (alone || use < mate) expected.push_back(use);
    });
    EXPECT_EQ(facets, expected);

    UnionFind arcs = cut.oracle.edges_joined(true);
    std::vector<EdgeUse> edges;
    cut.topology.for_each_edge([&](EdgeUse use) { edges.push_back(use); });
    std::vector<EdgeUse> expected_edges;
    std::map<int, EdgeUse> anchors;
    cut.oracle.each_edge([&](EdgeUse use) {
      const int root = arcs.root(cut.oracle.edge(use.element, use.edge));
      const auto [place, is_new] = anchors.try_emplace(root, use);
      if (is_new) expected_edges.push_back(use);
      EXPECT_EQ(cut.topology.anchor(use), place->second);
    });
    EXPECT_EQ(edges, expected_edges);
    for (Index e = cut.mesh.element_count(); e < cut.topology.element_count(); ++e) {
      for (Index k = 0; k < cut.topology.edge_count(e); ++k) {
        EXPECT_EQ(cut.topology.anchor(EdgeUse{e, k}), cut.topology.anchor(cut.bulk({e, k})));
      }
      EXPECT_EQ(cut.topology.anchor(FacetUse{e, 0}), cut.topology.mate({e, 0}));
      EXPECT_EQ(cut.topology.anchor(FacetUse{e, 1}), cut.topology.mate({e, 1}));
    }

    std::set<Index> vertices;
    cut.topology.for_each_vertex([&](VertexUse use) {
      EXPECT_TRUE(vertices.insert(cut.topology.nodes(use.element)[use.corner]).second);
    });
    EXPECT_EQ(static_cast<Index>(vertices.size()),
              cut.topology.node_count() - cut.oracle.nodes_without_elements());
  });
}

// Euler's relation: vertices - edges + facets - elements = 1 for a ball.
TEST(Queries, EulerCharacteristicOfABox) {
  std::mt19937 random(5);
  const SmallMesh mesh = mixed_box(4, 3, 3, random);
  const Topology topology = make_topology(mesh);
  int characteristic = -topology.element_count();
  topology.for_each_facet([&](FacetUse) { ++characteristic; });
  topology.for_each_edge([&](EdgeUse) { --characteristic; });
  topology.for_each_vertex([&](VertexUse) { ++characteristic; });
  EXPECT_EQ(characteristic, 1);
}

TEST(Queries, AtMostEightyBytesAHexahedron) {
  const SmallMesh mesh = box(30, 30, 30, Cell::hexahedron);
  EXPECT_LE(static_cast<double>(make_topology(mesh).memory()) / mesh.element_count(), 80);
  // Mixed with other types a hexahedron pays for its place.
  SmallMesh mixed = mesh;
  mixed.points.push_back({0.5, 0.5, -1});
  mixed.add(ElementType::pyramid, {0, 31, 32, 1, mixed.node_count() - 1});
  EXPECT_LE(static_cast<double>(make_topology(mixed).memory()) / mixed.element_count(), 80);
}

}  // namespace
}  // namespace cdfp::test
