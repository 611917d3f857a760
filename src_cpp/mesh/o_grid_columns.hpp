/// Rings of quadrilaterals around the origin that turn into the sides of the unit square.
#pragma once

#include "mesh/quad_mesh.hpp"

namespace cdfp {

/// About `count` quadrilaterals. Where a ring's quadrilaterals get too wide the next one has twice as many.
/// Smoothed at the end, so that they are well shaped towards the square's corner too.
QuadMesh o_grid_columns(Index count);

}  // namespace cdfp
