/// Points of a quadrilateral mesh moved to where its quadrilaterals are best shaped.
#pragma once

#include "mesh/quad_mesh.hpp"

namespace cdfp {

/// On the unit square: points on its rim slide along it, its corners stay. The quadrilaterals tend to squares
/// of one size.
void smooth(QuadMesh& mesh);

}  // namespace cdfp
