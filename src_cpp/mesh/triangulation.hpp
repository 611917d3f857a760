/// Triangles over points of the unit square.
#pragma once

#include <array>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

using PlanePoint = std::array<double, 2>;

struct Triangulation {
  std::vector<std::array<Index, 3>> triangles;  ///< counter-clockwise
  /// Triangle across the side from corner i to corner i + 1, kNone at the rim.
  std::vector<std::array<Index, 3>> neighbours;
};

/// Twice the signed area of a-b-c.
inline double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Delaunay triangles (Bowyer 1981, Watson 1981). The first four points are the corners of a rectangle,
/// counter-clockwise; the others lie inside it or on its sides. Time grows with the square of their number.
Triangulation delaunay(const std::vector<PlanePoint>& points);

}  // namespace cdfp
