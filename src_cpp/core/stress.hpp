/// Invariants of a symmetric stress.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vec3.hpp"

namespace cdfp {

/// Second invariant of the deviator, Pa2.
inline double second_deviator_invariant(const Mat3& s) {
  const double a = s(0, 0) - s(1, 1);
  const double b = s(1, 1) - s(2, 2);
  const double c = s(2, 2) - s(0, 0);
  return (a * a + b * b + c * c) / 6 + s(0, 1) * s(0, 1) + s(1, 2) * s(1, 2) + s(0, 2) * s(0, 2);
}

inline double von_mises(const Mat3& s) {
  return std::sqrt(3 * second_deviator_invariant(s));
}

/// Largest eigenvalue in closed form (Lode angle).
inline double max_principal(const Mat3& s) {
  const double mean = (s(0, 0) + s(1, 1) + s(2, 2)) / 3;
  const double radius = std::sqrt(second_deviator_invariant(s) / 3);
  if (radius == 0) return mean;
  Mat3 deviator = s;
  for (int i = 0; i < 3; ++i) deviator(i, i) -= mean;
  const double cosine = std::clamp(det(deviator) / (2 * radius * radius * radius), -1.0, 1.0);
  return mean + 2 * radius * std::cos(std::acos(cosine) / 3);
}

}  // namespace cdfp
