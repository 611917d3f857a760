// Random points that keep their distance, Delaunay triangles, pairs of triangles cut to quadrilaterals,
// smoothing.
#include "mesh/irregular_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/pairing.hpp"
#include "mesh/smoothing.hpp"
#include "mesh/triangulation.hpp"

namespace cdfp {

namespace {

/// splitmix64: the same numbers everywhere.
class Random {
 public:
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 1;
};

/// The corners first, then the rim, then one point for a square at each corner.
std::vector<PlanePoint> rim_points(Index side) {
  std::vector<PlanePoint> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (Index i = 1; i < side; ++i) {
    const double s = static_cast<double>(i) / side;
    points.insert(points.end(), {{s, 0}, {1, s}, {1 - s, 1}, {0, 1 - s}});
  }
  const double near = 1.05 / side;
  points.insert(points.end(), {{near, near}, {1 - near, near}, {1 - near, 1 - near}, {near, 1 - near}});
  return points;
}

/// Points in square bins, to find those near a place.
class Bins {
 public:
  explicit Bins(double least_width)
      : side_(std::max<std::size_t>(1, static_cast<std::size_t>(1 / least_width))), bins_(side_ * side_) {}

  void add(const PlanePoint& p) { bins_[bin(p[0]) + side_ * bin(p[1])].push_back(p); }

  /// `apart` at most the width of a bin.
  bool any_within(const PlanePoint& p, double apart) const {
    const std::size_t i = bin(p[0]), j = bin(p[1]);
    for (std::size_t b = j - std::min<std::size_t>(j, 1); b <= std::min(j + 1, side_ - 1); ++b) {
      for (std::size_t a = i - std::min<std::size_t>(i, 1); a <= std::min(i + 1, side_ - 1); ++a) {
        for (const PlanePoint& q : bins_[a + side_ * b]) {
          const double dx = p[0] - q[0], dy = p[1] - q[1];
          if (dx * dx + dy * dy < apart * apart) return true;
        }
      }
    }
    return false;
  }

 private:
  std::size_t bin(double x) const {
    return std::min(side_ - 1, static_cast<std::size_t>(x * static_cast<double>(side_)));
  }

  std::size_t side_;
  std::vector<std::vector<PlanePoint>> bins_;
};

/// Adds random points until there are `count`, each as far from the others as it can be (dart throwing with
/// a distance that shrinks when no place is found).
void add_inner_points(std::size_t count, double spacing, std::vector<PlanePoint>& points) {
  Random random;
  Bins bins(spacing);
  for (const PlanePoint& p : points) bins.add(p);
  double apart = spacing;
  while (points.size() < count) {
    for (int misses = 0; points.size() < count && misses < 2000;) {
      const PlanePoint p{random.next(), random.next()};
      const double to_rim = std::min({p[0], 1 - p[0], p[1], 1 - p[1]});
      if (to_rim > 0.6 * apart && !bins.any_within(p, apart)) {
        points.push_back(p);
        bins.add(p);
        misses = 0;
      } else {
        ++misses;
      }
    }
    apart *= 0.96;
  }
}

/// Inner points to the mean of their neighbours.
void relax(const Triangulation& t, std::size_t first_inner, std::vector<PlanePoint>& points) {
  std::vector<PlanePoint> sum(points.size(), {0, 0});
  std::vector<double> count(points.size(), 0);
  for (const auto& triangle : t.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(triangle[i]),
                 b = static_cast<std::size_t>(triangle[(i + 1) % 3]);
      for (std::size_t k = 0; k < 2; ++k) sum[a][k] += points[b][k];
      ++count[a];
    }
  }
  for (std::size_t p = first_inner; p < points.size(); ++p) {
    points[p] = {sum[p][0] / count[p], sum[p][1] / count[p]};
  }
}

}  // namespace

QuadMesh irregular_columns(Index count) {
  constexpr int relaxations = 3;
  // A pair of equilateral triangles of side a makes four quadrilaterals: sqrt(3)/2 a^2 = 4 / count.
  const double spacing = std::sqrt(8 / (std::sqrt(3.0) * count));
  const Index side = std::max<Index>(2, static_cast<Index>(std::lround(1 / spacing)));
  // n points, of which 4 side on the rim, make 2 n - 4 side - 2 triangles, half as many pairs.
  const std::size_t points_wanted =
      static_cast<std::size_t>(std::max<Index>(count / 4 + 2 * side + 1, 4 * side + 4));
  std::vector<PlanePoint> points = rim_points(side);
  const std::size_t first_inner = points.size();
  add_inner_points(points_wanted, spacing, points);
  for (int i = 0; i < relaxations; ++i) relax(delaunay(points), first_inner, points);
  QuadMesh mesh = paired_and_cut(points, delaunay(points));
  smooth(mesh);
  return mesh;
}

}  // namespace cdfp
