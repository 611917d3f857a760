// Cohesive elements in bodies of springs: energies, stability and friction at the step that a run can afford.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "spring_body.hpp"

namespace cdfp {
namespace {

struct Pulled {
  double dissipated;  ///< as the zone books it, over the law's
  double lost;        ///< kinetic and strain energy that went, over G A in mode I
  double law;         ///< the law's over G A
  Index broken;
};

/// A bar that stretches and shears at constant rates; only its middle section cracks.
Pulled pull_apart(const BodySettings& s, double rate, double shear_rate, int steps) {
  SpringBody bar(s);
  const double half = 0.5 * s.cells[0] * s.size[0];
  bar.set_velocity([&](Vec3 x) { return Vec3{rate * (x.x - half), shear_rate * (x.x - half), 0}; });
  const int middle = s.cells[0] / 2;
  bar.accept = [&](const OpenFacet& f) {
    return f.lower.element % s.cells[0] == middle &&
           bar.topology.mate(f.lower).element == f.lower.element + 1;
  };
  double before = 0;
  for (int i = 0; i < steps; ++i) {
    if (i == 0) {
      bar.step();
      before = bar.kinetic + bar.strain_energy();
    } else {
      bar.step({}, bar.all);
    }
  }
  const double ga = s.law.fracture_energy * bar.section() * s.cells[1] * s.cells[2];
  const CohesiveZone::Energy energy = bar.zone.energy();
  const double lost = before - bar.kinetic - bar.strain_energy() - energy.stored - energy.friction;
  return {energy.dissipated / energy.ga, lost / ga, energy.ga / ga, bar.zone.broken_count()};
}

TEST(CohesiveZone, BarDissipatesTheFractureEnergyAtTheAffordableStep) {
  for (const double h : {0.5e-3, 0.7e-3, 1.07e-3, 1.43e-3}) {
    for (const double step : {4e-8, 6e-8, 8e-8}) {
      BodySettings s;
      s.size[0] = h;
      s.step = step;
      const Pulled p = pull_apart(s, 2000, 0, 60);
      EXPECT_EQ(p.broken, 1);
      EXPECT_NEAR(p.lost, 1, 1e-6) << h << ' ' << step;
      EXPECT_NEAR(p.dissipated, 1, 1e-6) << h << ' ' << step;
      s.scheme = CohesiveScheme::plain;
      EXPECT_GT(pull_apart(s, 2000, 0, 60).lost, 1.02) << "what the plain update does " << h << ' ' << step;
    }
  }
}

TEST(CohesiveZone, MixedModeBarDissipatesWhatItsPathAsksFor) {
  for (const double shear : {300.0, 2000.0, 10000.0}) {
    for (const double step : {4e-8, 6e-8}) {
      BodySettings s;
      s.cells = {30, 3, 2};
      s.size = {0.7e-3, 1e-3, 0.8e-3};
      s.step = step;
      s.law.mode_ratio = 5;
      const Pulled p = pull_apart(s, 2000, shear, 100);
      EXPECT_EQ(p.broken, 6);
      EXPECT_NEAR(p.dissipated, 1, 1e-3) << shear << ' ' << step;
      EXPECT_NEAR(p.lost, p.law, 1e-3 * p.law) << shear << ' ' << step;
      EXPECT_GT(p.law, 1);
      EXPECT_LT(p.law, 5);
    }
  }
}

TEST(CohesiveZone, RateDependentBarDissipatesWhatItsRateAsksFor) {
  double last = 1;
  for (const double sensitivity : {0.02, 0.1, 0.3}) {
    BodySettings s;
    s.size = {0.7e-3, 1e-3, 0.8e-3};
    s.cells = {30, 3, 2};
    s.law.mode_ratio = 5;
    s.law.rate_sensitivity = sensitivity;
    s.law.reference_rate = 1e-2;
    const Pulled p = pull_apart(s, 2000, 1000, 100);
    EXPECT_EQ(p.broken, 6);
    EXPECT_NEAR(p.dissipated, 1, 1e-3) << sensitivity;
    EXPECT_NEAR(p.lost, p.law, 1e-3 * p.law) << sensitivity;
    EXPECT_GT(p.law, last);
    last = p.law;
  }
}

struct Fragments {
  double energy_gained;  ///< over what was there at first
  double momentum_gained;
  CohesiveZone::Energy energy;
  CohesiveZone::Cost cost;
  std::vector<double> position;
  Index inserted = 0;
  Index broken = 0;
};

/// A solid block flies apart in all directions.
Fragments fragment(int cells, double rate, double kappa, double friction, unsigned seed, int threads = 1) {
  BodySettings s;
  s.cells = {cells, cells, cells};
  s.size = {0.9e-3, 1e-3, 1.1e-3};
  s.solid = true;
  s.law.mode_ratio = kappa;
  s.law.friction = friction;
  s.threads = threads;
  SpringBody body(s);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  const Vec3 middle = 0.5e-3 * cells * Vec3{0.9, 1, 1.1};
  body.set_velocity([&](Vec3 x) {
    const Vec3 c = x - middle;
    return rate * (Vec3{c.x, 0.7 * c.y - 0.4 * c.x, 0.5 * c.z} +
                   3e-4 * Vec3{pick(random), pick(random), pick(random)});
  });
  body.step();
  const double before = body.kinetic + body.strain_energy();
  const Vec3 momentum = body.momentum();
  for (int i = 0; i < 150; ++i) body.step({}, body.all);
  const CohesiveZone::Energy e = body.zone.energy();
  const double after = body.kinetic + body.strain_energy() + e.stored + e.dissipated + e.friction;
  return {(after - before) / before,
          norm(body.momentum() - momentum) / (rate * 1e-3 * cells * body.corner_mass()),
          e,
          body.zone.cost(),
          body.nodes.position,
          body.zone.count(),
          body.zone.broken_count()};
}

TEST(CohesiveZone, FragmentingBodyKeepsItsAccounts) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const double kappa = seed % 3 != 0 ? 5 : 0.3 + 0.1 * seed;
    const Fragments f = fragment(4, 4000.0 * (2 + seed % 4), kappa, 0.05 * (seed % 5), seed);
    EXPECT_GT(f.broken, 30);
    EXPECT_NEAR(f.energy_gained, 0, 1e-4);
    EXPECT_LT(f.momentum_gained, 1e-11);
    EXPECT_NEAR(f.energy.dissipated / f.energy.ga, 1, 0.01);
    EXPECT_EQ(f.cost.unsettled, 0);
    EXPECT_LE(f.cost.softened, f.cost.clusters / 500);
    EXPECT_LT(f.cost.evaluations, 7 * f.cost.clusters) << "what new pairs carry included";
  }
}

