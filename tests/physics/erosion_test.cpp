// Elements that a material deletes leave the contact surface, and what lay behind them is met instead.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cdfp/simulation.hpp"
#include "scenes.hpp"

namespace cdfp {
namespace {

constexpr double kLayer = 1e-3;       ///< m
constexpr double kSpeed = 100;        ///< m/s, of the striker
constexpr double kDeletion = 1.5e-6;  ///< s

/// Hypoelastic; elements from `first` on are deleted at a time. State 0: alive.
UserMaterial vanishing(Index first, Index end) {
  UserMaterial m;
  m.density = 1000;
  m.states = 1;
  m.deletion_state = 0;
  m.callback = [first, end](const MaterialPoints& p) {
    const double young = 20e9, nu = 0.2;
    const double mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
    for (std::int64_t i = 0; i < p.count; ++i) {
      const double* d = p.strain_increment + i;
      const double volume = d[0] + d[p.count] + d[2 * p.count];
      for (int k = 0; k < 6; ++k)
        p.stress[k * p.count + i] += (k < 3 ? lambda * volume : 0) + 2 * mu * d[k * p.count];
      const bool goes = p.time >= kDeletion && p.elements[i] >= first && p.elements[i] < end;
      p.state[i] = goes ? 0 : 1;
    }
  };
  return m;
}

constexpr Index kAcross = 6;

/// A block strikes a plate of three layers of elements that stands on held nodes; the layers from `first` on
/// go while they are pressed.
Model struck(Index first) {
  Model model;
  scenes::add_box(model.mesh, "plate", {kAcross, kAcross, 3}, {6 * kLayer, 6 * kLayer, 3 * kLayer});
  NodeSet floor{"floor", {}};
  for (Index n = 0; n < model.mesh.node_count(); ++n) {
    if (model.mesh.coordinates[3 * n + 2] == 0) floor.nodes.push_back(n);
  }
  scenes::add_box(model.mesh, "striker", {3, 3, 3}, {2.1 * kLayer, 2.1 * kLayer, 2.1 * kLayer},
                  {1.87 * kLayer, 1.93 * kLayer, 3.1 * kLayer});
  model.mesh.node_sets.push_back(floor);
  model = scenes::with_part(std::move(model), "plate", {});
  model = scenes::with_part(std::move(model), "striker", {8000, 200e9, 0.3});
  model.materials[0].law = vanishing(first * kAcross * kAcross, 3 * kAcross * kAcross);
  model.prescribed_velocities = {{"floor", {true, true, true}, {}, {0}}};
  InitialVelocity flight;
  flight.part = "striker";
  flight.velocity = {0, 0, -kSpeed};
  model.initial_velocities = {flight};
  model.contact.surfaces = {"plate_faces", "striker_faces"};
  model.time.end = 4e-5;
  model.output.history_interval = 1;
  return model;
}

struct Seen {
  double force;   ///< N, between striker and plate
  double bottom;  ///< m, of the striker
};

class Erosion {
 public:
  explicit Erosion(Model model) : s(std::move(model)) {
    const std::vector<double>& x0 = s.model().mesh.coordinates;
    for (Index n = 4 * (kAcross + 1) * (kAcross + 1); n < s.node_count(); ++n) {
      if (x0[3 * n + 2] < 3.11 * kLayer) under_.push_back(n);
    }
  }
  Seen step() {
    s.step();
    const History& h = s.history();
    const auto column = std::find(h.columns.begin(), h.columns.end(), "contact_plate_striker_force_z_n");
    const std::size_t at = (h.rows() - 1) * h.columns.size() + std::size_t(column - h.columns.begin());
    double bottom = 1;
    for (const Index n : under_) bottom = std::min(bottom, s.positions()[3 * std::size_t(n) + 2]);
    return {std::abs(h.values[at]), bottom};
  }
  Simulation s;

