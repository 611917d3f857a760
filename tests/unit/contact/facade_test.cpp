// Contact of a model: the laminated plate's surfaces, and cracks that open in a topology.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>

#include "cdfp/error.hpp"
#include "cdfp/laminated_plate.hpp"
#include "contact/contact.hpp"
#include "core/archive.hpp"

namespace {

using namespace cdfp;

Material glass() {
  return {"glass", ElasticMaterial{2500, 74e9, 0.2}};
}

Model plate_model(Index columns, PlateColumns layout) {
  Model model;
  LaminatedPlate plate;
  plate.columns = columns;
  plate.layout = layout;
  model.mesh = laminated_plate_mesh(plate);
  model.materials = {glass(),
                     {"rubber", ElasticMaterial{1200, 42e6, 0.49}},
                     {"pvb", RateDependentMaterial{1000, 0.49, 5.88e6, 29.21e6, 0.176, 1e-6}},
                     {"steel", RigidMaterial{7850, 210e9, 0.27}}};
  model.parts = {{.name = "lower_glass", .material = "glass", .cohesive_law = ""},
                 {.name = "upper_glass", .material = "glass", .cohesive_law = ""},
                 {.name = "pvb", .material = "pvb", .cohesive_law = ""},
                 {.name = "support", .material = "rubber", .cohesive_law = ""},
                 {.name = "impactor", .material = "steel", .cohesive_law = ""}};
  model.contact.surfaces = {"lower_glass_faces", "upper_glass_faces", "support_top", "impactor_head"};
  return model;
}

Nodes nodes_of(const Model& model) {
  Nodes nodes(model.mesh.coordinates);
  std::fill(nodes.mass.begin(), nodes.mass.end(), 1e-6);
  return nodes;
}

TEST(Facade, PlateHasThePapersSegmentsAndIsQuietAtRest) {
  const Model model = plate_model(67, PlateColumns::regular);
  const Topology topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
  Contact contact(model, topology);
  EXPECT_EQ(contact.segment_count(), 23839);
  Nodes nodes = nodes_of(model);
  const Threads threads(2);
  for (int step = 0; step < 3; ++step) {
    if (contact.due(nodes, 6e-8) == Contact::Search::regular) contact.regular_search(nodes, threads);
    contact.local_search(nodes, threads);
    contact.add_force(nodes, 6e-8, threads);
  }
  EXPECT_GT(contact.pair_count(), 10000u) << "the plate lies on its support";
  EXPECT_EQ(contact.touching_count(), 0u);
  for (const double force : nodes.force) ASSERT_EQ(force, 0.0);
}

/// A block of bricks in which facets are split one after the other and their faces come free.
class Cracking : public testing::TestWithParam<unsigned> {
 protected:
  static Model block(Index n) {
    Model model;
    const Index m = n + 1;
    const double h = 1e-3;
    for (Index k = 0; k < m; ++k) {
      for (Index j = 0; j < m; ++j) {
        for (Index i = 0; i < m; ++i) {
          model.mesh.coordinates.insert(model.mesh.coordinates.end(), {i * h, j * h, k * h});
        }
      }
    }
    for (Index k = 0; k < n; ++k) {
      for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
          const Index a = i + m * (j + m * k), b = a + m * m;
          model.mesh.types.push_back(ElementType::hexahedron);
          model.mesh.connectivity.insert(model.mesh.connectivity.end(),
                                         {a, a + 1, a + m + 1, a + m, b, b + 1, b + m + 1, b + m});
        }
      }
    }
    model.mesh.parts.assign(model.mesh.types.size(), 0);
    model.mesh.part_names = {"block"};
    model.materials = {glass()};
    model.parts = {{.name = "block", .material = "glass", .cohesive_law = ""}};
    model.contact.surfaces = {"outside"};
    const Topology topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
    FacetSet outside{"outside", {}};
    for (Index e = 0; e < model.mesh.element_count(); ++e) {
      for (Index f = 0; f < 6; ++f) {
        if (topology.mate({e, f}).element == kNone) outside.facets.push_back({e, f});
      }
    }
    model.mesh.facet_sets = {outside};
    return model;
  }
};

