// Forces of pairs that touch: statics of one pair, balances of collisions, friction.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cdfp/error.hpp"
#include "lattice.hpp"

namespace {

using namespace cdfp;
using cdfp::test::Block;
using cdfp::test::Scene;

/// A small cube stands on its tip over a wide block.
Scene tip_on_block(double gap, double speed, const ContactSettings& settings = {}) {
  Scene scene(settings);
  scene.add({.size = {2e-3, 1e-3, 0.5e-3}, .centre = {0, 0, -0.25e-3}, .held = true});
  const Mat3 on_tip = test::rotation({1, -1, 0}, std::acos(1 / std::sqrt(3.0)));
  const double tip = 0.5e-3 * std::sqrt(3.0);
  scene.add({.size = {1e-3, 1e-3, 1e-3},
             .centre = {0.3e-3, 0.2e-3, tip + gap},
             .turn = on_tip,
             .velocity = {0, 0, -speed}});
  return scene;
}

TEST(Forces, OneNodeOnAFaceIsPushedByThePenalty) {
  const double depth = 1e-6, step = 1e-9;
  Scene scene = tip_on_block(-depth, depth / step);
  const double k = 70e9 / 1.8 * std::pow(2e-6, 2) / 1e-9, k_tip = 70e9 / 1.8 * 1e-3;
  scene.contact.regular_search(scene.arrays());
  scene.contact.local_search(scene.arrays());
  scene.contact.add_force(scene.arrays(), step);
  ASSERT_EQ(scene.contact.touching_count(), 1u);
  const SurfaceContact::Touch touch = scene.contact.touches()[0];
  EXPECT_NEAR(touch.gap, -depth, 1e-12 * 1e-3);
  EXPECT_NEAR(touch.normal[2], 1, 1e-12);
  EXPECT_NEAR(touch.force[2], std::min(k, k_tip) * depth, 1e-6 * k * depth);
  Vec3 sum, moment;
  for (Index n = 0; n < scene.node_count(); ++n) {
    const Vec3 force = Vec3::load(&scene.f[3 * n]);
    sum += force;
    moment += cross(scene.position(n), force);
  }
  EXPECT_LT(norm(sum), 1e-12 * touch.force[2]);
  EXPECT_LT(norm(moment), 1e-12 * touch.force[2] * 1e-3);
  EXPECT_EQ(touch.parts[0], 1);
  EXPECT_EQ(touch.parts[1], 0);
  ASSERT_EQ(scene.contact.body_pairs().size(), 1u);
  const SurfaceContact::BodyPair& bodies = scene.contact.body_pairs()[0];
  EXPECT_EQ(bodies.parts, (std::array<Index, 2>{0, 1}));
  EXPECT_EQ(bodies.force[2], -touch.force[2]) << "on the first part, by the second";
  EXPECT_EQ(bodies.peak_force, touch.force[2]);
  EXPECT_NEAR(bodies.stored, 0.5 * touch.force[2] * depth, 1e-9 * bodies.stored);
}

TEST(Forces, ClearOfTheFaceThereIsNone) {
  Scene scene = tip_on_block(1e-9, 0);
  scene.step(1e-12);
  EXPECT_EQ(scene.contact.touching_count(), 0u);
  EXPECT_EQ(scene.contact.deepest_penetration(), 0.0);
}

TEST(Forces, PenetrationFromBeforePushesNothing) {
  Scene scene = tip_on_block(-2e-5, 0);
  const double before = scene.energy();
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    scene.step(2e-8);
    for (const double force : scene.contact_force) largest = std::max(largest, std::abs(force));
  }
  EXPECT_EQ(scene.contact.touching_count(), 1u);
  EXPECT_LT(largest, 1e-6);
  EXPECT_LT(scene.energy() - before, 1e-15);
  EXPECT_NEAR(scene.contact.deepest_penetration(), 2e-5, 1e-12);
}

TEST(Forces, StiffnessStandsAtTheNodesThatTouch) {
  Scene scene = tip_on_block(-1e-6, 1e-6 / 1e-9);
  scene.contact.regular_search(scene.arrays());
  scene.contact.local_search(scene.arrays());
  scene.contact.add_force(scene.arrays(), 1e-9);
  std::vector<double> by_node(scene.node_count(), 0);
  scene.contact.add_stiffness_over_mass(by_node);
  const SurfaceContact::Touch touch = scene.contact.touches()[0];
  const double stiffness = touch.force[2] / 1e-6;
  for (Index i = 0; i < touch.count; ++i) {
    const Index node = touch.nodes[i];
    EXPECT_NEAR(by_node[node], 2 * stiffness * std::abs(touch.weights[i]) / scene.m[node],
                1e-5 * stiffness / scene.m[node]);
    by_node[node] = 0;
  }
  EXPECT_EQ(by_node, std::vector<double>(scene.node_count(), 0));
  EXPECT_THROW(scene.contact.add_stiffness_over_mass(std::span(by_node).first(3)), Error);
}

