#include "mesh/columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <vector>

#include "mesh/triangulation.hpp"

namespace cdfp {
namespace {

using Point = std::array<double, 2>;

struct NamedLayout {
  const char* name;
  PlateColumns layout;
};
constexpr NamedLayout kLayouts[] = {{"regular", PlateColumns::regular},
                                    {"graded", PlateColumns::graded},
                                    {"o_grid", PlateColumns::o_grid},
                                    {"irregular", PlateColumns::irregular}};

const Point& at(const QuadMesh& mesh, Index p) {
  return mesh.points[static_cast<std::size_t>(p)];
}

double length(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

struct Shape {
  double least_angle = 360, largest_angle = 0;  ///< degrees
  double shortest = 1, area = 0;
};

Shape shape_of(const QuadMesh& mesh) {
  Shape s;
  for (const auto& quad : mesh.quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Point& before = at(mesh, quad[(i + 3) % 4]);
      const Point& here = at(mesh, quad[i]);
      const Point& after = at(mesh, quad[(i + 1) % 4]);
      const double dot =
          (after[0] - here[0]) * (before[0] - here[0]) + (after[1] - here[1]) * (before[1] - here[1]);
      const double angle = std::atan2(turn(here, after, before), dot) * 180 / std::numbers::pi;
      s.least_angle = std::min(s.least_angle, angle);
      s.largest_angle = std::max(s.largest_angle, angle);
      s.shortest = std::min(s.shortest, length(here, after));
      s.area += turn(here, after, before) / 4;
    }
  }
  return s;
}

/// Length of the shortest way along edges from the origin over the straight one, by direction: mean over
/// the points of each of 9 sectors. What a crack along facets has to pay for its direction.
std::array<double, 9> detours(const QuadMesh& mesh) {
  std::vector<std::vector<Index>> near(mesh.points.size());
  Index origin = 0;
  for (const auto& quad : mesh.quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      near[static_cast<std::size_t>(quad[i])].push_back(quad[(i + 1) % 4]);
      near[static_cast<std::size_t>(quad[(i + 1) % 4])].push_back(quad[i]);
      if (at(mesh, quad[i]) == Point{0, 0}) origin = quad[i];
    }
  }
  std::vector<double> way(mesh.points.size(), 1e9);
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  way[static_cast<std::size_t>(origin)] = 0;
  queue.push({0, origin});
  while (!queue.empty()) {
    const auto [distance, p] = queue.top();
    queue.pop();
    if (distance > way[static_cast<std::size_t>(p)]) continue;
    for (const Index q : near[static_cast<std::size_t>(p)]) {
      const double longer = distance + length(at(mesh, p), at(mesh, q));
      if (longer < way[static_cast<std::size_t>(q)]) {
        way[static_cast<std::size_t>(q)] = longer;
        queue.push({longer, q});
      }
    }
  }
  std::array<double, 9> sum{}, count{};
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    const Point& x = mesh.points[p];
    const double straight = std::hypot(x[0], x[1]);
    if (straight < 0.3 || straight > 1) continue;
    const auto sector =
        std::min<std::size_t>(8, static_cast<std::size_t>(std::atan2(x[1], x[0]) * 18 / std::numbers::pi));
    sum[sector] += way[p] / straight;
    ++count[sector];
  }
  for (std::size_t i = 0; i < 9; ++i) sum[i] /= count[i];
  return sum;
}

