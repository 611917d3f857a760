// The mean traction between half steps, that the zone solves with: its work, its slope, and what friction
// between closed faces adds in every case of eq. 31.
#include "cohesive/increment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace cdfp {
namespace {

constexpr double kStrength = 60e6;
constexpr double kEnergy = 10;
constexpr double kReach = 2 * kEnergy / kStrength;
constexpr double kStep = 6e-8;
constexpr double kContact = 1e4 * kStrength / kReach;  ///< Pa/m

/// A point that goes from opening to opening, with the accounts that the zone keeps.
class Walker {
 public:
  Walker(const CohesiveLaw& law, Vec3 normal) : law_(law), weights_(law), normal_(normal) {
    // A little opened from the start, as the zone's pairs are.
    largest_ = 1e-9 * kReach;
    softening_ = {kStrength, kReach};
  }

  Increment increment() const {
    const Split from(at_, normal_);
    Increment i;
    i.normal = normal_;
    i.from_n = from.n;
    i.from_t = from.t;
    i.slip = slip_;
    i.weights = weights_;
    i.softening = softening_;
    i.largest = largest_;
    i.r0 = std::min(largest_, weights_.opening(from.n, from.t2()));
    i.unloading = softening_.stiffness(largest_);
    i.contact = kContact;
    i.rate = {law_.rate_sensitivity, kStep * law_.reference_rate};
    i.friction = law_.friction * friction_share(std::min(1.0, largest_ / kReach), law_.friction_exponent);
    i.area = 1;
    return i;
  }

  Reaction go(Vec3 to) {
    const Increment i = increment();
    const Reaction reaction = i.at<false>(to);
    const Vec3 moved = to - at_;
    const Vec3 closed_face = reaction.contact * normal_ + reaction.friction;
    work += dot(reaction.traction, moved);
    heat += dot(closed_face, moved);
    growth_ += weighted_growth(weights_, normal_, at_, to, largest_, kReach);
    const Split split(to, normal_);
    by_rate += i.rate_work(split, weights_.opening(split.n, split.t2()));
    largest_ = std::max(largest_, weights_.opening(split.n, split.t2()));
    at_ = to;
    slip_ = reaction.slip;
    return reaction;
  }
  /// In equal pieces; `see` gets each reaction.
  template <class See>
  void walk(Vec3 to, int pieces, See&& see) {
    const Vec3 from = at_;
    for (int i = 1; i <= pieces; ++i) see(go(from + (static_cast<double>(i) / pieces) * (to - from)));
  }
  void walk(Vec3 to, int pieces) {
    walk(to, pieces, [](const Reaction&) {});
  }

  double stored() const {
    const Split split(at_, normal_);
    return 0.5 * softening_.stiffness(largest_) * weights_.quadratic(split.n, split.t2());
  }
  double pressed() const {
    const double gap = std::min(0.0, dot(at_, normal_));
    return 0.5 * kContact * (gap * gap + dot(slip_, slip_));
  }
  double fracture() const { return 0.5 * kStrength * growth_; }  ///< J/m2, what the law says
  bool broken() const { return largest_ >= kReach; }
  double largest() const { return largest_; }

  double work = 0;     ///< J/m2, of the whole traction
  double heat = 0;     ///< J/m2, work against contact and friction, `pressed` included
  double by_rate = 0;  ///< J/m2, of what the rate adds

