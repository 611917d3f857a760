#include "element/wedge_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cdfp {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Modes = Eigen::Matrix<double, 6, 5>;
using Shapes = Eigen::Matrix<double, 6, 2>;

const Modes& modes() {
  static const Modes all = [] {
    Modes m;
    m << -1, -1, -1, 1, 1,  //
        1, 0, -1, -1, 0,    //
        0, 1, -1, 0, -1,    //
        -1, -1, 1, -1, -1,  //
        1, 0, 1, 1, 0,      //
        0, 1, 1, 0, 1;
    return m;
  }();
  return all;
}

/// dN/d(r, s, zeta) of all corners in the triangle's middle.
WedgeCorners slopes_at(double zeta) {
  WedgeCorners slopes;
  for (int c = 0; c < 6; ++c) {
    const double side = c < 3 ? -1 : 1, share = (1 + side * zeta) / 2;
    const int i = c % 3;
    slopes.row(c) << (i == 1 ? share : i == 0 ? -share : 0), (i == 2 ? share : i == 0 ? -share : 0), side / 6;
  }
  return slopes;
}

/// gamma_k by corner: q_k = gamma_k . x
Shapes shapes_of(const WedgeGeometry& g) {
  return modes().rightCols<2>() - g.gradient * g.moments.transpose();
}

/// Of (q_1, q_2), six: the stiffness of all that is not the mean strain.
Eigen::Matrix<double, 6, 6> stiffness_of(const WedgeGeometry& g, const PartConstants& part,
                                         const WedgeStiffness& stiffness) {
  Eigen::Matrix<double, 4, 6> bend = Eigen::Matrix<double, 4, 6>::Zero();  // xx, yy, xy twice, zz
  Eigen::Matrix<double, 1, 6> twist = Eigen::Matrix<double, 1, 6>::Zero();
  for (int k = 0; k < 2; ++k) {
    const double px = g.slopes(k, 0), py = g.slopes(k, 1);
    bend(0, 3 * k) = px;
    bend(1, 3 * k + 1) = py;
    bend(2, 3 * k) = py;
    bend(2, 3 * k + 1) = px;
    twist(3 * k) = py / 2;
    twist(3 * k + 1) = -px / 2;
  }
  bend.row(3) = -stiffness.poisson * (bend.row(0) + bend.row(1));
  const double lambda = part.material.lambda, mu = part.material.mu;
  Eigen::Matrix4d c = Eigen::Matrix4d::Zero();
  for (const int i : {0, 1, 3}) {
    for (const int j : {0, 1, 3}) c(i, j) = lambda;
    c(i, i) += 2 * mu;
  }
  c(2, 2) = mu;
  Eigen::Matrix<double, 6, 6> k =
      g.volume * bend.transpose() * c * bend + stiffness.twist * twist.transpose() * twist;
  k(2, 2) += stiffness.warp;
  k(5, 5) += stiffness.warp;
  k(2, 5) -= stiffness.warp / 2;
  k(5, 2) -= stiffness.warp / 2;
  return k;
}

/// Each entry of a square matrix as that number times the unit matrix of three.
Eigen::Matrix<double, 6, 6> by_direction(const Matrix2d& m) {
  Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Zero();
  for (int k = 0; k < 2; ++k) {
    for (int l = 0; l < 2; ++l) all.block<3, 3>(3 * k, 3 * l).diagonal().setConstant(m(k, l));
  }
  return all;
}

}  // namespace

