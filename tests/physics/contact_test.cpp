// Contact in whole simulations: the blocks of Chen, Zang, Xu 2015 (section 6.2), a block that slides to rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "blocks/blocks.hpp"
#include "cdfp/simulation.hpp"
#include "core/vec3.hpp"
#include "hertz.hpp"
#include "scenes.hpp"

namespace cdfp {
namespace {

Vec3 place(const Simulation& s, Index n) {
  return Vec3::load(&s.positions()[3 * std::size_t(n)]);
}
Vec3 momentum(const Simulation& s, Index n) {
  return s.masses()[n] * Vec3::load(&s.velocities()[3 * std::size_t(n)]);
}

/// The nodes of one part.
struct Body {
  Index first, end;

  Body(const Simulation& s, const std::string& name) : first(s.node_count()), end(0) {
    const Mesh& mesh = s.model().mesh;
    const auto part =
        std::find(mesh.part_names.begin(), mesh.part_names.end(), name) - mesh.part_names.begin();
    for (std::size_t e = 0; e < mesh.parts.size(); ++e) {
      if (mesh.parts[e] != part) continue;
      for (std::size_t c = 8 * e; c < 8 * e + 8; ++c) {
        first = std::min(first, mesh.connectivity[c]);
        end = std::max(end, mesh.connectivity[c] + 1);
      }
    }
  }
  template <class Of>
  Vec3 sum(const Of& of) const {
    Vec3 all;
    for (Index n = first; n < end; ++n) all += of(n);
    return all;
  }
  /// Internal forces sum to zero: what is left is contact.
  Vec3 contact_force(const Simulation& s) const {
    return sum([&](Index n) { return Vec3::load(&s.forces()[3 * std::size_t(n)]); });
  }
  Vec3 total_momentum(const Simulation& s) const {
    return sum([&](Index n) { return momentum(s, n); });
  }
  double mass(const Simulation& s) const {
    double all = 0;
    for (Index n = first; n < end; ++n) all += s.masses()[n];
    return all;
  }
  Vec3 spin(const Simulation& s) const {
    const Vec3 center = sum([&](Index n) { return s.masses()[n] * place(s, n); }) / mass(s);
    return sum([&](Index n) { return cross(place(s, n) - center, momentum(s, n)); });
  }
};

/// A time of touching.
struct Episode {
  double begin = 0, end = 0;
  Index nodes_inside = 0;  ///< of either body in the other, the most
};

TEST(Blocks, EdgeMeetsEdgeThenTheBlockTurnsAndACornerMeetsAFace) {
  Model model = blocks::case_1();
  model.output.history_interval = 1;
  const double side = 4e-3;
  const Vec3 thrown{-3, 0, -3};
  Simulation s(std::move(model));
  const Body held(s, "held"), flying(s, "flying");
  const double mass = flying.mass(s), scale = mass * norm(thrown);

  // The flying block's own axes, by its corners: elements are numbered along x, then y, then z.
  const Index n = 5;
  const auto inside_flying = [&](Vec3 p) {
    const Vec3 origin = place(s, flying.first);
    for (const Index far : {n - 1, n * (n - 1), n * n * (n - 1)}) {
      const Vec3 along = place(s, flying.first + far) - origin;
      const double share = dot(p - origin, along) / dot(along, along);
      if (share <= 0 || share >= 1) return false;
    }
    return true;
  };
  const auto inside_held = [&](Vec3 p) {
    return p.x < 0 && p.x > -side && p.z < 0 && p.z > -side && std::abs(p.y) < side;
  };

  std::vector<Episode> episodes;
  std::vector<Vec3> spins, velocities;
  bool touching = false;
  while (!s.finished()) {
    s.step();
    const Vec3 force = flying.contact_force(s);
    const bool now = norm(force) > 1e-6;
    if (now && !touching) episodes.push_back({s.time()});
    if (now) {
      episodes.back().end = s.time();
      Index inside = 0;
      for (Index i = flying.first; i < flying.end; ++i) inside += inside_held(place(s, i));
      for (Index i = held.first; i < held.end; ++i) inside += inside_flying(place(s, i));
      episodes.back().nodes_inside = std::max(episodes.back().nodes_inside, inside);
    }
    if (!now && touching) {
      spins.push_back(flying.spin(s));
      velocities.push_back(flying.total_momentum(s) / mass);
    }
    touching = now;

    // What the history calls the pair's force is what the blocks feel.
    const History& history = s.history();
    const auto column =
        std::find(history.columns.begin(), history.columns.end(), "contact_held_flying_force_x_n");
    ASSERT_NE(column, history.columns.end());
    const double* told =
        &history.values[(history.rows() - 1) * history.columns.size() + (column - history.columns.begin())];
    ASSERT_NEAR(norm(Vec3::load(told) + force), 0, 1e-6 + 1e-9 * norm(force));
  }

  ASSERT_EQ(episodes.size(), 2u);
  EXPECT_NEAR(episodes[0].begin, 0.2e-3, 0.002e-3) << "0.6 mm at 3 m/s";
  EXPECT_EQ(episodes[0].nodes_inside, 0) << "edges cross, no node is in a face";
  EXPECT_GT(episodes[1].nodes_inside, 0);
  EXPECT_GT(norm(spins[0]), 0.1 * scale * side) << "it turns";
  EXPECT_GT(velocities[1].x, 1) << "it leaves";
  const Summary summary = s.summary();
  EXPECT_GT(summary.energy_balance_min, 0.99);
  EXPECT_LT(summary.energy_balance_max, 1.01);
  ASSERT_EQ(summary.contact_pairs.size(), 1u);
  EXPECT_GT(summary.contact_pairs[0].peak_force_n, 10);
  EXPECT_TRUE(summary.warnings.empty());
}

TEST(Blocks, HeapKeepsMomentumAndEnergy) {
  Model model = blocks::case_2();
  Simulation s(std::move(model));
  const Body flying(s, "flying");
  const auto total = [&] {
    Vec3 p, l;
    for (Index n = 0; n < s.node_count(); ++n) {
      p += momentum(s, n);
      l += cross(place(s, n), momentum(s, n));
    }
    return std::pair{p, l};
  };
  s.step();
  const auto [p0, l0] = total();
  std::vector<double> hits;
  bool touching = false;
  while (!s.finished()) {
    s.step();
    const bool now = norm(flying.contact_force(s)) > 1e-6;
    if (now && !touching) hits.push_back(s.time());
    touching = now;
    ASSERT_LT(norm(total().first - p0), 1e-12 * norm(p0)) << "at " << s.time();
  }
  const auto [p1, l1] = total();
  EXPECT_LT(norm(l1 - l0), 1e-6 * norm(l0));
  EXPECT_GE(hits.size(), 2u);
  EXPECT_GT(hits.front(), 0.05e-3);
  const Summary summary = s.summary();
  EXPECT_GT(summary.energy_balance_min, 0.99);
  EXPECT_LT(summary.energy_balance_max, 1.01);
  EXPECT_GE(summary.contact_pairs.size(), 6u) << "the hit goes through the heap";
  EXPECT_LT(summary.deepest_penetration_m, 0.05 * 4e-3 / 3);
}

TEST(Hertz, ForceAndTimeOfABallOnGlass) {
  // Three elements along the contact radius; benchmarks/hertz.cpp goes on to finer meshes and other speeds.
  const hertz::Exact exact = hertz::exact_values(3);
  EXPECT_NEAR(exact.force, 4960.9, 0.5);
  EXPECT_NEAR(exact.time, 73.16e-6, 0.02e-6);
  const hertz::Result impact = hertz::impact(3, 3);
  EXPECT_NEAR(impact.force, exact.force, 0.05 * exact.force);
  EXPECT_NEAR(impact.time, exact.time, 0.05 * exact.time);
  EXPECT_NEAR(impact.balance, 1, 0.01);
}

/// On a floor that is held, under gravity; deformable, laid down with its weight on the springs.
TEST(Friction, SlidingBlockStopsAndItsKineticEnergyIsHeat) {
  const double mu = 0.3, speed = 1.5, g = 9.81;
  Model model;
  scenes::add_box(model.mesh, "floor", {9, 2, 1}, {0.9, 0.3, 0.1}, {-0.2, -0.15, -0.1});
  scenes::add_box(model.mesh, "block", {2, 2, 2}, {0.1, 0.1, 0.1}, {0, -0.05, 0});
  const ElasticMaterial soft{2500, 1e8, 0.2};
  for (const char* part : {"floor", "block"}) model = scenes::with_part(std::move(model), part, soft);
  NodeSet all{"floor_all", {}};
  for (Index n = 0; n < 10 * 3 * 2; ++n) all.nodes.push_back(n);
  model.mesh.node_sets.push_back(all);
  model.prescribed_velocities = {{"floor_all", {true, true, true}, {}, {0}}};
  model.initial_velocities = {{"block", {speed, 0, 0}}};
  model.gravity = {0, 0, -g};
  model.contact.surfaces = {"floor_faces", "block_faces"};
  model.contact.friction = mu;
  model.time = {1.2 * speed / (mu * g), 0, 0.7};
  Simulation s(std::move(model));
  const Body block(s, "block");
  const double mass = block.mass(s), kinetic = 0.5 * mass * speed * speed;
  const auto center = [&] { return block.sum([&](Index n) { return s.masses()[n] * place(s, n); }) / mass; };
  const double from = center().x, stop = speed * speed / (2 * mu * g);
  s.advance(10000000);
  EXPECT_NEAR(center().x - from, stop, 0.005 * stop);
  EXPECT_LT(std::abs(block.total_momentum(s).x / mass), 0.01 * speed);
  const Summary summary = s.summary();
  ASSERT_EQ(summary.contact_pairs.size(), 1u);
  EXPECT_NEAR(summary.contact_pairs[0].friction_heat_j, kinetic, 0.01 * kinetic);
  EXPECT_EQ(summary.contact_pairs[0].friction_heat_j, s.energies().contact_friction);
  EXPECT_NEAR(s.energies().balance(), 1, 0.01);
}

}  // namespace
}  // namespace cdfp
