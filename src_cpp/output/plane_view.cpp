#include "output/plane_view.hpp"

#include <algorithm>
#include <cmath>

namespace cdfp {
namespace {

double cross(Point o, Point a, Point b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}
double distance(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The two points of a polygon that are farthest apart.
std::pair<Point, Point> longest_chord(std::span<const Point> points) {
  std::pair<Point, Point> ends{points[0], points[0]};
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (distance(points[a], points[b]) > distance(ends.first, ends.second)) ends = {points[b], points[a]};
  return ends;
}

}  // namespace

SeenFacet see(const CrackFacet& facet, std::span<const double> positions, const View& view) {
  // Below this share of its longest side squared a face is taken as seen edge-on.
  constexpr double sliver = 0.1;
  SeenFacet seen;
  seen.damage = static_cast<float>(facet.damage);
  seen.count = facet.corners;
  for (std::size_t c = 0; c < static_cast<std::size_t>(facet.corners); ++c)
    seen.corners[c] = view.project(&positions[3 * static_cast<std::size_t>(facet.upper[c])]);
  const auto& p = seen.corners;
  double area = 0.5 * cross(p[0], p[1], p[2]);
  if (facet.corners == 4) area += 0.5 * cross(p[0], p[2], p[3]);
  const auto ends = longest_chord({p.data(), static_cast<std::size_t>(facet.corners)});
  const double length = distance(ends.first, ends.second);
  if (std::abs(area) < sliver * length * length) {
    seen.count = 2;
    seen.corners = {ends.first, ends.second};
  }
  return seen;
}

std::optional<SeenFacet> cut(const CrackFacet& facet, std::span<const double> positions, const View& view,
                             double depth) {
  const auto corners = static_cast<std::size_t>(facet.corners);
  std::array<const double*, 4> at{};
  for (std::size_t c = 0; c < corners; ++c) at[c] = &positions[3 * static_cast<std::size_t>(facet.upper[c])];
  const auto above = [&](std::size_t c) { return at[c][view.depth()] - depth; };
  double size = 0;
  for (std::size_t c = 1; c < corners; ++c)
    for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(at[c][i] - at[0][i]));
  const double tolerance = 1e-6 * size;

  std::vector<Point> met;
  std::size_t in_plane = 0;
  for (std::size_t c = 0; c < corners; ++c) {
    const std::size_t next = (c + 1) % corners;
    const double here = above(c), there = above(next);
    const Point p = view.project(at[c]), q = view.project(at[next]);
    if (std::abs(here) <= tolerance) {
      met.push_back(p);
      ++in_plane;
    } else if (std::abs(there) > tolerance && (here < 0) != (there < 0)) {
      const double share = here / (here - there);
      met.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
    }
  }
  if (in_plane == corners) return see(facet, positions, view);
  if (met.size() < 2) return std::nullopt;
  const auto ends = longest_chord(met);
  SeenFacet seen;
  seen.count = 2;
  seen.damage = static_cast<float>(facet.damage);
  seen.corners = {ends.first, ends.second};
  return seen;
}

std::vector<Copy> copies(const std::vector<std::pair<int, double>>& symmetry_planes, const View& view) {
  std::vector<Copy> all(1);
  bool across = false, up = false;
  for (const auto& [axis, coordinate] : symmetry_planes) {
    const bool is_across = axis == view.across && !across, is_up = axis == view.up && !up;
    if (!is_across && !is_up) continue;
    across = across || is_across;
    up = up || is_up;
    const std::size_t count = all.size();
    for (std::size_t i = 0; i < count; ++i) {
      Copy mirrored = all[i];
      if (is_across) {
        mirrored.factor.x = -1;
        mirrored.shift.x = 2 * coordinate;
      } else {
        mirrored.factor.y = -1;
        mirrored.shift.y = 2 * coordinate;
      }
      all.push_back(mirrored);
    }
  }
  return all;
}

std::vector<Point> convex_outline(std::vector<Point> points) {
  // Monotone chain (Andrew 1979).
  std::sort(points.begin(), points.end(),
            [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  if (points.size() < 3) return points;
  std::vector<Point> outline(2 * points.size());
  std::size_t size = 0;
  const auto add = [&](Point p, std::size_t floor) {
    while (size >= floor + 2 && cross(outline[size - 2], outline[size - 1], p) <= 0) --size;
    outline[size++] = p;
  };
  for (const Point& p : points) add(p, 0);
  const std::size_t lower = size - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  outline.resize(size - 1);
  return outline;
}

std::vector<Point> part_outline(const Frame& frame, Index part, std::span<const double> positions,
                                const View& view) {
  std::vector<bool> seen(positions.size() / 3, false);
  std::vector<Point> points;
  for (std::size_t element = 0; element < frame.parts.size(); ++element) {
    if (frame.parts[element] != part) continue;
    for (Index c = frame.first_corner[element]; c < frame.first_corner[element + 1]; ++c) {
      const auto node = static_cast<std::size_t>(frame.connectivity[static_cast<std::size_t>(c)]);
      if (!seen[node]) points.push_back(view.project(&positions[3 * node]));
      seen[node] = true;
    }
  }
  const std::vector<Point> modelled = convex_outline(std::move(points));
  std::vector<Point> whole;
  for (const Copy& copy : copies(frame.symmetry_planes, view))
    for (const Point& p : modelled) whole.push_back(copy.place(p));
  return convex_outline(std::move(whole));
}

}  // namespace cdfp
