// Bending, locking and vibration against theory, by the elements' linear stiffness.
#include <gtest/gtest.h>

#include <functional>

#include "fixtures.hpp"

namespace cdfp::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Linear {
  MatrixXd k;
  VectorXd mass;
};

Linear linear(const Model& model) {
  ElementForce elements(model);
  std::vector<double> mass(model.mesh.coordinates.size() / 3, 0.0);
  elements.add_mass(mass);
  Linear result{stiffness(elements, model.mesh.coordinates, 1e-9), VectorXd(3 * Index(mass.size()))};
  for (std::size_t i = 0; i < 3 * mass.size(); ++i) result.mass[Index(i)] = mass[i / 3];
  return result;
}

Mesh wedges(const Mesh& mesh) {
  return cut_into_wedges(mesh);
}

/// Deflection along z at the end of a strip held at x = 0, with `load` spread over its end, over that of a
/// Timoshenko beam. `plane_strain` holds y everywhere.
double deflection_ratio(const Box& box, Formulation formulation, double nu, bool plane_strain,
                        double slant = 0, const std::function<Mesh(const Mesh&)>& cut = {}) {
  const double modulus = 1e9, load = 1e-3;
  Mesh mesh = box_mesh(box);
  for (std::size_t n = 0; n < mesh.coordinates.size() / 3; ++n) {
    double& x = mesh.coordinates[3 * n];
    const double z = mesh.coordinates[3 * n + 2];
    if (x > 1e-9 * box.lx && x < (1 - 1e-9) * box.lx) x += slant * (z - 0.5 * box.lz);
  }
  if (cut) mesh = cut(mesh);
  const MatrixXd k = linear(model_of(std::move(mesh), formulation, modulus, nu)).k;
  std::vector<Index> free;
  VectorXd f = VectorXd::Zero(k.rows());
  for (cdfp::Index kz = 0; kz <= box.nz; ++kz) {
    for (cdfp::Index j = 0; j <= box.ny; ++j) {
      for (cdfp::Index i = 0; i <= box.nx; ++i) {
        const Index n = 3 * Index(box.node(i, j, kz));
        // The root may grow in y and z, but for the middle.
        if (i > 0) free.push_back(n);
        if (!plane_strain && !(i == 0 && j == 0)) free.push_back(n + 1);
        if (!(i == 0 && kz == 0)) free.push_back(n + 2);
        if (i == box.nx) {
          const double share = (j == 0 || j == box.ny ? 0.5 : 1.0) * (kz == 0 || kz == box.nz ? 0.5 : 1.0);
          f[n + 2] = load * share / (box.ny * box.nz);
        }
      }
    }
  }
  VectorXd reduced_load(free.size());
  for (std::size_t i = 0; i < free.size(); ++i) reduced_load[Index(i)] = f[free[i]];
  const VectorXd u = reduced(k, free).ldlt().solve(reduced_load);
  const double mean = reduced_load.dot(u) / load;
  const double bending = plane_strain ? modulus / (1 - nu * nu) : modulus;
  const double area = box.ly * box.lz, shear = modulus / (2 * (1 + nu));
  const double beam = load * std::pow(box.lx, 3) / (3 * bending * area * box.lz * box.lz / 12) +
                      load * box.lx / (5.0 / 6 * shear * area);
  return mean / beam;
}

TEST(Bending, StripOfOnePointElementsIsABeam) {
  for (const cdfp::Index layers : {1, 3, 5}) {
    const Box box{16, 1, layers, 16, 1, 1};
    EXPECT_NEAR(deflection_ratio(box, Formulation::one_point, 0.2, false), 1, 0.01) << layers << " layers";
  }
}

TEST(Bending, StripOfFlatElementsIsABeam) {
  // 1.12 mm columns, 2.5 mm in three layers: as in a laminated plate
  const Box box{16, 1, 3, 18e-3, 1.12e-3, 2.5e-3};
  EXPECT_NEAR(deflection_ratio(box, Formulation::one_point, 0.2, false), 1, 0.015);
}

TEST(Bending, SlantedElementsAreSomewhatStiff) {
  const Box box{16, 1, 3, 16, 1, 1};
  EXPECT_NEAR(deflection_ratio(box, Formulation::one_point, 0.2, false, 0.3), 1, 0.05);
}