/// Then no search finds the pair any more, but its springs hold on.
TEST(Forces, NodeDeeperThanTheBufferStaysHeld) {
  ContactSettings settings;
  settings.buffer_factor = 0.05;
  Scene scene = tip_on_block(-1e-6, 1e-6 / 1e-9, settings);
  const auto look = [&] {
    scene.contact.regular_search(scene.arrays());
    scene.contact.local_search(scene.arrays());
    scene.contact.add_force(scene.arrays(), 1e-9);
  };
  look();
  ASSERT_EQ(scene.contact.touching_count(), 1u);
  const double first = scene.contact.touches()[0].force[2];
  for (Index n = 0; n < scene.node_count(); ++n) {
    if (scene.body[n] == 1) scene.x[3 * n + 2] -= 99e-6;
  }
  look();
  EXPECT_LT(scene.contact.search().buffer(), 90e-6);
  ASSERT_EQ(scene.contact.touching_count(), 1u);
  EXPECT_NEAR(scene.contact.touches()[0].force[2], 100 * first, 1e-6 * first);
}

TEST(Forces, DeepPenetrationIsReportedWithItsPair) {
  Scene scene = tip_on_block(-1e-4, 0);
  scene.contact.name_parts({"floor", "die"});
  scene.step(1e-9);
  ASSERT_EQ(scene.contact.warnings().size(), 1u);
  for (const char* part : {"of part floor", "of part die"}) {
    EXPECT_NE(scene.contact.warnings()[0].find(part), std::string::npos) << scene.contact.warnings()[0];
  }
}

TEST(Forces, WhatIsDeepIsTheUsersChoice) {
  for (const double share : {0.1, 0.19, 0.21, 0.4}) {
    ContactSettings settings;
    settings.penetration_warning = share;
    Scene scene = tip_on_block(-1e-4, 0, settings);  // a fifth of the block's 0.5 mm
    scene.step(1e-9);
    EXPECT_EQ(scene.contact.warnings().size(), share < 0.2 ? 1u : 0u) << share;
  }
}

TEST(Forces, StiffnessKeepsToTheStep) {
  Scene scene = tip_on_block(-1e-6, 10);
  const double step = 5e-7;  // far too long for the paper's k
  scene.contact.regular_search(scene.arrays());
  scene.contact.local_search(scene.arrays());
  scene.contact.add_force(scene.arrays(), step);
  EXPECT_GT(scene.contact.stiffness_over_mass(), 0);
  EXPECT_LE(scene.contact.stiffness_over_mass() * step * step, 1.0 + 1e-12);
}

