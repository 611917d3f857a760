#include "cdfp/laminated_plate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "cdfp/error.hpp"
#include "core/vec3.hpp"
#include "topology/templates.hpp"

namespace cdfp {
namespace {

constexpr PlateColumns kLayouts[] = {PlateColumns::regular, PlateColumns::graded, PlateColumns::o_grid,
                                     PlateColumns::irregular};

Vec3 node_place(const Mesh& mesh, Index node) {
  return Vec3::load(&mesh.coordinates[3 * node]);
}

std::array<Vec3, 8> corners_of(const Mesh& mesh, Index element) {
  std::array<Vec3, 8> x;
  for (int i = 0; i < 8; ++i) x[i] = node_place(mesh, mesh.connectivity[8 * element + i]);
  return x;
}

/// Of the trilinear map, exact: 2 x 2 x 2 Gauss points.
double volume_of(const Mesh& mesh, Index element) {
  const auto x = corners_of(mesh, element);
  static constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const double g = 1 / std::sqrt(3.0);
  double volume = 0;
  for (const auto& at : sign) {
    std::array<Vec3, 3> jacobian{};
    for (int i = 0; i < 8; ++i) {
      double n[3];
      for (int a = 0; a < 3; ++a) n[a] = 1 + sign[i][a] * g * at[a];
      jacobian[0] += sign[i][0] * n[1] * n[2] / 8 * x[i];
      jacobian[1] += sign[i][1] * n[0] * n[2] / 8 * x[i];
      jacobian[2] += sign[i][2] * n[0] * n[1] / 8 * x[i];
    }
    volume += dot(jacobian[0], cross(jacobian[1], jacobian[2]));
  }
  return volume;
}

std::map<std::string, double> volumes(const Mesh& mesh) {
  std::map<std::string, double> sum;
  for (Index e = 0; e < mesh.element_count(); ++e) sum[mesh.part_names[mesh.parts[e]]] += volume_of(mesh, e);
  return sum;
}

std::map<std::string, Index> part_counts(const Mesh& mesh) {
  std::map<std::string, Index> count;
  for (const Index part : mesh.parts) ++count[mesh.part_names[part]];
  return count;
}

const FacetSet& facets(const Mesh& mesh, const std::string& name) {
  return *std::find_if(mesh.facet_sets.begin(), mesh.facet_sets.end(),
                       [&](auto& s) { return s.name == name; });
}

const NodeSet& nodes(const Mesh& mesh, const std::string& name) {
  return *std::find_if(mesh.node_sets.begin(), mesh.node_sets.end(), [&](auto& s) { return s.name == name; });
}

std::array<Vec3, 4> facet_corners(const Mesh& mesh, FacetUse use) {
  const auto x = corners_of(mesh, use.element);
  const auto f = element_template(ElementType::hexahedron).facet(use.facet);
  return {x[f[0]], x[f[1]], x[f[2]], x[f[3]]};
}

Vec3 area_vector(const std::array<Vec3, 4>& x) {
  return 0.5 * cross(x[2] - x[0], x[3] - x[1]);
}

Vec3 center(const std::array<Vec3, 4>& x) {
  return 0.25 * (x[0] + x[1] + x[2] + x[3]);
}

LaminatedPlate small_plate(PlateColumns layout) {
  LaminatedPlate plate;
  plate.layout = layout;
  plate.columns = 17;
  return plate;
}

TEST(LaminatedPlate, RegularColumnsGiveThePapersCounts) {
  LaminatedPlate plate;
  plate.layout = PlateColumns::regular;
  const Mesh mesh = laminated_plate_mesh(plate);
  EXPECT_EQ(mesh.element_count(), 47088);
  std::size_t segments = 0;
  for (const FacetSet& set : mesh.facet_sets) segments += set.facets.size();
  EXPECT_EQ(segments, 23839u);
  const auto count = part_counts(mesh);
  EXPECT_EQ(count.at("lower_glass"), 5 * 4489);
  EXPECT_EQ(count.at("pvb"), 4489);
  EXPECT_EQ(count.at("upper_glass"), 3 * 4489);
  EXPECT_EQ(count.at("support"), 4489);
  EXPECT_EQ(count.at("impactor"), 2198);
  EXPECT_EQ(facets(mesh, "lower_glass_faces").facets.size(), 2u * 4489 + 5 * 134);
  EXPECT_EQ(facets(mesh, "upper_glass_faces").facets.size(), 2u * 4489 + 3 * 134);
  EXPECT_EQ(facets(mesh, "support_top").facets.size(), 4489u);
  EXPECT_EQ(facets(mesh, "impactor_head").facets.size(), 322u);
  EXPECT_TRUE(check_mesh(mesh).empty());
}

TEST(LaminatedPlate, EveryLayoutIsAGoodMesh) {
  for (const PlateColumns layout : kLayouts) {
    LaminatedPlate plate;
    plate.layout = layout;
    const Mesh mesh = laminated_plate_mesh(plate);
    EXPECT_TRUE(check_mesh(mesh).empty());
    EXPECT_NEAR(part_counts(mesh).at("pvb"), 67 * 67, 0.02 * 67 * 67);
  }
}

TEST(LaminatedPlate, FillsItsGeometry) {
  for (const PlateColumns layout : kLayouts) {
    const LaminatedPlate plate = small_plate(layout);
    const auto volume = volumes(laminated_plate_mesh(plate));
    const double area = plate.half_width * plate.half_width;
    EXPECT_NEAR(volume.at("lower_glass"), area * plate.lower_glass, 1e-12 * area * plate.lower_glass);
    EXPECT_NEAR(volume.at("pvb"), area * plate.pvb, 1e-12 * area * plate.pvb);
    EXPECT_NEAR(volume.at("upper_glass"), area * plate.upper_glass, 1e-12 * area * plate.upper_glass);
    EXPECT_NEAR(volume.at("support"), area * plate.support, 1e-12 * area * plate.support);
  }
}

TEST(LaminatedPlate, ImpactorVolumeConvergesToQuarterCapsule) {
  LaminatedPlate plate = small_plate(PlateColumns::regular);
  const double r = plate.impactor_radius;
  const double exact = std::numbers::pi * r * r * (2 * r / 3 + plate.impactor_shaft) / 4;
  double error[2];
  for (const int fine : {0, 1}) {
    plate.impactor_refinement = fine ? 2 : 1;
    const double volume = volumes(laminated_plate_mesh(plate)).at("impactor");
    EXPECT_LT(volume, exact);
    error[fine] = exact - volume;
  }
  EXPECT_LT(error[0], 0.01 * exact);
  EXPECT_NEAR(error[0] / error[1], 4, 0.3);
}

TEST(LaminatedPlate, ImpactorTouchesWithItsTip) {
  LaminatedPlate plate = small_plate(PlateColumns::regular);
  plate.impactor_gap = 1e-4;
  const double top = plate.lower_glass + plate.pvb + plate.upper_glass;
  const Mesh mesh = laminated_plate_mesh(plate);
  const Vec3 sphere_center{0, 0, top + plate.impactor_gap + plate.impactor_radius};
  double lowest = 1;
  double area = 0;
  for (const FacetUse use : facets(mesh, "impactor_head").facets) {
    const auto x = facet_corners(mesh, use);
    const bool on_head = center(x).z < sphere_center.z;
    for (const Vec3& corner : x) {
      lowest = std::min(lowest, corner.z);
      const Vec3 arm = corner - (on_head ? sphere_center : Vec3{0, 0, corner.z});
      EXPECT_NEAR(norm(arm), plate.impactor_radius, 1e-15);
    }
    const Vec3 out = center(x) - (on_head ? sphere_center : Vec3{0, 0, center(x).z});
    EXPECT_GT(dot(area_vector(x), out), 0.95 * norm(area_vector(x)) * norm(out));
    area += norm(area_vector(x));
  }
  EXPECT_DOUBLE_EQ(lowest, top + plate.impactor_gap);
  const double exact =
      std::numbers::pi / 2 * plate.impactor_radius * (plate.impactor_radius + plate.impactor_shaft);
  EXPECT_NEAR(area, exact, 0.01 * exact);
}

TEST(LaminatedPlate, GlassFacetSetsAreClosedButForTheSymmetryPlanes) {
  for (const PlateColumns layout : kLayouts) {
    const LaminatedPlate plate = small_plate(layout);
    const Mesh mesh = laminated_plate_mesh(plate);
    const double w = plate.half_width;
    for (const auto& [name, bottom, thickness] :
         {std::tuple("lower_glass_faces", 0.0, plate.lower_glass),
          std::tuple("upper_glass_faces", plate.lower_glass + plate.pvb, plate.upper_glass)}) {
      std::map<std::string, double> area;
      std::set<FacetUse> seen;
      for (const FacetUse use : facets(mesh, name).facets) {
        EXPECT_TRUE(seen.insert(use).second);
        const auto x = facet_corners(mesh, use);
        const Vec3 c = center(x);
        const Vec3 a = area_vector(x);
        const double size = norm(a);
        if (c.z < bottom + 1e-9) {
          EXPECT_NEAR(a.z, -size, 1e-12 * size);
          area["bottom"] += size;
        } else if (c.z > bottom + thickness - 1e-9) {
          EXPECT_NEAR(a.z, size, 1e-12 * size);
          area["top"] += size;
        } else if (c.x == w) {
          EXPECT_NEAR(a.x, size, 1e-12 * size);
          area["rim_x"] += size;
        } else {
          EXPECT_EQ(c.y, w);
          EXPECT_NEAR(a.y, size, 1e-12 * size);
          area["rim_y"] += size;
        }
      }
      EXPECT_NEAR(area["bottom"], w * w, 1e-12 * w * w);
      EXPECT_NEAR(area["top"], w * w, 1e-12 * w * w);
      EXPECT_NEAR(area["rim_x"], w * thickness, 1e-12 * w * w);
      EXPECT_NEAR(area["rim_y"], w * thickness, 1e-12 * w * w);
    }
    double support = 0;
    for (const FacetUse use : facets(mesh, "support_top").facets) {
      EXPECT_EQ(mesh.part_names[mesh.parts[use.element]], "support");
      EXPECT_EQ(center(facet_corners(mesh, use)).z, 0);
      support += area_vector(facet_corners(mesh, use)).z;
    }
    EXPECT_NEAR(support, w * w, 1e-12 * w * w);
  }
}

TEST(LaminatedPlate, SheetsAreBondedAndSupportAndImpactorAreNot) {
  const Mesh mesh = laminated_plate_mesh(small_plate(PlateColumns::regular));
  std::vector<std::set<std::string>> parts_of_node(mesh.node_count());
  for (Index e = 0; e < mesh.element_count(); ++e) {
    for (int i = 0; i < 8; ++i) {
      parts_of_node[mesh.connectivity[8 * e + i]].insert(mesh.part_names[mesh.parts[e]]);
    }
  }
  std::map<std::set<std::string>, int> count;
  for (const auto& parts : parts_of_node) ++count[parts];
  EXPECT_EQ((count[{"lower_glass", "pvb"}]), 18 * 18);
  EXPECT_EQ((count[{"pvb", "upper_glass"}]), 18 * 18);
  EXPECT_EQ(count[{"support"}], 2 * 18 * 18);
  EXPECT_EQ(count[{"pvb"}], 0);
  EXPECT_EQ(count.count({"impactor"}), 1u);
  EXPECT_EQ(count.size(), 7u) << "other parts share nodes";
}

TEST(LaminatedPlate, NodeSetsHoldThePlanes) {
  const LaminatedPlate plate = small_plate(PlateColumns::graded);
  const Mesh mesh = laminated_plate_mesh(plate);
  const auto in_set = [&](const std::string& name) {
    return std::set<Index>(nodes(mesh, name).nodes.begin(), nodes(mesh, name).nodes.end());
  };
  const auto x = in_set("symmetry_x"), y = in_set("symmetry_y"), bottom = in_set("support_bottom");
  double nearest = 1;
  for (Index n = 0; n < mesh.node_count(); ++n) {
    const Vec3 p = node_place(mesh, n);
    EXPECT_EQ(x.count(n), p.x == 0 ? 1u : 0u);
    EXPECT_EQ(y.count(n), p.y == 0 ? 1u : 0u);
    EXPECT_EQ(bottom.count(n), p.z == -plate.support ? 1u : 0u);
    if (p.x != 0) nearest = std::min(nearest, std::abs(p.x));
  }
  EXPECT_GT(nearest, 1e-5) << "a node that misses the symmetry plane by rounding";
}

TEST(LaminatedPlate, LayersCountFromTheBottomOfEachPart) {
  const LaminatedPlate plate = small_plate(PlateColumns::regular);
  const Mesh mesh = laminated_plate_mesh(plate);
  ASSERT_EQ(mesh.layers.size(), mesh.types.size());
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const double z = corners_of(mesh, e)[0].z;
    const std::string& part = mesh.part_names[mesh.parts[e]];
    if (part == "lower_glass") {
      EXPECT_EQ(mesh.layers[e], std::lround(z / 0.5e-3));
    }
    if (part == "upper_glass") {
      EXPECT_EQ(mesh.layers[e], std::lround((z - 3.26e-3) / (2.5e-3 / 3)));
    }
    if (part == "pvb" || part == "support") {
      EXPECT_EQ(mesh.layers[e], 0);
    }
  }
}

TEST(LaminatedPlate, RefusesBadParameters) {
  const auto refused = [](auto&& change, const char* word) {
    LaminatedPlate plate;
    change(plate);
    try {
      laminated_plate_mesh(plate);
      ADD_FAILURE() << word << " was not refused";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused([](LaminatedPlate& p) { p.half_width = 0; }, "half_width");
  refused([](LaminatedPlate& p) { p.pvb = std::nan(""); }, "pvb");
  refused([](LaminatedPlate& p) { p.upper_layers = 0; }, "layers");
  refused([](LaminatedPlate& p) { p.columns = 1; }, "columns");
  refused([](LaminatedPlate& p) { p.impactor_gap = -1e-6; }, "impactor_gap");
  refused([](LaminatedPlate& p) { p.impactor_refinement = 0; }, "impactor_refinement");
}

}  // namespace
}  // namespace cdfp