TEST(Bending, WidePlateOfOnePointElements) {
  const Box box{16, 1, 3, 16, 1, 1};
  EXPECT_NEAR(deflection_ratio(box, Formulation::one_point, 0.3, true), 1, 0.015);
  EXPECT_NEAR(deflection_ratio(box, Formulation::one_point, 0.49, true), 1, 0.02);
}

TEST(Locking, NearlyIncompressibleStripBendsFreely) {
  // Displacement elements are stiff in bending where they are long; how stiff must not depend on nu.
  const Box box{24, 1, 6, 12, 1, 2};
  const double soft = deflection_ratio(box, Formulation::full, 0.3, true);
  EXPECT_NEAR(soft, 1, 0.03);
  EXPECT_NEAR(deflection_ratio(box, Formulation::full, 0.49, true), soft, 0.02);
  EXPECT_NEAR(deflection_ratio(box, Formulation::full, 0.4999, true), soft, 0.03);
}

/// First frequency of a hard simply supported plate 100 x 100 mm by its quarter.
double plate_frequency(double thickness, cdfp::Index columns, cdfp::Index layers, Formulation formulation,
                       const std::function<Mesh(const Mesh&)>& cut = {}) {
  const Box box{columns, columns, layers, 50e-3, 50e-3, thickness};
  const Linear plate = linear(model_of(cut ? cut(box_mesh(box)) : box_mesh(box), formulation));
  std::vector<Index> free;
  for (cdfp::Index k = 0; k <= box.nz; ++k) {
    for (cdfp::Index j = 0; j <= box.ny; ++j) {
      for (cdfp::Index i = 0; i <= box.nx; ++i) {
        // Support at x = 0 and y = 0; symmetry at the far sides.
        const Index n = 3 * Index(box.node(i, j, k));
        if (j > 0 && i < box.nx) free.push_back(n);
        if (i > 0 && j < box.ny) free.push_back(n + 1);
        if (i > 0 && j > 0) free.push_back(n + 2);
      }
    }
  }
  VectorXd root_mass(free.size());
  for (std::size_t i = 0; i < free.size(); ++i) root_mass[Index(i)] = std::sqrt(plate.mass[free[i]]);
  const Eigen::LDLT<MatrixXd> solver(reduced(plate.k, free));
  VectorXd v = root_mass;
  double omega_squared = 0;
  for (int i = 0; i < 30; ++i) {
    const VectorXd next = root_mass.cwiseProduct(solver.solve(root_mass.cwiseProduct(v)));
    omega_squared = v.dot(v) / v.dot(next);
    v = next.normalized();
  }
  return std::sqrt(omega_squared) / (2 * std::numbers::pi);
}

TEST(Vibration, SimplySupportedPlate) {
  // exact three-dimensional solution, first mode
  EXPECT_NEAR(plate_frequency(10e-3, 8, 3, Formulation::one_point) / 4883.41, 1, 0.01);
  EXPECT_NEAR(plate_frequency(5e-3, 8, 3, Formulation::one_point) / 2498.02, 1, 0.01);
  EXPECT_NEAR(plate_frequency(10e-3, 8, 1, Formulation::one_point) / 4883.41, 1, 0.02);
}

TEST(Wedge, OneLayerBendsAndHardlyLocks) {
  for (const double nu : {0.2, 0.49, 0.4999}) {
    for (const bool plane_strain : {false, true}) {
      for (const cdfp::Index layers : {1, 2}) {
        const Box box{16, 1, layers, 16, 1, 1};
        const double found = deflection_ratio(box, Formulation::one_point, nu, plane_strain, 0, wedges);
        EXPECT_GT(found, 0.9) << nu << " in " << layers << " layers";
        EXPECT_LT(found, 1.005);
      }
    }
  }
}

/// Upright along the strip.
Mesh upright(const Mesh& mesh) {
  static constexpr int kTurned[8] = {0, 3, 7, 4, 1, 2, 6, 5};
  Mesh turned = mesh;
  for (std::size_t i = 0; i < turned.connectivity.size(); ++i) {
    turned.connectivity[i] = mesh.connectivity[i / 8 * 8 + std::size_t(kTurned[i % 8])];
  }
  return cut_into_wedges(turned);
}

