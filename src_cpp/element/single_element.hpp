/// One element at a time, with the formulas of the blocks.
#pragma once

#include <span>

#include "core/vec3.hpp"
#include "element/element_blocks.hpp"

namespace cdfp {

/// Mean Cauchy stress at the nodes' `position`, Pa.
Mat3 element_stress(const BlockGroup& group, std::size_t slot, std::span<const double> position);

/// Minus the internal force at the corners, with the material state as it is, N.
void element_force(const BlockGroup& group, std::size_t slot, std::span<const double> position,
                   std::span<double> force);

/// J/m3: energy in hourglass modes over the undeformed volume.
double hourglass_density(const BlockGroup& group, std::size_t slot, std::span<const double> position);

/// kg: what the element gives to each of its corners.
double corner_mass(const BlockGroup& group, std::size_t slot);

/// m3; negative where it is inside out.
double element_volume(const BlockGroup& group, std::size_t slot, std::span<const double> position);

}  // namespace cdfp
