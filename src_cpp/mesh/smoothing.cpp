#include "mesh/smoothing.hpp"

#include <cmath>
#include <vector>

#include "mesh/triangulation.hpp"

namespace cdfp {

namespace {

constexpr int kAveraging = 4;   ///< rounds that move each point to the mean of its neighbours
constexpr int kImproving = 40;  ///< rounds that look for a better place around each point

class Smoother {
 public:
  explicit Smoother(QuadMesh& mesh)
      : mesh_(mesh), around_(mesh.points.size()), target_area_(1.0 / static_cast<double>(mesh.quads.size())) {
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
      for (const Index p : mesh.quads[q]) around_[static_cast<std::size_t>(p)].push_back(q);
    }
  }

  void run() {
    for (int round = 0; round < kAveraging; ++round) {
      for (std::size_t p = 0; p < around_.size(); ++p) average(p);
    }
    double reach = 0.15 * std::sqrt(target_area_);
    for (int round = 0; round < kImproving; ++round, reach *= 0.92) {
      for (std::size_t p = 0; p < around_.size(); ++p) improve(p, reach);
    }
  }

 private:
  std::array<bool, 2> free_axes(const PlanePoint& p) const {
    return {p[0] != 0 && p[0] != 1, p[1] != 0 && p[1] != 1};
  }

  void average(std::size_t p) {
    PlanePoint sum{0, 0};
    double count = 0;
    for (const std::size_t q : around_[p]) {
      for (std::size_t i = 0; i < 4; ++i) {
        if (static_cast<std::size_t>(mesh_.quads[q][i]) != p) continue;
        for (const std::size_t step : {1u, 3u}) {
          const PlanePoint& other = mesh_.points[static_cast<std::size_t>(mesh_.quads[q][(i + step) % 4])];
          sum[0] += other[0];
          sum[1] += other[1];
          ++count;
        }
      }
    }
    PlanePoint& place = mesh_.points[p];
    const auto free = free_axes(place);
    for (std::size_t k = 0; k < 2; ++k) {
      if (free[k]) place[k] = sum[k] / count;
    }
  }

  /// At a corner with sides a and b: (|a|^2 + |b|^2) / (2 a x b) is 1 for equal sides at a right angle and
  /// grows without bound as they close; the area against the wanted one likewise.
  double corner_badness(const PlanePoint& before, const PlanePoint& here, const PlanePoint& after) const {
    const double ax = after[0] - here[0], ay = after[1] - here[1];
    const double bx = before[0] - here[0], by = before[1] - here[1];
    const double area = ax * by - ay * bx;
    if (area <= 1e-3 * target_area_) return 1e30 * (1 - area / target_area_);
    const double shape = (ax * ax + ay * ay + bx * bx + by * by) / (2 * area);
    const double size = area / target_area_;
    const double value = shape + 0.4 * (size + 1 / size);
    const double squared = value * value;
    const double fourth = squared * squared;
    return fourth * fourth;  // a high power, for it is the worst corner that counts
  }

  double badness_around(std::size_t p) const {
    double sum = 0;
    for (const std::size_t q : around_[p]) {
      const auto& quad = mesh_.quads[q];
      for (std::size_t i = 0; i < 4; ++i) {
        sum += corner_badness(mesh_.points[static_cast<std::size_t>(quad[(i + 3) % 4])],
                              mesh_.points[static_cast<std::size_t>(quad[i])],
                              mesh_.points[static_cast<std::size_t>(quad[(i + 1) % 4])]);
      }
    }
    return sum;
  }

  void improve(std::size_t p, double reach) {
    static constexpr double d = 0.7071;
    static constexpr PlanePoint directions[] = {{1, 0}, {0, 1},  {-1, 0},  {0, -1},
                                                {d, d}, {-d, d}, {-d, -d}, {d, -d}};
    PlanePoint& place = mesh_.points[p];
    const auto free = free_axes(place);
    PlanePoint best_place = place;
    double best = badness_around(p);
    const PlanePoint start = place;
    for (const PlanePoint& direction : directions) {
      if ((!free[0] && direction[0] != 0) || (!free[1] && direction[1] != 0)) continue;
      place = {start[0] + reach * direction[0], start[1] + reach * direction[1]};
      const bool inside =
          (!free[0] || (place[0] > 0 && place[0] < 1)) && (!free[1] || (place[1] > 0 && place[1] < 1));
      if (!inside) continue;
      const double value = badness_around(p);
      if (value < best) {
        best = value;
        best_place = place;
      }
    }
    place = best_place;
  }

  QuadMesh& mesh_;
  std::vector<std::vector<std::size_t>> around_;
  double target_area_;
};

}  // namespace

void smooth(QuadMesh& mesh) {
  Smoother(mesh).run();
}

}  // namespace cdfp
