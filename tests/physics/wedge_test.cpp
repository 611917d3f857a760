// Wedges in whole simulations: a body that spins and rings, bars that meet, a rigid body.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "cdfp/simulation.hpp"
#include "cdfp/topology.hpp"
#include "core/vec3.hpp"
#include "scenes.hpp"

namespace cdfp {
namespace {

const ElasticMaterial kGlass{2500, 74e9, 0.2};

TEST(Wedges, FreeBodySpinsAndRingsWithoutLoss) {
  constexpr unsigned kSeed = 6;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> shift(-0.15e-3, 0.15e-3), kick(-1, 1);
  Model model;
  scenes::add_box(model.mesh, "body", {5, 4, 2}, {5e-3, 4e-3, 2e-3});
  for (double& x : model.mesh.coordinates) x += shift(random);
  scenes::cut_into_wedges(model.mesh, 2);
  model = scenes::with_part(std::move(model), "body", kGlass);
  // Spin about an axis through no symmetry, and a stretch that rings; half a turn.
  model.initial_velocities = {{"body", {3, -2, 1}, {800, -4000, 2000, 4000, -300, -3000, -2000, 3000, 500}}};
  model.time = {6e-4, 0, 0.9};
  Simulation s(std::move(model));
  std::vector<double> v(s.velocities().begin(), s.velocities().end());
  for (double& x : v) x += kick(random);
  s.set_velocities(v);
  const auto momenta = [&] {
    std::array<Vec3, 2> sum;
    for (std::size_t n = 0; n < s.masses().size(); ++n) {
      // Positions are half a step behind.
      const Vec3 p = s.masses()[n] * Vec3::load(&s.velocities()[3 * n]);
      sum[0] += p;
      sum[1] += cross(Vec3::load(&s.positions()[3 * n]), p);
    }
    return sum;
  };
  const auto before = momenta();
  double least = 1e300, most = 0;
  const auto total = [&] {
    const Energies e = s.energies();
    return e.kinetic + e.strain + e.hourglass;
  };
  while (!s.finished()) {
    s.advance(50);
    least = std::min(least, total());
    most = std::max(most, total());
  }
  EXPECT_GT(s.step_count(), 3000);
  const auto after = momenta();
  EXPECT_LT(norm(after[0] - before[0]), 1e-11 * norm(before[0])) << "seed " << kSeed;
  EXPECT_LT(norm(after[1] - before[1]), 1e-9 * norm(before[1]));
  EXPECT_LT(most / least - 1, 5e-3);
  EXPECT_NEAR(s.summary().energy_balance_min, 1, 5e-3);
  EXPECT_NEAR(s.summary().energy_balance_max, 1, 5e-3);
}

/// Facets that no other element has.
FacetSet outside(const Mesh& mesh) {
  FacetSet faces{"outside", {}};
  const Topology topology(mesh.node_count(), mesh.types, mesh.connectivity);
  topology.for_each_facet([&](FacetUse use) {
    if (topology.is_boundary(use)) faces.facets.push_back(use);
  });
  return faces;
}

TEST(Wedges, BarsThatMeetInTrianglesAndQuadrilateralsSwapVelocities) {
  Model model;
  const double h = 1e-3;
  Mesh right;
  scenes::add_box(model.mesh, "left", {40, 2, 2}, {40 * h, 2 * h, 2 * h});
  scenes::add_box(right, "right", {40, 2, 2}, {40 * h, 2 * h, 2 * h}, {40 * h + 1e-6, 0, 0});
  scenes::cut_into_wedges(model.mesh, 0);
  scenes::cut_into_wedges(right, 2);
  const Index half = model.mesh.node_count();
  Mesh& mesh = model.mesh;
  mesh.coordinates.insert(mesh.coordinates.end(), right.coordinates.begin(), right.coordinates.end());
  for (const Index n : right.connectivity) mesh.connectivity.push_back(half + n);
  mesh.types.insert(mesh.types.end(), right.types.begin(), right.types.end());
  mesh.parts.insert(mesh.parts.end(), right.parts.size(), 1);
  mesh.part_names.emplace_back("right");
  mesh.facet_sets = {outside(mesh)};
  const ElasticMaterial bar{2456, 74e9, 0};
  model = scenes::with_part(std::move(model), "left", bar);
  model = scenes::with_part(std::move(model), "right", bar);
  model.initial_velocities = {{"left", {3, 0, 0}, {}}};
  model.contact.surfaces = {"outside"};
  model.time = {40e-6, 0, 0.8};
  Simulation s(std::move(model));
  s.advance(1000000);
  double sum[2] = {0, 0}, mass = 0;
  for (std::size_t n = 0; n < s.masses().size(); ++n) {
    sum[static_cast<Index>(n) < half ? 0 : 1] += s.masses()[n] * s.velocities()[3 * n];
    mass += s.masses()[n] / 2;
  }
  EXPECT_NEAR((sum[0] + sum[1]) / mass, 3, 1e-11);
  EXPECT_NEAR(sum[0] / mass, 0, 0.03 * 3);
  EXPECT_NEAR(sum[1] / mass, 3, 0.03 * 3);
  EXPECT_NEAR(s.summary().energy_balance_min, 1, 0.01);
  EXPECT_NEAR(s.summary().energy_balance_max, 1, 0.01);
}

/// Half a turn of a rigid box of 4 x 2 x 1 mm about a slant axis, beside a free one of glass.
std::vector<double> after_half_a_turn(const std::function<void(Mesh&)>& cut) {
  Model model;
  scenes::add_box(model.mesh, "block", {4, 2, 2}, {4e-3, 2e-3, 1e-3});
  model.mesh.layers.clear();
  cut(model.mesh);
  Mesh glass;
  scenes::add_box(glass, "glass", {1, 1, 1}, {1e-3, 1e-3, 1e-3}, {1, 1, 1});
  const Index first = model.mesh.node_count();
  model.mesh.coordinates.insert(model.mesh.coordinates.end(), glass.coordinates.begin(),
                                glass.coordinates.end());
  for (const Index n : glass.connectivity) model.mesh.connectivity.push_back(first + n);
  model.mesh.types.push_back(ElementType::hexahedron);
  model.mesh.parts.push_back(1);
  model.mesh.part_names.push_back("glass");
  Part part;
  part.name = "block";
  part.material = "steel";
  model.parts = {part};
  model.materials = {{"steel", RigidMaterial{7850, 210e9, 0.3}}};
  model = scenes::with_part(std::move(model), "glass", kGlass);
  model.initial_velocities = {{"glass", {5, 0, 0}, {}}};
  RigidBody body;
  body.part = "block";
  body.mass = 1e-3;
  body.angular_velocity = {300, 1000, 500};
  model.rigid_bodies = {body};
  model.time = {2e-3, 1e-6, 0.9};
  Simulation s(std::move(model));
  s.advance(1000000);
  EXPECT_NEAR(s.positions()[3 * static_cast<std::size_t>(first)], 1 + 5 * s.time(), 1e-9) << "stays free";
  return {s.positions().begin(), s.positions().end()};
}

TEST(Wedges, RigidBodySpinsAsOneOfBricks) {
  const std::vector<double> bricks = after_half_a_turn([](Mesh&) {});
  for (const int upright : {0, 2}) {
    const std::vector<double> wedges =
        after_half_a_turn([&](Mesh& m) { scenes::cut_into_wedges(m, upright); });
    for (std::size_t i = 0; i < bricks.size(); ++i) EXPECT_NEAR(wedges[i], bricks[i], 1e-12);
  }
  const std::vector<double> tetrahedra = after_half_a_turn([](Mesh& mesh) {
    static constexpr int kCut[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                       {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    std::vector<Index> corners;
    for (std::size_t e = 0; e < mesh.parts.size(); ++e) {
      for (const auto& of_one : kCut) {
        for (const int c : of_one) corners.push_back(mesh.connectivity[8 * e + static_cast<std::size_t>(c)]);
      }
    }
    mesh.connectivity = corners;
    mesh.types.assign(corners.size() / 4, ElementType::tetrahedron);
    mesh.parts.assign(corners.size() / 4, 0);
    mesh.facet_sets.clear();
  });
  for (std::size_t i = 0; i < bricks.size(); ++i) EXPECT_NEAR(tetrahedra[i], bricks[i], 1e-12);
}

}  // namespace
}  // namespace cdfp
