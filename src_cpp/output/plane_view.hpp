/// Bodies and crack faces projected along an axis, whole by reflection over the symmetry planes.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "cdfp/results.hpp"
#include "output/canvas.hpp"

namespace cdfp {

/// The two axes that span the picture.
struct View {
  int across = 0, up = 1;
  int depth() const { return 3 - across - up; }
  Point project(const double* position) const { return {position[across], position[up]}; }
};

inline constexpr View from_above{0, 1}, from_the_front{0, 2};

/// A crack face as the view shows it, in m.
struct SeenFacet {
  std::array<Point, 4> corners{};
  int count = 0;  ///< corners; 2 for a face seen edge-on
  float damage = 0;
  bool edge_on() const { return count == 2; }
};

SeenFacet see(const CrackFacet& facet, std::span<const double> positions, const View& view);

/// What a plane at this depth of the view meets of a face: a line, the whole face if it lies in the plane,
/// nothing if it touches in no more than a point.
std::optional<SeenFacet> cut(const CrackFacet& facet, std::span<const double> positions, const View& view,
                             double depth);

/// One copy of what is modelled: `p -> factor * p + shift` in each of the view's axes.
struct Copy {
  Point factor{1, 1}, shift{0, 0};
  Point place(Point p) const { return {factor.x * p.x + shift.x, factor.y * p.y + shift.y}; }
};

/// 1, 2 or 4 copies: one plane an axis of the view is heeded.
std::vector<Copy> copies(const std::vector<std::pair<int, double>>& symmetry_planes, const View& view);

/// Smallest convex outline of the points, counter-clockwise.
std::vector<Point> convex_outline(std::vector<Point> points);

/// Outline of all copies of a part.
std::vector<Point> part_outline(const Frame& frame, Index part, std::span<const double> positions,
                                const View& view);

}  // namespace cdfp
