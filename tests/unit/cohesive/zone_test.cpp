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
      printf("%g %g: %.6f %.6f %.6f %d\n", shear, step, p.dissipated, p.lost, p.law, p.broken);
      EXPECT_EQ(p.broken, 6);
      EXPECT_NEAR(p.dissipated, 1, 0.01) << shear << ' ' << step;
      EXPECT_NEAR(p.lost, p.law, 0.01 * p.law);
      EXPECT_GT(p.law, 1);
      EXPECT_LT(p.law, 5);
    }
  }
}

struct Fragments {
  double balance_lost;
  CohesiveZone::Energy energy;
  std::vector<double> position;
  Index inserted, broken;
  Vec3 momentum_change;
  CohesiveZone::Cost cost;
};
Fragments fragment(int cells, double rate, double kappa, double friction, int steps, int threads,
                   CohesiveScheme scheme = CohesiveScheme::mean_traction) {
  BodySettings s;
  s.cells = {cells, cells, cells};
  s.size = {0.9e-3, 1e-3, 1.1e-3};
  s.solid = true;
  s.step = 6e-8;
  s.law.mode_ratio = kappa;
  s.law.friction = friction;
  s.threads = threads;
  s.scheme = scheme;
  SpringBody body(s);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> pick(-1, 1);
  body.set_velocity([&](Vec3 x) {
    const Vec3 c = x - 0.5e-3 * cells * Vec3{0.9, 1, 1.1};
    return rate * (Vec3{c.x, 0.7 * c.y - 0.4 * c.x, 0.5 * c.z} +
                   3e-4 * Vec3{pick(random), pick(random), pick(random)});
  });
  body.step();
  const double before = body.kinetic + body.strain_energy();
  const Vec3 momentum = body.momentum();
  for (int i = 0; i < steps; ++i) {
    body.step({}, body.all);
    if (getenv("SERIES") && i % 3 == 0) {
      const CohesiveZone::Energy e = body.zone.energy();
      double a = body.kinetic + body.strain_energy() + e.stored + e.dissipated + e.friction;
      printf("%d %.3e st %.2e d %.2e f %.2e ga %.2e uns %ld n %d b %d\n", i, (before - a) / before, e.stored,
             e.dissipated, e.friction, e.ga, body.zone.cost().unsettled, body.zone.count(),
             body.zone.broken_count());
    }
  }
  const CohesiveZone::Energy e = body.zone.energy();
  const double after = body.kinetic + body.strain_energy() + e.stored + e.dissipated + e.friction;
  return {(before - after) / before, e,
          body.nodes.position,       body.zone.count(),
          body.zone.broken_count(),  body.momentum() - momentum,
          body.zone.cost()};
}

TEST(CohesiveZone, FragmentingBodyKeepsItsAccounts) {
  for (const double kappa : {1.0, 5.0}) {
    for (const double rate : {2e3, 1e4}) {
      const Fragments f = fragment(5, rate, kappa, 0.3, 150, 1);
      printf(
          "kappa %g: balance %.3e diss/ga %.6f stored %.3e diss %.3e fric %.3e inserted %d broken %d mom "
          "%.2e; evals %.2f unsettled %ld of %ld\n",
          kappa, f.balance_lost, f.energy.dissipated / f.energy.ga, f.energy.stored, f.energy.dissipated,
          f.energy.friction, f.inserted, f.broken, norm(f.momentum_change),
          double(f.cost.evaluations) / f.cost.clusters, f.cost.unsettled, f.cost.clusters);
    }
  }
}

}  // namespace
}  // namespace cdfp
