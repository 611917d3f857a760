/// The extrinsic irreversible law (Snozzi and Molinari 2013; Chen, Zang, Xu 2015, eqs. 8-10) at one point.
///
/// With w = (eta/kappa)^2 and s = eta^2/kappa:
///   effective opening  r^2 = <dn>^2 + w |dt|^2
///   traction           T = K(D) (dn n + s dt),  K(D) = S (1/D - 1/reach),  D = largest r so far
///   stored energy      K(D)/2 (<dn>^2 + s |dt|^2)
///   dissipation        S/2 m dD,  m = (<dn>^2 + s |dt|^2) / r^2 between 1 (opening) and kappa (sliding)
#pragma once

#include <algorithm>
#include <cmath>

#include "cdfp/model.hpp"
#include "core/vec3.hpp"

namespace cdfp {

/// How a law weighs opening against sliding.
struct ModeWeights {
  double effective = 1;  ///< w
  double traction = 1;   ///< s
  double mode_ratio = 1;

  ModeWeights() = default;
  explicit ModeWeights(const CohesiveLaw& law)
      : effective(law.shear_ratio * law.shear_ratio / (law.mode_ratio * law.mode_ratio)),
        traction(law.shear_ratio * law.shear_ratio / law.mode_ratio),
        mode_ratio(law.mode_ratio) {}

  /// r; `t2` is the square of the sliding.
  double opening(double dn, double t2) const {
    const double p = std::max(dn, 0.0);
    return std::sqrt(p * p + effective * t2);
  }
  /// Twice the stored energy over K.
  double quadratic(double dn, double t2) const {
    const double p = std::max(dn, 0.0);
    return p * p + traction * t2;
  }
};

/// Opening and sliding parts of a vector.
struct Split {
  double n = 0;
  Vec3 t;
  Split(Vec3 d, Vec3 normal) : n(dot(d, normal)), t(d - n * normal) {}
  double t2() const { return dot(t, t); }
};

/// Te = sqrt(<Tn>^2 + (|Tt|/eta)^2), the traction conjugate to r.
inline double effective_traction(Vec3 traction, Vec3 normal, double shear_ratio) {
  const Split split(traction, normal);
  const double p = std::max(split.n, 0.0);
  return std::sqrt(p * p + split.t2() / (shear_ratio * shear_ratio));
}

/// f of eq. 31: the share of its friction that a closed face has at `damage`.
inline double friction_share(double damage, double exponent) {
  return exponent == 1 ? damage : 1 - std::pow(1 - damage, exponent);
}

/// The straight line down: T = scale (1 - D/reach) over D, from D = start.
struct Softening {
  double scale = 0;  ///< Pa
  double reach = 0;  ///< m
  double start = 0;  ///< m: up to here it is elastic

  double damage(double largest) const {
    return largest < reach ? std::max(0.0, (largest - start) / (reach - start)) : 1.0;
  }
  double stiffness(double largest) const { return largest < reach ? scale * (1 / largest - 1 / reach) : 0.0; }

  struct Mean {
    double value;  ///< Pa/m
    double slope;  ///< by the opening at the end
  };
  /// The stiffness that does the law's work over an increment from `r0` <= `largest` to `r1` > `largest`:
  ///   [K(D) (D^2 - r0^2) + integral of 2 T dr from D to min(r1, reach)] / (r1^2 - r0^2)
  /// It lies between K at the end and K at the start, so that no increment can gain energy.
  Mean mean(double largest, double r0, double r1) const {
    const double end = std::min(r1, reach);
    const double unloaded = largest > 0 ? stiffness(largest) * (largest - r0) * (largest + r0) : 0.0;
    const double work = unloaded + scale * (2 - (largest + end) / reach) * (end - largest);
    const double grows = r1 < reach ? 2 * scale * (1 - r1 / reach) : 0.0;
    if (r1 - r0 < 1e-7 * r1) return {0.5 * grows / r1, -0.5 * scale / (r1 * r1)};
    const double squares = (r1 - r0) * (r1 + r0);
    const double value = work / squares;
    return {value, (grows - 2 * r1 * value) / squares};
  }
};

/// How much the traction grows with the opening rate (CohesiveLaw::rate_sensitivity), by what the effective
/// opening grows in a step.
struct RateFactor {
  double sensitivity = 0;
  double scale = 0;  ///< m a step at the reference rate

  double excess(double growth) const { return sensitivity * std::log1p(growth / scale); }
  double slope(double growth) const { return sensitivity / (scale + growth); }
};

/// Mean of <x> over the way from `a` to `b`, and its slope by `b`: (<b>^2 - <a>^2) / (2 (b - a)).
struct PositiveMean {
  double value;
  double slope;
};
inline PositiveMean positive_mean(double a, double b) {
  if (a >= 0 && b >= 0) return {0.5 * (a + b), 0.5};
  if (a <= 0 && b <= 0) return {0, 0};
  const double p = std::max(b, 0.0);
  const double q = std::max(a, 0.0);
  const double value = 0.5 * (p * p - q * q) / (b - a);
  return {value, (p - value) / (b - a)};
}

/// Integral of m dD along the straight segment from opening `d0` to `d1`, D starting at `largest` and ending
/// at `reach` at most: the segment's dissipation over S/2. To `slope` is added what its slope by `d1` has
/// beyond m grad r.
double weighted_growth(const ModeWeights& weights, Vec3 normal, Vec3 d0, Vec3 d1, double largest,
                       double reach, Vec3* slope = nullptr);

}  // namespace cdfp
