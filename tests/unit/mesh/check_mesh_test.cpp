#include <gtest/gtest.h>

#include <limits>

#include "cdfp/error.hpp"
#include "cdfp/mesh.hpp"

namespace cdfp {
namespace {

/// Two unit cubes side by side along x; element 0 has nodes 0..7, node 8 .. 11 belong to element 1 only.
Mesh two_cubes() {
  Mesh mesh;
  mesh.coordinates = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1,
                      1, 1, 1, 0, 1, 1, 2, 0, 0, 2, 1, 0, 2, 0, 1, 2, 1, 1};
  mesh.types = {ElementType::hexahedron, ElementType::hexahedron};
  mesh.connectivity = {0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 9, 2, 5, 10, 11, 6};
  mesh.parts = {0, 1};
  mesh.part_names = {"left", "right"};
  mesh.node_sets = {{"corner", {0}}};
  mesh.facet_sets = {{"end", {{1, 3}}}};
  return mesh;
}

void append_element(Mesh& mesh, ElementType type, std::initializer_list<Index> corners) {
  mesh.types.push_back(type);
  mesh.connectivity.insert(mesh.connectivity.end(), corners);
  mesh.parts.push_back(0);
}

void expect_refused(const Mesh& mesh, std::initializer_list<const char*> words) {
  try {
    check_mesh(mesh);
    FAIL() << "was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_mesh);
    for (const char* word : words) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
          << "'" << word << "' is missing in: " << error.what();
    }
  }
}

TEST(CheckMesh, TakesAGoodMeshWithoutWarnings) {
  EXPECT_TRUE(check_mesh(two_cubes()).empty());
}

