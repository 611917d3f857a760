// Insertion without a jump: traction, crack time, order of facets, turning bodies and triangular facets.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "spring_body.hpp"

namespace cdfp {
namespace {

/// A bar that stretches and shears until its middle opens.
SpringBody bar_with_middle(BodySettings s, double rate, double shear_rate) {
  s.cells = {20, 1, 1};
  SpringBody bar(s);
  const double half = 0.5 * s.cells[0] * s.size[0];
  bar.set_velocity([&](Vec3 x) { return Vec3{rate * (x.x - half), shear_rate * (x.x - half), 0}; });
  return bar;
}

void open_middle_only(SpringBody& bar) {
  bar.accept = [&bar](const OpenFacet& f) {
    return f.lower.element == 9 && bar.topology.mate(f.lower).element == 10;
  };
}

TEST(Insertion, TractionGoesOnWhereItWas) {
  for (const double shear : {0.0, 1500.0, 6000.0}) {
    for (const double kappa : {1.0, 5.0}) {
      BodySettings s;
      s.law.mode_ratio = kappa;
      s.law.shear_ratio = 1.3;
      SpringBody bar = bar_with_middle(s, 1000, shear);
      open_middle_only(bar);
      while (bar.zone.count() == 0) bar.step({}, bar.all);
      const Vec3 before = bar.open.front().traction;
      // What the zone did to the nodes of the element below, over their area.
      std::vector<double> internal(bar.nodes.force.size(), 0.0);
      for (Index e = 0; e < bar.topology.bulk_count(); ++e) bar.add_springs(e, internal);
      Vec3 after;
      const FacetNodes facet = bar.topology.facet_nodes(bar.open.front().lower);
      for (const Index n : facet.view())
        after += bar.nodes.f(n) - Vec3::load(&internal[3 * static_cast<std::size_t>(n)]);
      after *= 1 / bar.section();
      EXPECT_LT(norm(after - before), 1e-8 * s.law.strength) << shear << ' ' << kappa;
      EXPECT_GT(norm(before), 0.9 * s.law.strength);
    }
  }
}

struct CrackTimes {
  double inserted, broken;
};

CrackTimes crack_times(double step) {
  BodySettings s;
  s.step = step;
  s.law.fracture_energy = 100;
  SpringBody bar = bar_with_middle(s, 1000, 0);
  open_middle_only(bar);
  CrackTimes t{0, 0};
  while (bar.zone.broken_count() == 0 && bar.time < 1e-4) {
    bar.step({}, bar.all);
    if (bar.zone.count() == 0) t.inserted = bar.time;
    t.broken = bar.time;
  }
  EXPECT_EQ(bar.zone.broken_count(), 1);
  return t;
}

TEST(Insertion, CrackTimeConvergesUnderStepHalving) {
  const CrackTimes exact = crack_times(5e-10);
  for (const double step : {8e-8, 4e-8, 2e-8, 1e-8}) {
    const CrackTimes t = crack_times(step);
    // A time is known to its step.
    EXPECT_NEAR(t.inserted, exact.inserted, 1.5 * step);
    EXPECT_NEAR(t.broken, exact.broken, 2.5 * step);
  }
}

struct Shattered {
  double ga, kinetic;
  Index inserted, broken;
};

Shattered shatter(bool reversed) {
  BodySettings s;
  s.cells = {4, 4, 4};
  s.solid = true;
  s.law.mode_ratio = 5;
  s.law.friction = 0.2;
  SpringBody body(s);
  body.reversed = reversed;
  const Vec3 middle{2e-3, 2e-3, 2e-3};
  body.set_velocity([&](Vec3 x) { return 12000 * (x - middle); });
  for (int i = 0; i < 60; ++i) body.step({}, body.all);
  return {body.zone.energy().ga, body.kinetic, body.zone.count(), body.zone.broken_count()};
}

TEST(Insertion, OrderOfFacetsDoesNotMatter) {
  const Shattered forward = shatter(false);
  const Shattered backward = shatter(true);
  EXPECT_GT(forward.inserted, 50);
  EXPECT_EQ(forward.inserted, backward.inserted);
  EXPECT_EQ(forward.broken, backward.broken);
  EXPECT_NEAR(forward.ga, backward.ga, 1e-6 * forward.ga);
  EXPECT_NEAR(forward.kinetic, backward.kinetic, 1e-8 * forward.kinetic);
}

/// Two bulk elements with one facet between them, moved by hand.
struct Moved {
  /// `mass` of the nodes, kg: so much that what the zone does to them cannot be seen.
  Moved(const Mesh& mesh, FacetUse facet, Vec3 traction, const CohesiveLaw& law, double mass)
      : model(model_of(mesh, law)),
        nodes(model.mesh.coordinates),
        topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity),
        zone(model),
        threads(1) {
    topology.insert_cohesive(facet, report);
    for (const auto& [node, mother] : report.new_nodes) nodes.clone(mother);
    std::fill(nodes.mass.begin(), nodes.mass.end(), mass);
    zone.insert(topology, report, {report.lower, traction}, nodes, 0);
    for (const Index n : topology.nodes(report.upper.element)) is_upper.push_back(n);
  }
  static Model model_of(const Mesh& mesh, const CohesiveLaw& law) {
    Model model;
    model.mesh = mesh;
    model.materials = {{"glass", ElasticMaterial{2500, 74e9, 0.2}}};
    model.cohesive_laws = {law};
    Part part;
    part.name = "body";
    part.material = "glass";
    part.cohesive_law = law.name;
    model.parts = {part};
    return model;
  }
  /// Nodes are at `place(reference, upper, i)` at step i; does that step and returns the zone's force on the
  /// upper element.
  template <class Place>
  Vec3 go(int i, double step, Place&& place) {
    std::vector<double> given(nodes.force.size());
    for (Index n = 0; n < nodes.count(); ++n) {
      const bool upper = std::find(is_upper.begin(), is_upper.end(), n) != is_upper.end();
      const Vec3 now = place(nodes.x0(n), upper, i);
      const Vec3 behind = (now - place(nodes.x0(n), upper, i - 1)) / step;
      const Vec3 ahead = (place(nodes.x0(n), upper, i + 1) - now) / step;
      now.store(&nodes.position[3 * static_cast<std::size_t>(n)]);
      behind.store(&nodes.velocity[3 * static_cast<std::size_t>(n)]);
      ((nodes.mass[n] / step) * (ahead - behind)).store(&given[3 * static_cast<std::size_t>(n)]);
    }
    nodes.force = given;
    zone.add_force(nodes, step, time, threads);
    time += step;
    Vec3 sum;
    for (const Index n : topology.nodes(report.upper.element))
      sum += nodes.f(n) - Vec3::load(&given[3 * static_cast<std::size_t>(n)]);
    return sum;
  }

