// Cohesive insertion against union-find over element corners, after every step.
#include <gtest/gtest.h>

#include "cdfp/error.hpp"
#include "oracle.hpp"

namespace cdfp::test {
namespace {

std::vector<std::vector<Index>> all_nodes(const Topology& topology) {
  std::vector<std::vector<Index>> all;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto nodes = topology.nodes(e);
    all.emplace_back(nodes.begin(), nodes.end());
  }
  return all;
}

/// A driver's own arrays, kept up to date from the reports alone.
class Driver {
 public:
  explicit Driver(const Topology& topology)
      : nodes_(all_nodes(topology)), node_count_(topology.node_count()) {}

  void follow(const Insertion& report, const Topology& topology) {
    for (const auto& [node, mother] : report.new_nodes) {
      EXPECT_EQ(node, node_count_++);
      EXPECT_LT(mother, node);
    }
    for (const auto& r : report.renumbered) {
      EXPECT_EQ(nodes_.at(r.element).at(r.corner), r.old_node);
      EXPECT_EQ(r.old_node, mother_of(report, r.new_node));
      nodes_.at(r.element).at(r.corner) = r.new_node;
    }
    const auto nodes = topology.nodes(report.cohesive_element);
    nodes_.emplace_back(nodes.begin(), nodes.end());
    EXPECT_EQ(nodes_, all_nodes(topology));
  }

 private:
  static Index mother_of(const Insertion& report, Index node) {
    for (const auto& n : report.new_nodes) {
      if (n.node == node) return n.mother;
    }
    return kNone;
  }