TEST(CohesiveZone, SameBitsForAnyNumberOfThreads) {
  const Fragments one = fragment(3, 12000, 5, 0.3, 3, 1);
  const Fragments two = fragment(3, 12000, 5, 0.3, 3, 2);
  ASSERT_EQ(one.position.size(), two.position.size());
  EXPECT_EQ(std::memcmp(one.position.data(), two.position.data(), one.position.size() * sizeof(double)), 0);
  EXPECT_EQ(one.energy.dissipated, two.energy.dissipated);
  EXPECT_EQ(one.energy.friction, two.energy.friction);
}

/// Two cells; the facet between them opens with `traction` on it. The first cell is held.
SpringBody held_pair(BodySettings s, Vec3 traction) {
  s.cells = {2, 1, 1};
  SpringBody body(s);
  for (Index f = 0; f < 6; ++f) {
    if (body.topology.mate({0, f}).element == 1) {
      body.insert({{0, f}, traction});
      break;
    }
  }
  for (const Index n : body.topology.nodes(0)) body.nodes.fixed[n] = 7;
  return body;
}

double opening(const SpringBody& body, int direction) {
  return (body.nodes.x(body.topology.nodes(1)[0]) - body.nodes.x(body.topology.nodes(0)[4]))[direction];
}

TEST(CohesiveZone, InsertionUnderLoadMovesNothing) {
  // A bar at rest under a tension just below the strength of all of its facets: they open, and stay closed.
  BodySettings s;
  s.cells = {12, 1, 1};
  SpringBody bar(s);
  const double sigma = 59e6;
  const auto pull = [&](Nodes& nodes) {
    for (Index n = 0; n < nodes.count(); ++n) {
      const double x = nodes.x0(n).x;
      if (x == 0) nodes.force[3 * n] -= sigma * bar.section() / 4;
      if (x > 11.5e-3) nodes.force[3 * n] += sigma * bar.section() / 4;
    }
  };
  for (Index n = 0; n < bar.nodes.count(); ++n) bar.nodes.position[3 * n] *= 1 + sigma / s.youngs_modulus;
  for (int i = 0; i < 20; ++i) bar.step(pull);
  for (Index e = 0; e + 1 < 12; ++e) {
    for (Index f = 0; f < 6; ++f) {
      if (bar.topology.mate({e, f}).element == e + 1) bar.insert({{e, f}, {60e6, 0, 0}});
    }
  }
  ASSERT_EQ(bar.zone.count(), 11);
  for (int i = 0; i < 2000; ++i) {
    bar.step(pull);
    for (Index e = 0; e < 12; ++e) ASSERT_NEAR(bar.stress(e)(0, 0), sigma, 0.01 * sigma) << i;
  }
  EXPECT_LT(bar.zone.energy().ga, 1e-3 * s.law.fracture_energy * bar.section());
  EXPECT_EQ(bar.zone.broken_count(), 0);
}

