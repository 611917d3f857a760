#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cdfp/contact.hpp"
#include "contact/projection.hpp"

namespace {

using cdfp::Vec3;

Vec3 on_face(const Vec3* x, const std::array<double, 4>& shape) {
  return shape[0] * x[0] + shape[1] * x[1] + shape[2] * x[2] + shape[3] * x[3];
}

TEST(Projection, IsExactOnTaperedAndWarpedFaces) {
  const unsigned seed = 11;
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    Vec3 x[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (Vec3& corner : x) corner += Vec3{0.2 * unit(random), 0.2 * unit(random), 0.1 * unit(random)};
    const double xi = unit(random), eta = unit(random), gap = 0.1 * unit(random);
    const std::array<double, 4> shape{0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta),
                                      0.25 * (1 + xi) * (1 + eta), 0.25 * (1 - xi) * (1 + eta)};
    const Vec3 along_xi = 0.25 * ((1 - eta) * (x[1] - x[0]) + (1 + eta) * (x[2] - x[3]));
    const Vec3 along_eta = 0.25 * ((1 - xi) * (x[3] - x[0]) + (1 + xi) * (x[2] - x[1]));
    const Vec3 normal = normalized(cross(along_xi, along_eta));
    const Vec3 p = on_face(x, shape) + gap * normal;
    const cdfp::FacePoint f = cdfp::project_on_quadrilateral(p, x);
    EXPECT_NEAR(f.gap, gap, 1e-12);
    EXPECT_NEAR(f.outside, 0, 1e-12);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(f.shape[i], shape[i], 1e-11);
    EXPECT_NEAR(norm(f.normal - normal), 0, 1e-11);
  }
}

TEST(Projection, SaysHowFarOutsideThePointIs) {
  const Vec3 x[4] = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  EXPECT_NEAR(cdfp::project_on_quadrilateral({2.3, 0.5, -0.1}, x).outside, 0.3, 1e-12);
  EXPECT_NEAR(cdfp::project_on_quadrilateral({1, -0.25, 0.1}, x).outside, 0.25, 1e-12);
  EXPECT_NEAR(cdfp::project_on_triangle({1, -0.25, 0.1}, x).outside, 0.25, 1e-12);
  EXPECT_NEAR(cdfp::project_on_triangle({1, 0.25, 0.1}, x).outside, 0, 1e-12);
}

TEST(Projection, PublicDoorTakesPlainArrays) {
  const double triangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const double point[] = {0.25, 0.5, -0.125};
  const cdfp::FaceProjection f = cdfp::project_on_face(point, triangle);
  EXPECT_NEAR(f.gap, -0.125, 1e-15);
  EXPECT_NEAR(f.shape[0], 0.25, 1e-15);
  EXPECT_NEAR(f.shape[1], 0.25, 1e-15);
  EXPECT_NEAR(f.shape[2], 0.5, 1e-15);
  EXPECT_EQ(f.shape[3], 0.0);
}

TEST(Projection, LinesCrossWhereTheyAreClosest) {
  const cdfp::LineCrossing c = cdfp::cross_lines({-1, 0, 0.5}, {3, 0, 0.5}, {0, -1, 0}, {0, 2, 0});
  EXPECT_NEAR(c.s, 0.25, 1e-15);
  EXPECT_NEAR(c.t, 1.0 / 3, 1e-15);
  EXPECT_NEAR(std::abs(c.normal.z), 1, 1e-15);
  EXPECT_NEAR(c.sine, 1, 1e-15);
}

}  // namespace
