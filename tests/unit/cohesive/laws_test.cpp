// The laws behind the zone's one interface: Camacho-Ortiz, the bilinear bond, a user's.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cdfp/error.hpp"
#include "cohesive/law.hpp"
#include "spring_body.hpp"

namespace cdfp {
namespace {

TEST(CohesiveLaws, CamachoOrtizHasAPotential) {
  // With kappa = 1 the traction at any opening that grows is the gradient of
  // phi = S (r - r^2 / (2 reach)), r^2 = dn^2 + eta^2 |dt|^2: the work depends on the end only.
  CohesiveLaw law;
  law.strength = 60e6;
  law.fracture_energy = 10;
  law.shear_ratio = 1.7;
  const double reach = 2 * law.fracture_energy / law.strength;
  const ModeWeights weights(law);
  const Softening softening{law.strength, reach};
  const Vec3 n{1, 0, 0};
  const auto phi = [&](Vec3 d) {
    const double r = std::hypot(d.x, law.shear_ratio * d.y);
    return law.strength * (r - r * r / (2 * reach));
  };
  for (const Vec3 d : {reach * Vec3{0.3, 0.1, 0}, reach * Vec3{0.05, 0.4, 0}, reach * Vec3{0.7, 0.01, 0}}) {
    const double k = softening.stiffness(weights.opening(d.x, d.y * d.y));
    const double h = 1e-6 * reach;
    EXPECT_NEAR(k * d.x, (phi(d + h * n) - phi(d - h * n)) / (2 * h), 1e-6 * law.strength);
    const Vec3 t{0, 1, 0};
    EXPECT_NEAR(k * weights.traction * d.y, (phi(d + h * t) - phi(d - h * t)) / (2 * h), 1e-6 * law.strength);
  }
  const Vec3 end = reach * Vec3{0.4, 0.2, 0};
  const Vec3 by_normal = reach * Vec3{0.4, 0, 0}, by_shear = reach * Vec3{0, 0.2, 0};
  const double spent = weighted_growth(weights, n, {}, by_normal, 0, reach) +
                       weighted_growth(weights, n, by_normal, end, weights.opening(by_normal.x, 0), reach);
  const double other =
      weighted_growth(weights, n, {}, by_shear, 0, reach) +
      weighted_growth(weights, n, by_shear, end, weights.opening(0, by_shear.y * by_shear.y), reach);
  EXPECT_NEAR(spent, other, 1e-12 * reach);
}

/// Two cells pulled apart at a constant speed, bonded in the middle.
struct Bonded {
  explicit Bonded(const CohesiveLaw& law, double slow) : body(settings(law)) {
    Index f = 0;
    while (body.topology.mate({0, f}).element != 1) ++f;
    body.topology.insert_cohesive({0, f}, body.report);
    for (const auto& [node, mother] : body.report.new_nodes)
      body.nodes.clone(mother, body.model.mesh.coordinates);
    std::fill(body.nodes.mass.begin(), body.nodes.mass.end(), 0.0);
    for (Index e = 0; e < 2; ++e) {
      for (const Index n : body.topology.nodes(e)) body.nodes.mass[n] += body.corner_mass();
    }
    body.zone.insert_bond(body.topology, body.report, law.name, body.nodes);
    for (const Index n : body.topology.nodes(0)) body.nodes.fixed[n] = 7;
    for (const Index n : body.topology.nodes(1)) {
      body.nodes.fixed[n] = 7;
      body.nodes.velocity[3 * n] = slow;
    }
  }
  static BodySettings settings(const CohesiveLaw& law) {
    BodySettings s;
    s.cells = {2, 1, 1};
    s.law = law;
    return s;
  }
  double opening() const {
    return (body.nodes.x(body.topology.nodes(1)[0]) - body.nodes.x(body.topology.nodes(0)[4])).x;
  }
  /// Pa, what the bond pulls with.
  double traction() {
    body.step();
    double sum = 0;
    for (const Index n : body.topology.nodes(1)) sum -= body.nodes.f(n).x;
    return sum / body.section();
  }
  SpringBody body;
};

TEST(CohesiveLaws, BondIsElasticThenSoftensAndDissipatesItsEnergy) {
  CohesiveLaw law;
  law.name = "pvb_glass";
  law.kind = CohesiveKind::bilinear;
  law.strength = 8e6;
  law.fracture_energy = 200;
  law.stiffness = 1e13;
  const double start = law.strength / law.stiffness, reach = 2 * law.fracture_energy / law.strength;
  const double speed = reach / (20000 * 6e-8);
  Bonded bond(law, speed);
  EXPECT_EQ(bond.body.zone.facets(bond.body.topology).size(), 0u) << "a whole bond is no crack";
  double most = 0;
  for (int i = 0; i < 21000; ++i) {
    const double t = bond.traction();
    const double d = bond.opening();
    most = std::max(most, t);
    const double exact =
        d < start ? law.stiffness * d : std::max(0.0, law.strength * (reach - d) / (reach - start));
    ASSERT_NEAR(t, exact, 2e-3 * law.strength) << d / reach;
    if (d < 0.9 * start) {
      ASSERT_EQ(bond.body.zone.energy().ga, 0) << "elastic";
    }
    if (i == 10000) {
      EXPECT_EQ(bond.body.zone.facets(bond.body.topology).size(), 1u);
      EXPECT_NEAR(bond.body.zone.facets(bond.body.topology)[0].damage,
                  (0.5 * reach - start) / (reach - start), 1e-3);
    }
  }
  EXPECT_NEAR(most, law.strength, 2e-3 * law.strength);
  EXPECT_EQ(bond.body.zone.broken_count(), 1);
  const double energy = law.fracture_energy * bond.body.section();
  EXPECT_NEAR(bond.body.zone.energy().ga, energy, 1e-9 * energy);
  EXPECT_NEAR(bond.body.zone.energy().dissipated, energy, 1e-6 * energy);
}

/// Exponential softening, T = S exp(-D/l) over the largest opening D, unloading to the origin, as a user
/// would write it. Keeps D.
void exponential(const CohesivePoints& p) {
  const double length = 2e-6;
  for (std::int64_t i = 0; i < p.count; ++i) {
    double dn = 0, carried = 0;
    for (int k = 0; k < 3; ++k) {
      dn += p.opening[3 * i + k] * p.normal[3 * i + k];
      carried += p.insertion_traction[3 * i + k] * p.normal[3 * i + k];
    }
    const bool fresh = p.state[i] == 0 && dn <= 0;
    p.state[i] = std::max(p.state[i], dn);
    const double stiffness = fresh ? 0 : carried * std::exp(-p.state[i] / length) / p.state[i];
    const double t = fresh ? carried : stiffness * std::max(0.0, dn);
    for (int k = 0; k < 3; ++k) p.traction[3 * i + k] = t * p.normal[3 * i + k];
    p.stored[i] = fresh ? 0 : 0.5 * stiffness * std::max(0.0, dn) * std::max(0.0, dn);
    p.damage[i] = -std::expm1(-p.state[i] / length);
    if (p.state[i] > 12 * length) p.damage[i] = 1;
  }
}

CohesiveLaw user_law() {
  CohesiveLaw law;
  law.name = "user";
  law.kind = CohesiveKind::user;
  law.strength = 60e6;
  law.fracture_energy = 60e6 * 2e-6;
  law.states = 1;
  law.stiffness = 60e6 / 2e-6;
  law.callback = exponential;
  return law;
}

TEST(CohesiveLaws, UsersLawCracksABarAndKeepsTheAccounts) {
  BodySettings s;
  s.law = user_law();
  SpringBody bar(s);
  bar.set_velocity([&](Vec3 x) { return Vec3{2000 * (x.x - 20e-3), 0, 0}; });
  bar.accept = [&](const OpenFacet& f) {
    return f.lower.element == 20 && bar.topology.mate(f.lower).element == 21;
  };
  bar.step();
  const double before = bar.kinetic + bar.strain_energy();
  for (int i = 0; i < 150; ++i) bar.step({}, bar.all);
  EXPECT_EQ(bar.zone.broken_count(), 1);
  const CohesiveZone::Energy e = bar.zone.energy();
  const double ga = s.law.fracture_energy * bar.section();
  EXPECT_NEAR(e.dissipated, ga, 0.06 * ga) << "as well as plain steps do";
  EXPECT_NEAR(bar.kinetic + bar.strain_energy() + e.stored + e.dissipated + e.friction, before, 1e-4 * ga);
  EXPECT_EQ(e.slope_cost, 0);
}

TEST(CohesiveLaws, SlopesBeyondTheStepAreBoundedAndCounted) {
  // The same law, but it drops to nothing within a hundredth of what the step can follow.
  BodySettings s;
  s.law = user_law();
  s.law.callback = [](const CohesivePoints& p) {
    for (std::int64_t i = 0; i < p.count; ++i) {
      double dn = 0;
      for (int k = 0; k < 3; ++k) dn += p.opening[3 * i + k] * p.normal[3 * i + k];
      const double t = 60e6 * std::tanh(std::max(0.0, dn) / 1e-12);
      for (int k = 0; k < 3; ++k) p.traction[3 * i + k] = t * p.normal[3 * i + k];
    }
  };
  s.cells = {8, 1, 1};
  SpringBody bar(s);
  bar.set_velocity([&](Vec3 x) { return Vec3{20 * (x.x - 4e-3), 0, 0}; });
  bar.accept = [&](const OpenFacet& f) { return f.lower.element == 3; };
  for (Index n = 0; n < bar.nodes.count(); ++n) bar.nodes.position[3 * n] *= 1 + 61e6 / s.youngs_modulus;
  bar.step();
  const double before = bar.kinetic + bar.strain_energy();
  double most = 0;
  for (int i = 0; i < 4000; ++i) {
    bar.step({}, bar.all);
    most = std::max(most, bar.kinetic + bar.strain_energy());
  }
  EXPECT_EQ(bar.zone.count(), 1);
  EXPECT_LT(most, 1.5 * before) << "it stays stable";
  EXPECT_GT(bar.zone.energy().slope_cost, 0);
}

TEST(CohesiveLaws, NumbersThatAreNotFiniteAreRefused) {
  BodySettings s;
  s.law = user_law();
  s.law.callback = [](const CohesivePoints& p) {
    for (std::int64_t i = 0; i < 3 * p.count; ++i) p.traction[i] = std::nan("");
  };
  s.cells = {2, 1, 1};
  SpringBody bar(s);
  for (Index n = 0; n < bar.nodes.count(); ++n) bar.nodes.position[3 * n] *= 1 + 61e6 / s.youngs_modulus;
  try {
    bar.step({}, bar.all);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'user'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cdfp