WedgeGeometry wedge_geometry(const WedgeCorners& x) {
  WedgeGeometry g;
  const WedgeCorners centred = x.rowwise() - x.row(0);
  const Matrix3d middle = slopes_at(0).transpose() * centred;
  g.frame.row(0) = middle.row(0).normalized();
  g.frame.row(2) = middle.row(0).cross(middle.row(1)).normalized();
  g.frame.row(1) = g.frame.row(2).cross(g.frame.row(0));
  const WedgeCorners local = centred * g.frame.transpose();

  // Both points integrate the cofactors, hence volume and mean gradient, exactly.
  g.least_jacobian = std::numeric_limits<double>::infinity();
  WedgeCorners gradient = WedgeCorners::Zero();
  for (const double zeta : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
    const WedgeCorners slopes = slopes_at(zeta);
    const Matrix3d jacobian = slopes.transpose() * local;  // dX_j/dxi_m: row m
    const double volume = jacobian.determinant() / 2;
    g.least_jacobian = std::min(g.least_jacobian, 4 * volume);
    g.volume += volume;
    gradient += volume * slopes * jacobian.inverse().transpose();
  }
  g.gradient = gradient / g.volume;
  g.b = (modes().transpose() * modes()).ldlt().solve(modes().transpose() * g.gradient);
  g.moments = modes().rightCols<2>().transpose() * local;

  const Matrix3d jacobian = slopes_at(0).transpose() * local;
  g.slopes = jacobian.topLeftCorner<2, 2>().inverse().transpose() / (2 * std::sqrt(3.0));
  const double upright = 1 / jacobian(2, 2);
  const Vector3d a = jacobian.row(0), b = jacobian.row(1);
  const double polar = (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm()) / 36;
  g.twist = 0.6 * 3 * g.volume * upright * upright * polar;
  g.warp = g.volume * upright * upright / 72;
  return g;
}

WedgeStiffness wedge_stiffness(const WedgeGeometry& geometry, const PartPlan& plan) {
  const double nu = plan.constants.bending_coupling, shear = 32 * (1 - nu) * plan.hourglass_factor;
  return {shear * geometry.twist, 2 * (1 + nu) * shear * geometry.warp, nu / (1 - nu)};
}

StepTerms wedge_terms(const WedgeGeometry& g, const PartConstants& part, const WedgeStiffness& stiffness) {
  StepTerms terms = mean_terms(g.gradient.transpose() * g.gradient, 6, part, part.density);
  const Shapes shapes = shapes_of(g);
  const Matrix2d metric = shapes.transpose() * shapes;
  const Eigen::SelfAdjointEigenSolver<Matrix2d> spread(metric);
  const auto root = by_direction(spread.operatorSqrt());
  terms.hourglass =
      highest_eigenvalue(Eigen::Matrix<double, 6, 6>(root * stiffness_of(g, part, stiffness) * root)) * 6 /
      (part.density * g.volume);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> uniform(g.gradient.transpose() * g.gradient);
  const Eigen::Matrix<double, 3, 2> cosines =
      uniform.operatorInverseSqrt() * g.gradient.transpose() * shapes * spread.operatorInverseSqrt();
  if (cosines.cwiseAbs().maxCoeff() >= 1e-9) {
    terms.coupling = std::min(1.0, std::sqrt(highest_eigenvalue(Matrix3d(cosines * cosines.transpose()))));
  }
  return terms;
}

double wedge_exact(const WedgeGeometry& g, const PartConstants& part, const WedgeStiffness& stiffness) {
  Eigen::Matrix<double, 6, 18> strain = Eigen::Matrix<double, 6, 18>::Zero(), q = strain;
  const Shapes shapes = shapes_of(g);
  for (int c = 0; c < 6; ++c) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      strain(i, 3 * c + i) = g.gradient(c, i);
      strain(3 + i, 3 * c + i) = g.gradient(c, j);
      strain(3 + i, 3 * c + j) = g.gradient(c, i);
      for (int k = 0; k < 2; ++k) q(3 * k + i, 3 * c + i) = shapes(c, k);
    }
  }
  Eigen::Matrix<double, 6, 6> elasticity = Eigen::Matrix<double, 6, 6>::Zero();
  elasticity.topLeftCorner<3, 3>().setConstant(part.material.lambda);
  elasticity.diagonal().head<3>().array() += 2 * part.material.mu;
  elasticity.diagonal().tail<3>().setConstant(part.material.mu);
  const Eigen::Matrix<double, 18, 18> k = g.volume * strain.transpose() * elasticity * strain +
                                          q.transpose() * stiffness_of(g, part, stiffness) * q;
  return highest_eigenvalue(k) * 6 / (part.density * g.volume);
}

double wedge_volume(const WedgeCorners& x) {
  const WedgeCorners centred = x.rowwise() - x.row(0);
  double volume = 0;
  for (const double zeta : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
    volume += (slopes_at(zeta).transpose() * centred).determinant() / 2;
  }
  return volume;
}

}  // namespace cdfp
