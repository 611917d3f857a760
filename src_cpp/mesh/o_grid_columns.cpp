#include "mesh/o_grid_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "mesh/smoothing.hpp"

namespace cdfp {

namespace {

constexpr Index kCoreSide = 4;         ///< quads along a side of the innermost disc
constexpr Index kDiscRings = 2;        ///< around its core
constexpr double kDiscRadius = 5;      ///< in widths of a quad
constexpr double kTooWide = 1.45;      ///< in widths of a quad: twice as many from there
constexpr double kRoundRadius = 0.15;  ///< rings are circles up to there

class OGrid {
 public:
  explicit OGrid(double width) : width_(width) {}

  QuadMesh build() {
    start_disc();
    const Index rings = std::max<Index>(1, static_cast<Index>(std::lround((1 - radius_) / width_)));
    const double first = radius_;
    for (Index k = 0; k < rings;) {
      const double arc = std::numbers::pi / 2 * radius_ / divisions();
      const bool doubles = arc > kTooWide * width_ && k + 2 <= rings;
      k += doubles ? 2 : 1;
      const double next = k == rings ? 1 : first + (1 - first) * k / rings;
      if (doubles) {
        add_doubling_ring(next);
      } else {
        add_ring(next);
      }
    }
    return std::move(mesh_);
  }

 private:
  Index divisions() const { return static_cast<Index>(rim_.size()) - 1; }

  void start_disc() {
    mesh_ = quarter_disc(kCoreSide, kCoreSide, kDiscRings, 0.55);
    radius_ = kDiscRadius * width_;
    for (auto& p : mesh_.points) p = {radius_ * p[0], radius_ * p[1]};
    const Index last = static_cast<Index>(mesh_.points.size());
    for (Index s = 0; s <= 2 * kCoreSide; ++s) rim_.push_back(last - 2 * kCoreSide - 1 + s);
  }

  /// The point at the share s of the ring: on a circle inside, on the square at radius 1.
  Index add_point(double radius, double s) {
    const double squareness = std::max(0.0, (radius - kRoundRadius) / (1 - kRoundRadius));
    const double angle = std::numbers::pi / 2 * s;
    const std::array<double, 2> circle{s == 1 ? 0 : std::cos(angle), std::sin(angle)};
    const std::array<double, 2> square{std::min(1.0, 2 - 2 * s), std::min(1.0, 2 * s)};
    std::array<double, 2> p{};
    for (std::size_t k = 0; k < 2; ++k) {
      p[k] = radius == 1 ? square[k] : radius * ((1 - squareness) * circle[k] + squareness * square[k]);
    }
    mesh_.points.push_back(p);
    return static_cast<Index>(mesh_.points.size()) - 1;
  }

  std::vector<Index> add_rim(double radius, Index n) {
    std::vector<Index> rim;
    for (Index s = 0; s <= n; ++s) rim.push_back(add_point(radius, static_cast<double>(s) / n));
    return rim;
  }

  void add_ring(double next) {
    const std::vector<Index> outer = add_rim(next, divisions());
    for (std::size_t s = 0; s + 1 < outer.size(); ++s) {
      mesh_.quads.push_back({rim_[s], outer[s], outer[s + 1], rim_[s + 1]});
    }
    rim_ = outer;
    radius_ = next;
  }

  /// Two inner sides a-b-c meet four outer ones p0..p4 over three points x, y, z between them: six
  /// quadrilaterals on the space of two rings.
  void add_doubling_ring(double next) {
    const Index n = divisions();
    const std::vector<Index> p = add_rim(next, 2 * n);
    const double between = 0.5 * (radius_ + next);
    for (Index s = 0; s < n; s += 2) {
      const auto inner = static_cast<std::size_t>(s);
      const std::size_t outer = 2 * inner;
      const Index a = rim_[inner], b = rim_[inner + 1], c = rim_[inner + 2];
      const auto add = [&](double offset) { return add_point(between, (s + offset) / n); };
      const Index x = add(0.55), y = add(1), z = add(1.45);
      mesh_.quads.insert(mesh_.quads.end(), {{a, p[outer], p[outer + 1], x},
                                             {x, p[outer + 1], p[outer + 2], y},
                                             {y, p[outer + 2], p[outer + 3], z},
                                             {z, p[outer + 3], p[outer + 4], c},
                                             {a, x, y, b},
                                             {b, y, z, c}});
    }
    rim_ = p;
    radius_ = next;
  }

  double width_;
  double radius_ = 0;
  QuadMesh mesh_;
  std::vector<Index> rim_;  ///< points of the outermost ring so far, from the x axis to the y axis
};

}  // namespace

QuadMesh o_grid_columns(Index count) {
  const double mean_width = 1 / std::sqrt(static_cast<double>(count));
  QuadMesh best;
  for (int trial = 0; trial < 90; ++trial) {
    const double factor = 0.85 + 0.005 * trial;
    const double width = std::min(factor * mean_width, 0.8 / kDiscRadius);
    QuadMesh mesh = OGrid(width).build();
    const auto miss = [count](const QuadMesh& m) {
      return std::abs(static_cast<Index>(m.quads.size()) - count);
    };
    if (best.quads.empty() || miss(mesh) < miss(best)) best = std::move(mesh);
  }
  smooth(best);
  return best;
}

}  // namespace cdfp
