#include "element/step_bound.hpp"

#include <algorithm>
#include <cmath>

namespace cdfp {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

using Stiffness = Eigen::Matrix<double, 24, 24>;
using StrainOf = Eigen::Matrix<double, 6, 24>;

double highest(const Stiffness& k) {
  return Eigen::SelfAdjointEigenSolver<Stiffness>(k, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// Engineering strains xx yy zz xy yz xz of corner displacements, for gradients by corner.
StrainOf strain_of(const Corners& gradient) {
  StrainOf b = StrainOf::Zero();
  for (int c = 0; c < 8; ++c) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      b(i, 3 * c + i) = gradient(c, i);
      b(3 + i, 3 * c + i) = gradient(c, j);
      b(3 + i, 3 * c + j) = gradient(c, i);
    }
  }
  return b;
}

Eigen::Matrix<double, 6, 6> elasticity(double lambda, double mu) {
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(lambda);
  c.diagonal().head<3>().array() += 2 * mu;
  c.diagonal().tail<3>().setConstant(mu);
  return c;
}

/// Hourglass amplitudes' shape vectors, gamma_a by corner: q_a = gamma_a . x.
Eigen::Matrix<double, 8, 4> hourglass_shapes(const HexahedronGeometry& g) {
  return mode_signs().rightCols<4>() - g.gradient * g.moments.transpose();
}

/// K of one_point.hpp on (qhat_ia at 4 i + a).
Eigen::Matrix<double, 12, 12> hourglass_stiffness(const PartConstants& part, const Vector3d& g) {
  Eigen::Matrix<double, 12, 12> k = Eigen::Matrix<double, 12, 12>::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int along = 4 * i + j, across = 4 * j + i;
    k(along, along) = g[i] * g[i];
    k(across, across) = g[j] * g[j];
    k(along, across) = k(across, along) = part.bending_coupling * g[i] * g[j];
    k(4 * i + 3, 4 * i + 3) = part.warping_share * g[i] * g[i];
    Eigen::Matrix<double, 12, 1> shear = Eigen::Matrix<double, 12, 1>::Zero();
    shear(5 * i) = g[j];
    shear(5 * j) = g[i];
    k += part.shear_share * shear * shear.transpose();
  }
  return k;
}

}  // namespace

double StepTerms::bound() const {
  return std::max(material, hourglass) + coupling * std::sqrt(material * hourglass);
}

StepTerms one_point_terms(const HexahedronGeometry& geometry, const PartConstants& part,
                          const Vector3d& hourglass, double density) {
  const double mass = density * geometry.volume / 8;
  const double lambda = part.material.lambda, mu = part.material.mu;
  StepTerms terms;

  // In the principal axes of the gradients' metric, shear and normal strains part; the elasticity is
  // isotropic.
  const Matrix3d metric = geometry.gradient.transpose() * geometry.gradient;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(metric);
  const Vector3d squares = axes.eigenvalues();
  const Vector3d lengths = squares.cwiseSqrt();
  Matrix3d normal = lambda * lengths * lengths.transpose();
  normal.diagonal() += 2 * mu * squares;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> waves(normal, Eigen::EigenvaluesOnly);
  const double shear = mu * (squares[1] + squares[2]);
  terms.material = geometry.volume / mass * std::max(shear, waves.eigenvalues()[2]);
  terms.geometric = geometry.volume / mass * squares[2];

  const Eigen::Matrix<double, 8, 4> shapes = hourglass_shapes(geometry);
  const Eigen::Matrix4d shape_metric = shapes.transpose() * shapes;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> spread(shape_metric);
  double stiffest = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double a = hourglass[i] * hourglass[i], b = hourglass[j] * hourglass[j];
    stiffest = std::max(stiffest, 0.5 * (a + b) + std::hypot(0.5 * (a - b), part.bending_coupling *
                                                                                hourglass[i] * hourglass[j]));
    stiffest = std::max(stiffest, part.warping_share * a);
  }
  Matrix3d twist = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    Vector3d pair = Vector3d::Zero();
    pair[i] = hourglass[j];
    pair[j] = hourglass[i];
    twist += part.shear_share * pair * pair.transpose();
  }
  stiffest = std::max(
      stiffest, Eigen::SelfAdjointEigenSolver<Matrix3d>(twist, Eigen::EigenvaluesOnly).eigenvalues()[2]);
  terms.hourglass = stiffest * spread.eigenvalues()[3] / mass;

  const Eigen::Matrix<double, 3, 4> overlap = geometry.gradient.transpose() * shapes;
  if (overlap.cwiseAbs().maxCoeff() > 1e-12) {
    const Eigen::Matrix<double, 3, 4> cosines =
        axes.operatorInverseSqrt() * overlap * spread.operatorInverseSqrt();
    terms.coupling = std::min(
        1.0,
        std::sqrt(Eigen::SelfAdjointEigenSolver<Matrix3d>(cosines * cosines.transpose()).eigenvalues()[2]));
  }
  return terms;
}

StepTerms full_terms(const HexahedronGeometry& geometry, const PartConstants& part, double density) {
  const double mass = density * geometry.volume / 8;
  const Eigen::Matrix<double, 6, 6> c = elasticity(part.material.lambda, part.material.mu);
  const StrainOf mean = strain_of(geometry.gradient);
  Stiffness k = Stiffness::Zero();
  StepTerms terms;
  for (int p = 0; p < 8; ++p) {
    const double place = 1 / std::sqrt(3.0);
    const Corners gradient =
        shape_slopes(p & 1 ? place : -place, p & 2 ? place : -place, p & 4 ? place : -place) *
        geometry.to_points[p];
    StrainOf b = strain_of(gradient);
    const Eigen::Matrix<double, 1, 24> correction = (mean - b).topRows<3>().colwise().sum() / 3;
    b.topRows<3>().rowwise() += correction;
    k += geometry.point_volumes[p] * b.transpose() * c * b;
    const Matrix3d metric = gradient.transpose() * gradient;
    terms.geometric +=
        2 * geometry.point_volumes[p] / mass *
        Eigen::SelfAdjointEigenSolver<Matrix3d>(metric, Eigen::EigenvaluesOnly).eigenvalues()[2];
  }
  terms.material = highest(k) / mass;
  return terms;
}

double one_point_exact(const HexahedronGeometry& geometry, const PartConstants& part,
                       const Vector3d& hourglass, double density) {
  const double mass = density * geometry.volume / 8;
  const StrainOf b = strain_of(geometry.gradient);
  const Eigen::Matrix<double, 8, 4> shapes = hourglass_shapes(geometry);
  Eigen::Matrix<double, 12, 24> amplitudes = Eigen::Matrix<double, 12, 24>::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    for (int i = 0; i < 3; ++i)
      amplitudes.block<4, 1>(4 * i, 3 * corner + i) = shapes.row(corner).transpose();
  }
  const Stiffness k =
      geometry.volume * b.transpose() * elasticity(part.material.lambda, part.material.mu) * b +
      amplitudes.transpose() * hourglass_stiffness(part, hourglass) * amplitudes;
  return highest(k) / mass;
}

}  // namespace cdfp