 private:
  CohesiveLaw law_;
  ModeWeights weights_;
  Vec3 normal_;
  Softening softening_;
  Vec3 at_;
  Vec3 slip_;
  double largest_;
  double growth_ = 0;
};

CohesiveLaw law_of(double kappa, double eta, double friction = 0, double exponent = 1) {
  CohesiveLaw law;
  law.name = "glass";
  law.strength = kStrength;
  law.fracture_energy = kEnergy;
  law.mode_ratio = kappa;
  law.shear_ratio = eta;
  law.friction = friction;
  law.friction_exponent = exponent;
  return law;
}

const Vec3 kNormal = normalized(Vec3{0.3, -0.5, 0.8});
const Vec3 kAlong = normalized(cross(kNormal, Vec3{1, 0, 0}));
const Vec3 kAcross = cross(kNormal, kAlong);

TEST(Increment, AnyPathDoesTheLawsWorkInAnyIncrements) {
  const unsigned seed = 17;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  for (int path = 0; path < 400; ++path) {
    const double kappa = 0.2 * std::pow(50, 0.5 + 0.5 * pick(random));
    const double eta = 0.5 * std::pow(6, 0.5 + 0.5 * pick(random));
    Walker walker(law_of(kappa, eta), kNormal);
    const double start = walker.stored();
    for (int leg = 0; leg < 12; ++leg) {
      walker.go(kReach * ((0.4 + 0.5 * pick(random)) * kNormal +
                          0.5 * kappa / eta * (pick(random) * kAlong + pick(random) * kAcross)));
      EXPECT_NEAR(walker.work, walker.stored() - start + walker.fracture() + walker.heat,
                  1e-6 * kEnergy * std::min(1.0, kappa))
          << "kappa " << kappa << " eta " << eta << " leg " << leg;
    }
  }
}

TEST(Increment, PureModesAndTwoLegsDissipateTheGivenEnergies) {
  for (const double kappa : {0.2, 0.7, 1.0, 5.0, 10.0}) {
    for (const double eta : {0.5, 1.0, 3.0}) {
      const double slide = 1.01 * kappa / eta * kReach;
      for (const int pieces : {1, 3, 50}) {
        Walker opens(law_of(kappa, eta), kNormal);
        opens.walk(1.01 * kReach * kNormal, pieces);
        EXPECT_NEAR(opens.work, kEnergy, 1e-6 * kEnergy);
        Walker slides(law_of(kappa, eta), kNormal);
        slides.walk(slide * kAlong, pieces);
        EXPECT_NEAR(slides.work, kappa * kEnergy, 1e-6 * kappa * kEnergy);
        for (const double a : {0.3, 0.8}) {
          // Opens to a, closes again, then slides; and the other way round: each growth of the largest
          // opening is in one pure mode.
          Walker first(law_of(kappa, eta), kNormal);
          first.walk(a * kReach * kNormal, pieces);
          first.walk({}, pieces);
          first.walk(slide * kAlong, pieces);
          const double exact = kEnergy * (a + kappa * (1 - a));
          EXPECT_NEAR(first.work, exact, 1e-6 * exact) << kappa << ' ' << eta << ' ' << a;
          Walker second(law_of(kappa, eta), kNormal);
          second.walk(a * kappa / eta * kReach * kAcross, pieces);
          second.walk({}, pieces);
          second.walk(1.01 * kReach * kNormal, pieces);
          const double other = kEnergy * (kappa * a + 1 - a);
          EXPECT_NEAR(second.work, other, 1e-6 * other) << kappa << ' ' << eta << ' ' << a;
        }
      }
    }
  }
}

TEST(Increment, ThousandCyclesAtFixedDamageDissipateNothing) {
  Walker walker(law_of(5, 1.5), kNormal);
  const Vec3 top = kReach * (0.3 * kNormal + 0.8 * kAlong);
  walker.go(top);
  const double fracture = walker.fracture();
  const double work = walker.work;
  for (int cycle = 0; cycle < 1000; ++cycle) {
    for (const Vec3 d : {0.2 * top, -0.01 * top, 0.7 * top, top}) walker.go(d);
  }
  EXPECT_NEAR(walker.fracture(), fracture, 1e-9 * kEnergy);
  EXPECT_NEAR(walker.work, work, 1e-9 * kEnergy);
}

TEST(Increment, CompressionNeitherHealsNorDissipates) {
  Walker walker(law_of(5, 1), kNormal);
  const Vec3 open = 0.4 * kReach * kNormal;
  walker.go(open);
  const double fracture = walker.fracture(), largest = walker.largest(), work = walker.work;
  walker.go(-0.01 * kReach * kNormal);
  walker.go(-0.02 * kReach * kNormal);
  walker.go(open);
  EXPECT_EQ(walker.fracture(), fracture);
  EXPECT_EQ(walker.largest(), largest);
  EXPECT_NEAR(walker.work, work, 1e-9 * kEnergy);
}

TEST(Increment, SlopeIsThatOfTheTraction) {
  const unsigned seed = 23;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const double kappa = trial % 3 == 0 ? 1 : 5;
    const double eta = 1.5;
    Walker walker(law_of(kappa, eta, 0.3), kNormal);
    const auto somewhere = [&](double lowest) {
      return kReach * ((lowest + (0.9 - lowest) * (0.5 + 0.5 * pick(random))) * kNormal +
                       0.6 * kappa / eta * (pick(random) * kAlong + pick(random) * kAcross));
    };
    walker.go(somewhere(0));
    const Increment i = walker.increment();
    const Vec3 x = somewhere(-0.1);
    const Slope slope = i.at<true>(x).slope;
    const double step = 1e-6 * kReach;
    for (int column = 0; column < 3; ++column) {
      Vec3 along;
      along[column] = step;
      const Vec3 found = (i.at<false>(x + along).traction - i.at<false>(x - along).traction) / (2 * step);
      for (int row = 0; row < 3; ++row) {
        // What the turning of the path gives is integrated by three points: it steers iterations only.
        EXPECT_NEAR(slope.v[3 * row + column], found[row], 1e-2 * (norm(found) + kStrength / kReach))
            << trial;
      }
    }
  }
}

