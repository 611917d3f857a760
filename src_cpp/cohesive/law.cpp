#include "cohesive/law.hpp"

namespace cdfp {

namespace {

/// r^2 = a u^2 + 2 b u + c along a part of a segment on which the face is open or closed throughout.
struct EffectiveSquare {
  double a, b, c;

  double at(double u) const { return std::max(0.0, (a * u + 2 * b) * u + c); }
  /// Where r^2 passes `level` while growing.
  double reaches(double level) const {
    const double root = std::sqrt(std::max(0.0, b * b + a * (level - c)));
    return b > 0 ? (level - c) / (b + root) : (root - b) / a;
  }
};

/// Integral of m dr on a part where r grows from `u1` to `u2`, the face open: m = 1 + (s - w) |dt|^2 / r^2,
/// and by parts, with M = |dt|^2: integral of M/r^2 dr = -[M/r] + integral of M'/r du.
double open_part(const ModeWeights& weights, const EffectiveSquare& square, Vec3 sliding, Vec3 slides,
                 double u1, double u2) {
  const double r1 = std::sqrt(square.at(u1));
  const double r2 = std::sqrt(square.at(u2));
  const Vec3 t1 = sliding + u1 * slides;
  const Vec3 t2 = sliding + u2 * slides;
  const double excess = weights.traction - weights.effective;
  if (excess == 0) return r2 - r1;
  const double root = std::sqrt(square.a);
  const double rate1 = square.a * u1 + square.b;  // r dr/du
  const double rate2 = square.a * u2 + square.b;
  if (root * r1 + rate1 <= 1e-12 * (root * r2 + rate2)) {
    return r2 * (1 + excess * dot(t2, t2) / (r2 * r2));  // from the origin: M/r^2 is constant
  }
  // Integrals of 1/r and of (u - u1)/r.
  const double inverse = std::log((root * r2 + rate2) / (root * r1 + rate1)) / root;
  const double moment = (r2 - r1 - rate1 * inverse) / square.a;
  const double parts =
      dot(t1, t1) / r1 - dot(t2, t2) / r2 + 2 * dot(t1, slides) * inverse + 2 * dot(slides, slides) * moment;
  return r2 - r1 + excess * parts;
}

/// Integral over a part, the face open, of u (grad m dr/du - dm/du grad r): m is not a function of r alone,
/// so that a segment's integral changes with its end by more than m grad r there. Three Gauss points; it only
/// steers iterations.
Vec3 turning(const ModeWeights& weights, Vec3 normal, const Split& from, double opens, Vec3 slides, double u1,
             double u2) {
  constexpr double kPlace[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr double kWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const double excess = weights.traction - weights.effective;
  const Vec3 moved = opens * normal + slides;
  Vec3 sum;
  for (int g = 0; g < 3; ++g) {
    const double u = u1 + kPlace[g] * (u2 - u1);
    const Vec3 t = from.t + u * slides;
    const double n = from.n + u * opens;
    const double m2 = dot(t, t);
    const double q = n * n + weights.effective * m2;
    if (q == 0) continue;
    const Vec3 half = n * normal + weights.effective * t;  // r grad r
    const Vec3 grad_m = (2 * excess / q) * (t - (m2 / q) * half);
    sum += (kWeight[g] * u / std::sqrt(q)) * (dot(half, moved) * grad_m - dot(grad_m, moved) * half);
  }
  return (u2 - u1) * sum;
}

}  // namespace

double weighted_growth(const ModeWeights& weights, Vec3 normal, Vec3 d0, Vec3 d1, double largest,
                       double reach, Vec3* slope) {
  const Split from(d0, normal);
  const Split to(d1, normal);
  if (largest >= reach || weights.opening(to.n, to.t2()) <= largest) return 0;
  const double opens = to.n - from.n;
  const Vec3 slides = to.t - from.t;
  // r is convex along the segment and starts at `largest` at most: it passes `largest` and `reach` once.
  const bool crosses = (from.n < 0) != (to.n < 0);
  const double turn = crosses ? from.n / (from.n - to.n) : 1.0;
  double sum = 0;
  for (int part = 0; part < (crosses ? 2 : 1); ++part) {
    const double begin = part == 0 ? 0.0 : turn;
    const double end = part == 0 ? turn : 1.0;
    const bool open = part == 0 && crosses ? from.n > to.n : to.n >= 0;
    EffectiveSquare square{weights.effective * dot(slides, slides), weights.effective * dot(from.t, slides),
                           weights.effective * from.t2()};
    if (open) square.a += opens * opens, square.b += from.n * opens, square.c += from.n * from.n;
    if (square.at(end) <= largest * largest || square.at(begin) >= reach * reach) continue;
    const double u1 = square.a > 0 ? std::clamp(square.reaches(largest * largest), begin, end) : begin;
    const double u2 =
        square.at(end) > reach * reach ? std::clamp(square.reaches(reach * reach), u1, end) : end;
    if (open && slope != nullptr) *slope += turning(weights, normal, from, opens, slides, u1, u2);
    sum += open ? open_part(weights, square, from.t, slides, u1, u2)
                : weights.mode_ratio * (std::sqrt(square.at(u2)) - std::sqrt(square.at(u1)));
  }
  return sum;
}

}  // namespace cdfp
