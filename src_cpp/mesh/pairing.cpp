#include "mesh/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace cdfp {

namespace {

using Polygon = std::vector<Index>;  ///< 3 or 4 points, counter-clockwise

class Pairing {
 public:
  Pairing(const std::vector<PlanePoint>& points, const Triangulation& t)
      : points_(points), t_(t), mate_(t.triangles.size(), kNone) {
    corner_count_.assign(points.size(), 0);
    for (const auto& triangle : t.triangles) {
      for (const Index p : triangle) ++corner_count_[static_cast<std::size_t>(p)];
    }
    for (Index k = 0; k < count(); ++k)
      worths_.push_back({pair_worth(k, 0), pair_worth(k, 1), pair_worth(k, 2)});
  }

  std::vector<Polygon> polygons() {
    pair_best_first();
    for (Index t = 0; t < count(); ++t) {
      if (mate(t) == kNone) pair_along_path(t);
    }
    std::vector<Polygon> result;
    for (Index t = 0; t < count(); ++t) {
      if (mate(t) == kNone) {
        const auto& c = t_.triangles[static_cast<std::size_t>(t)];
        result.push_back({c[0], c[1], c[2]});
      } else if (t < mate(t)) {
        result.push_back(joined(t, side_to(t, mate(t))));
      }
    }
    return result;
  }

 private:
  Index count() const { return static_cast<Index>(mate_.size()); }
  Index mate(Index t) const { return mate_[static_cast<std::size_t>(t)]; }
  Index neighbour(Index t, std::size_t side) const {
    return t_.neighbours[static_cast<std::size_t>(t)][side];
  }
  Index corner(Index t, std::size_t i) const { return t_.triangles[static_cast<std::size_t>(t)][i % 3]; }

  std::size_t side_to(Index t, Index other) const {
    std::size_t side = 0;
    while (neighbour(t, side) != other) ++side;
    return side;
  }

  /// The quadrilateral of a triangle and its neighbour across a side.
  Polygon joined(Index t, std::size_t side) const {
    const Index other = neighbour(t, side);
    const std::size_t back = side_to(other, t);
    return {corner(t, side), corner(other, back + 2), corner(t, side + 1), corner(t, side + 2)};
  }

  bool on_rim(Index point) const {
    const PlanePoint& p = points_[static_cast<std::size_t>(point)];
    return p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1;
  }

  /// 1 for a rectangle, 0 for flat or worse: the least sine of its corners. A pair that would leave a point
  /// of the rim, or one inside, with a flat corner is worth nothing.
  double pair_worth(Index t, std::size_t side) const {
    if (neighbour(t, side) == kNone) return 0;
    for (const Index end : {corner(t, side), corner(t, side + 1)}) {
      const Index corners = corner_count_[static_cast<std::size_t>(end)];
      if (on_rim(end) ? corners <= 2 && !is_square_corner(end) : corners <= 3) return 0;
    }
    const Polygon q = joined(t, side);
    double least = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      const PlanePoint& a = points_[static_cast<std::size_t>(q[(i + 3) % 4])];
      const PlanePoint& b = points_[static_cast<std::size_t>(q[i])];
      const PlanePoint& c = points_[static_cast<std::size_t>(q[(i + 1) % 4])];
      const double lengths = std::hypot(b[0] - a[0], b[1] - a[1]) * std::hypot(c[0] - b[0], c[1] - b[1]);
      least = std::min(least, turn(a, b, c) / lengths);
    }
    return std::max(least, 0.0);
  }

  double worth(Index t, std::size_t side) const { return worths_[static_cast<std::size_t>(t)][side]; }

  bool is_square_corner(Index point) const {
    const PlanePoint& p = points_[static_cast<std::size_t>(point)];
    return (p[0] == 0 || p[0] == 1) && (p[1] == 0 || p[1] == 1);
  }

  void pair_up(Index a, Index b) {
    mate_[static_cast<std::size_t>(a)] = b;
    mate_[static_cast<std::size_t>(b)] = a;
  }

  /// Always the triangle with the fewest free neighbours next, with its best one.
  void pair_best_first() {
    for (;;) {
      Index chosen = kNone, partner = kNone;
      int fewest = 4;
      double best = 0;
      for (Index t = 0; t < count(); ++t) {
        if (mate(t) != kNone) continue;
        int options = 0;
        double own_best = 0;
        Index own_partner = kNone;
        for (std::size_t side = 0; side < 3; ++side) {
          const Index other = neighbour(t, side);
          if (other == kNone || mate(other) != kNone) continue;
          const double w = worth(t, side);
          if (w <= 0) continue;
          ++options;
          if (w > own_best) {
            own_best = w;
            own_partner = other;
          }
        }
        if (options > 0 && (options < fewest || (options == fewest && own_best > best))) {
          fewest = options;
          best = own_best;
          chosen = t;
          partner = own_partner;
        }
      }
      if (chosen == kNone) return;
      pair_up(chosen, partner);
    }
  }