TEST_P(Cracking, FacesThatComeFreeStayQuietAndAreFoundAsByARegularSearch) {
  std::mt19937 random(GetParam());
  RecordProperty("seed", static_cast<int>(GetParam()));
  Model model = block(4);
  Topology topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
  Contact contact(model, topology);
  Nodes nodes = nodes_of(model);
  const Threads threads(1);
  std::vector<FacetUse> inner;
  for (Index e = 0; e < topology.bulk_count(); ++e) {
    for (Index f = 0; f < 6; ++f) {
      if (topology.mate({e, f}).element > e) inner.push_back({e, f});
    }
  }
  std::shuffle(inner.begin(), inner.end(), random);
  ASSERT_EQ(contact.due(nodes, 6e-8), Contact::Search::regular);
  contact.regular_search(nodes, threads);
  EXPECT_EQ(contact.segment_count(), 6 * 16);
  Insertion report;
  Index segments = contact.segment_count();
  std::size_t at = 0;
  while (at < inner.size()) {
    std::vector<FacetUse> free;
    for (const std::size_t end = std::min(inner.size(), at + 1 + random() % 5); at < end; ++at) {
      topology.insert_cohesive(inner[at], report);
      for (const Insertion::NewNode& node : report.new_nodes) {
        ASSERT_EQ(nodes.clone(node.mother, model.mesh.coordinates), node.node);
        nodes.mass[node.mother] *= 0.5;
        nodes.mass[node.node] = nodes.mass[node.mother];
      }
      contact.follow(report);
      free.push_back(report.lower);
      free.push_back(report.upper);
    }
    contact.add_segments(free, topology, nodes);
    segments += static_cast<Index>(free.size());
    const Contact::Search due = contact.due(nodes, 6e-8);
    if (due == Contact::Search::regular) {
      contact.regular_search(nodes, threads);
    } else {
      ASSERT_EQ(due, Contact::Search::adaptive);
      contact.adaptive_search(nodes);
    }
    contact.local_search(nodes, threads);
    contact.add_force(nodes, 6e-8, threads);
  }
  EXPECT_EQ(contact.segment_count(), segments);
  EXPECT_EQ(segments, 6 * 64) << "every brick on its own";
  for (const double force : nodes.force) ASSERT_EQ(force, 0.0);
  const std::size_t adaptive = contact.pair_count();
  contact.regular_search(nodes, threads);
  EXPECT_EQ(contact.pair_count(), adaptive);
  EXPECT_GT(adaptive, 1000u);

  // Closing faces push each other apart: the block's halves are pressed together.
  for (Index e = 0; e < topology.bulk_count(); ++e) {
    const double push = e % 4 < 2 ? 1.0 : -1.0;
    for (const Index node : topology.nodes(e)) nodes.velocity[3 * node] = push;
  }
  for (int step = 0; step < 3; ++step) {
    for (std::size_t i = 0; i < nodes.position.size(); ++i) nodes.position[i] += 6e-8 * nodes.velocity[i];
    if (contact.due(nodes, 6e-8) == Contact::Search::regular) contact.regular_search(nodes, threads);
    contact.local_search(nodes, threads);
    contact.add_force(nodes, 6e-8, threads);
  }
  double left = 0, right = 0;
  for (Index e = 0; e < topology.bulk_count(); ++e) {
    for (const Index node : topology.nodes(e)) (e % 4 < 2 ? left : right) += nodes.force[3 * node];
  }
  EXPECT_GT(contact.energy().stored, 0.0);
  EXPECT_LT(left, 0.0);
  EXPECT_NEAR(left, -right, 1e-12 * right);
  EXPECT_NEAR(contact.deepest_penetration(), 3 * 6e-8 * 2, 1e-12);
}
/// Pairs of living nodes and faces by name: (node, four corners).
std::set<std::array<Index, 5>> living_pairs(const SurfaceContact& contact, const std::set<Index>& living) {
  std::set<std::array<Index, 5>> pairs;
  for (Index row = 0; row < contact.node_count(); ++row) {
    const Index node = contact.nodes()[row];
    if (!living.contains(node)) continue;
    contact.search().node_segments().for_each(row, [&](Index segment) {
      const Index* c = &contact.segments()[4 * static_cast<std::size_t>(segment)];
      if (c[1] != c[2]) pairs.insert({node, c[0], c[1], c[2], c[3]});
    });
  }
  return pairs;
}

