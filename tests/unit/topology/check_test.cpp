// What a topology refuses to be built from, and what its check finds.
#include <gtest/gtest.h>

#include <functional>

#include "cdfp/error.hpp"
#include "oracle.hpp"
#include "topology/insertion.hpp"
#include "topology/store.hpp"

namespace cdfp::test {
namespace {

void expect_bad_mesh(const SmallMesh& mesh, const std::string& cause) {
  try {
    make_topology(mesh);
    ADD_FAILURE() << "not refused: " << cause;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_mesh);
    EXPECT_NE(std::string(error.what()).find(cause), std::string::npos) << error.what();
  }
}

TEST(Build, RefusesNodesOutOfRange) {
  SmallMesh mesh = box(2, 1, 1, Cell::hexahedron);
  mesh.elements[1][5] = mesh.node_count();
  expect_bad_mesh(mesh, "corner 5 of element 1 names node 12");
  mesh.elements[1][5] = -1;
  expect_bad_mesh(mesh, "corner 5 of element 1 names node -1");
}

TEST(Build, RefusesRepeatedCorners) {
  SmallMesh mesh = box(2, 1, 1, Cell::hexahedron);
  mesh.elements[1][5] = mesh.elements[1][1];
  expect_bad_mesh(mesh, "element 1 names node 2 twice");
}

TEST(Build, RefusesThreeElementsAtAFacet) {
  SmallMesh mesh = box(2, 1, 1, Cell::tetrahedra);
  const Oracle oracle(mesh);
  const FacetUse inner = oracle.inner_facets()[0];
  mesh.points.push_back({9, 9, 9});
  const FacetNodes facet = make_topology(mesh).facet_nodes(inner);
  mesh.add(ElementType::tetrahedron, {facet.nodes[0], facet.nodes[1], facet.nodes[2], mesh.node_count() - 1});
  expect_bad_mesh(mesh, "at most two elements may share a facet");
  expect_bad_mesh(mesh, "facet 0 of element " + std::to_string(mesh.element_count() - 1));
}

TEST(Build, RefusesInvertedNeighbours) {
  SmallMesh mesh = box(2, 1, 1, Cell::hexahedron);
  auto& c = mesh.elements[1];
  c = {c[4], c[5], c[6], c[7], c[0], c[1], c[2], c[3]};
  expect_bad_mesh(mesh, "in the same sense");
}

TEST(Build, RefusesWrongSizesAndCohesiveTypes) {
  SmallMesh mesh = box(2, 1, 1, Cell::hexahedron);
  mesh.types[1] = ElementType::wedge;
  expect_bad_mesh(mesh, "16 corners where the types of the elements need 14");
  mesh.types[1] = ElementType::cohesive_quadrilateral;
  expect_bad_mesh(mesh, "element 1 is not of a bulk type");
}

// All facets of many elements with the same lowest node fall into one bucket.
TEST(Build, PairsFacetsOfAFullBucket) {
  const SmallMesh mesh = fan(300);
  EXPECT_EQ(make_topology(mesh).check(), "");
  EXPECT_EQ(Oracle(mesh).inner_facets().size(), 300u);
  int boundary = 0;
  const Topology topology = make_topology(mesh);
  topology.for_each_facet([&](FacetUse use) { boundary += topology.is_boundary(use); });
  EXPECT_EQ(boundary, 600);
}

TEST(Build, AcceptsNoElements) {
  Topology topology(3, {}, {});
  EXPECT_EQ(topology.check(), "");
  EXPECT_EQ(topology.node_count(), 3);
  EXPECT_EQ(topology.anchor(1), VertexUse{});
}

class Check : public testing::Test {
 protected:
  Check() : mesh(box(2, 2, 1, Cell::hexahedron)), store(mesh.node_count(), mesh.types, mesh.connectivity()) {
    Inserter inserter;
    Insertion report;
    inserter.insert(store, {0, 3}, report);
    inserter.insert(store, {2, 3}, report);
    EXPECT_EQ(check(store), "");
  }
  void expect_found(const std::string& violation) {
    EXPECT_NE(check(store).find(violation), std::string::npos) << "found: " << check(store);
  }

  SmallMesh mesh;
  TopologyStore store;
};

TEST_F(Check, FindsANodeOutOfRange) {
  store.mutable_nodes(3)[2] = 1000;
  expect_found("corner 2 of element 3 names node 1000");
}
TEST_F(Check, FindsARepeatedNode) {
  store.mutable_nodes(3)[2] = store.mutable_nodes(3)[5];
  expect_found("corners 2 and 5 of element 3");
}
TEST_F(Check, FindsAOneSidedMate) {
  store.mutable_mates(0)[4] = kNone;
  expect_found("facet 2 of element 2 has as its mate facet 4 of element 0, which has another");
}
TEST_F(Check, FindsAMissingMate) {
  store.mutable_mates(1)[5] = kNone;
  store.mutable_mates(4)[0] = kNone;
  expect_found("facet 0 of element 4 has a mate that does not exist");
}
TEST_F(Check, FindsFacesThatDisagree) {
  store.mutable_nodes(4)[0] = store.mutable_nodes(4)[4];
  expect_found("do not have the same nodes in opposite orders");
}
TEST_F(Check, FindsACohesiveElementUpsideDown) {
  const FacetUse upper{element_of(store.view(4).mates[0]), local_of(store.view(4).mates[0])};
  const FacetUse lower{element_of(store.view(4).mates[1]), local_of(store.view(4).mates[1])};
  Index* nodes = store.mutable_nodes(4);
  std::swap_ranges(nodes, nodes + 4, nodes + 4);
  std::swap(nodes[1], nodes[3]);
  std::swap(nodes[5], nodes[7]);
  std::swap(store.mutable_mates(4)[0], store.mutable_mates(4)[1]);
  store.mutable_mates(upper.element)[upper.facet] = pack(4, 1);
  store.mutable_mates(lower.element)[lower.facet] = pack(4, 0);
  expect_found("the upper face of cohesive element 4 belongs to the bulk element with the smaller number");
}
TEST_F(Check, FindsAMisplacedAnchor) {
  store.anchors[store.view(2).nodes[0]] = pack(2, 0);
  expect_found("is anchored at element 2, but element 0 of the same part is lower");
  store.anchors[store.view(2).nodes[0]] = pack(2, 1);
  expect_found("is anchored at corner 1 of element 2, which does not name it");
}
TEST_F(Check, FindsANodeThatShouldHaveComeApart) {
  // Join the halves again by name only.
  const Index kept = store.view(0).nodes[1];
  const Index copy = store.view(1).nodes[0];
  ASSERT_NE(kept, copy);
  for (Index e = 0; e < store.element_count(); ++e) {
    for (Index c = 0; c < store.view(e).shape->corner_count; ++c) {
      if (store.view(e).nodes[c] == copy) store.mutable_nodes(e)[c] = kept;
    }
  }
  expect_found("node " + std::to_string(kept) + " is named by 2 elements, but only 1 are connected");
}

}  // namespace
}  // namespace cdfp::test
