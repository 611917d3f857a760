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

/// Highest eigenvalue of `hourglass_stiffness` in closed form but for the twist.
double stiffest(const PartConstants& part, const Vector3d& g) {
  double most = 0;
  Matrix3d twist = Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double a = g[i] * g[i], b = g[j] * g[j];
    most = std::max(most, 0.5 * (a + b) + std::hypot(0.5 * (a - b), part.bending_coupling * g[i] * g[j]));
    most = std::max(most, part.warping_share * a);
    Vector3d pair = Vector3d::Zero();
    pair[i] = g[j];
    pair[j] = g[i];
    twist += part.shear_share * pair * pair.transpose();
  }
  return std::max(most, highest_eigenvalue(twist));
}

/// Between the space of the mean gradient and that of an orthonormal `basis`.
double greatest_cosine(const Corners& gradient, const Eigen::Matrix<double, 8, 4>& basis) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> metric(gradient.transpose() * gradient);
  const Eigen::Matrix<double, 3, 4> cosines = metric.operatorInverseSqrt() * gradient.transpose() * basis;
  if (cosines.cwiseAbs().maxCoeff() < 1e-9) return 0;
  return std::min(1.0, std::sqrt(highest_eigenvalue(Matrix3d(cosines * cosines.transpose()))));
}

Corners point_gradient(const HexahedronGeometry& geometry, int p) {
  const double place = 1 / std::sqrt(3.0);
  return shape_slopes(p & 1 ? place : -place, p & 2 ? place : -place, p & 4 ? place : -place) *
         geometry.to_points[p];
}

}  // namespace

double StepTerms::bound() const {
  return std::max(material, hourglass) + coupling * std::sqrt(material * hourglass);
}

/// In the principal axes of the gradients' metric shear and normal strains part; the elasticity is isotropic.
StepTerms mean_terms(const Matrix3d& metric, int corners, const PartConstants& part, double density) {
  const double lambda = part.material.lambda, mu = part.material.mu;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(metric, Eigen::EigenvaluesOnly);
  const Vector3d& squares = principal.eigenvalues();
  const Vector3d roots = squares.cwiseSqrt();
  Matrix3d normal = lambda * roots * roots.transpose();
  normal.diagonal() += 2 * mu * squares;
  StepTerms terms;
  terms.material = corners / density * std::max(mu * (squares[1] + squares[2]), highest_eigenvalue(normal));
  terms.geometric = corners / density * squares[2];
  return terms;
}

StepTerms tetrahedron_terms(const TetrahedronGeometry& geometry, const PartConstants& part, double density) {
  return mean_terms(geometry.gradient.transpose() * geometry.gradient, 4, part, density);
}

StepTerms one_point_terms(const HexahedronGeometry& geometry, const PartConstants& part,
                          const Vector3d& hourglass, double density) {
  StepTerms terms = mean_terms(geometry.gradient.transpose() * geometry.gradient, 8, part, density);
  const Eigen::Matrix<double, 8, 4> shapes = hourglass_shapes(geometry);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> spread(shapes.transpose() * shapes);
  terms.hourglass = stiffest(part, hourglass) * spread.eigenvalues()[3] * 8 / (density * geometry.volume);
  terms.coupling = greatest_cosine(geometry.gradient, shapes * spread.operatorInverseSqrt());
  return terms;
}

/// The stiffness is that of the mean strains plus that of what the points' gradients d_p differ from the
/// mean, since these have no mean; the latter works on deviators alone: <= 2 mu sum_p w_p |d_p|^2.
StepTerms full_terms(const HexahedronGeometry& geometry, const PartConstants& part, double density) {
  StepTerms terms = mean_terms(geometry.gradient.transpose() * geometry.gradient, 8, part, density);
  Eigen::Matrix<double, 8, 8> differences = Eigen::Matrix<double, 8, 8>::Zero();
  terms.geometric = 0;
  for (int p = 0; p < 8; ++p) {
    const Corners gradient = point_gradient(geometry, p);
    const Corners difference = gradient - geometry.gradient;
    const double share = geometry.point_volumes[p] / geometry.volume * 8 / density;  // volume over mass
    differences += share * difference * difference.transpose();
    terms.geometric += 2 * share * highest_eigenvalue(Matrix3d(gradient.transpose() * gradient));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 8, 8>> spread(differences);
  terms.hourglass = 2 * part.material.mu * spread.eigenvalues()[7];
  terms.coupling = greatest_cosine(geometry.gradient, spread.eigenvectors().rightCols<4>());
  return terms;
}

double full_exact(const HexahedronGeometry& geometry, const PartConstants& part, double density) {
  const Eigen::Matrix<double, 6, 6> c = elasticity(part.material.lambda, part.material.mu);
  const StrainOf mean = strain_of(geometry.gradient);
  Stiffness k = Stiffness::Zero();
  for (int p = 0; p < 8; ++p) {
    StrainOf b = strain_of(point_gradient(geometry, p));
    const Eigen::Matrix<double, 1, 24> correction = (mean - b).topRows<3>().colwise().sum() / 3;
    b.topRows<3>().rowwise() += correction;
    k += geometry.point_volumes[p] * b.transpose() * c * b;
  }
  return highest_eigenvalue(k) * 8 / (density * geometry.volume);
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
  return highest_eigenvalue(k) / mass;
}

}  // namespace cdfp
