// PVB: stress at constant rate, energy account, dissipation on random paths.
#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace cdfp::test {
namespace {

constexpr unsigned kSeed = 42;
constexpr double kStatic = 5.88e6, kRate = 29.21e6, kExponent = 0.176, kNu = 0.49;

enum class Kind { one_point, full, wedges };

const Box kCube{1, 1, 1, 1e-3, 1e-3, 1e-3};

Model pvb(Kind kind, double smoothing_time) {
  const Mesh cube = box_mesh(kCube);
  Model model = model_of(kind == Kind::wedges ? cut_into_wedges(cube) : cube,
                         kind == Kind::full ? Formulation::full : Formulation::one_point);
  model.materials = {
      {"elastic", RateDependentMaterial{1000, kNu, kStatic, kRate, kExponent, smoothing_time}}};
  return model;
}

class EveryFormulation : public testing::TestWithParam<Kind> {};
std::string name_of(const testing::TestParamInfo<Kind>& given) {
  return given.param == Kind::full ? "full" : given.param == Kind::wedges ? "wedges" : "one_point";
}
INSTANTIATE_TEST_SUITE_P(Pvb, EveryFormulation, testing::Values(Kind::one_point, Kind::full, Kind::wedges),
                         name_of);

TEST_P(EveryFormulation, StressAtConstantRateIsModulusOfTheRateTimesStrain) {
  for (const double rate : {1.0, 100.0, 1e4}) {
    const double final_strain = 1e-4, duration = final_strain / rate;
    const int steps = 4000;
    ElementForce elements(pvb(GetParam(), duration / 400));
    const Positions start = box_mesh(kCube).coordinates;
    Positions x = start;
    for (int i = 0; i <= steps; ++i) {
      // Pure shear: equivalent rate 2 / sqrt 3 times the tensor's component.
      Matrix3d f = Matrix3d::Identity();
      f(0, 1) = f(1, 0) = final_strain * i / steps;
      x = mapped(start, f);
      force_of(elements, x, duration / steps);
    }
    const double modulus = kStatic + kRate * std::pow(2 / std::sqrt(3.0) * rate, kExponent);
    const double expected = 2 * modulus / (2 * (1 + kNu)) * final_strain;
    EXPECT_NEAR(elements.stress(0, x)(0, 1) / expected, 1, 0.005) << "rate " << rate;
  }
}

TEST_P(EveryFormulation, StressIsContinuousInTime) {
  ElementForce elements(pvb(GetParam(), 1e-6));
  const Positions start = box_mesh(kCube).coordinates;
  Matrix3d f = Matrix3d::Identity();
  double before = 0;
  const double step = 1e-8;
  for (int i = 0; i < 2000; ++i) {
    f(0, 1) += step * (i < 1000 ? 1e4 : 1.0);  // the rate falls to nearly nothing
    const Positions x = mapped(start, f);
    force_of(elements, x, step);
    const double now = elements.stress(0, x)(0, 1);
    EXPECT_LT(std::abs(now - before), 0.02e6) << i;
    before = now;
  }
  EXPECT_GT(before, 0);
}

TEST_P(EveryFormulation, NeverGivesEnergyBack) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> entry(-1, 1), pace(1, 5);
  for (int path = 0; path < 10; ++path) {
    const double step = 1e-8;
    ElementForce elements(pvb(GetParam(), 1e-6));
    const Positions start = box_mesh(kCube).coordinates;
    // Sums of waves of many frequencies, with every corner on its own.
    std::array<std::array<double, 3>, 24> size{}, frequency{};
    for (int d = 0; d < 24; ++d) {
      for (int w = 0; w < 3; ++w) {
        size[d][w] = 3e-6 * entry(random);
        frequency[d][w] = std::pow(10, pace(random));
      }
    }
    Positions x = start, before = start;
    std::vector<double> force = force_of(elements, x, step);
    double work = 0, dissipated = 0, moved = 0;
    for (int i = 1; i <= 4000; ++i) {
      for (int d = 0; d < 24; ++d) {
        x[d] = start[d];
        for (int w = 0; w < 3; ++w)
          x[d] += size[d][w] * std::sin(2 * std::numbers::pi * frequency[d][w] * step * i);
      }
      const std::vector<double> now = force_of(elements, x, step);
      for (int d = 0; d < 24; ++d) {
        const double share = -0.5 * (force[d] + now[d]) * (x[d] - before[d]);
        work += share;
        moved += std::abs(share);
      }
      force = now;
      before = x;
      if (i % 50 == 0) {
        const PartEnergy energy = energy_of(elements, x);
        EXPECT_GE(energy.dissipated, dissipated - 1e-12 * moved) << "path " << path << " seed " << kSeed;
        EXPECT_GE(energy.strain, 0);
        EXPECT_NEAR(energy.strain + energy.hourglass + energy.dissipated, work, 1e-4 * moved) << "step " << i;
        dissipated = energy.dissipated;
      }
    }
    EXPECT_GT(dissipated, 0);
  }
}

TEST_P(EveryFormulation, CornerForceLeavesTheStateAlone) {
  ElementForce elements(pvb(GetParam(), 1e-6));
  Positions x = box_mesh(kCube).coordinates;
  force_of(elements, x, 1e-8);
  std::mt19937 random(kSeed);
  distort(x, 1e-6, random);
  const std::vector<double> force = force_of(elements, x, 1e-8);
  const Mesh mesh = pvb(GetParam(), 1e-6).mesh;
  const Index corners = corners_of(mesh.types[0]);
  std::vector<double> corner(3 * std::size_t(corners));
  for (int repeat = 0; repeat < 2; ++repeat) {
    std::vector<double> sum(x.size(), 0.0);
    for (Index e = 0; e < mesh.element_count(); ++e) {
      elements.corner_force(e, x, corner);
      for (int i = 0; i < 3 * corners; ++i) {
        sum[3 * std::size_t(mesh.connectivity[e * corners + i / 3]) + i % 3] += corner[i];
      }
    }
    for (int i = 0; i < 24; ++i) EXPECT_NEAR(sum[i], force[i], 1e-12 * largest(force));
  }
}

TEST_P(EveryFormulation, StepForeseesTheRateToCome) {
  Model model = pvb(GetParam(), 1e-6);
  const double at_rest = ElementForce(model).stable_step(model.mesh.coordinates, Threads(1)).step;
  model.materials = {{"elastic", ElasticMaterial{1000, kStatic + kRate * std::pow(1e4, kExponent), kNu}}};
  EXPECT_NEAR(at_rest / ElementForce(model).stable_step(model.mesh.coordinates, Threads(1)).step, 1, 0.02);
}

}  // namespace
}  // namespace cdfp::test