TEST(CohesiveZone, SlowBarPassesTheStrengthSmoothly) {
  BodySettings s;
  s.cells = {10, 1, 1};
  s.law.fracture_energy = 1000;  // softens slower than the bar unloads
  SpringBody bar(s);
  const double speed = 0.005;
  const double length = 10e-3;
  bar.set_velocity([&](Vec3 x) { return Vec3{speed * x.x / length, 0, 0}; });
  for (Index n = 0; n < bar.nodes.count(); ++n) {
    const double x = bar.nodes.x0(n).x;
    if (x == 0 || x > 9.5e-3) bar.nodes.fixed[n] |= 1;
    // Starts at 99 % of the strength.
    bar.nodes.position[3 * n] += x * 0.99 * s.law.strength / s.youngs_modulus;
  }
  bar.accept = [](const OpenFacet& f) { return f.lower.element == 5; };
  const std::vector<Index> middle = {5};
  double last = 0;
  double roughest = 0;
  double peak = 0;
  for (int i = 0; i < 4000; ++i) {
    bar.step({}, bar.zone.count() == 0 ? std::span<const Index>(middle) : std::span<const Index>());
    const double sigma = bar.stress(5)(0, 0);
    if (i > 0) roughest = std::max(roughest, std::abs(sigma - last));
    peak = std::max(peak, sigma);
    last = sigma;
  }
  EXPECT_EQ(bar.zone.count(), 1);
  EXPECT_GT(bar.zone.energy().ga, 0);
  EXPECT_LT(peak, 1.003 * s.law.strength);
  EXPECT_LT(roughest, 0.003 * s.law.strength);
}

/// A bar between two hands opens in its middle to `damage`, is knocked back and left to ring. Returns the
/// largest mechanical energy after that over the one right after the knock, and checks the accounts.
double ring(double damage, CohesiveScheme scheme) {
  BodySettings s;
  s.cells = {8, 1, 1};
  s.step = 8e-8;
  s.size[0] = 0.5e-3;
  s.law.fracture_energy = 1000;
  s.scheme = scheme;
  SpringBody bar(s);
  const double speed = 0.2;
  bar.set_velocity([&](Vec3 x) { return Vec3{speed * (x.x - 2e-3) / 2e-3, 0, 0}; });
  std::vector<Index> ends;
  for (Index n = 0; n < bar.nodes.count(); ++n) {
    const double x = bar.nodes.x0(n).x;
    bar.nodes.position[3 * n] += 0.995 * s.law.strength / s.youngs_modulus * x;
    if (x > 0.1e-3 && x < 3.9e-3) continue;
    bar.nodes.fixed[n] = 7;
    ends.push_back(n);
  }
  bar.accept = [](const OpenFacet& f) { return f.lower.element == 4; };
  const std::vector<Index> middle = {4};
  const double ga = s.law.fracture_energy * bar.section();
  while (bar.zone.energy().ga < damage * ga) bar.step({}, middle);
  for (const Index n : ends) bar.nodes.velocity[3 * n] = 0;
  bar.step([&](Nodes& nodes) {
    for (Index n = 0; n < nodes.count(); ++n) {
      if (nodes.fixed[n] == 0) nodes.force[3 * n] -= nodes.mass[n] * 3 * nodes.velocity[3 * n] / s.step;
    }
  });
  bar.step();
  const auto energy = [&] { return bar.kinetic + bar.strain_energy() + bar.zone.energy().stored; };
  const double turned = energy();
  double most = turned;
  for (int i = 0; i < 20000; ++i) {
    bar.step();
    most = std::max(most, energy());
    if (most > 100 * turned) break;
  }
  EXPECT_EQ(bar.zone.broken_count(), 0);
  const CohesiveZone::Energy e = bar.zone.energy();
  if (scheme == CohesiveScheme::mean_traction) {
    EXPECT_NEAR(e.dissipated, e.ga, 1e-4 * ga) << damage;
    EXPECT_LT(e.ga, (2 * damage + 0.02) * ga) << "it rings below its largest opening";
  }
  return most / turned;
}

TEST(CohesiveZone, UnloadingIsBoundedAtAnyOpening) {
  for (const double damage : {1e-5, 1e-4, 0.001, 0.003, 0.01, 0.1}) {
    EXPECT_LT(ring(damage, CohesiveScheme::mean_traction), 1.001) << damage;
  }
  EXPECT_GT(ring(1e-4, CohesiveScheme::plain), 1.1) << "what the plain update does";
}