CohesiveLaw rate_dependent_law(double kappa, double eta) {
  CohesiveLaw law = law_of(kappa, eta);
  law.rate_sensitivity = 0.12;
  law.reference_rate = 2e-3;
  return law;
}

TEST(Rate, FactorsTheTractionAndTheEnergyAtAConstantRate) {
  for (const double kappa : {0.2, 1.0, 5.0}) {
    for (const double eta : {0.5, 1.0, 3.0}) {
      for (const double rate : {1e-4, 2e-2, 1.0}) {
        const CohesiveLaw law = rate_dependent_law(kappa, eta);
        const double factor = 1 + 0.12 * std::log(1 + rate / 2e-3);
        for (const bool sliding : {false, true}) {
          Walker walker(law, kNormal);
          const Vec3 way = (sliding ? kappa / eta * kReach : kReach) * (sliding ? kAlong : kNormal);
          const double grown = kStep * rate;  // a step, of the effective opening
          const int pieces = static_cast<int>(kReach / grown);
          double first = 0;
          for (int i = 1; i <= pieces; ++i) {
            const Reaction r = walker.go((i * grown / kReach) * way);
            if (i == 1) first = norm(r.traction);
          }
          const double peak = (sliding ? eta : 1) * kStrength * factor;
          if (pieces > 50) {
            EXPECT_NEAR(first, peak, 3 * peak / pieces) << kappa << eta << rate;
          }
          const double energy = (sliding ? kappa : 1) * kEnergy;
          const double x = pieces * grown / kReach;
          EXPECT_NEAR(walker.work - walker.stored(), energy * (x + (factor - 1) * (2 * x - x * x)),
                      1e-6 * energy);
          EXPECT_NEAR(walker.work, walker.fracture() + walker.by_rate + walker.stored(), 1e-8 * energy);
        }
      }
    }
  }
}

