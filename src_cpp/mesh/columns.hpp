/// Layouts of the plate's columns on the unit square, impact point at the origin.
#pragma once

#include "cdfp/laminated_plate.hpp"
#include "mesh/quad_mesh.hpp"

namespace cdfp {

/// About columns^2 quadrilaterals; points on the rim lie on it exactly.
QuadMesh plate_columns(PlateColumns layout, Index columns);

}  // namespace cdfp
