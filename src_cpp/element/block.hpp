/// The data that a kernel works on: a block of elements of one part, `[row][component][lane]`, each row as
/// wide as the widest pack.
#pragma once

#include <cstdint>

#include "material/constants.hpp"

namespace cdfp {

inline constexpr int kRows = 8;
inline constexpr int kBlock = kRows * kLanes;  ///< elements

/// What all elements of a part share.
struct PartConstants {
  MaterialConstants material;

  // Hourglass stiffness relative to that of bending (see one_point.hpp).
  double bending_coupling = 0, shear_share = 0, warping_share = 0;

  double density = 0;                ///< kg/m3
  double critical_norm_squared = 0;  ///< Pa2, of the second Piola-Kirchhoff stress; infinite: never critical
};

struct BlockInput {
  const Lanes* constants;
  const std::int32_t* offsets;  ///< [row][corner][lane], 3 * node; idle lanes repeat the last element
  const Lanes* state;
  int count;  ///< elements, the first of the block's lanes
  const PartConstants* part;
  const double* position;
};

/// The points of one integration point of a block's elements, for a law of the user's: component after
/// component, each of `BlockInput::count` points (see cdfp/material.h).
struct UserPointArrays {
  const double* stretch_old;
  double *stretch, *gradient, *rotation, *strain_increment, *spin_increment;
  double* density;  ///< kg/m3; not positive or not a number where the point is inverted or lost
  const double *stress, *dissipated, *stiffness;
};

struct BlockEnergy {
  double strain = 0, hourglass = 0, dissipated = 0;
};

}  // namespace cdfp