TEST(Columns, CoverTheSquareOnceAtEveryCount) {
  for (const auto& [name, layout] : kLayouts) {
    for (const Index columns : {2, 3, 5, 8, 13, 17, 25, 43}) {
      SCOPED_TRACE(testing::Message() << name << " " << columns);
      const QuadMesh mesh = plate_columns(layout, columns);
      EXPECT_NEAR(shape_of(mesh).area, 1, 1e-12);
      EXPECT_GT(shape_of(mesh).least_angle, 20);
      std::map<std::array<Index, 2>, int> sides;
      for (const auto& quad : mesh.quads) {
        for (std::size_t i = 0; i < 4; ++i) ++sides[{quad[i], quad[(i + 1) % 4]}];
      }
      double rim = 0;
      Index inner_sides = 0;
      for (const auto& [side, count] : sides) {
        EXPECT_EQ(count, 1);
        if (sides.count({side[1], side[0]})) {
          ++inner_sides;
          continue;
        }
        const Point& a = at(mesh, side[0]);
        const Point& b = at(mesh, side[1]);
        const bool on_rim =
            (a[0] == b[0] && (a[0] == 0 || a[0] == 1)) || (a[1] == b[1] && (a[1] == 0 || a[1] == 1));
        EXPECT_TRUE(on_rim) << a[0] << " " << a[1] << " to " << b[0] << " " << b[1];
        rim += length(a, b);
      }
      EXPECT_NEAR(rim, 4, 1e-12);
      const auto edges = static_cast<long>(sides.size()) - inner_sides / 2;
      EXPECT_EQ(static_cast<long>(mesh.points.size()) - edges + static_cast<long>(mesh.quads.size()), 1)
          << "Euler";
      if (columns >= 13) {
        EXPECT_NEAR(static_cast<double>(mesh.quads.size()), columns * columns,
                    (layout == PlateColumns::o_grid ? 0.06 : 0.02) * columns * columns);
      }
    }
  }
}

TEST(Columns, AreWellShapedAtTheFullSize) {
  for (const auto& [name, layout] : kLayouts) {
    SCOPED_TRACE(name);
    const Shape s = shape_of(plate_columns(layout, 67));
    EXPECT_GE(s.least_angle, layout == PlateColumns::o_grid ? 38 : 45);
    EXPECT_LE(s.largest_angle, layout == PlateColumns::o_grid ? 141 : 135);
    EXPECT_GE(75 * s.shortest, 0.6) << "mm: shorter edges cut the stable step below the paper's";
  }
}

TEST(Columns, IrregularOnesFavourNoDirection) {
  const auto spread = [](PlateColumns layout) {
    const auto d = detours(plate_columns(layout, 67));
    return *std::max_element(d.begin(), d.end()) - *std::min_element(d.begin(), d.end());
  };
  EXPECT_GT(spread(PlateColumns::regular), 0.3);
  EXPECT_LT(spread(PlateColumns::irregular), 0.16);
  EXPECT_LT(spread(PlateColumns::o_grid), 0.16);
}

TEST(Columns, AreTheSameEachTime) {
  const QuadMesh a = plate_columns(PlateColumns::irregular, 20);
  const QuadMesh b = plate_columns(PlateColumns::irregular, 20);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.quads, b.quads);
}

TEST(Delaunay, NoPointLiesInACircle) {
  std::vector<Point> points{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {1, 0}, {0.5, 1}};
  std::uint32_t state = 12345;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state) / 4294967296.0;
  };
  for (int i = 0; i < 200; ++i) points.push_back({2 * random(), random()});
  const Triangulation t = delaunay(points);
  EXPECT_EQ(t.triangles.size(), 2 * points.size() - 6 - 2);
  for (std::size_t k = 0; k < t.triangles.size(); ++k) {
    const auto& c = t.triangles[k];
    const auto corner = [&](std::size_t i) { return points[static_cast<std::size_t>(c[i])]; };
    const Point p = corner(0), q = corner(1), r = corner(2);
    EXPECT_GT(turn(p, q, r), 0);
    for (const Point& x : points) {
      const auto lift = [&](const Point& y) {
        return std::array{y[0] - x[0], y[1] - x[1],
                          (y[0] - x[0]) * (y[0] - x[0]) + (y[1] - x[1]) * (y[1] - x[1])};
      };
      const auto a = lift(p), b = lift(q), d = lift(r);
      const double in_circle = a[2] * (b[0] * d[1] - b[1] * d[0]) - b[2] * (a[0] * d[1] - a[1] * d[0]) +
                               d[2] * (a[0] * b[1] - a[1] * b[0]);
      EXPECT_LT(in_circle, 1e-9);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Index other = t.neighbours[k][i];
      if (other == kNone) continue;
      const auto& o = t.neighbours[static_cast<std::size_t>(other)];
      EXPECT_NE(std::find(o.begin(), o.end(), static_cast<Index>(k)), o.end());
    }
  }
}

}  // namespace
}  // namespace cdfp