TEST(Rate, AnyPathDissipatesAtLeastWhatTheLawDoesAndNothingAtRest) {
  const unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  for (int path = 0; path < 200; ++path) {
    const double kappa = std::exp(1.6 * pick(random)), eta = std::exp(pick(random));
    Walker walker(rate_dependent_law(kappa, eta), kNormal);
    const double start = walker.stored();
    for (int leg = 0; leg < 20 && !walker.broken(); ++leg) {
      const double before = walker.work - walker.stored();
      const double spent = walker.fracture() + walker.by_rate;
      walker.go((0.05 * leg) * kReach *
                ((0.6 + 0.5 * pick(random)) * kNormal + pick(random) * kAlong + pick(random) * kAcross));
      EXPECT_GE(walker.by_rate, 0);
      EXPECT_NEAR(walker.work - walker.stored() - before, walker.fracture() + walker.by_rate - spent,
                  1e-7 * kEnergy * (1 + kappa));
    }
    EXPECT_GE(walker.by_rate, 0.1 * 0.12 * walker.fracture());
    // Within what is open already, the rate changes nothing.
    const double work = walker.work - walker.stored(), added = walker.by_rate;
    walker.go(1e-3 * kReach * kNormal);
    walker.go({});
    EXPECT_EQ(walker.by_rate, added);
    EXPECT_NEAR(walker.work - walker.stored(), work, 1e-9 * kEnergy);
    EXPECT_GE(start, 0);
  }
}

/// Shear under constant pressure: the published curve.
TEST(Friction, MonotonicShearUnderPressureIsThePublishedCurve) {
  for (const double mu : {0.1, 0.4}) {
    for (const double exponent : {0.5, 1.0, 2.0}) {
      const double kappa = 5, eta = 1.5, pressure = 80e6;
      Walker walker(law_of(kappa, eta, mu, exponent), kNormal);
      const Vec3 closed = (-pressure / kContact) * kNormal;
      walker.walk(closed, 1);
      const double slide = 2 * kappa * kEnergy / (eta * kStrength);  // 2 G_II / peak
      const int pieces = 20000;
      const double heat = walker.heat, work = walker.work;
      double slid = 0, last = 0, peak = 0, jump = 0, previous = 0, worst = 0;
      walker.walk(closed + 1.2 * slide * kAlong, static_cast<int>(1.2 * pieces), [&](const Reaction& r) {
        const double middle = slid + 0.5 * slide / pieces;
        slid += slide / pieces;
        last = dot(r.traction, kAlong);
        EXPECT_NEAR(dot(r.traction, kNormal), -pressure, 1e-9 * pressure);
        const double damage = std::min(1.0, middle / slide);
        const double expected =
            eta * kStrength * (1 - damage) + mu * pressure * (1 - std::pow(1 - damage, exponent));
        // Friction is elastic up to its limit and knows the damage of the step before.
        const double reach = 2 * mu * pressure / kContact + 2 * slide / pieces;
        if (middle > 2 * reach && std::abs(middle - slide) > 2 * reach) {
          worst = std::max(worst, std::abs(last - expected));
          jump = std::max(jump, std::abs(last - previous));
        }
        previous = last;
        peak = std::max(peak, last);
      });
      EXPECT_LT(worst, 0.02 * mu * pressure) << mu << ' ' << exponent;
      EXPECT_LT(jump, 0.01 * eta * kStrength) << "no jump " << mu << ' ' << exponent;
      EXPECT_TRUE(walker.broken());
      EXPECT_NEAR(last, mu * pressure, 1e-12 * pressure) << "residual";
      if (mu * pressure * exponent < eta * kStrength) {
        EXPECT_NEAR(peak, eta * kStrength, 2e-4 * eta * kStrength + mu * pressure * 0.01) << "peak shear";
      }
      // Split of the dissipation: kappa G to fracture, the integral of mu p f to friction.
      EXPECT_NEAR(walker.fracture(), kappa * kEnergy, 1e-9 * kappa * kEnergy);
      const double rubbed = mu * pressure * slide * (exponent / (exponent + 1) + 0.2);
      EXPECT_NEAR(walker.heat - heat, rubbed, 5e-3 * rubbed);
      EXPECT_NEAR(walker.work - work, walker.fracture() + walker.heat - heat, 1e-6 * kappa * kEnergy);
    }
  }
}