TEST(Collisions, HeadOnBarsSwapVelocities) {
  Scene scene;
  const double speed = 3;
  const Index a = scene.add({.bricks = {12, 2, 2},
                             .size = {12e-3, 2e-3, 2e-3},
                             .centre = {-6.01e-3, 0, 0},
                             .velocity = {speed, 0, 0}});
  const Index b = scene.add({.bricks = {12, 2, 2}, .size = {12e-3, 2e-3, 2e-3}, .centre = {6.01e-3, 0, 0}});
  const double energy = scene.energy();
  const Vec3 momentum = scene.momentum();
  const double step = scene.stable_step();
  double worst = 0;
  while (scene.time < 40e-6) {
    scene.step(step);
    worst = std::max(worst, std::abs(scene.energy() / energy - 1));
    ASSERT_LT(norm(scene.momentum() - momentum), 1e-12 * norm(momentum));
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(scene.velocity(a).x, 0.1 * speed);
  EXPECT_GT(scene.velocity(b).x, 0.9 * speed);
  EXPECT_EQ(scene.contact.touching_count(), 0u);
}

class FromAnywhere : public testing::TestWithParam<unsigned> {};

/// Two cubes of random attitude meet by corner, edge or face; none may pass into the other.
TEST_P(FromAnywhere, NoHitIsMissed) {
  std::mt19937 random(GetParam());
  RecordProperty("seed", static_cast<int>(GetParam()));
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto direction = [&] {
    Vec3 d;
    do {
      d = {unit(random), unit(random), unit(random)};
    } while (dot(d, d) > 1 || dot(d, d) < 0.01);
    return normalized(d);
  };
  int hits = 0;
  double kept = 0;
  for (int trial = 0; trial < 250; ++trial) {
    Scene scene;
    const Vec3 from = direction();
    const Vec3 aside = 0.3e-3 * cross(from, direction());
    const double speed = 20;
    const Mat3 turn_a = test::rotation(direction(), 3 * unit(random)),
               turn_b = test::rotation(direction(), 3 * unit(random));
    const Index a = scene.add({.size = {1e-3, 1e-3, 1e-3}, .turn = turn_a, .held = true});
    const Index b = scene.add({.size = {1e-3, 1e-3, 1e-3},
                               .centre = 1.8e-3 * from + aside,
                               .turn = turn_b,
                               .velocity = -speed * from,
                               .rigid = true});
    // Separating axes: how deep the cubes are in each other.
    const auto depth = [&] {
      Vec3 axes[15];
      int count = 0;
      for (int i = 0; i < 3; ++i) {
        axes[count++] = transpose(turn_a).r[i];
        axes[count++] = transpose(turn_b).r[i];
        for (int j = 0; j < 3; ++j) {
          const Vec3 n = cross(transpose(turn_a).r[i], transpose(turn_b).r[j]);
          if (norm(n) > 1e-3) axes[count++] = normalized(n);
        }
      }
      double least = 1;
      for (int i = 0; i < count; ++i) {
        double low[2] = {1, 1}, high[2] = {-1, -1};
        for (Index n = 0; n < scene.node_count(); ++n) {
          const int side = scene.body[n] == a ? 0 : 1;
          const double s = dot(axes[i], scene.position(n));
          low[side] = std::min(low[side], s);
          high[side] = std::max(high[side], s);
        }
        least = std::min({least, high[0] - low[1], high[1] - low[0]});
      }
      return least;
    };
    double deepest = 0;
    const double step = 2e-8;
    for (int i = 0; i < 4000 && dot(scene.position(8), scene.position(8)) < 1e-5; ++i) {
      scene.step(step);
      if (i % 4 == 0) deepest = std::max(deepest, depth());
    }
    hits += norm(scene.velocity(b) + speed * from) > 1e-3 * speed;
    EXPECT_LT(deepest, 0.03e-3) << "trial " << trial << " of seed " << GetParam();
    EXPECT_LT(norm(scene.velocity(b)), 1.005 * speed) << "trial " << trial << " of seed " << GetParam();
    kept += dot(scene.velocity(b), scene.velocity(b)) / (speed * speed) / 250;
  }
  EXPECT_GT(kept, 0.99);
  EXPECT_GT(hits, 200);
}
INSTANTIATE_TEST_SUITE_P(Seeds, FromAnywhere, testing::Range(1u, 5u));

/// A block on a wide one under gravity, contact springs loaded as at rest.
Scene block_on_floor(double friction, double slope, double speed, std::array<int, 3> bricks) {
  ContactSettings settings;
  settings.friction = friction;
  Scene scene(settings);
  const double g = 9.81;
  scene.gravity = {g * std::sin(slope), 0, -g * std::cos(slope)};
  scene.add({.bricks = {9, 2, 1},
             .size = {0.9, 0.2, 0.1},
             .centre = {0.2, 0, -0.05},
             .youngs_modulus = 1e8,
             .held = true});
  scene.add({.bricks = bricks,
             .size = {0.1, 0.1, 0.1},
             .centre = {0, 0, 0.05},
             .velocity = {speed, 0, 0},
             .youngs_modulus = 1e8,
             .rigid = true});
  return scene;
}

TEST(Friction, SlidingBlockStopsAfterV2Over2MuG) {
  const double mu = 0.3, speed = 1.5, g = 9.81;
  Scene scene = block_on_floor(mu, 0, speed, {2, 2, 2});
  const double mass = scene.mass(1), from = scene.position(60).x;
  const double kinetic = 0.5 * mass * speed * speed;
  while (scene.time < 1.3 * speed / (mu * g)) scene.step(1e-4);
  EXPECT_NEAR(scene.position(60).x - from, speed * speed / (2 * mu * g),
              0.005 * speed * speed / (2 * mu * g));
  EXPECT_NEAR(scene.contact.friction_heat(), kinetic, 0.005 * kinetic);
  EXPECT_LT(std::abs(scene.velocity(1).x), 1e-3 * speed);
}

TEST(Friction, BlockStaysOnASlopeBelowTheFrictionAngle) {
  const double mu = 0.5, step = 1e-4;
  Scene scene = block_on_floor(mu, 0.9 * std::atan(mu), 0, {2, 2, 2});
  const Vec3 gravity = scene.gravity;
  for (int i = 0; i < 5000; ++i) {  // laid down gently: the block must not hop
    scene.gravity = std::min(1.0, i / 4000.0) * gravity;
    scene.step(step);
  }
  const double x = scene.position(60).x;
  for (int i = 0; i < 100000; ++i) scene.step(step);
  EXPECT_NEAR(scene.position(60).x, x, 1e-7);
  EXPECT_GT(scene.contact.touching_count(), 0u);
}

TEST(Friction, BlockAcceleratesDownASteeperSlope) {
  const double mu = 0.2, slope = 0.4, g = 9.81;
  Scene scene = block_on_floor(mu, slope, 0, {2, 2, 2});
  const double from = scene.position(60).x;
  while (scene.time < 0.3) scene.step(1e-4);
  const double distance = 0.5 * g * (std::sin(slope) - mu * std::cos(slope)) * scene.time * scene.time;
  EXPECT_NEAR(scene.position(60).x - from, distance, 0.01 * distance);
}

/// Bricks that lie on each other as faces just freed do, with micrometre openings and overlaps: nothing
/// bursts.
TEST(CrackFaces, LieQuietOnEachOther) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const double off = seed == 3 ? 0.0 : 2e-6, speed = 0.1;
    Scene scene;
    scene.add({.bricks = {4, 4, 3}, .size = {4.4e-3, 4.4e-3, 2.5e-3}, .loose = true});
    for (Index brick = 0; brick < scene.node_count() / 8; ++brick) {
      for (int d = 0; d < 3; ++d) {
        const double shift = off * unit(random), push = speed * unit(random);
        for (Index n = 8 * brick; n < 8 * brick + 8; ++n) {
          scene.x[3 * n + d] += shift;
          scene.v[3 * n + d] += push;
        }
      }
    }
    const double step = 0.4 * scene.stable_step(1.0), before = scene.energy();
    double most = 0, fastest = 0;
    for (int i = 0; i < 1000; ++i) {
      scene.step(step);
      most = std::max(most, scene.energy());
    }
    for (const double v : scene.v) fastest = std::max(fastest, std::abs(v));
    EXPECT_LT(most, 1.02 * before) << "seed " << seed;
    EXPECT_LT(scene.energy(), 1.005 * before) << "seed " << seed;
    EXPECT_LT(fastest, 5 * speed) << "seed " << seed;
    EXPECT_GT(scene.contact.search().node_segments().size(), 100u);
  }
}

