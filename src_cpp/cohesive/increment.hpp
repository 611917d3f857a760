/// A point between two half steps: its mean traction as a function of the opening at the half step ahead.
#pragma once

#include "cohesive/law.hpp"

namespace cdfp {

/// Rows of a tensor that is added up from dyads.
struct Slope {
  double v[9] = {};

  /// += a b^T
  void add_dyad(Vec3 a, Vec3 b) {
    for (int i = 0; i < 3; ++i) {
      v[3 * i] += a[i] * b.x;
      v[3 * i + 1] += a[i] * b.y;
      v[3 * i + 2] += a[i] * b.z;
    }
  }
  /// += along n n^T + across (I - n n^T)
  void add_axial(double along, double across, Vec3 n) {
    add_dyad((along - across) * n, n);
    v[0] += across, v[4] += across, v[8] += across;
  }
};

struct Reaction {
  Vec3 traction;       ///< Pa, that the upper side exerts on the lower one
  Vec3 friction;       ///< the part of it that is friction
  double contact = 0;  ///< the part of it along the normal that is contact; negative presses
  Vec3 slip;           ///< elastic slip at the half step ahead
  Slope slope;         ///< of the traction by the opening ahead, Pa/m
};

struct Increment {
  Vec3 normal;
  Vec3 from_t;        ///< sliding at the half step behind
  double from_n = 0;  ///< opening at the half step behind
  Vec3 slip;          ///< elastic slip of the friction spring
  ModeWeights weights;
  Softening softening;
  double largest = 0;
  double r0 = 0;
  double unloading = 0;  ///< Pa/m, K(largest); 0 once broken
  double contact = 0;    ///< Pa/m, stiffness of the closed face; 0 leaves contact to others
  double friction = 0;   ///< Coulomb coefficient, scaled by eq. 31
  RateFactor rate;
  double area = 0;      ///< m2
  Vec3 given;           ///< Pa, by a user's law: the same over the whole increment
  bool linear = false;  ///< stiffness and contact as `freeze` found them
  bool closed = false;  ///< as `freeze` found it

  /// Takes the stiffness of contact and of a little opened face down to `share` of that of contact.
  void soften(double share) {
    contact *= share;
    if (unloading <= contact || contact == 0) return;
    largest = softening.reach / (1 + contact * softening.reach / softening.scale);
    unloading = contact;
  }

  /// Fixes all that makes the reaction nonlinear as it is at opening `x`.
  void freeze(Vec3 x) {
    if (linear) return;
    const Split to(x, normal);
    const double r = weights.opening(to.n, to.t2());
    if (unloading > 0 && r > largest) {
      unloading = softening.mean(largest, r0, r).value;
      largest = r;
    }
    closed = from_n < 0 && to.n < 0;
    friction = 0;
    linear = true;
  }

  /// J/m2, what the traction beyond the law does by its rate on the way to effective opening `r` at `to`.
  double rate_work(const Split& to, double r) const {
    if (rate.sensitivity == 0 || !(unloading > 0) || r <= largest) return 0;
    return rate.excess(r - largest) * law_work(to, r);
  }

  /// With or without its slope.
  template <bool Sloped>
  Reaction at(Vec3 x) const {
    Reaction out;
    out.traction = given;
    const Split to(x, normal);
    if (unloading > 0) add_cohesion<Sloped>(to, out);
    if (contact > 0 && (linear ? closed : (from_n < 0 || to.n < 0))) add_contact<Sloped>(to, out);
    return out;
  }

 private:
  template <bool Sloped>
  void add_cohesion(const Split& to, Reaction& out) const {
    PositiveMean opening = positive_mean(from_n, to.n);
    if (linear) opening = closed ? PositiveMean{0, 0} : PositiveMean{0.5 * (from_n + to.n), 0.5};
    const double t2 = to.t2();
    const double r = weights.opening(to.n, t2);
    const bool loads = !linear && r > largest;
    const Softening::Mean k = loads ? softening.mean(largest, r0, r) : Softening::Mean{unloading, 0};
    const Vec3 path = opening.value * normal + (0.5 * weights.traction) * (from_t + to.t);
    out.traction += k.value * path;
    if constexpr (Sloped)
      out.slope.add_axial(k.value * opening.slope, 0.5 * k.value * weights.traction, normal);
    if (loads) {
      const Vec3 gradient = std::max(to.n, 0.0) * normal + weights.effective * to.t;
      if constexpr (Sloped) out.slope.add_dyad((k.slope / r) * path, gradient);
      if (weights.mode_ratio != 1) add_path<Sloped>(to, r, k, gradient, out);
      if (rate.sensitivity > 0) add_rate<Sloped>(to, r, gradient / r, out);
    }
  }

