/// Unstructured quadrilaterals on the unit square: no direction is preferred.
#pragma once

#include "mesh/quad_mesh.hpp"

namespace cdfp {

/// About `count` quadrilaterals of one size; the same for the same count.
QuadMesh irregular_columns(Index count);

}  // namespace cdfp