  /// Alternating path from a free triangle to another, breadth first; pairs along it change over.
  void pair_along_path(Index start) {
    std::vector<Index> from(mate_.size(), kNone);
    std::vector<bool> seen(mate_.size(), false);
    std::deque<Index> queue{start};
    seen[static_cast<std::size_t>(start)] = true;
    while (!queue.empty()) {
      const Index t = queue.front();
      queue.pop_front();
      for (std::size_t side = 0; side < 3; ++side) {
        const Index other = neighbour(t, side);
        if (other == kNone || seen[static_cast<std::size_t>(other)] || worth(t, side) <= 0) continue;
        if (mate(other) == kNone) {
          change_over(t, other, from);
          return;
        }
        if (seen[static_cast<std::size_t>(mate(other))]) continue;
        seen[static_cast<std::size_t>(other)] = true;
        seen[static_cast<std::size_t>(mate(other))] = true;
        from[static_cast<std::size_t>(mate(other))] = t;
        queue.push_back(mate(other));
      }
    }
  }

  void change_over(Index t, Index free, const std::vector<Index>& from) {
    while (t != kNone) {
      const Index next = mate(t);
      pair_up(t, free);
      free = next;
      t = from[static_cast<std::size_t>(t)];
    }
  }

  const std::vector<PlanePoint>& points_;
  const Triangulation& t_;
  std::vector<Index> mate_;
  std::vector<Index> corner_count_;            ///< triangles around each point
  std::vector<std::array<double, 3>> worths_;  ///< `pair_worth` of each triangle and side
};

/// A point inside with two quadrilaterals around it would have two corners of 180 degrees: one quadrilateral
/// takes the place of both.
void merge_doublets(Index point_count, const std::vector<PlanePoint>& points,
                    std::vector<Polygon>& polygons) {
  for (bool merged = true; merged;) {
    merged = false;
    std::vector<std::vector<std::size_t>> around(static_cast<std::size_t>(point_count));
    for (std::size_t q = 0; q < polygons.size(); ++q) {
      for (const Index p : polygons[q]) around[static_cast<std::size_t>(p)].push_back(q);
    }
    for (std::size_t p = 0; p < around.size() && !merged; ++p) {
      const PlanePoint& x = points[p];
      const bool rim = x[0] == 0 || x[0] == 1 || x[1] == 0 || x[1] == 1;
      if (rim || around[p].size() != 2) continue;
      Polygon& a = polygons[around[p][0]];
      const Polygon& b = polygons[around[p][1]];
      if (a.size() != 4 || b.size() != 4) continue;
      const auto opposite = [](const Polygon& q, Index point) {
        return q[static_cast<std::size_t>(std::find(q.begin(), q.end(), point) - q.begin() + 2) % 4];
      };
      std::replace(a.begin(), a.end(), static_cast<Index>(p), opposite(b, static_cast<Index>(p)));
      polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(around[p][1]));
      merged = true;
    }
  }
}

/// Each polygon of n corners into n quadrilaterals around its middle.
QuadMesh cut(const std::vector<PlanePoint>& points, const std::vector<Polygon>& polygons) {
  QuadMesh mesh;
  std::map<Index, Index> kept;
  std::map<std::array<Index, 2>, Index> middles;
  const auto add = [&](PlanePoint p) {
    mesh.points.push_back(p);
    return static_cast<Index>(mesh.points.size()) - 1;
  };
  const auto corner = [&](Index p) {
    const auto [found, is_new] = kept.try_emplace(p, kNone);
    if (is_new) found->second = add(points[static_cast<std::size_t>(p)]);
    return found->second;
  };
  const auto middle = [&](Index a, Index b) {
    const auto [found, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, kNone);
    const PlanePoint& p = points[static_cast<std::size_t>(a)];
    const PlanePoint& q = points[static_cast<std::size_t>(b)];
    if (is_new) found->second = add({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2});
    return found->second;
  };
  for (const Polygon& polygon : polygons) {
    const std::size_t n = polygon.size();
    PlanePoint center{0, 0};
    for (const Index p : polygon) {
      for (std::size_t k = 0; k < 2; ++k) {
        center[k] += points[static_cast<std::size_t>(p)][k] / static_cast<double>(n);
      }
    }
    const Index c = add(center);
    for (std::size_t i = 0; i < n; ++i) {
      const Index before = polygon[(i + n - 1) % n], here = polygon[i], after = polygon[(i + 1) % n];
      mesh.quads.push_back({corner(here), middle(here, after), c, middle(before, here)});
    }
  }
  return mesh;
}

}  // namespace

QuadMesh paired_and_cut(const std::vector<PlanePoint>& points, const Triangulation& triangulation) {
  std::vector<Polygon> polygons = Pairing(points, triangulation).polygons();
  merge_doublets(static_cast<Index>(points.size()), points, polygons);
  return cut(points, polygons);
}

}  // namespace cdfp