/// A point broken by sliding, pressed with `pressure` after that.
Walker broken_point(const CohesiveLaw& law, double pressure) {
  Walker walker(law, kNormal);
  walker.go(1.1 * kReach * law.mode_ratio / law.shear_ratio * kAlong);
  walker.go((-pressure / kContact) * kNormal);
  return walker;
}

TEST(Friction, SticksSlidesReversesAndOpens) {
  const double mu = 0.3, pressure = 50e6;
  const CohesiveLaw law = law_of(2, 1, mu);
  const Vec3 closed = (-pressure / kContact) * kNormal;
  const double limit = mu * pressure / kContact;  // elastic slip at which it slides
  Walker walker = broken_point(law, pressure);
  // To and fro a few times brings the friction spring to rest at no slip.
  walker.go(closed + 5 * limit * kAlong);
  Reaction r = walker.go(closed + 4 * limit * kAlong);
  EXPECT_NEAR(dot(r.friction, kAlong), 0, 1e-6 * mu * pressure);
  const Vec3 rest = closed + 4 * limit * kAlong;

  // Sticking: linear, and a closed loop costs nothing.
  const double work = walker.work;
  r = walker.go(rest + 0.6 * limit * kAcross);
  EXPECT_NEAR(dot(r.friction, kAcross), 0.6 * mu * pressure, 1e-9 * pressure);
  walker.go(rest - 0.7 * limit * kAlong);
  r = walker.go(rest);
  EXPECT_NEAR(norm(r.friction), 0, 1e-9 * pressure);
  const double after_loop = walker.work - work;

  // Sliding: mu p against the motion, whatever the direction.
  const Vec3 aside = normalized(0.6 * kAlong + 0.8 * kAcross);
  r = walker.go(rest + 50 * limit * aside);
  r = walker.go(rest + 60 * limit * aside);
  EXPECT_NEAR(norm(r.friction - mu * pressure * aside), 0, 1e-9 * pressure);
  const double slid = walker.work;
  walker.go(rest + 70 * limit * aside);
  EXPECT_NEAR(walker.work - slid, mu * pressure * 10 * limit, 1e-9 * pressure * limit);

  // Reversal: back by twice the elastic slip it pulls the other way with mu p; half way it is zero.
  r = walker.go(rest + 69 * limit * aside);
  EXPECT_NEAR(norm(r.friction), 0, 1e-9 * pressure);
  r = walker.go(rest + 68 * limit * aside);
  EXPECT_NEAR(norm(r.friction + mu * pressure * aside), 0, 1e-9 * pressure);

  // Open: nothing; and when it closes again it starts from no slip.
  walker.go(rest + 68 * limit * aside + 0.1 * kReach * kNormal);
  r = walker.go(rest + 10 * limit * aside + 0.1 * kReach * kNormal);
  EXPECT_EQ(norm(r.traction), 0);
  walker.go(rest + 10 * limit * aside);
  r = walker.go(rest + 10 * limit * aside);
  EXPECT_NEAR(norm(r.friction), 0, 1e-9 * pressure);
  EXPECT_NEAR(r.contact, -pressure, 1e-9 * pressure);
  EXPECT_GE(after_loop, -1e-9 * pressure * limit) << "friction never gives energy";
}

TEST(Friction, NeverGivesEnergyOnAnyPath) {
  const unsigned seed = 31;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pick(-1, 1);
  for (int path = 0; path < 100; ++path) {
    Walker walker(law_of(2, 1, 0.5), kNormal);
    const double start = walker.stored();
    for (int leg = 0; leg < 30; ++leg) {
      const double spent = walker.work - walker.stored() - walker.pressed();
      walker.go(kReach *
                ((1e-4 * pick(random)) * kNormal + 0.3 * (pick(random) * kAlong + pick(random) * kAcross)));
      EXPECT_GE(walker.work - walker.stored() - walker.pressed(), spent - 1e-9 * kEnergy) << path;
    }
    EXPECT_NEAR(walker.work - walker.heat, walker.stored() - start + walker.fracture(), 1e-6 * kEnergy);
  }
}

}  // namespace
}  // namespace cdfp
