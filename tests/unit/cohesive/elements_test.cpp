// The services on a caller's arrays do what the simulation's own stages do, to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <string>

#include "cdfp/cohesive.hpp"
#include "cdfp/error.hpp"
#include "spring_body.hpp"

namespace cdfp {
namespace {

/// Runs the services beside a body, on a topology of their own that opens what their criterion finds.
class Beside {
 public:
  Beside(SpringBody& body, const CohesiveLaw& law, StressRecovery recovery)
      : body_(body),
        topology_(body.model.mesh.node_count(), body.model.mesh.types, body.model.mesh.connectivity),
        criterion_(topology_, body.model.mesh.coordinates, settings(body, law, recovery)),
        elements_(topology_.bulk_count()) {
    law_ = elements_.add_law(law);
  }

  /// To be called when all but the cohesive forces of the step stand.
  void step(const Nodes& nodes) {
    std::vector<double> stress;
    for (Index e = 0; e < topology_.bulk_count(); ++e) {
      const Mat3 s = body_.stress(e);
      stress.insert(stress.end(), {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)});
    }
    const std::span<const double> before(nodes.position.data(), 3 * topology_.node_count());
    criterion_.find(topology_, before, stress, open_);
    ASSERT_EQ(open_.size(), body_.open.size());
    for (std::size_t i = 0; i < open_.size(); ++i) {
      ASSERT_EQ(open_[i].lower, body_.open[i].lower);
      ASSERT_EQ(open_[i].law, 0);
      ASSERT_EQ(std::memcmp(open_[i].traction.data(), &body_.open[i].traction, 24), 0);
      topology_.insert_cohesive(open_[i].lower, report_);
      elements_.follow(report_);
      elements_.insert(report_.cohesive_element, law_, topology_.nodes(report_.cohesive_element),
                       open_[i].traction, nodes.position, body_.time);
    }
    force = nodes.force;
    elements_.add_force({nodes.position, nodes.velocity, nodes.mass, force}, body_.s.step, body_.time,
                        body_.s.threads);
    opened += open_.size();
  }

  const CohesiveElements& elements() const { return elements_; }
  std::vector<double> force;
  std::size_t opened = 0;

 private:
  static CohesiveCriterion::Settings settings(const SpringBody& body, CohesiveLaw law,
                                              StressRecovery recovery) {
    law.name = "not asked for";
    return {{law}, {0}, body.model.mesh.parts, recovery, {}};
  }
  SpringBody& body_;
  Topology topology_;
  CohesiveCriterion criterion_;
  CohesiveElements elements_;
  Index law_;
  Insertion report_;
  std::vector<CohesiveCriterion::Opening> open_;
};

TEST(CohesiveElements, ForcesAreThoseOfTheZoneToTheBit) {
  for (const int threads : {1, 3}) {
    for (const double scatter : {0.0, 8.0}) {
      BodySettings s;
      s.cells = {4, 4, 4};
      s.size = {0.9e-3, 1e-3, 1.1e-3};
      s.solid = true;
      s.law.mode_ratio = 5;
      s.law.friction = 0.3;
      s.law.weibull_modulus = scatter;
      s.law.weibull_area = scatter > 0 ? 1e-6 : 0;
      s.threads = threads;
      SpringBody body(s);
      Beside beside(body, s.law, StressRecovery::element_mean);
      std::mt19937 random(5);
      std::uniform_real_distribution<double> pick(-1, 1);
      body.set_velocity([&](Vec3 x) {
        const Vec3 c = x - Vec3{1.8e-3, 2e-3, 2.2e-3};
        return 10000 * (Vec3{c.x, 0.7 * c.y - 0.4 * c.x, 0.5 * c.z} +
                        3e-4 * Vec3{pick(random), pick(random), pick(random)});
      });
      body.step();
      for (int i = 0; i < 120; ++i) {
        body.step([&](Nodes& nodes) { beside.step(nodes); }, body.all);
        if (HasFatalFailure()) return;
        ASSERT_EQ(beside.force.size(), body.nodes.force.size());
        ASSERT_EQ(std::memcmp(beside.force.data(), body.nodes.force.data(), 8 * beside.force.size()), 0)
            << "step " << i;
      }
      const CohesiveElements& elements = beside.elements();
      EXPECT_GT(beside.opened, 50u);
      EXPECT_GT(elements.broken_count(), 20);
      EXPECT_EQ(elements.broken_count(), body.zone.broken_count());
      EXPECT_EQ(elements.energy().dissipated, body.zone.energy().dissipated);

      double dissipated = 0;
      const Index first = body.topology.bulk_count();
      for (Index e = first; e < first + elements.count(); ++e) {
        for (Index c = 0; c < elements.corner_count(e); ++c) {
          const CohesivePointState point = elements.point(e, c);
          dissipated += point.area * point.dissipated;
          EXPECT_GE(point.damage, 0);
          EXPECT_LE(point.damage, 1);
          EXPECT_EQ(point.damage == 1, point.largest >= point.reach);
        }
      }
      EXPECT_NEAR(dissipated, elements.energy().dissipated, 1e-5 * dissipated)
          << "point by point, but for the couples that hold the facets' frames";
    }
  }
}

/// Two facing squares of 1 mm, nodes 4 to 7 above 0 to 3.
struct Pair {
  std::vector<double> position, velocity = std::vector<double>(24, 0.0), mass = std::vector<double>(8, 1e-6),
                                force = std::vector<double>(24, 0.0);
  std::vector<Index> corners{4, 5, 6, 7, 0, 1, 2, 3};
  CohesiveElements elements;
  Pair() {
    for (int side = 0; side < 2; ++side) {
      for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1e-3, 0.0}, {1e-3, 1e-3}, {0.0, 1e-3}}) {
        position.insert(position.end(), {x, y, 0});
      }
    }
    CohesiveLaw law;
    law.strength = 60e6;
    law.fracture_energy = 10;
    elements.add_law(law);
  }
  CohesiveElements::Arrays arrays() { return {position, velocity, mass, force}; }
};

