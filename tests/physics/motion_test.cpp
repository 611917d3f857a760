// Free motion, waves, impact: whole simulations against exact values.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cdfp/error.hpp"
#include "cdfp/simulation.hpp"
#include "core/vec3.hpp"
#include "scenes.hpp"

namespace cdfp {
namespace {

const ElasticMaterial kGlass{2500, 74e9, 0.2};

Vec3 sum_of_momentum(const Simulation& s) {
  Vec3 p;
  for (Index n = 0; n < s.node_count(); ++n)
    p += s.masses()[n] * Vec3::load(&s.velocities()[3 * std::size_t(n)]);
  return p;
}

TEST(Motion, FreeFallIsTheParabola) {
  Model model;
  scenes::add_box(model.mesh, "block", {3, 2, 2}, {3e-3, 2e-3, 2e-3});
  model = scenes::with_part(std::move(model), "block", kGlass);
  model.gravity = {0, 0, -9.81};
  model.initial_velocities = {{"block", {1, 0, 2}, {}}};
  model.time = {1e-4, 5e-8, 0.9};
  Simulation s(std::move(model));
  const std::vector<double> start(s.positions().begin(), s.positions().end());
  s.advance(2000);
  const double t = s.time();
  EXPECT_NEAR(t, 1e-4, 1e-12);
  for (std::size_t i = 0; i < start.size(); i += 3) {
    EXPECT_NEAR(s.positions()[i] - start[i], t, 1e-13);
    EXPECT_NEAR(s.positions()[i + 2] - start[i + 2], 2 * t - 0.5 * 9.81 * t * t, 1e-13);
  }
  EXPECT_NEAR(s.energies().balance(), 1, 1e-9);
}

/// A bar between side walls that hold it (dilatational speed) or free with nu = 0 (bar speed); one end is
/// pushed.
double measured_wave_speed(double nu, bool held) {
  Model model;
  const double h = 1e-3;
  scenes::add_box(model.mesh, "bar", {200, 1, 1}, {200 * h, h, h});
  model = scenes::with_part(std::move(model), "bar", {2500, 74e9, nu});
  if (held) model.symmetry_planes = {{1, 0}, {1, h}, {2, 0}, {2, h}};
  model.prescribed_velocities = {{"bar_low_x", {true, false, false}, {0, 2e-6}, {0, 0.1}}};
  model.time = {40e-6, 0, 0.9};
  Simulation s(std::move(model));
  const std::size_t near = 3 * 50;
  const std::size_t far = 3 * 150;
  double t_near = 0;
  double t_far = 0;
  while (!s.finished() && t_far == 0) {
    s.step();
    if (t_near == 0 && s.velocities()[near] > 0.05) t_near = s.time();
    if (t_far == 0 && s.velocities()[far] > 0.05) t_far = s.time();
  }
  EXPECT_NEAR(s.energies().balance(), 1, 2e-3);
  return 100 * h / (t_far - t_near);
}

TEST(Motion, BarWaveSpeed) {
  EXPECT_NEAR(measured_wave_speed(0, false), std::sqrt(74e9 / 2500), 0.005 * 5440.6);
  EXPECT_NEAR(measured_wave_speed(0.2, true), 5734.9, 0.005 * 5734.9);
}

TEST(Motion, EqualBarsSwapVelocities) {
  Model model;
  const double h = 1e-3;
  scenes::add_box(model.mesh, "left", {40, 2, 2}, {40 * h, 2 * h, 2 * h});
  scenes::add_box(model.mesh, "right", {40, 2, 2}, {40 * h, 2 * h, 2 * h}, {40 * h + 1e-6, 0, 0});
  const ElasticMaterial bar{2456, 74e9, 0};
  model = scenes::with_part(std::move(model), "left", bar);
  model = scenes::with_part(std::move(model), "right", bar);
  model.initial_velocities = {{"left", {3, 0, 0}, {}}};
  model.contact.surfaces = {"left_faces", "right_faces"};
  model.time = {40e-6, 0, 0.8};
  Simulation s(std::move(model));
  const Vec3 before = sum_of_momentum(s);
  s.advance(1000000);
  const Vec3 after = sum_of_momentum(s);
  EXPECT_NEAR(norm(after - before), 0, 1e-12 * norm(before));
  // Rigid-body velocities of the two bars.
  const Index half = s.node_count() / 2;
  Vec3 left;
  Vec3 right;
  double mass = 0;
  for (Index n = 0; n < half; ++n) {
    left += s.masses()[n] * Vec3::load(&s.velocities()[3 * std::size_t(n)]);
    right += s.masses()[n + half] * Vec3::load(&s.velocities()[3 * std::size_t(n + half)]);
    mass += s.masses()[n];
  }
  EXPECT_NEAR(left.x / mass, 0, 0.03 * 3);
  EXPECT_NEAR(right.x / mass, 3, 0.03 * 3);
  const Summary summary = s.summary();
  EXPECT_NEAR(summary.energy_balance_min, 1, 0.01);
  EXPECT_NEAR(summary.energy_balance_max, 1, 0.01);
}

TEST(Motion, RigidBodySpinsFreely) {
  Model model;
  scenes::add_box(model.mesh, "block", {2, 2, 2}, {2e-3, 2e-3, 2e-3});
  Part part;
  part.name = "block";
  part.material = "steel";
  model.parts = {part};
  model.materials = {{"steel", RigidMaterial{7850, 210e9, 0.3}}};
  scenes::add_box(model.mesh, "far", {1, 1, 1}, {1e-3, 1e-3, 1e-3}, {1, 1, 1});
  model = scenes::with_part(std::move(model), "far", kGlass);
  RigidBody body;
  body.part = "block";
  body.mass = 1e-3;
  body.velocity = {1, 2, 3};
  body.angular_velocity = {0, 0, 1000};
  model.rigid_bodies = {body};
  model.time = {std::numbers::pi / 1000, 1e-7, 0.9};
  Simulation s(std::move(model));
  const double energy = s.energies().kinetic;
  s.advance(1000000);
  const double t = s.time();
  // Half a turn: the corner at (-1,-1,-1) mm of the centre comes to (1, 1, -1) mm.
  EXPECT_NEAR(s.positions()[0],
              1e-3 + t + 1e-3 * std::cos(1000 * t - 3 * std::numbers::pi / 4) * std::sqrt(2), 1e-9);
  EXPECT_NEAR(s.positions()[1],
              1e-3 + 2 * t + 1e-3 * std::sin(1000 * t - 3 * std::numbers::pi / 4) * std::sqrt(2), 1e-9);
  EXPECT_NEAR(s.energies().kinetic, energy, 1e-10 * energy);
}

TEST(Motion, RefusesWhatCannotBe) {
  const auto message_of = [](Model model) {
    try {
      Simulation s(std::move(model));
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  Model model;
  scenes::add_box(model.mesh, "block", {1, 1, 1}, {1e-3, 1e-3, 1e-3});
  model = scenes::with_part(std::move(model), "block", kGlass);
  model.time.end = 1e-6;
  EXPECT_EQ(message_of(model), "accepted");
  Model bad = model;
  bad.parts[0].material = "glas";
  EXPECT_NE(message_of(bad).find("'glas'"), std::string::npos);
  EXPECT_NE(message_of(bad).find("'block'"), std::string::npos);
  bad = model;
  bad.materials[0].law = ElasticMaterial{2500, 74e9, 0.5};
  EXPECT_NE(message_of(bad).find("poissons_ratio"), std::string::npos);
  bad = model;
  bad.contact.surfaces = {"nowhere"};
  EXPECT_NE(message_of(bad).find("'nowhere'"), std::string::npos);
  bad = model;
  bad.parts.clear();
  EXPECT_NE(message_of(bad).find("no definition"), std::string::npos);
  bad = model;
  bad.time.end = 0;
  EXPECT_NE(message_of(bad).find("time: end"), std::string::npos);
}

}  // namespace
}  // namespace cdfp