TEST(CheckMesh, TakesEveryBulkShape) {
  Mesh mesh;
  // A cube below, a pyramid on it, a tetrahedron on a side of the pyramid, a wedge beside the cube.
  mesh.coordinates = {0, 0, 0, 1, 0, 0, 1,   1,   0, 0,   1,  0,   0, 0,   1, 1, 0,   1,
                      1, 1, 1, 0, 1, 1, 0.5, 0.5, 2, 0.5, -1, 1.5, 2, 0.5, 0, 2, 0.5, 1};
  mesh.part_names = {"all"};
  append_element(mesh, ElementType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  append_element(mesh, ElementType::pyramid, {4, 5, 6, 7, 8});
  append_element(mesh, ElementType::tetrahedron, {4, 9, 5, 8});
  append_element(mesh, ElementType::wedge, {1, 10, 2, 5, 11, 6});
  EXPECT_TRUE(check_mesh(mesh).empty());
  std::swap(mesh.connectivity[8 + 5], mesh.connectivity[8 + 5 + 2]);
  expect_refused(mesh, {"element 2", "tetrahedron", "inverted"});
}

TEST(CheckMesh, RefusesSizesThatDisagree) {
  Mesh mesh = two_cubes();
  mesh.coordinates.pop_back();
  expect_refused(mesh, {"coordinates holds 35"});
  mesh = two_cubes();
  mesh.connectivity.pop_back();
  expect_refused(mesh, {"connectivity holds 15", "16"});
  mesh = two_cubes();
  mesh.parts.pop_back();
  expect_refused(mesh, {"parts holds 1"});
  mesh = two_cubes();
  mesh.layers = {0};
  expect_refused(mesh, {"layers holds 1"});
  expect_refused(Mesh{}, {"no elements"});
}

TEST(CheckMesh, RefusesBadNumbers) {
  Mesh mesh = two_cubes();
  mesh.coordinates[3 * 5 + 1] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(mesh, {"node 5", "coordinate y", "not a finite"});
  mesh = two_cubes();
  mesh.connectivity[9] = 12;
  expect_refused(mesh, {"element 1, corner 1", "node 12", "0 to 11"});
  mesh = two_cubes();
  mesh.connectivity[9] = -1;
  expect_refused(mesh, {"element 1, corner 1", "node -1"});
  mesh = two_cubes();
  mesh.parts[1] = 2;
  expect_refused(mesh, {"element 1", "part 2"});
  mesh = two_cubes();
  mesh.connectivity[6] = 5;
  expect_refused(mesh, {"element 0", "node 5", "corners 5 and 6"});
  mesh = two_cubes();
  mesh.types[1] = ElementType::cohesive_quadrilateral;
  expect_refused(mesh, {"element 1", "no bulk type"});
}

TEST(CheckMesh, RefusesInvertedAndFlatElements) {
  Mesh mesh = two_cubes();
  for (int i = 0; i < 4; ++i) std::swap(mesh.connectivity[i], mesh.connectivity[4 + i]);
  expect_refused(mesh, {"element 0", "part 'left'", "inverted", "corner 0", "order of its corners"});
  mesh = two_cubes();
  mesh.coordinates[3 * 11] = 0.5;  // one corner of element 1 pushed through its opposite face
  expect_refused(mesh, {"element 1", "inverted", "node 11", "(0.5, 1, 1)"});
  mesh = two_cubes();
  for (const int node : {8, 9, 10, 11}) mesh.coordinates[3 * node] = 1;
  expect_refused(mesh, {"element 1", "degenerate"});
}

TEST(CheckMesh, ThinIsNotFlat) {
  Mesh mesh = two_cubes();
  for (std::size_t n = 0; n < 12; ++n) mesh.coordinates[3 * n + 2] *= 1e-7;
  EXPECT_TRUE(check_mesh(mesh).empty());
}

TEST(CheckMesh, RefusesFacetsOfThreeElementsAndOverlaps) {
  Mesh mesh = two_cubes();
  mesh.coordinates.insert(mesh.coordinates.end(), {3, 0, 0, 3, 1, 0, 3, 0, 1, 3, 1, 1});
  append_element(mesh, ElementType::hexahedron, {1, 12, 13, 2, 5, 14, 15, 6});
  expect_refused(mesh, {"facet of nodes 1, 2, 5, 6", "elements 0, 1 and 2"});
  mesh = two_cubes();
  mesh.connectivity.erase(mesh.connectivity.begin(), mesh.connectivity.begin() + 8);
  mesh.connectivity.insert(mesh.connectivity.end(), {1, 8, 9, 2, 5, 10, 11, 6});
  expect_refused(mesh, {"elements 0 and 1", "same side", "overlap"});
}

TEST(CheckMesh, RefusesSetsOfWhatDoesNotExist) {
  Mesh mesh = two_cubes();
  mesh.node_sets[0].nodes.push_back(12);
  expect_refused(mesh, {"node set 'corner'", "node 12"});
  mesh = two_cubes();
  mesh.facet_sets[0].facets.push_back({2, 0});
  expect_refused(mesh, {"facet set 'end'", "element 2"});
  mesh = two_cubes();
  mesh.facet_sets[0].facets.push_back({1, 6});
  expect_refused(mesh, {"facet set 'end'", "element 1", "no facet 6"});
  mesh = two_cubes();
  mesh.node_sets.push_back({"corner", {}});
  expect_refused(mesh, {"two node sets", "'corner'"});
  mesh = two_cubes();
  mesh.part_names[1] = "left";
  expect_refused(mesh, {"two parts", "'left'"});
}

TEST(CheckMesh, WarnsOfUnusedAndCoincidentNodes) {
  Mesh mesh = two_cubes();
  mesh.coordinates.insert(mesh.coordinates.end(), {5, 5, 5});
  std::vector<std::string> warnings = check_mesh(mesh);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("node 12"), std::string::npos) << warnings[0];

  mesh = two_cubes();
  mesh.coordinates.insert(mesh.coordinates.end(), {1, 1, 1});
  mesh.connectivity.back() = 12;
  EXPECT_TRUE(check_mesh(mesh).empty()) << "other parts may touch there";
  mesh.parts[1] = 0;
  warnings = check_mesh(mesh);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("nodes 6 and 12 at (1, 1, 1)"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace cdfp