TEST(CohesiveZone, CompressionNeitherHealsNorDissipates) {
  BodySettings s;
  s.law.fracture_energy = 2000;  // softens slower than the cell unloads
  SpringBody body = held_pair(s, {60e6, 0, 0});
  const std::vector<Index> outer(body.topology.nodes(1).begin() + 4, body.topology.nodes(1).end());
  double now = 0;
  const auto push = [&](double sigma) {
    const double from = now;
    for (int i = 1; i <= 5000; ++i) {
      now = from + std::min(1.0, i / 4000.0) * (sigma - from);
      body.step([&](Nodes& nodes) {
        for (const Index n : outer) nodes.force[3 * n] += now * body.section() / 4;
        for (std::size_t k = 0; k < nodes.force.size(); ++k) nodes.force[k] -= 2 * nodes.velocity[k];
      });
    }
  };
  // Opens to a tenth of the reach, with the far end moved by hand.
  for (const Index n : outer) body.nodes.fixed[n] |= 1;
  for (int i = 0; i < 4000; ++i) {
    for (const Index n : outer) body.nodes.velocity[3 * n] = opening(body, 0) < 6e-6 ? 0.1 : 0.0;
    body.step();
  }
  for (const Index n : outer) body.nodes.fixed[n] = 0;
  now = body.stress(1)(0, 0);
  const double dissipated = body.zone.energy().dissipated;
  const double open = opening(body, 0);
  ASSERT_GT(dissipated, 0.01 * s.law.fracture_energy * body.section());
  ASSERT_EQ(body.zone.broken_count(), 0);
  push(-500e6);
  EXPECT_LT(opening(body, 0), 0);
  EXPECT_GT(opening(body, 0), -1e-7) << "stiff as far as a step can see";
  EXPECT_NEAR(body.stress(1)(0, 0), -500e6, 1e6);
  push(5e6);
  EXPECT_GT(opening(body, 0), 0);
  EXPECT_LT(opening(body, 0), open);
  EXPECT_NEAR(body.zone.energy().dissipated, dissipated, 1e-9 * s.law.fracture_energy * body.section());
}

TEST(CohesiveZone, ShearUnderPressureEndsAtCoulombFriction) {
  for (const double exponent : {1.0, 2.0}) {
    for (const double mu : {0.1, 0.4}) {
      BodySettings s;
      s.law.mode_ratio = 5;
      s.law.shear_ratio = 1.5;
      s.law.friction = mu;
      s.law.friction_exponent = exponent;
      s.law.fracture_energy = 2000;  // softens slower than the cell unloads
      const double pressure = 80e6;
      SpringBody body = held_pair(s, {-pressure, 90e6, 0});
      const std::vector<Index> outer(body.topology.nodes(1).begin() + 4, body.topology.nodes(1).end());
      const double reach = 5 / 1.5 * 2 * s.law.fracture_energy / s.law.strength;
      for (const Index n : outer) body.nodes.fixed[n] |= 2;
      const auto run = [&](double speed, int steps, const std::function<void(double, double)>& see) {
        for (int i = 0; i < steps && body.zone.broken_count() == 0; ++i) {
          for (const Index n : outer) body.nodes.velocity[3 * n + 1] = speed;
          body.step([&](Nodes& nodes) {
            for (const Index n : outer) nodes.force[3 * n] -= pressure * body.section() / 4;
            for (Index n = 0; n < nodes.count(); ++n) {
              for (int d = 0; d < 3; ++d) nodes.force[3 * n + d] -= 2e-2 * nodes.velocity[3 * n + d];
            }
          });
          see(opening(body, 1), body.stress(1)(0, 1));
        }
      };
      double last = 0;
      double worst = 0;
      double slip = 0;
      run(0.2, 30000, [&](double slid, double tau) {
        slip = std::max(slip, slid);
        const double damage = slip / reach;
        if (damage < 0.02) return;
        const double expected = 90e6 * (1 - damage) + mu * pressure * (1 - std::pow(1 - damage, exponent));
        worst = std::max(worst, std::abs(tau - expected));
        last = tau;
      });
      EXPECT_LT(worst, 0.03 * 90e6) << mu << ' ' << exponent;
      EXPECT_EQ(body.zone.broken_count(), 1);
      EXPECT_NEAR(last, mu * pressure, 0.02 * 90e6) << mu;
      const CohesiveZone::Energy e = body.zone.energy();
      EXPECT_NEAR(e.dissipated, 5 * s.law.fracture_energy * body.section(), 1e-3 * e.dissipated);
      // Integral of mu p (1 - (1 - x)^q) over the reach.
      const double heat = mu * pressure * reach * (1 - 1 / (exponent + 1)) * body.section();
      EXPECT_NEAR(e.friction, heat, 0.02 * heat);
    }
  }
}

}  // namespace
}  // namespace cdfp
