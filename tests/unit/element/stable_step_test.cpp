// The stable step against exact values, the true highest frequency, and motion itself.
#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace cdfp::test {
namespace {

constexpr unsigned kSeed = 7;

/// 2 / omega of the free model by the eigenvalues of its stiffness at `x`.
double true_step(ElementForce& elements, const Positions& x, double h) {
  std::vector<double> mass(x.size() / 3, 0.0);
  elements.add_mass(mass);
  Eigen::MatrixXd k = stiffness(elements, x, h);
  for (Eigen::Index i = 0; i < k.rows(); ++i) {
    for (Eigen::Index j = 0; j < k.cols(); ++j) k(i, j) /= std::sqrt(mass[i / 3] * mass[j / 3]);
  }
  const double highest =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  return 2 / std::sqrt(highest);
}

TEST(StableStep, FreeCube) {
  for (const auto& [nu, expected] : {std::pair{0.2, 0.8165}, {0.3, 0.734}, {0.49, 0.585}}) {
    const double h = 1e-3, density = 2500, modulus = 74e9;
    const double wave = std::sqrt(modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / density);
    const Mesh mesh = box_mesh({1, 1, 1, h, h, h});
    for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
      ElementForce elements(model_of(mesh, formulation, modulus, nu, density));
      const StepBound bound = elements.stable_step(mesh.coordinates, Threads(1));
      EXPECT_EQ(bound.element, 0);
      const double exact = h / wave * std::sqrt((1 - nu) / (1 + nu));
      EXPECT_NEAR(exact * wave / h, expected, 0.001);
      EXPECT_NEAR(bound.step / exact, 1, 1e-6) << nu;
    }
  }
}

TEST(StableStep, NeverAboveTheTruthAndNotFarBelow) {
  std::mt19937 random(kSeed);
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    for (int trial = 0; trial < 60; ++trial) {
      std::uniform_real_distribution<double> side(0.4e-3, 2e-3), portion(0, 0.25);
      const Box box{1, 1, 1, side(random), side(random), side(random)};
      Mesh mesh = box_mesh(box);
      const double least = std::min({box.lx, box.ly, box.lz});
      if (trial % 3 == 1) distort_columns(mesh, box, portion(random) * least, random);
      if (trial % 3 == 2) distort(mesh.coordinates, portion(random) * least, random);
      const double nu = std::array{0.0, 0.2, 0.3, 0.45, 0.49}[trial % 5];
      Model model = model_of(mesh, formulation, 74e9, nu);
      model.parts[0].hourglass = trial % 4 == 0 ? 3.0 : 1.0;
      ElementForce elements(model);
      for (const double strain : {0.0, 1e-3, 0.05}) {
        Positions x = mapped(mesh.coordinates, Matrix3d::Identity() + random_matrix(strain, random));
        distort(x, strain * least, random);
        const double bound = elements.stable_step(x, Threads(1)).step;
        const double truth = true_step(elements, x, 1e-6 * least);
        EXPECT_LE(bound, truth * (1 + 1e-6))
            << "trial " << trial << " strain " << strain << " seed " << kSeed;
        EXPECT_GE(bound, truth * (strain > 0.01 ? 0.6 : 0.985)) << "trial " << trial << " strain " << strain;
      }
    }
  }
}

TEST(StableStep, OfATetrahedron) {
  std::mt19937 random(kSeed);
  for (int trial = 0; trial < 60; ++trial) {
    Mesh cube = cut_into_tetrahedra(box_mesh({1, 1, 1, 1e-3, 1e-3, 1e-3}));
    distort(cube.coordinates, 0.2e-3, random);
    Mesh mesh;
    mesh.part_names = cube.part_names;
    mesh.types = {ElementType::tetrahedron};
    mesh.parts = {0};
    mesh.connectivity = {0, 1, 2, 3};
    for (int c = 0; c < 4; ++c) {
      const Vector3d corner = at(cube.coordinates, cube.connectivity[4 * (trial % 6) + c]);
      mesh.coordinates.insert(mesh.coordinates.end(), corner.begin(), corner.end());
    }
    const double nu = std::array{0.0, 0.2, 0.3, 0.45, 0.49}[trial % 5];
    ElementForce elements(model_of(mesh, Formulation::one_point, 74e9, nu));
    for (const double strain : {0.0, 1e-3, 0.05}) {
      const Positions x = mapped(mesh.coordinates, Matrix3d::Identity() + random_matrix(strain, random));
      const double bound = elements.stable_step(x, Threads(1)).step;
      const double truth = true_step(elements, x, 1e-9);
      EXPECT_LE(bound, truth * (1 + 1e-6)) << "trial " << trial << " strain " << strain << " seed " << kSeed;
      EXPECT_GE(bound, truth * (strain > 0.01 ? 0.6 : 0.985)) << "trial " << trial << " strain " << strain;
    }
  }
}

