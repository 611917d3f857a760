#include <string>

#include "cdfp/cohesive.hpp"
#include "cdfp/error.hpp"
#include "cohesive/law.hpp"
#include "core/numbered.hpp"
#include "core/require.hpp"

namespace cdfp {

namespace {

void require_rows(std::size_t size, std::size_t points, const char* name) {
  require(size == 3 * points, std::string("'") + name + "' has " + std::to_string(size) +
                                  " numbers; give three for each of the " + std::to_string(points) +
                                  " points");
}

Softening softening_of(const CohesivePoint& point) {
  return {point.strength, point.reach};
}

/// Moves the point's state along the straight segment to `d`.
void follow(const ModeWeights& weights, Vec3 normal, Vec3 d, CohesivePoint& point) {
  point.dissipated +=
      0.5 * point.strength *
      weighted_growth(weights, normal, Vec3::load(point.opening.data()), d, point.largest, point.reach);
  const Split split(d, normal);
  point.largest = std::max(point.largest, weights.opening(split.n, split.t2()));
  d.store(point.opening.data());
}

}  // namespace

double effective_traction(const CohesiveLaw& law, std::span<const double, 3> traction,
                          std::span<const double, 3> normal) {
  return effective_traction(Vec3::load(traction.data()), Vec3::load(normal.data()), law.shear_ratio);
}

void start_cohesive(const CohesiveLaw& law, std::span<const double> traction, std::span<const double> normal,
                    std::span<CohesivePoint> points) {
  require_rows(traction.size(), points.size(), "traction");
  require_rows(normal.size(), points.size(), "normal");
  require(law.fracture_energy > 0 && law.mode_ratio > 0 && law.shear_ratio > 0,
          "cohesive law '" + law.name + "' needs a positive fracture_energy, mode_ratio and shear_ratio");
  require(law.rate_sensitivity == 0,
          "cohesive law '" + law.name +
              "' depends on the rate, and these points know no time; set rate_sensitivity to 0 or use "
              "CohesiveElements");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 carried = Vec3::load(&traction[3 * i]);
    const double strength = effective_traction(carried, Vec3::load(&normal[3 * i]), law.shear_ratio);
    require(strength > 0, "the traction at point " + numbered(i) +
                              " neither pulls nor shears; a face opens under tension or shear only");
    points[i] = {};
    points[i].strength = strength;
    points[i].reach = 2 * law.fracture_energy / strength;
    carried.store(points[i].insertion_traction.data());
  }
}

void cohesive_traction(const CohesiveLaw& law, std::span<const double> opening,
                       std::span<const double> normal, std::span<CohesivePoint> points,
                       std::span<double> traction) {
  require_rows(opening.size(), points.size(), "opening");
  require_rows(normal.size(), points.size(), "normal");
  require_rows(traction.size(), points.size(), "traction");
  const ModeWeights weights(law);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 n = Vec3::load(&normal[3 * i]);
    const Vec3 d = Vec3::load(&opening[3 * i]);
    follow(weights, n, d, points[i]);
    if (points[i].largest == 0) {
      Vec3::load(points[i].insertion_traction.data()).store(&traction[3 * i]);
      continue;
    }
    const Split split(d, n);
    const double k = softening_of(points[i]).stiffness(points[i].largest);
    (k * (std::max(split.n, 0.0) * n + weights.traction * split.t)).store(&traction[3 * i]);
  }
}

void cohesive_mean_traction(const CohesiveLaw& law, std::span<const double> opening,
                            std::span<const double> normal, std::span<CohesivePoint> points,
                            std::span<double> traction) {
  require_rows(opening.size(), points.size(), "opening");
  require_rows(normal.size(), points.size(), "normal");
  require_rows(traction.size(), points.size(), "traction");
  const ModeWeights weights(law);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 n = Vec3::load(&normal[3 * i]);
    const Split before(Vec3::load(points[i].opening.data()), n);
    const Split after(Vec3::load(&opening[3 * i]), n);
    const double r1 = weights.opening(after.n, after.t2());
    const double largest = points[i].largest;
    if (largest == 0 && r1 == 0) {
      Vec3::load(points[i].insertion_traction.data()).store(&traction[3 * i]);
    } else {
      const Softening softening = softening_of(points[i]);
      const double r0 = std::min(weights.opening(before.n, before.t2()), largest);
      double k = 0;
      if (largest < points[i].reach) {
        k = r1 > largest ? softening.mean(largest, r0, r1).value : softening.stiffness(largest);
      }
      (k * (positive_mean(before.n, after.n).value * n + 0.5 * weights.traction * (before.t + after.t)))
          .store(&traction[3 * i]);
    }
    follow(weights, n, Vec3::load(&opening[3 * i]), points[i]);
  }
}

double cohesive_stored(const CohesiveLaw& law, const CohesivePoint& point,
                       std::span<const double, 3> normal) {
  if (point.largest == 0) return 0;
  const ModeWeights weights(law);
  const Split split(Vec3::load(point.opening.data()), Vec3::load(normal.data()));
  return 0.5 * softening_of(point).stiffness(point.largest) * weights.quadratic(split.n, split.t2());
}

}  // namespace cdfp