/// A loose block thrown at a plate: the balance holds while bricks tumble against each other.
TEST(CrackFaces, RubbleKeepsTheEnergyBalance) {
  for (const double friction : {0.0, 0.3}) {
    ContactSettings settings;
    settings.friction = friction;
    Scene scene(settings);
    scene.add({.bricks = {4, 4, 1}, .size = {6e-3, 6e-3, 1e-3}, .centre = {0.1e-3, 0.2e-3, -0.5e-3}});
    scene.add({.bricks = {3, 3, 3},
               .size = {3e-3, 3e-3, 3e-3},
               .centre = {0, 0, 2.5e-3},
               .turn = test::rotation({1, 2, 0.3}, 0.4),
               .velocity = {2, 0, -10},
               .loose = true});
    const double before = scene.energy(), step = 0.7 * scene.stable_step(1.0);
    const Vec3 momentum = scene.momentum();
    double low = 1, high = 1;
    for (int i = 0; i < 2000; ++i) {
      scene.step(step);
      low = std::min(low, scene.energy() / before);
      high = std::max(high, scene.energy() / before);
    }
    EXPECT_LT(norm(scene.momentum() - momentum), 1e-11 * norm(momentum));
    EXPECT_GT(low, 0.99) << "friction " << friction;
    EXPECT_LT(high, 1.01) << "friction " << friction;
  }
}

/// Many pairs, so that every thread has nodes to sum forces at.
TEST(Threads, DoNotChangeABit) {
  std::vector<double> x;
  std::array<double, 3> force{};
  for (const int threads : {1, 2, 5}) {
    ContactSettings settings;
    settings.friction = 0.2;
    Scene scene(settings);
    scene.threads = threads;
    scene.add({.bricks = {20, 20, 1}, .size = {20e-3, 20e-3, 1e-3}, .centre = {0, 0, -0.5e-3}});
    scene.add({.bricks = {16, 16, 2},
               .size = {16.5e-3, 16.5e-3, 2e-3},
               .centre = {0, 0, 1.0e-3},
               .turn = test::rotation({0, 0, 1}, 0.4),
               .velocity = {2, 0, -10},
               .loose = true});
    const double step = 0.7 * scene.stable_step(1.0);
    std::size_t touched = 0;
    for (int i = 0; i < 40; ++i) {
      scene.step(step);
      touched += scene.contact.touching_count();
    }
    EXPECT_GT(touched, 40u * 500u);
    if (threads == 1) {
      x = scene.x;
      force = scene.contact.body_pairs()[0].force;
    }
    EXPECT_EQ(scene.x, x) << threads << " threads";
    EXPECT_EQ(scene.contact.body_pairs()[0].force, force) << threads << " threads";
  }
}

}  // namespace
