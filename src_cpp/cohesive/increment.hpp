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
  Vec3 traction;  ///< Pa, that the upper side exerts on the lower one
  Vec3 friction;  ///< the part of it that is friction
  Vec3 slip;      ///< elastic slip at the half step ahead
  Slope slope;    ///< of the traction by the opening ahead, Pa/m
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
  double area = 0;       ///< m2
  bool linear = false;   ///< stiffness and contact as `freeze` found them
  bool closed = false;   ///< as `freeze` found it

  /// Fixes all that makes the reaction nonlinear as it is at opening `x`.
  void freeze(Vec3 x) {
    const Split to(x, normal);
    const double r = weights.opening(to.n, to.t2());
    if (unloading > 0 && r > largest) {
      unloading = softening.mean(largest, r0, r).value;
      largest = r;
    }
    closed = to.n < 0;
    friction = 0;
    linear = true;
  }

  Reaction at(Vec3 x) const {
    Reaction out;
    const Split to(x, normal);
    if (unloading > 0) add_cohesion(to, out);
    if (contact > 0 && (linear ? closed : (from_n < 0 || to.n < 0))) add_contact(to, out);
    return out;
  }

 private:
  void add_cohesion(const Split& to, Reaction& out) const {
    PositiveMean opening = positive_mean(from_n, to.n);
    if (linear) opening = closed ? PositiveMean{0, 0} : PositiveMean{0.5 * (from_n + to.n), 0.5};
    const double t2 = to.t2();
    const double r = weights.opening(to.n, t2);
    const bool loads = !linear && r > largest;
    const Softening::Mean k = loads ? softening.mean(largest, r0, r) : Softening::Mean{unloading, 0};
    const Vec3 path = opening.value * normal + (0.5 * weights.traction) * (from_t + to.t);
    out.traction = k.value * path;
    out.slope.add_axial(k.value * opening.slope, 0.5 * k.value * weights.traction, normal);
    if (loads) {
      const Vec3 gradient = std::max(to.n, 0.0) * normal + weights.effective * to.t;
      out.slope.add_dyad((k.slope / r) * path, gradient);
    }
  }

  /// A stiff spring that only pushes, and Coulomb friction by an elastic slip that ends where it slides:
  /// taken at the half step ahead, so that it never feeds energy in.
  void add_contact(const Split& to, Reaction& out) const {
    PositiveMean closing = positive_mean(-from_n, -to.n);
    if (linear) closing = {-0.5 * (from_n + to.n), 0.5};
    out.traction += (-contact * closing.value) * normal;
    out.slope.add_axial(contact * closing.slope, 0, normal);
    if (friction <= 0) return;
    const double limit = friction * contact * closing.value;
    const Vec3 trial = slip + to.t - from_t;
    const double length = norm(trial);
    if (contact * length <= limit) {
      out.slip = trial;
      out.slope.add_axial(0, contact, normal);
    } else {
      const Vec3 direction = trial / length;
      out.slip = (limit / contact) * direction;
      out.slope.add_axial(0, limit / length, normal);
      out.slope.add_dyad((-limit / length) * direction, direction);
      out.slope.add_dyad((-friction * contact * closing.slope) * direction, normal);
    }
    out.friction = contact * out.slip;
    out.traction += out.friction;
  }
};

}  // namespace cdfp
