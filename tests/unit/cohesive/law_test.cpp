// The law at a point against exact works of separation and against fine integration.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "cdfp/cohesive.hpp"
#include "cdfp/error.hpp"
#include "core/vec3.hpp"

namespace cdfp {
namespace {

constexpr double kStrength = 60e6;
constexpr double kEnergy = 10;

CohesiveLaw law_of(double kappa, double eta) {
  CohesiveLaw law;
  law.name = "glass";
  law.strength = kStrength;
  law.fracture_energy = kEnergy;
  law.mode_ratio = kappa;
  law.shear_ratio = eta;
  return law;
}

const std::vector<std::pair<double, double>> kRatios = {{0.2, 0.5}, {0.2, 3}, {1, 1},  {1, 0.5},
                                                        {5, 1},     {5, 2.2}, {10, 3}, {10, 0.5}};

/// A frame at an angle to the axes.
struct Face {
  Vec3 n = normalized(Vec3{0.3, -0.5, 0.8});
  Vec3 a = normalized(cross(n, Vec3{1, 0, 0}));
  Vec3 b = cross(n, a);
};

class Probe {
 public:
  Probe(const CohesiveLaw& law, Vec3 normal, Vec3 insertion) : law_(law), normal_(normal) {
    start_cohesive(law_, values(insertion), values(normal_), {&point_, 1});
  }
  Vec3 at(Vec3 opening) { return call(cohesive_traction, opening); }
  Vec3 mean(Vec3 opening) { return call(cohesive_mean_traction, opening); }
  void turn(Vec3 normal) { normal_ = normal; }

  /// Straight to `to` in `steps`; returns the work, by a rule of fourth order on each.
  double go(Vec3 to, int steps) {
    const Vec3 from = Vec3::load(point_.opening.data());
    double work = 0;
    Vec3 t0 = point_.largest > 0 ? at(from) : Vec3{};
    bool started = point_.largest > 0;
    for (int i = 1; i <= steps; ++i) {
      const Vec3 begin = from + ((i - 1.0) / steps) * (to - from);
      const Vec3 end = from + (static_cast<double>(i) / steps) * (to - from);
      const Vec3 middle = at(0.5 * (begin + end));
      const Vec3 t1 = at(end);
      if (!started) t0 = 2 * middle - t1, started = true;
      work += dot((t0 + 4 * middle + t1) / 6, end - begin);
      t0 = t1;
    }
    return work;
  }
  const CohesivePoint& point() const { return point_; }
  double stored() const { return cohesive_stored(law_, point_, values(normal_)); }

