/// Constants of an undeformed wedge in its own frame (see wedge.hpp), and what they make of its stable step.
#pragma once

#include <Eigen/Dense>
#include <span>

#include "element/part_plan.hpp"
#include "element/step_bound.hpp"

namespace cdfp {

using WedgeCorners = Eigen::Matrix<double, 6, 3>;  ///< one corner a row

struct WedgeGeometry {
  double volume = 0;
  double least_jacobian = 0;            ///< m3: least of 2 det(dX/d(r, s, zeta)) over both points
  Eigen::Matrix3d frame;                ///< rows: the element's axes
  WedgeCorners gradient;                ///< mean gradient of each corner's shape function, in the frame
  Eigen::Matrix<double, 5, 3> b;        ///< the same in the modes of wedge.hpp
  Eigen::Matrix<double, 2, 3> moments;  ///< modes 3 and 4 of the corners
  Eigen::Matrix2d slopes;               ///< P_k
  double twist = 0;                     ///< k_t over the shear modulus, m3
  double warp = 0;                      ///< k_z over Young's modulus, m-1
};

/// Without regard to whether the element is inverted: see `least_jacobian` and `volume`.
WedgeGeometry wedge_geometry(const WedgeCorners& x);

/// k_t and k_z, N m and N/m3.
struct WedgeStiffness {
  double twist = 0, warp = 0;
  double poisson = 0;  ///< nu / (1 - nu)
};
WedgeStiffness wedge_stiffness(const WedgeGeometry& geometry, const PartPlan& plan);

StepTerms wedge_terms(const WedgeGeometry& geometry, const PartConstants& part,
                      const WedgeStiffness& stiffness);
/// Without slack, by solving the eigenproblem of the element.
double wedge_exact(const WedgeGeometry& geometry, const PartConstants& part, const WedgeStiffness& stiffness);

/// Of a wedge with bilinear sides.
double wedge_volume(const WedgeCorners& x);

}  // namespace cdfp
