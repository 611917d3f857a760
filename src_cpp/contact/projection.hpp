/// Where a node stands to a face, and where two edges cross.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/vec3.hpp"

namespace cdfp {

struct FacePoint {
  std::array<double, 4> shape{};
  double xi = 0, eta = 0;  ///< of a quadrilateral
  Vec3 normal;
  double gap = std::numeric_limits<double>::infinity();
  double outside = std::numeric_limits<double>::infinity();
};

/// Closest point of the bilinear face by Newton on (p - x(xi, eta)) . x_,xi = (p - x) . x_,eta = 0: exact for
/// tapered and warped faces (the area coordinates of appendix E are exact for parallelograms only). There p -
/// x is normal to the face, so the pair's forces have no moment, and the gap's derivative holds no change of
/// xi, eta. Starts from `xi`, `eta`.
inline FacePoint project_on_quadrilateral(Vec3 p, const Vec3* x, double xi = 0, double eta = 0) {
  const Vec3 c0 = 0.25 * (x[0] + x[1] + x[2] + x[3]);
  const Vec3 c1 = 0.25 * (x[1] + x[2] - x[0] - x[3]);
  const Vec3 c2 = 0.25 * (x[2] + x[3] - x[0] - x[1]);
  const Vec3 c3 = 0.25 * (x[0] + x[2] - x[1] - x[3]);
  Vec3 along_xi = c1 + eta * c3, along_eta = c2 + xi * c3, rest = p - (c0 + xi * c1 + eta * along_eta);
  FacePoint point;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const double r1 = dot(rest, along_xi), r2 = dot(rest, along_eta);
    const double a11 = dot(along_xi, along_xi), a22 = dot(along_eta, along_eta);
    const double a12 = dot(along_xi, along_eta) - dot(rest, c3);
    const double d = a11 * a22 - a12 * a12;
    if (!(d > 1e-6 * a11 * a22)) return point;
    const double step1 = (a22 * r1 - a12 * r2) / d, step2 = (a11 * r2 - a12 * r1) / d;
    xi = std::clamp(xi + step1, -3.0, 3.0);
    eta = std::clamp(eta + step2, -3.0, 3.0);
    along_xi = c1 + eta * c3;
    along_eta = c2 + xi * c3;
    rest = p - (c0 + xi * c1 + eta * along_eta);
    if (std::abs(step1) + std::abs(step2) < 1e-7) break;             // quadratic: what is left is below 1e-14
    if (iteration == 0 && dot(c3, c3) < 1e-26 * (a11 + a22)) break;  // a parallelogram: exact already
  }
  point.xi = xi, point.eta = eta;
  const Vec3 n = cross(along_xi, along_eta);
  point.normal = n / norm(n);
  point.gap = dot(point.normal, rest);
  const double past_xi = std::max(std::abs(xi) - 1, 0.0), past_eta = std::max(std::abs(eta) - 1, 0.0);
  point.outside = std::sqrt(past_xi * past_xi * dot(along_xi, along_xi) +
                            past_eta * past_eta * dot(along_eta, along_eta));
  point.shape = {0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta), 0.25 * (1 + xi) * (1 + eta),
                 0.25 * (1 - xi) * (1 + eta)};
  return point;
}

inline FacePoint project_on_triangle(Vec3 p, const Vec3* x) {
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], rest = p - x[0];
  const Vec3 n = cross(a, b);
  const double nn = dot(n, n);
  FacePoint point;
  if (!(nn > 0)) return point;
  const double l1 = dot(cross(rest, b), n) / nn, l2 = dot(cross(a, rest), n) / nn, l0 = 1 - l1 - l2;
  point.normal = n / std::sqrt(nn);
  point.gap = dot(point.normal, rest);
  const double twice_area = std::sqrt(nn);
  const auto past = [&](double l, Vec3 side) { return std::max(-l, 0.0) * twice_area / norm(side); };
  point.outside = std::max({past(l0, x[2] - x[1]), past(l1, b), past(l2, a)});
  point.shape = {l0, l1, l2, 0};
  return point;
}

/// Closest points a + s (b - a) and c + t (d - c) of two straight lines.
struct LineCrossing {
  double s = 0, t = 0;
  Vec3 normal;      ///< unit, along cd x ab (F.2), of either sign
  double sine = 0;  ///< of the angle between the lines
};
inline LineCrossing cross_lines(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
  const Vec3 n = cross(v, u);
  const double nn = dot(n, n);
  LineCrossing crossing;
  if (!(nn > 0)) return crossing;
  const double uw = dot(u, w), vw = dot(v, w);
  crossing.s = (uv * vw - vv * uw) / nn;
  crossing.t = (uu * vw - uv * uw) / nn;
  crossing.normal = n / std::sqrt(nn);
  crossing.sine = std::sqrt(nn / (uu * vv));
  return crossing;
}

}  // namespace cdfp