 private:
  static std::array<double, 3> values(Vec3 v) { return {v.x, v.y, v.z}; }
  template <class Call>
  Vec3 call(Call&& f, Vec3 opening) {
    std::array<double, 3> traction{};
    f(law_, values(opening), values(normal_), std::span<CohesivePoint>(&point_, 1), traction);
    return Vec3::load(traction.data());
  }
  CohesiveLaw law_;
  Vec3 normal_;
  CohesivePoint point_;
};

TEST(CohesiveLaw, StraightPathsDoTheExactWork) {
  const Face face;
  const double reach = 2 * kEnergy / kStrength;
  for (const auto& [kappa, eta] : kRatios) {
    for (const double degrees : {0.0, 10.0, 30.0, 45.0, 60.0, 80.0, 90.0}) {
      const double c = std::cos(degrees * M_PI / 180);
      const double s = std::sin(degrees * M_PI / 180);
      // The angle is that of the effective opening.
      const Vec3 end = reach * (c * face.n + (kappa / eta) * s * (0.6 * face.a + 0.8 * face.b));
      Probe probe(law_of(kappa, eta), face.n, kStrength * face.n);
      const double work = probe.go(end, 64);
      const double exact = kEnergy * (c * c + kappa * s * s);
      EXPECT_NEAR(work, exact, 1e-6 * exact) << kappa << ' ' << eta << ' ' << degrees;
      EXPECT_NEAR(probe.point().dissipated, exact, 1e-9 * exact);
      EXPECT_EQ(norm(probe.at(2 * end)), 0);
      EXPECT_EQ(norm(probe.at(0.1 * end)), 0) << "broken stays broken";

      Probe mean(law_of(kappa, eta), face.n, kStrength * face.n);
      double sum = 0;
      Vec3 last;
      for (const double f : {0.05, 0.3, 0.31, 0.7, 1.4}) {
        sum += dot(mean.mean(f * end), f * end - last);
        last = f * end;
      }
      EXPECT_NEAR(sum, exact, 1e-9 * exact) << "five large increments";
    }
  }
}

TEST(CohesiveLaw, TwoLegsDoTheExactWork) {
  const Face face;
  const double reach = 2 * kEnergy / kStrength;
  for (const auto& [kappa, eta] : kRatios) {
    for (const double a : {0.1, 0.35, 0.5, 0.9}) {
      const double slide = kappa / eta * reach;
      {
        Probe probe(law_of(kappa, eta), face.n, kStrength * face.n);
        double work = probe.go(a * reach * face.n, 16);
        work += probe.go(a * reach * face.n + 1.001 * slide * face.a, 6000);
        const double exact = kEnergy * (1 - (1 - a) * (1 - a) + kappa * (1 - a) * (1 - a));
        EXPECT_NEAR(probe.point().dissipated, exact, 1e-9 * exact) << "normal first " << kappa << ' ' << eta;
        EXPECT_NEAR(work, exact, 1e-6 * exact);
      }
      {
        Probe probe(law_of(kappa, eta), face.n, eta * kStrength * face.a);
        double work = probe.go(a * slide * face.a, 16);
        work += probe.go(a * slide * face.a + 1.001 * reach * face.n, 6000);
        const double exact = kEnergy * (kappa * (1 - (1 - a) * (1 - a)) + (1 - a) * (1 - a));
        EXPECT_NEAR(probe.point().dissipated, exact, 1e-9 * exact) << "sliding first " << kappa << ' ' << eta;
        EXPECT_NEAR(work, exact, 1e-6 * exact);
      }
    }
  }
}

TEST(CohesiveLaw, PeakShearAndReach) {
  const Face face;
  const double kappa = 5, eta = 2;
  Probe probe(law_of(kappa, eta), face.n, eta * kStrength * face.b);
  const double reach = kappa / eta * 2 * kEnergy / kStrength;
  EXPECT_NEAR(norm(probe.at(1e-9 * reach * face.b)), eta * kStrength, 1e-8 * kStrength);
  EXPECT_GT(norm(probe.at(0.999 * reach * face.b)), 0);
  EXPECT_NEAR(norm(probe.at(reach * face.b)), 0, 1e-9 * kStrength);
}

TEST(CohesiveLaw, RandomPathsAgreeWithFineIntegration) {
  const unsigned seed = 4711;
  std::mt19937 random(seed);
  SCOPED_TRACE(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  const Face face;
  const double reach = 2 * kEnergy / kStrength;
  for (const auto& ratios : kRatios) {
    const double kappa = ratios.first, eta = ratios.second;
    for (int path = 0; path < 4; ++path) {
      const auto point = [&] {
        return reach * ((0.35 + 0.55 * pick(random)) * face.n +
                        0.6 * kappa / eta * (pick(random) * face.a + pick(random) * face.b));
      };
      Probe fine(law_of(kappa, eta), face.n, kStrength * face.n);
      Probe coarse(law_of(kappa, eta), face.n, kStrength * face.n);
      double work = 0, coarse_work = 0;
      Vec3 last;
      for (int leg = 0; leg < 6 && !fine.point().broken(); ++leg) {
        const Vec3 next = point();
        work += fine.go(next, 5000);
        const int pieces = 400;
        for (int i = 1; i <= pieces; ++i) {
          const Vec3 d = last + (static_cast<double>(i) / pieces) * (next - last);
          const Vec3 from = Vec3::load(coarse.point().opening.data());
          coarse_work += dot(coarse.mean(d), d - from);
        }
        last = next;
        const double scale = kEnergy * std::max(1.0, kappa);
        EXPECT_NEAR(work, fine.stored() + fine.point().dissipated, 1e-6 * scale) << kappa << ' ' << eta;
        EXPECT_NEAR(coarse.point().dissipated, fine.point().dissipated, 1e-9 * scale)
            << "the state follows straight segments exactly";
        EXPECT_NEAR(coarse_work, work, 1e-4 * scale) << "mean traction over increments of 1/400";
      }
    }
  }
}

TEST(CohesiveLaw, UnloadingAndReloadingDissipatesNothing) {
  const Face face;
  for (const auto& [kappa, eta] : kRatios) {
    Probe probe(law_of(kappa, eta), face.n, kStrength * face.n);
    const double reach = 2 * kEnergy / kStrength;
    const Vec3 top = reach * (0.3 * face.n + 0.3 * kappa / eta * face.a);
    probe.mean(top);
    const double dissipated = probe.point().dissipated;
    const double start = probe.stored();
    double work = 0;
    for (int cycle = 0; cycle < 1000; ++cycle) {
      for (const Vec3 d : {0.2 * top, -0.5 * top, Vec3{}, top}) {
        const Vec3 from = Vec3::load(probe.point().opening.data());
        work += dot(probe.mean(d), d - from);
      }
    }
    EXPECT_NEAR(probe.point().dissipated, dissipated, 1e-9 * kEnergy);
    EXPECT_NEAR(probe.stored(), start, 1e-9 * kEnergy);
    EXPECT_NEAR(work, 0, 1e-9 * kEnergy);
  }
}

TEST(CohesiveLaw, CompressionNeitherHealsNorDissipates) {
  const Face face;
  const double reach = 2 * kEnergy / kStrength;
  Probe probe(law_of(5, 1), face.n, kStrength * face.n);
  const Vec3 open = 0.4 * reach * face.n;
  const Vec3 before = probe.at(open);
  const double dissipated = probe.point().dissipated;
  const Vec3 pressed = probe.at(-20 * reach * face.n);
  EXPECT_LT(norm(pressed), 1e-12 * kStrength);
  EXPECT_EQ(probe.point().dissipated, dissipated);
  EXPECT_NEAR(norm(probe.at(open) - before), 0, 1e-12 * kStrength);
}

TEST(CohesiveLaw, InsertionTractionIsCarriedUntilThePointOpens) {
  const unsigned seed = 99;
  std::mt19937 random(seed);
  SCOPED_TRACE(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  const Face face;
  for (const auto& [kappa, eta] : kRatios) {
    for (int i = 0; i < 20; ++i) {
      const Vec3 carried =
          1e8 * (std::abs(pick(random)) * face.n + pick(random) * face.a + pick(random) * face.b);
      Probe probe(law_of(kappa, eta), face.n, carried);
      EXPECT_LT(norm(probe.at({}) - carried), 1e-8 * kStrength);
      EXPECT_LT(norm(probe.mean({}) - carried), 1e-8 * kStrength);
      // The opening that is conjugate to it reproduces it in the limit.
      const double te = probe.point().strength;
      const Vec3 normal_part = dot(carried, face.n) * face.n;
      const Vec3 towards = (normal_part + (kappa / (eta * eta)) * (carried - normal_part)) / te;
      EXPECT_LT(norm(probe.at(1e-10 * probe.point().reach * towards) - carried), 1e-8 * te);
    }
  }
}

TEST(CohesiveLaw, TurnsWithTheFrame) {
  const unsigned seed = 5;
  std::mt19937 random(seed);
  SCOPED_TRACE(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  const Face face;
  const double reach = 2 * kEnergy / kStrength;
  for (int i = 0; i < 20; ++i) {
    const Vec3 axis = normalized(Vec3{pick(random), pick(random), pick(random)});
    const double angle = 3 * pick(random);
    const auto turn = [&](Vec3 v) {
      return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
             (1 - std::cos(angle)) * dot(axis, v) * axis;
    };
    const CohesiveLaw law = law_of(5, 1.5);
    Probe one(law, face.n, 1e8 * (0.4 * face.n + 0.2 * face.b));
    Probe two(law, turn(face.n), turn(1e8 * (0.4 * face.n + 0.2 * face.b)));
    EXPECT_LT(norm(turn(one.at({})) - two.at({})), 1e-7 * kStrength);
    for (int leg = 0; leg < 5; ++leg) {
      const Vec3 d = 0.3 * reach * (pick(random) * face.n + pick(random) * face.a + pick(random) * face.b);
      EXPECT_LT(norm(turn(one.at(d)) - two.at(turn(d))), 1e-7 * kStrength);
      EXPECT_NEAR(one.point().dissipated, two.point().dissipated, 1e-9 * kEnergy);
    }
  }
}

TEST(CohesiveLaw, RefusesWhatItCannotUse) {
  CohesiveLaw law = law_of(1, 1);
  std::vector<CohesivePoint> points(2);
  const std::vector<double> six(6, 1.0), three(3, 1.0);
  EXPECT_THROW(start_cohesive(law, three, six, points), Error);
  EXPECT_THROW(start_cohesive(law, std::vector<double>(6, 0.0), six, points), Error);
  law.fracture_energy = 0;
  EXPECT_THROW(start_cohesive(law, six, six, points), Error);
  law = law_of(1, 1);
  law.rate_sensitivity = 0.1;
  EXPECT_THROW(start_cohesive(law, six, six, points), Error);
}

}  // namespace
}  // namespace cdfp
