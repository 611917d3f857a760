#include "mesh/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "cdfp/error.hpp"

namespace cdfp {

namespace {

using Triangle = std::array<Index, 3>;
using Side = std::array<Index, 2>;

struct Circled {
  Triangle corners;
  PlanePoint center;
  double radius2;
};

const PlanePoint& at(const std::vector<PlanePoint>& points, Index i) {
  return points[static_cast<std::size_t>(i)];
}

Circled circled(const std::vector<PlanePoint>& points, const Triangle& t) {
  const PlanePoint& a = at(points, t[0]);
  const double bx = at(points, t[1])[0] - a[0], by = at(points, t[1])[1] - a[1];
  const double cx = at(points, t[2])[0] - a[0], cy = at(points, t[2])[1] - a[1];
  const double d = 2 * (bx * cy - by * cx);
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double x = (cy * b2 - by * c2) / d, y = (bx * c2 - cx * b2) / d;
  return {t, {a[0] + x, a[1] + y}, x * x + y * y};
}

/// Replaces the triangles whose circle holds the point by a fan around it.
void insert(const std::vector<PlanePoint>& points, Index point, std::vector<Circled>& triangles) {
  const PlanePoint& p = at(points, point);
  const auto keeps = [&](const Circled& t) {
    const double dx = p[0] - t.center[0], dy = p[1] - t.center[1];
    return dx * dx + dy * dy >= t.radius2 * (1 - 1e-12);
  };
  const auto cavity = std::partition(triangles.begin(), triangles.end(), keeps);
  std::vector<Side> sides;
  for (auto t = cavity; t != triangles.end(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) sides.push_back({t->corners[i], t->corners[(i + 1) % 3]});
  }
  triangles.erase(cavity, triangles.end());
  for (const Side& s : sides) {
    const bool inside = std::find(sides.begin(), sides.end(), Side{s[1], s[0]}) != sides.end();
    const bool holds_point = turn(at(points, s[0]), at(points, s[1]), p) == 0;
    if (!inside && !holds_point) triangles.push_back(circled(points, {s[0], s[1], point}));
  }
}

Triangulation with_neighbours(const std::vector<Circled>& circles) {
  Triangulation result;
  for (const Circled& t : circles) result.triangles.push_back(t.corners);
  std::sort(result.triangles.begin(), result.triangles.end());
  std::map<Side, Index> user;
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const Triangle& c = result.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) user[{c[i], c[(i + 1) % 3]}] = static_cast<Index>(t);
  }
  for (const Triangle& c : result.triangles) {
    std::array<Index, 3> across{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = user.find({c[(i + 1) % 3], c[i]});
      across[i] = found == user.end() ? kNone : found->second;
    }
    result.neighbours.push_back(across);
  }
  return result;
}

}  // namespace

Triangulation delaunay(const std::vector<PlanePoint>& points) {
  std::vector<Circled> triangles{circled(points, {0, 1, 2}), circled(points, {0, 2, 3})};
  for (Index p = 4; p < static_cast<Index>(points.size()); ++p) insert(points, p, triangles);
  double area = 0;
  for (const Circled& t : triangles) {
    area += turn(at(points, t.corners[0]), at(points, t.corners[1]), at(points, t.corners[2]));
  }
  const double whole = turn(points[0], points[1], points[2]) + turn(points[0], points[2], points[3]);
  if (std::abs(area - whole) > 1e-9 * whole) {
    throw Error(Status::internal, "Delaunay triangles do not cover the rectangle; two points may coincide");
  }
  return with_neighbours(triangles);
}

}  // namespace cdfp
