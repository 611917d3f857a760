/// Plates of four layers for timing.
#pragma once

#include "cdfp/model.hpp"

namespace bench {

enum class Shape { extruded, distorted, tetrahedra, wedges };

/// `columns` squared columns of four elements, of 24 tetrahedra or of eight wedges; one part.
cdfp::Model plate(Shape shape, cdfp::Formulation formulation, bool rate_dependent, cdfp::Index columns);

}  // namespace bench