  std::vector<std::vector<Index>> nodes_;
  Index node_count_;
};

void expect_classes(const Oracle& oracle, const Topology& topology) {
  UnionFind classes = oracle.node_classes();
  std::map<int, Index> node_of_class;
  std::map<Index, int> class_of_node;
  oracle.each_corner([&](VertexUse use) {
    const Index node = topology.nodes(use.element)[use.corner];
    const int root = classes.root(oracle.corner(use.element, use.corner));
    EXPECT_EQ(node_of_class.try_emplace(root, node).first->second, node);
    EXPECT_EQ(class_of_node.try_emplace(node, root).first->second, root);
  });
  EXPECT_EQ(topology.node_count(),
            static_cast<Index>(class_of_node.size()) + oracle.nodes_without_elements());
}

/// In each part that met a node before, the lowest element still names it.
void expect_lowest_keeps(const Oracle& oracle, const std::vector<std::vector<Index>>& before,
                         const Topology& topology) {
  std::set<std::pair<Index, int>> seen;
  oracle.each_corner([&](VertexUse use) {
    const Index node = before[use.element][use.corner];
    if (!seen.insert({node, oracle.part(oracle.corner(use.element, use.corner))}).second) return;
    EXPECT_EQ(topology.nodes(use.element)[use.corner], node);
  });
}

void expect_cohesive(const Oracle& oracle, FacetUse use, const Insertion& report, const Topology& topology) {
  const Index e = report.cohesive_element;
  const FacetUse lower = std::min(use, oracle.mate(use));
  const FacetUse upper = std::max(use, oracle.mate(use));
  EXPECT_EQ(report.lower, lower);
  EXPECT_EQ(report.upper, upper);
  EXPECT_EQ(topology.mate({e, 0}), upper);
  EXPECT_EQ(topology.mate({e, 1}), lower);
  EXPECT_EQ(topology.mate(upper), (FacetUse{e, 0}));
  EXPECT_EQ(topology.mate(lower), (FacetUse{e, 1}));
  const FacetNodes below = topology.facet_nodes(lower);
  EXPECT_EQ(topology.type(e),
            below.count == 4 ? ElementType::cohesive_quadrilateral : ElementType::cohesive_triangle);
  // Seen from the lower element the corners run in outward order, and each faces its copy.
  const auto nodes = topology.nodes(e);
  ASSERT_EQ(nodes.size(), 2 * static_cast<std::size_t>(below.count));
  const auto& initial = oracle.mesh().elements;
  for (Index i = 0; i < below.count; ++i) {
    EXPECT_EQ(nodes[below.count + i], below.nodes[i]);
    const Index node = initial[lower.element][oracle.shape(lower.element).facets[lower.facet][i]];
    const auto& corners = initial[upper.element];
    const auto corner = std::find(corners.begin(), corners.end(), node) - corners.begin();
    EXPECT_EQ(nodes[i], topology.nodes(upper.element)[corner]);
  }
  UnionFind edges = oracle.edges_joined(true);
  for (Index i = 0; i < below.count; ++i) {
    const EdgeUse side = topology.facet_edge(lower, i);
    for (const int k : oracle.edges_on(upper)) {
      if (oracle.nodes_of(EdgeUse{upper.element, k}) != oracle.nodes_of(side)) continue;
      const bool joined =
          edges.root(oracle.edge(side.element, side.edge)) == edges.root(oracle.edge(upper.element, k));
      EXPECT_EQ(report.split_edges[i], !joined);
    }
  }
}

void cut_everything(const SmallMesh& mesh, std::mt19937& random) {
  Topology topology = make_topology(mesh);
  Oracle oracle(mesh);
  Driver driver(topology);
  Insertion report;
  std::vector<FacetUse> facets = oracle.inner_facets();
  std::shuffle(facets.begin(), facets.end(), random);
  ASSERT_EQ(topology.check(), "");
  expect_classes(oracle, topology);
  for (FacetUse use : facets) {
    if (random() % 2 == 0) use = oracle.mate(use);
    const auto before = all_nodes(topology);
    topology.insert_cohesive(use, report);
    oracle.cut(use, report.cohesive_element);
    driver.follow(report, topology);
    expect_cohesive(oracle, use, report, topology);
    expect_lowest_keeps(oracle, before, topology);
    expect_classes(oracle, topology);
    ASSERT_EQ(topology.check(), "");
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(topology.element_count(), mesh.element_count() + static_cast<Index>(facets.size()));
}

class Insertions : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override { RecordProperty("seed", static_cast<int>(GetParam())); }
  std::mt19937 random{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Seeds, Insertions, testing::Range(1u, 5u));

TEST_P(Insertions, HexahedraMatchUnionFind) {
  cut_everything(shuffled(box(3, 3, 2, Cell::hexahedron), 0, random), random);
}
TEST_P(Insertions, TetrahedraMatchUnionFind) {
  cut_everything(shuffled(box(2, 2, 2, Cell::tetrahedra), 0, random), random);
}
TEST_P(Insertions, WedgesMatchUnionFind) {
  cut_everything(shuffled(box(3, 2, 2, Cell::wedges), 0, random), random);
}
TEST_P(Insertions, PyramidsMatchUnionFind) {
  cut_everything(shuffled(box(2, 2, 2, Cell::centre), 0, random), random);
}
TEST_P(Insertions, MixedTypesMatchUnionFind) {
  cut_everything(shuffled(mixed_box(3, 3, 2, random), 0, random), random);
}
// Missing elements leave parts that meet at an edge or a vertex only, and nodes without elements.
TEST_P(Insertions, PartsThatOnlyTouchMatchUnionFind) {
  cut_everything(shuffled(box(3, 3, 3, Cell::hexahedron), 0.4, random), random);
  cut_everything(shuffled(mixed_box(3, 3, 2, random), 0.5, random), random);
}
TEST_P(Insertions, ManyElementsAroundOneEdgeMatchUnionFind) {
  cut_everything(shuffled(fan(70), 0, random), random);
}

// Which corners share a node, and which of them keep the first number, follows from the set of facets.
TEST_P(Insertions, OrderDoesNotMatter) {
  const SmallMesh mesh = shuffled(mixed_box(3, 3, 3, random), 0.1, random);
  std::vector<FacetUse> facets = Oracle(mesh).inner_facets();
  std::shuffle(facets.begin(), facets.end(), random);
  facets.resize(facets.size() / 2);
  const auto outcome = [&] {
    Topology topology = make_topology(mesh);
    Insertion report;
    std::shuffle(facets.begin(), facets.end(), random);
    for (const FacetUse use : facets) topology.insert_cohesive(use, report);
    // Copies are renamed in the order in which corners name them.
    std::map<Index, Index> names;
    std::vector<Index> corners;
    for (Index e = 0; e < topology.bulk_count(); ++e) {
      for (const Index node : topology.nodes(e)) {
        corners.push_back(node < mesh.node_count()
                              ? node
                              : names.try_emplace(node, mesh.node_count() + static_cast<Index>(names.size()))
                                    .first->second);
      }
    }
    return corners;
  };
  const auto first = outcome();
  EXPECT_EQ(outcome(), first);
  EXPECT_EQ(outcome(), first);
}

TEST(Insertion, CutMeshFallsIntoSingleElements) {
  std::mt19937 random(3);
  for (const SmallMesh& mesh : {box(4, 3, 2, Cell::hexahedron), mixed_box(3, 3, 3, random)}) {
    Topology topology = make_topology(mesh);
    Insertion report;
    for (const FacetUse use : Oracle(mesh).inner_facets()) topology.insert_cohesive(use, report);
    EXPECT_EQ(topology.node_count(), Oracle(mesh).corner_count());
  }
}

// A layer of 2 x 2 bricks: a front, a full crack, a branch, crossing cracks.
TEST(Insertion, CrackFrontBranchAndCrossing) {
  Topology topology = make_topology(box(2, 2, 1, Cell::hexahedron));
  Insertion report;
  topology.insert_cohesive({0, 3}, report);  // between 0 and 1: the middle edge is a crack front
  EXPECT_EQ(report.new_nodes.size(), 2u);
  EXPECT_EQ(report.split_edges, (std::array<bool, 4>{true, false, true, true}));
  const auto front = topology.nodes(4);
  EXPECT_EQ(std::count_if(report.renumbered.begin(), report.renumbered.end(),
                          [](const auto& r) { return r.element == 1; }),
            2);
  int closed = 0;
  for (int i = 0; i < 4; ++i) closed += front[i] == front[i + 4];
  EXPECT_EQ(closed, 2);

  topology.insert_cohesive({2, 3}, report);  // the crack goes through
  EXPECT_EQ(report.new_nodes.size(), 4u);
  const auto behind = topology.nodes(4);
  for (int i = 0; i < 4; ++i) EXPECT_NE(behind[i], behind[i + 4]);

  topology.insert_cohesive({0, 4}, report);  // a branch
  EXPECT_EQ(report.new_nodes.size(), 4u);
  topology.insert_cohesive({1, 4}, report);  // crossing: the middle has four copies
  EXPECT_EQ(report.new_nodes.size(), 4u);
  EXPECT_EQ(topology.node_count(), 32);
}

// Inside a block a single open facet is all front: nothing comes apart.
TEST(Insertion, SingleInnerFacetDuplicatesNothing) {
  Topology topology = make_topology(box(4, 4, 4, Cell::hexahedron));
  Insertion report;
  topology.insert_cohesive({1 + 4 * (1 + 4 * 1), 3}, report);
  EXPECT_TRUE(report.new_nodes.empty());
  EXPECT_TRUE(report.renumbered.empty());
  EXPECT_EQ(report.split_edges, (std::array<bool, 4>{false, false, false, false}));
}

TEST(Insertion, RefusalsNameTheCauseAndChangeNothing) {
  std::mt19937 random(7);
  const SmallMesh mesh = mixed_box(2, 2, 2, random);
  Topology topology = make_topology(mesh);
  Insertion report;
  const std::vector<FacetUse> inner = Oracle(mesh).inner_facets();
  for (std::size_t i = 0; i < 5; ++i) topology.insert_cohesive(inner[i], report);
  FacetUse boundary;
  topology.for_each_facet([&](FacetUse use) {
    if (topology.is_boundary(use)) boundary = use;
  });

  const auto nodes = all_nodes(topology);
  const Index node_count = topology.node_count();
  const auto refused = [&](FacetUse use, const std::string& cause) {
    try {
      topology.insert_cohesive(use, report);
      ADD_FAILURE() << "not refused: " << cause;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::bad_argument);
      EXPECT_NE(std::string(error.what()).find(cause), std::string::npos) << error.what();
    }
  };
  refused(boundary, "boundary");
  refused(inner[2], "cohesive already, by element " + std::to_string(mesh.element_count() + 2));
  refused(Oracle(mesh).mate(inner[2]), "cohesive already");
  refused({mesh.element_count(), 0}, "the element is cohesive itself");
  refused({topology.element_count(), 0}, "there are");
  refused({-1, 0}, "there are");
  refused({0, 6}, "facets");
  refused({0, -1}, "facets");
  EXPECT_EQ(all_nodes(topology), nodes);
  EXPECT_EQ(topology.node_count(), node_count);
  EXPECT_EQ(topology.check(), "");
}

}  // namespace
}  // namespace cdfp::test
