/// One element at a time, with the formulas of the blocks.
#pragma once

#include <span>

#include "core/vec3.hpp"
#include "element/element_blocks.hpp"

namespace cdfp {

/// Mean Cauchy stress, Pa.
Mat3 element_stress(const BlockGroup& group, std::size_t slot, const double (&x)[8][3]);

/// Minus the internal force at the corners, with the material state as it is, N.
void element_force(const BlockGroup& group, std::size_t slot, const double (&x)[8][3],
                   std::span<double> force);

}  // namespace cdfp