 private:
  std::vector<Index> under_;
};

class LayersGo : public testing::TestWithParam<int> {};

TEST_P(LayersGo, TheStrikerMeetsTheOneBehind) {
  const Index first = GetParam();
  Erosion run(struck(first));
  double pressed = 0;
  while (run.s.time() < 0.95 * kDeletion) pressed = std::max(pressed, run.step().force);
  EXPECT_GT(pressed, 100) << "it has struck the upper face";
  while (run.s.time() < kDeletion) run.step();
  ASSERT_EQ(run.s.summary().deleted.size(), std::size_t(3 - first) * kAcross * kAcross);

  // Nodes of the deleted layers, but for those that the layer below has too, fly on as they did.
  const std::size_t lost = std::size_t(3) * (first + 1) * (kAcross + 1) * (kAcross + 1);
  const std::size_t end = std::size_t(3) * 4 * (kAcross + 1) * (kAcross + 1);
  const std::vector<double> flying(run.s.velocities().begin() + lost, run.s.velocities().begin() + end);
  Seen seen = run.step();
  EXPECT_LT(seen.bottom, 3 * kLayer) << "it had gone in";
  while (seen.bottom > first * kLayer) {
    EXPECT_EQ(seen.force, 0) << "bottom at " << seen.bottom << " m, time " << run.s.time();
    seen = run.step();
    ASSERT_LT(run.s.time(), 0.9 * run.s.model().time.end);
  }
  double most = 0;
  while (!run.s.finished()) {
    seen = run.step();
    most = std::max(most, seen.force);
    ASSERT_GT(seen.bottom, (first - 0.5) * kLayer) << "the layer behind holds it up";
  }
  EXPECT_GT(most, pressed);
  EXPECT_EQ(std::vector<double>(run.s.velocities().begin() + lost, run.s.velocities().begin() + end), flying);
  const Summary summary = run.s.summary();
  EXPECT_GT(summary.energy_balance_min, 0.99);
  EXPECT_LT(summary.energy_balance_max, 1.01);
  // The upper face and the sides of the layers went, the next layer's upper face came.
  EXPECT_EQ(summary.segments_final - summary.segments_initial, -(3 - first) * 4 * kAcross);
}

INSTANTIATE_TEST_SUITE_P(Upper, LayersGo, testing::Values(1, 2));

/// The layer in the middle goes: the upper one is pushed through the gap and strikes the lower one.
TEST(Erosion, WhatLosesItsBedFallsOnWhatIsBelow) {
  Model model = struck(1);
  model.materials[0].law = vanishing(kAcross * kAcross, 2 * kAcross * kAcross);
  Simulation s(std::move(model));
  const std::size_t upper = 3 * (2 * (kAcross + 1) * (kAcross + 1) + std::size_t(kAcross + 1) * 3 + 3) + 2;
  double lowest = 1, force = 0;
  while (!s.finished()) {
    s.step();
    lowest = std::min(lowest, s.positions()[upper]);
    const auto pairs = s.summary().contact_pairs;
    for (const Summary::ContactPair& p : pairs) {
      if (p.parts == std::array<std::string, 2>{"plate", "plate"}) force = p.deepest_penetration_m;
    }
  }
  EXPECT_LT(lowest, 1.1 * kLayer) << "the middle of the upper layer's lower face";
  EXPECT_GT(lowest, 0.6 * kLayer);
  EXPECT_GT(force, 0) << "the plate has touched itself";
  EXPECT_GT(s.summary().energy_balance_min, 0.99);
  EXPECT_LT(s.summary().energy_balance_max, 1.01);
}

TEST(Erosion, SameBitsForAnyNumberOfThreads) {
  std::vector<double> first;
  for (const int threads : {1, 3}) {
    Model model = struck(2);
    model.threads = threads;
    Simulation s(std::move(model));
    s.advance(100000);
    const std::vector<double> x(s.positions().begin(), s.positions().end());
    if (first.empty()) first = x;
    EXPECT_EQ(x, first);
  }
}

}  // namespace
}  // namespace cdfp
