#include "element/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cdfp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Signs = Eigen::Matrix<double, 8, 7>;

Signs make_signs() {
  static constexpr int kCorner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                        {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  Signs s;
  for (int c = 0; c < 8; ++c) {
    const int xi = kCorner[c][0], eta = kCorner[c][1], zeta = kCorner[c][2];
    s.row(c) << xi, eta, zeta, eta * zeta, xi * zeta, xi * eta, xi * eta * zeta;
  }
  return s;
}

/// The rotation nearest to the directions of the mid lines (symmetric orthonormalisation), axes as rows.
Matrix3d frame_of(const Matrix3d& mid_lines) {
  const Matrix3d directions = mid_lines.rowwise().normalized();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> metric(directions * directions.transpose());
  return metric.operatorInverseSqrt() * directions;
}

/// Entries of b and moments that Prism keeps.
bool prism_keeps(int mode, int axis) {
  static constexpr bool kKept[7][3] = {{true, true, false},  {true, true, false},  {false, false, true},
                                       {false, false, true}, {false, false, true}, {false, false, false},
                                       {false, false, false}};
  return kKept[mode][axis];
}

}  // namespace

const Eigen::Matrix<double, 8, 7>& mode_signs() {
  static const Signs signs = make_signs();
  return signs;
}

Corners shape_slopes(double xi, double eta, double zeta) {
  const Signs& s = mode_signs();
  Corners slopes;
  slopes.col(0) = s.col(0) + eta * s.col(5) + zeta * s.col(4) + eta * zeta * s.col(6);
  slopes.col(1) = s.col(1) + xi * s.col(5) + zeta * s.col(3) + xi * zeta * s.col(6);
  slopes.col(2) = s.col(2) + xi * s.col(4) + eta * s.col(3) + xi * eta * s.col(6);
  return slopes;
}

HexahedronGeometry hexahedron_geometry(const Corners& x) {
  const Signs& signs = mode_signs();
  HexahedronGeometry g;
  const Corners centred = x.rowwise() - x.row(0);
  g.frame = frame_of(signs.leftCols<3>().transpose() * centred);
  const Corners local = centred * g.frame.transpose();

  // Two points a direction integrate the cofactors, hence volume and mean gradient, exactly.
  g.least_jacobian = std::numeric_limits<double>::infinity();
  Corners gradient = Corners::Zero();
  const double place = 1 / std::sqrt(3.0);
  for (int p = 0; p < 8; ++p) {
    const Corners slopes =
        shape_slopes(p & 1 ? place : -place, p & 2 ? place : -place, p & 4 ? place : -place);
    const Matrix3d jacobian = slopes.transpose() * local / 8;  // dX_j/dxi_m: row m
    const double volume = jacobian.determinant();
    const Matrix3d inverse = jacobian.inverse();  // dxi_m/dX_j: row j
    g.to_points[p] = inverse.transpose() / 8;
    g.point_volumes[p] = volume;
    g.least_jacobian = std::min(g.least_jacobian, 8 * volume);
    g.volume += volume;
    gradient += volume * (slopes * inverse.transpose()) / 8;
  }
  // Axes of the wrong hand make a proper Jacobian of an inverted one.
  if (g.frame.determinant() < 0) g.least_jacobian = -std::abs(g.least_jacobian);
  g.gradient = gradient / g.volume;
  g.b = signs.transpose() * g.gradient / 8;
  g.moments = signs.rightCols<4>().transpose() * local;
  g.lengths = (signs.leftCols<3>().transpose() * local).diagonal();

  // Coordinates are rounded relative to their distance from the origin.
  const double size = g.lengths.minCoeff();
  const double round_off = 1e-15 * (64 + 16 * x.cwiseAbs().maxCoeff() / size);
  const double b_scale = g.b.cwiseAbs().maxCoeff();
  g.prism = true;
  for (int mode = 0; mode < 7; ++mode) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!prism_keeps(mode, axis) && !(std::abs(g.b(mode, axis)) <= round_off * b_scale)) g.prism = false;
      const bool moment_kept = mode < 3 || (mode == 5 && axis < 2);
      if (!moment_kept && !(std::abs(g.moments(mode - 3, axis)) <= round_off * g.lengths.maxCoeff())) {
        g.prism = false;
      }
    }
  }
  return g;
}

TetrahedronGeometry tetrahedron_geometry(const TetrahedronCorners& x) {
  const Matrix3d edges = x.bottomRows<3>().rowwise() - x.row(0);
  TetrahedronGeometry g;
  g.volume = edges.determinant() / 6;
  g.gradient.bottomRows<3>() = edges.inverse().transpose();
  g.gradient.row(0) = -g.gradient.bottomRows<3>().colwise().sum();
  return g;
}

double hexahedron_volume(const Corners& x) {
  const Corners centred = x.rowwise() - x.row(0);
  const double place = 1 / std::sqrt(3.0);
  double volume = 0;
  for (int p = 0; p < 8; ++p) {
    const Corners slopes =
        shape_slopes(p & 1 ? place : -place, p & 2 ? place : -place, p & 4 ? place : -place);
    volume += (slopes.transpose() * centred).determinant() / 512;
  }
  return volume;
}

}  // namespace cdfp