  Model model;
  Nodes nodes;
  Topology topology;
  CohesiveZone zone;
  Threads threads;
  Insertion report;
  std::vector<Index> is_upper;
  double time = 0;
};

Mesh two_bricks() {
  BodySettings s;
  s.cells = {2, 1, 1};
  return grid_mesh(s);
}

FacetUse facet_between(const Mesh& mesh) {
  const Topology topology(mesh.node_count(), mesh.types, mesh.connectivity);
  Index f = 0;
  while (topology.mate({0, f}).element != 1) ++f;
  return {0, f};
}

/// Two tetrahedra on one triangle in the plane x = 0, its area 0.5 mm2.
Mesh two_tetrahedra() {
  Mesh mesh;
  mesh.coordinates = {0, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 1e-3, 0, 0, -1e-3, 0, 0};
  mesh.types = {ElementType::tetrahedron, ElementType::tetrahedron};
  mesh.connectivity = {0, 2, 1, 4, 0, 1, 2, 3};
  mesh.parts = {0, 0};
  mesh.part_names = {"body"};
  return mesh;
}

CohesiveLaw tough_law() {
  CohesiveLaw law;
  law.name = "glass";
  law.strength = 60e6;
  law.fracture_energy = 1000;
  law.mode_ratio = 3;
  law.shear_ratio = 1.2;
  return law;
}

void turn_half_open(const Mesh& mesh, const CohesiveLaw& law) {
  const double reach = 2 * law.fracture_energy / law.strength;
  Moved body(mesh, facet_between(mesh), {60e6, 0, 0}, law, 1e3);
  const Vec3 half_open = reach * Vec3{0.4, 0.25, -0.15};
  const double step = 6e-8;
  Vec3 force;
  for (int i = 0; i < 210; ++i) {
    force = body.go(i, step, [&](Vec3 x, bool upper, int k) {
      return upper ? x + std::clamp(k / 200.0, 0.0, 1.0) * half_open : x;
    });
  }
  const CohesiveZone::Energy before = body.zone.energy();
  ASSERT_GT(before.ga, 0.1 * law.fracture_energy * 0.5e-6);
  const Vec3 axis = normalized(Vec3{0.2, -0.7, 0.5});
  const int turn = 10000;  // 1e4 rad/s
  const auto turned = [&](Vec3 v, int k) {
    const double angle = 2 * std::numbers::pi * std::max(0, k) / turn;
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
           (1 - std::cos(angle)) * dot(axis, v) * axis;
  };
  for (int i = 0; i < turn; ++i) {
    const Vec3 now =
        body.go(i, step, [&](Vec3 x, bool upper, int k) { return turned(upper ? x + half_open : x, k); });
    if (i == 0) continue;  // turns from its middle on
    ASSERT_LT(norm(now - turned(force, i)), 1e-5 * norm(force)) << i;
  }
  const CohesiveZone::Energy after = body.zone.energy();
  EXPECT_NEAR(after.ga, before.ga, 1e-6 * before.ga);
  EXPECT_EQ(body.zone.broken_count(), 0);
  // A traction along the opening does no work on a body that turns. Another one has a moment over the
  // opening, which takes or gives a little.
  if (law.mode_ratio == law.shear_ratio * law.shear_ratio) {
    EXPECT_NEAR(after.dissipated, before.dissipated, 1e-5 * before.dissipated);
  }
}

TEST(Insertion, RigidRotationOfAHalfOpenZoneChangesNothing) {
  CohesiveLaw law = tough_law();
  for (const Mesh& mesh : {two_bricks(), two_tetrahedra()}) {
    turn_half_open(mesh, law);
    law.mode_ratio = law.shear_ratio * law.shear_ratio;
    turn_half_open(mesh, law);
  }
}

TEST(Insertion, TriangularFacetsDissipateTheirArea) {
  const CohesiveLaw law = tough_law();
  const double reach = 2 * law.fracture_energy / law.strength;
  const Mesh mesh = two_tetrahedra();
  const double area = 0.5e-6;
  const auto pull = [&](Vec3 end, double energy) {
    Moved body(mesh, facet_between(mesh), {60e6, 0, 0}, law, 1e3);
    double work = 0;
    for (int i = 0; i < 60; ++i) {
      const auto opened = [&](int k) { return std::max(0, k) / 50.0 * end; };
      const Vec3 force =
          body.go(i, 6e-8, [&](Vec3 x, bool upper, int k) { return upper ? x + opened(k) : x; });
      work -= dot(force, 0.5 * (opened(i + 1) - opened(i - 1)));
    }
    EXPECT_EQ(body.zone.broken_count(), 1);
    EXPECT_NEAR(body.zone.energy().ga, energy * area, 1e-9 * energy * area);
    EXPECT_NEAR(body.zone.energy().dissipated, energy * area, 1e-6 * energy * area);
    EXPECT_NEAR(work, energy * area, 1e-6 * energy * area) << "what the nodes' forces did";
  };
  pull({1.1 * reach, 0, 0}, law.fracture_energy);
  pull({0, 0.8 * 1.1 * reach * 3 / 1.2, -0.6 * 1.1 * reach * 3 / 1.2}, 3 * law.fracture_energy);
}

}  // namespace
}  // namespace cdfp
