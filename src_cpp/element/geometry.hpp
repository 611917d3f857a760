/// Constants of an undeformed hexahedron in its own frame.
#pragma once

#include <Eigen/Dense>
#include <array>

namespace cdfp {

using Corners = Eigen::Matrix<double, 8, 3>;  ///< one corner a row

struct HexahedronGeometry {
  double volume = 0;
  double least_jacobian = 0;                 ///< m3: least of 8 det(dX/dxi) at the eight points
  Eigen::Matrix3d frame;                     ///< rows: the element's axes
  Corners gradient;                          ///< mean gradient of each corner's shape function, in the frame
  Eigen::Matrix<double, 7, 3> b;             ///< the same in modes (modes.hpp): gradient = signs * b
  Eigen::Matrix<double, 4, 3> moments;       ///< sums of the reference corners over the hourglass modes
  Eigen::Vector3d lengths;                   ///< four times the mean edge along each axis
  std::array<Eigen::Matrix3d, 8> to_points;  ///< d(xi_m)/dX_j / 8 at each point of 2 x 2 x 2
  std::array<double, 8> point_volumes;
  bool prism = false;  ///< extruded along zeta to round-off: what Prism leaves out is zero
};

using TetrahedronCorners = Eigen::Matrix<double, 4, 3>;

struct TetrahedronGeometry {
  double volume = 0;
  TetrahedronCorners gradient;  ///< of each corner's shape function
};

/// Not inverted where `volume` is positive.
TetrahedronGeometry tetrahedron_geometry(const TetrahedronCorners& x);

/// Signs of the seven modes at the corners.
const Eigen::Matrix<double, 8, 7>& mode_signs();

/// 8 dN/dxi of all corners at (xi, eta, zeta).
Corners shape_slopes(double xi, double eta, double zeta);

/// Without regard to whether the element is inverted: see `least_jacobian` and `volume`.
HexahedronGeometry hexahedron_geometry(const Corners& x);

/// Of a hexahedron with trilinear faces.
double hexahedron_volume(const Corners& x);

}  // namespace cdfp