TEST(Wedge, StripOfUprightOnesIsABeam) {
  for (const cdfp::Index n : {1, 2, 3}) {
    const Box box{16, n, n, 16, 1, 1};
    for (const bool plane_strain : {false, true}) {
      EXPECT_NEAR(deflection_ratio(box, Formulation::one_point, 0.2, plane_strain, 0, upright), 1, 0.02);
    }
    // Where the cross-section cannot bulge, triangles are stiff near incompressibility.
    EXPECT_GT(deflection_ratio(box, Formulation::one_point, 0.49, false, 0, upright), 0.9);
    EXPECT_GT(deflection_ratio(box, Formulation::one_point, 0.49, true, 0, upright), 0.65);
  }
}

TEST(Wedge, OnlyRigidMotionsAreFree) {
  constexpr unsigned kSeed = 4;
  std::mt19937 random(kSeed);
  for (int trial = 0; trial < 10; ++trial) {
    Mesh mesh = cut_into_wedges(box_mesh({}));
    if (trial > 0) distort(mesh.coordinates, 0.2, random);
    mesh.types.resize(1);
    mesh.parts.resize(1);
    mesh.connectivity.resize(6);
    const MatrixXd k = linear(model_of(mesh, Formulation::one_point, 1, 0.2)).k;
    std::vector<Index> mine;
    for (const cdfp::Index n : mesh.connectivity) mine.insert(mine.end(), {3 * n, 3 * n + 1, 3 * n + 2});
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(reduced(k, mine));
    EXPECT_LT(solver.eigenvalues()[5], 1e-6);
    EXPECT_GT(solver.eigenvalues()[6], 5e-3) << "trial " << trial << " seed " << kSeed;
  }
}

/// A free column of 12 equilateral wedges under opposite torques: Saint-Venant's constant sqrt 3 / 80 a^4.
TEST(Wedge, ColumnTwistsLikeAnEquilateralBar) {
  const double side = 1, height = 0.5, modulus = 1, nu = 0.2;
  Mesh mesh;
  mesh.part_names = {"column"};
  constexpr cdfp::Index kCount = 12;
  for (cdfp::Index k = 0; k <= kCount; ++k) {
    for (int c = 0; c < 3; ++c) {
      const double angle = 2 * std::numbers::pi * c / 3;
      mesh.coordinates.insert(mesh.coordinates.end(), {side / std::sqrt(3.0) * std::cos(angle),
                                                       side / std::sqrt(3.0) * std::sin(angle), height * k});
    }
    if (k == kCount) break;
    mesh.types.push_back(ElementType::wedge);
    mesh.parts.push_back(0);
    for (cdfp::Index c = 0; c < 6; ++c) mesh.connectivity.push_back(3 * k + c);
  }
  const MatrixXd k = linear(model_of(mesh, Formulation::one_point, modulus, nu)).k;
  VectorXd f = VectorXd::Zero(k.rows());
  const double radius = side / std::sqrt(3.0);
  for (Index c = 0; c < 3; ++c) {
    const double angle = 2 * std::numbers::pi * double(c) / 3;
    for (const Index n : {c, 3 * kCount + c}) {
      const double share = (n < 3 ? -1 : 1) / (3 * radius);  // of a torque of one
      f[3 * n] = -share * std::sin(angle);
      f[3 * n + 1] = share * std::cos(angle);
    }
  }
  const VectorXd u = k.completeOrthogonalDecomposition().solve(f);
  const double constant = std::sqrt(3.0) / 80 * std::pow(side, 4), shear = modulus / (2 * (1 + nu));
  EXPECT_NEAR(f.dot(u) / (height * kCount / (shear * constant)), 1, 1e-3);
}

TEST(Wedge, StripConverges) {
  for (const double slant : {0.0, 0.2}) {
    double last = 0;
    for (const cdfp::Index n : {1, 2, 3}) {
      const Box box{8 * n, n, n, 8, 1, 1};
      const double off = 1 - deflection_ratio(box, Formulation::one_point, 0.2, false, slant, wedges);
      EXPECT_GT(off, 0);
      if (n == 2) {
        EXPECT_LT(off, 0.5 * last);
      }
      if (n == 3) {
        EXPECT_LT(off, 0.6 * last);
        EXPECT_LT(off, 0.025);
      }
      last = off;
    }
  }
}

TEST(Wedge, PlateIsStiffWhereTrianglesAreLargeAgainstItsThickness) {
  EXPECT_NEAR(plate_frequency(10e-3, 8, 1, Formulation::one_point, wedges) / 4883.41, 1.03, 0.01);
  EXPECT_NEAR(plate_frequency(5e-3, 8, 1, Formulation::one_point, wedges) / 2498.02, 1.14, 0.01);
}

}  // namespace
}  // namespace cdfp::test
