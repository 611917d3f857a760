/// Plates of four layers for timing.
#pragma once

#include "cdfp/model.hpp"

namespace bench {

enum class Shape { extruded, distorted, tetrahedra };

/// `columns` squared columns of four elements, or of 24 tetrahedra; one part.
cdfp::Model plate(Shape shape, cdfp::Formulation formulation, bool rate_dependent, cdfp::Index columns);

}  // namespace bench
