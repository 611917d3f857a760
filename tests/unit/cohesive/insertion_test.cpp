// Insertion without a jump: traction, crack time, order of facets, turning bodies and triangular facets.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
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

/// A solid that is torn from a notch, so that facets open around its tip, several a step and sharing nodes.
SpringBody torn_solid() {
  BodySettings s;
  s.cells = {6, 6, 4};
  s.solid = true;
  s.law.mode_ratio = 5;
  s.law.friction = 0.2;
  s.law.fracture_energy = 100;
  SpringBody body(s);
  const Vec3 middle{3e-3, 3e-3, 2e-3};
  body.set_velocity([&](Vec3 x) {
    const Vec3 c = x - middle;
    return Vec3{6000 * c.x * (1 + 300 * (x.y + 0.5 * x.z)), 1500 * c.y - 2000 * c.x, 900 * c.z};
  });
  return body;
}

/// Velocities of the corners of all elements.
std::vector<Vec3> corner_velocities(const SpringBody& body) {
  std::vector<Vec3> all;
  for (Index e = 0; e < body.topology.bulk_count(); ++e) {
    for (const Index n : body.topology.nodes(e)) all.push_back(body.nodes.v(n));
  }
  return all;
}

/// Two bodies that are the same up to one step, in which the one's facets open and the other's do not, must
/// move alike in that step: the traction before is the traction after.
TEST(Insertion, TractionGoesOnAlsoAtCrackFrontsAndSharedNodes) {
  Index inserted = 0;
  Index most_at_once = 0;
  std::size_t at_open_cracks = 0;
  for (int step = 1; step < 60; ++step) {
    SpringBody opens = torn_solid(), holds = torn_solid();
    for (int i = 0; i < step; ++i) {
      opens.step({}, opens.all);
      holds.step({}, holds.all);
    }
    const Index before = holds.zone.count();
    opens.step({}, opens.all);
    const Index now = opens.zone.count() - before;
    if (now == 0) continue;
    holds.step();
    inserted += now;
    most_at_once = std::max(most_at_once, now);
    if (holds.zone.energy().ga > 0) at_open_cracks += now;
    const std::vector<Vec3> a = corner_velocities(opens), b = corner_velocities(holds);
    // The lightest node is one corner; a facet's share at a corner is a quarter of it.
    const double most =
        1e-8 * opens.s.law.strength * 0.25 * opens.section() * opens.s.step / opens.corner_mass();
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LT(norm(a[i] - b[i]), most) << step << ' ' << now;
    if (inserted > 400) break;
  }
  EXPECT_GT(inserted, 100);
  EXPECT_GT(most_at_once, 20);
  EXPECT_GT(at_open_cracks, 50u);
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

/// The times at which the torn solid has opened some shares of its first cracks.
std::vector<double> crack_growth(double step) {
  BodySettings s;
  s.cells = {6, 4, 4};
  s.size = {1e-3, 1e-3, 1e-3};
  s.solid = true;
  s.step = step;
  s.law.fracture_energy = 300;
  s.law.mode_ratio = 2;
  SpringBody body(s);
  body.set_velocity([&](Vec3 x) { return Vec3{2500 * (x.x - 3e-3) * (1 + 200 * x.y + 100 * x.z), 0, 0}; });
  // One plane, from its far edge on.
  body.accept = [&](const OpenFacet& f) {
    return f.lower.element % 6 == 2 && body.topology.mate(f.lower).element == f.lower.element + 1;
  };
  std::vector<double> times;
  const double all = s.law.fracture_energy * 16 * body.section();
  for (const double share : {0.05, 0.2, 0.4}) {
    while (body.zone.energy().ga < share * all && body.time < 2e-5) body.step({}, body.all);
    times.push_back(body.time);
  }
  EXPECT_GT(body.zone.energy().ga, 0.39 * all);
  return times;
}

TEST(Insertion, CrackTimesInASolidConvergeUnderStepHalving) {
  const std::vector<double> exact = crack_growth(2.5e-9);
  for (const double step : {4e-8, 2e-8, 1e-8}) {
    const std::vector<double> times = crack_growth(step);
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(times[i], exact[i], 4.5 * step) << step << " " << i;
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
    for (const auto& [node, mother] : report.new_nodes) nodes.clone(mother, model.mesh.coordinates);
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
  /// Adds the forces' moment about the origin to `moment`.
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
    for (Index n = 0; n < nodes.count(); ++n) {
      const Vec3 force = nodes.f(n) - Vec3::load(&given[3 * static_cast<std::size_t>(n)]);
      if (std::find(is_upper.begin(), is_upper.end(), n) != is_upper.end()) sum += force;
      resultant += force;
      moment += cross(nodes.x(n), force);
    }
    return sum;
  }

  Model model;
  Nodes nodes;
  Topology topology;
  CohesiveZone zone;
  Threads threads;
  Insertion report;
  std::vector<Index> is_upper;
  Vec3 resultant;  ///< N and N m, of the zone's forces, summed over the steps
  Vec3 moment;
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
  for (int i = -1; i < 210; ++i) {  // the pairs come to be at rest
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
  // Whether the traction pulls along the opening or not.
  EXPECT_NEAR(after.dissipated, before.dissipated, 1e-5 * before.dissipated);
}

TEST(Insertion, RigidRotationOfAHalfOpenZoneChangesNothing) {
  CohesiveLaw law = tough_law();
  for (const Mesh& mesh : {two_bricks(), two_tetrahedra()}) {
    turn_half_open(mesh, law);
    law.mode_ratio = law.shear_ratio * law.shear_ratio;
    turn_half_open(mesh, law);
  }
}

/// Opening, sliding and turning at random until the facet breaks.
TEST(Insertion, ForcesOnAnyPathHaveNeitherResultantNorMoment) {
  const unsigned seed = 17;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  const CohesiveLaw law = tough_law();
  const double reach = 2 * law.fracture_energy / law.strength;
  for (const Mesh& mesh : {two_bricks(), two_tetrahedra()}) {
    for (int path = 0; path < 10; ++path) {
      Moved body(mesh, facet_between(mesh), {60e6, 0, 0}, law, 1);
      std::vector<Vec3> legs{{}};
      for (int leg = 1; leg <= 12; ++leg)
        legs.push_back((leg / 10.0) * reach *
                       Vec3{0.6 + 0.5 * pick(random), 2 * pick(random), 2 * pick(random)});
      legs.back().x = 1.2 * reach;
      const Vec3 axis = normalized(Vec3{pick(random), pick(random), pick(random)});
      const auto place = [&](Vec3 x, bool upper, int k) {
        const double at = std::clamp(k / 20.0, 0.0, 11.99);
        const auto leg = static_cast<std::size_t>(at);
        const double share = at - std::floor(at);
        const Vec3 v = upper ? x + (1 - share) * legs[leg] + share * legs[leg + 1] : x;
        const double angle = 0.002 * std::max(0, k);
        return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
               (1 - std::cos(angle)) * dot(axis, v) * axis;
      };
      double largest = 0;
      for (int i = -1; i < 260; ++i) {
        body.go(i, 6e-8, place);
        largest = std::max(largest, norm(body.moment));
      }
      ASSERT_EQ(body.zone.broken_count(), 1);
      // What is missed of a moment is held one step later, so that at the end all of it has been.
      const double scale = law.strength * body.zone.energy().ga / law.fracture_energy * reach;
      EXPECT_LT(largest, scale);
      EXPECT_GT(largest, 1e-3 * scale);
      EXPECT_LT(norm(body.moment), 2e-6 * scale) << "rounding of the forces that turn the masses";
      EXPECT_LT(norm(body.resultant), 2e-6 * scale / reach);
    }
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
    for (int i = -1; i < 60; ++i) {  // the pairs come to be at rest
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