  /// J/m2, of the law's own traction where it softens, from `largest` to `r`.
  double law_work(const Split& to, double r) const {
    const double end = std::min(r, softening.reach);
    const double growth = weights.mode_ratio == 1
                              ? end - largest
                              : weighted_growth(weights, normal, from_n * normal + from_t,
                                                to.n * normal + to.t, largest, softening.reach);
    return softening.scale * (1 - 0.5 * (largest + end) / softening.reach) * growth;
  }

  /// What the rate adds goes along the gradient of r, so that it never gives energy; along the increment
  /// where that gradient turns on the way (Gonzalez 1996), so that its work is `rate_work`.
  template <bool Sloped>
  void add_rate(const Split& to, double r, Vec3 gradient, Reaction& out) const {
    const double way = r - r0;
    const Vec3 moved = (to.n - from_n) * normal + (to.t - from_t);
    const double square = dot(moved, moved);
    if (way <= 1e-12 * r || square == 0) return;
    const double law = law_work(to, r);
    const double excess = rate.excess(r - largest);
    const Vec3 direction = gradient + ((way - dot(gradient, moved)) / square) * moved;
    const double size = excess * law / way;
    out.traction += size * direction;
    if constexpr (!Sloped) return;
    const double grows = r < softening.reach ? softening.scale * (1 - r / softening.reach) *
                                                   weights.quadratic(to.n, to.t2()) / (r * r)
                                             : 0.0;
    const double slope = (rate.slope(r - largest) * law + excess * grows - size) / way;
    out.slope.add_dyad(slope * direction - (size / r) * gradient, gradient);
    out.slope.add_axial(to.n > 0 ? size / r : 0, weights.effective * size / r, normal);
  }

  /// Where the ratio of opening to sliding changes on the way, the mean stiffness misses the work of the
  /// straight path by a little: the rest goes along the increment (Gonzalez 1996).
  template <bool Sloped>
  void add_path(const Split& to, double r, Softening::Mean k, Vec3 gradient, Reaction& out) const {
    const Vec3 moved = (to.n - from_n) * normal + (to.t - from_t);
    const double square = dot(moved, moved);
    if (weights.effective * square <= 1e-12 * r * r) return;  // the rest is rounding
    const double s0 = weights.quadratic(from_n, dot(from_t, from_t));
    const double s1 = weights.quadratic(to.n, to.t2());
    const double k1 = softening.stiffness(r);
    Vec3 turning;
    const double growth = weighted_growth(weights, normal, from_n * normal + from_t, to.n * normal + to.t,
                                          largest, softening.reach, Sloped ? &turning : nullptr);
    const double missing = 0.5 * (k1 * s1 - unloading * s0 + softening.scale * growth - k.value * (s1 - s0));
    out.traction += (missing / square) * moved;
    if constexpr (!Sloped) return;
    const Vec3 path = std::max(to.n, 0.0) * normal + weights.traction * to.t;
    const Vec3 missing_slope = (k1 - k.value) * path - (0.5 * (s1 - s0) * k.slope / r) * gradient +
                               (0.5 * softening.scale) * turning;
    out.slope.add_dyad(moved / square, missing_slope - (2 * missing / square) * moved);
    out.slope.add_axial(missing / square, missing / square, normal);
  }

  /// A stiff spring that only pushes, and Coulomb friction by an elastic slip that ends where it slides:
  /// taken at the half step ahead, so that it never feeds energy in.
  template <bool Sloped>
  void add_contact(const Split& to, Reaction& out) const {
    PositiveMean closing = positive_mean(-from_n, -to.n);
    if (linear) closing = {-0.5 * (from_n + to.n), 0.5};
    out.contact = -contact * closing.value;
    out.traction += out.contact * normal;
    if constexpr (Sloped) out.slope.add_axial(contact * closing.slope, 0, normal);
    if (friction <= 0) return;
    const double limit = friction * contact * closing.value;
    const Vec3 trial = slip + to.t - from_t;
    const double length = norm(trial);
    if (contact * length <= limit) {
      out.slip = trial;
      if constexpr (Sloped) out.slope.add_axial(0, contact, normal);
    } else {
      const Vec3 direction = trial / length;
      out.slip = (limit / contact) * direction;
      if constexpr (Sloped) {
        out.slope.add_axial(0, limit / length, normal);
        out.slope.add_dyad((-limit / length) * direction, direction);
        out.slope.add_dyad((-friction * contact * closing.slope) * direction, normal);
      }
    }
    out.friction = contact * out.slip;
    out.traction += out.friction;
  }
};

}  // namespace cdfp