/// Bricks are taken out of a block in any order: what is left has the pairs of a block that never had them,
/// and the nodes of what was taken out touch nothing wherever they go.
TEST_P(Cracking, BricksThatAreTakenOutLeaveThePairsOfTheRest) {
  std::mt19937 random(GetParam());
  RecordProperty("seed", static_cast<int>(GetParam()));
  const Model model = block(4);
  const Topology topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
  const std::vector<double> bulk{40e9};
  const SurfaceContact::FacetSource source{topology, model.mesh.coordinates, model.mesh.parts, bulk};
  Nodes nodes = nodes_of(model);
  std::vector<Index> order(topology.bulk_count());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<bool> gone(order.size(), false);
  const auto is_free = [&](FacetUse use) {
    const Index mate = topology.mate(use).element;
    return !gone[use.element] && (mate == kNone || gone[mate]);
  };
  SurfaceContact contact(model.contact);
  contact.add_facets(source, model.mesh.facet_sets[0].facets);
  const SurfaceContact::Arrays arrays{nodes.position, nodes.velocity, nodes.mass, {}, nodes.force};
  for (std::size_t at = 0; at + 4 < order.size(); ++at) {
    const SurfaceContact::Search due = contact.due(arrays, 6e-8);
    if (due == SurfaceContact::Search::regular) contact.regular_search(arrays);
    if (due == SurfaceContact::Search::adaptive) contact.adaptive_search(arrays);
    contact.local_search(arrays);
    contact.add_force(arrays, 6e-8);
    ASSERT_EQ(contact.touching_count(), 0u) << at;

    SurfaceContact afresh(model.contact);
    std::set<Index> living;
    for (Index e = 0; e < topology.bulk_count(); ++e) {
      for (Index f = 0; f < 6; ++f) {
        if (!is_free({e, f})) continue;
        afresh.add_facets(source, std::array{FacetUse{e, f}});
        const FacetNodes corners = topology.facet_nodes({e, f});
        living.insert(corners.nodes.begin(), corners.nodes.end());
      }
    }
    ASSERT_EQ(contact.segment_count() - contact.removed_count(), afresh.segment_count()) << at;
    afresh.regular_search(arrays);
    ASSERT_EQ(living_pairs(contact, living), living_pairs(afresh, living)) << at;

    if (random() % 4 == 0) {  // a saved one that goes on in its place
      Archive saved;
      contact.archive(saved);
      SurfaceContact restored(model.contact);
      Archive read(saved.bytes());
      restored.archive(read);
      contact = std::move(restored);
    }

    // A lost node in the middle of a brick that is left would be deep inside.
    for (Index n = 0; n < nodes.count(); ++n) {
      const bool lost = std::none_of(order.begin(), order.end(), [&](Index e) {
        const auto corners = topology.nodes(e);
        return !gone[e] && std::find(corners.begin(), corners.end(), n) != corners.end();
      });
      if (lost) std::copy_n(std::array{1.5e-3, 1.5e-3, 2.95e-3}.begin(), 3, &nodes.position[3 * n]);
    }
    const Index e = order[at];
    gone[e] = true;
    contact.remove_element(e);
    for (Index f = 0; f < 6; ++f) {
      const FacetUse mate = topology.mate({e, f});
      if (mate.element != kNone && !gone[mate.element]) contact.add_facets(source, std::array{mate});
    }
  }
  EXPECT_GT(contact.removed_count(), 100);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Cracking, testing::Range(1u, 6u));

TEST(Facade, NamesTheEntryThatIsWrong) {
  Model model = plate_model(6, PlateColumns::regular);
  const Topology topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
  model.contact.surfaces.push_back("roof");
  try {
    const Contact contact(model, topology);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_argument);
    EXPECT_NE(std::string(error.what()).find("roof"), std::string::npos);
  }
}

}  // namespace