TEST(CohesiveElements, CarriesTheFacetsTractionAtFirstAndHeldNodesStay) {
  Pair p;
  const std::vector<Index> below{0, 1, 2, 3};
  p.elements.hold(below, {true, true, true});
  p.elements.insert(0, 0, p.corners, {1e6, 0, 60e6}, p.position, 0);
  // The rest of the body pulls as hard.
  const double share = 1e-6 / 4;
  for (int n = 0; n < 8; ++n) {
    p.force[3 * n] = (n < 4 ? -1e6 : 1e6) * share;
    p.force[3 * n + 2] = (n < 4 ? -60e6 : 60e6) * share;
  }
  p.elements.add_force(p.arrays(), 1e-8, 0);
  for (int n = 0; n < 8; ++n) {
    EXPECT_NEAR(p.force[3 * n], 0, 1e-3 * 1e6 * share);
    EXPECT_NEAR(p.force[3 * n + 2], 0, 1e-3 * 60e6 * share);
  }
}

void expect_refused(const std::function<void()>& call, const std::string& words) {
  try {
    call();
    ADD_FAILURE() << "not refused: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_argument);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(CohesiveElements, RefusesWhatItCannotTakeAndStaysAsItWas) {
  Pair p;
  const std::array<double, 3> pull{0, 0, 60e6};
  const auto insert = [&](Index element, Index law, std::vector<Index> corners, std::array<double, 3> t) {
    p.elements.insert(element, law, corners, t, p.position, 0);
  };
  expect_refused([&] { insert(1, 0, p.corners, pull); }, "is not the next one, which is 0");
  expect_refused([&] { insert(0, 1, p.corners, pull); }, "has the law 1; there are 1");
  expect_refused([&] { insert(0, 0, {0, 1, 2, 3}, pull); }, "has 4 corners; give 6 or 8");
  expect_refused([&] { insert(0, 0, {4, 5, 6, 8, 0, 1, 2, 3}, pull); }, "names node 8");
  expect_refused([&] { insert(0, 0, {4, 5, 4, 5, 0, 1, 0, 1}, pull); }, "has no area");
  expect_refused([&] { insert(0, 0, p.corners, {0, 0, 0}); }, "carries nothing");
  expect_refused([&] { insert(0, 0, p.corners, {NAN, 0, 0}); }, "traction is not finite");
  EXPECT_EQ(p.elements.count(), 0);
  insert(0, 0, p.corners, pull);
  expect_refused([&] { p.elements.point(1, 0); }, "no cohesive element 1");
  expect_refused([&] { p.elements.point(0, 4); }, "has no pair 4");
  expect_refused([&] { p.elements.add_force(p.arrays(), 0, 0); }, "the step is");
  CohesiveElements::Arrays few = p.arrays();
  few.velocity = few.velocity.first(21);
  expect_refused([&] { p.elements.add_force(few, 1e-9, 0); }, "'velocity' has 21 numbers");
  few = {few.position.first(21), few.velocity, few.mass.first(7), few.force.first(21)};
  expect_refused([&] { p.elements.add_force(few, 1e-9, 0); }, "name node 7");
  p.position[5] = NAN;
  expect_refused([&] { p.elements.add_force(p.arrays(), 1e-9, 0); }, "node 1 of a cohesive element");
  p.position[5] = 0;
  p.mass[6] = 0;
  expect_refused([&] { p.elements.add_force(p.arrays(), 1e-9, 0); }, "no positive mass");
  for (const double f : p.force) EXPECT_EQ(f, 0);
}

}  // namespace
}  // namespace cdfp