TEST(StableStep, OfAWedge) {
  std::mt19937 random(kSeed);
  for (int trial = 0; trial < 90; ++trial) {
    std::uniform_real_distribution<double> side(0.4e-3, 2e-3), portion(0, 0.25);
    const Box box{1, 1, 1, side(random), side(random), side(random)};
    const double least = std::min({box.lx, box.ly, box.lz});
    Mesh cube = box_mesh(box);
    if (trial % 3 == 1) distort_columns(cube, box, portion(random) * least, random);
    if (trial % 3 == 2) distort(cube.coordinates, portion(random) * least, random);
    cube = cut_into_wedges(cube);
    Mesh mesh;
    mesh.part_names = cube.part_names;
    mesh.types = {ElementType::wedge};
    mesh.parts = {0};
    mesh.connectivity = {0, 1, 2, 3, 4, 5};
    for (int c = 0; c < 6; ++c) {
      const Vector3d corner = at(cube.coordinates, cube.connectivity[6 * (trial % 2) + c]);
      mesh.coordinates.insert(mesh.coordinates.end(), corner.begin(), corner.end());
    }
    const double nu = std::array{0.0, 0.2, 0.3, 0.45, 0.49}[trial % 5];
    Model model = model_of(mesh, Formulation::one_point, 74e9, nu);
    model.parts[0].hourglass = trial % 4 == 0 ? 3.0 : 1.0;
    ElementForce elements(model);
    for (const double strain : {0.0, 1e-3, 0.05}) {
      Positions x = mapped(mesh.coordinates, Matrix3d::Identity() + random_matrix(strain, random));
      distort(x, strain * least, random);
      const double bound = elements.stable_step(x, Threads(1)).step;
      const double truth = true_step(elements, x, 1e-6 * least);
      EXPECT_LE(bound, truth * (1 + 1e-6)) << "trial " << trial << " strain " << strain << " seed " << kSeed;
      EXPECT_GE(bound, truth * (strain > 0.01 ? 0.6 : 0.985)) << "trial " << trial << " strain " << strain;
    }
  }
}

TEST(StableStep, HoldsInAMeshWithItsWorstElement) {
  std::mt19937 random(kSeed);
  const Box box{4, 3, 2, 4e-3, 3e-3, 2e-3};
  Mesh mesh = box_mesh(box);
  distort(mesh.coordinates, 0.2e-3, random);
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    ElementForce elements(model_of(mesh, formulation));
    const StepBound bound = elements.stable_step(mesh.coordinates, Threads(1));
    EXPECT_LE(bound.step, true_step(elements, mesh.coordinates, 1e-9));

    Mesh alone = mesh;
    alone.types.resize(1);
    alone.parts.resize(1);
    alone.connectivity.assign(mesh.connectivity.begin() + 8 * bound.element,
                              mesh.connectivity.begin() + 8 * bound.element + 8);
    ElementForce worst(model_of(alone, formulation));
    EXPECT_NEAR(worst.stable_step(mesh.coordinates, Threads(1)).step / bound.step, 1, 1e-9);
  }
}

TEST(StableStep, FreeElementMovesStably) {
  std::mt19937 random(kSeed);
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    for (const double share : {0.99, 1.02}) {
      Mesh mesh = box_mesh({1, 1, 1, 1e-3, 1e-3, 1e-3});
      ElementForce elements(model_of(mesh, formulation));
      Positions x = mesh.coordinates;
      const double step = share * elements.stable_step(x, Threads(1)).step;
      const double mass = elements.corner_mass(0);
      std::vector<double> v(24, 0.0);
      distort(v, 1e-3, random);
      for (int i = 0; i < 2000; ++i) {
        for (int d = 0; d < 24; ++d) x[d] += step * v[d];
        const std::vector<double> force = force_of(elements, x, step);
        for (int d = 0; d < 24; ++d) v[d] += step * force[d] / mass;
        if (largest(v) > 1) break;
      }
      EXPECT_EQ(largest(v) < 0.1, share < 1);
    }
  }
}

TEST(StableStep, IsNotANumberWhereThePositionsAreNot) {
  const Box box{20, 2, 2, 20, 2, 2};
  ElementForce elements(model_of(box_mesh(box), Formulation::one_point));
  Positions x = box_mesh(box).coordinates;
  x[3 * std::size_t(box.node(10, 1, 1)) + 1] = std::nan("");
  EXPECT_TRUE(std::isnan(elements.stable_step(x, Threads(1)).step));
}

}  // namespace
}  // namespace cdfp::test
