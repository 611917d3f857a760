/// Triangles paired to quadrilaterals.
#pragma once

#include <vector>

#include "mesh/quad_mesh.hpp"
#include "mesh/triangulation.hpp"

namespace cdfp {

/// Well-shaped pairs first; the triangles that no pair takes are few. Every pair is cut into four
/// quadrilaterals and every left triangle into three, so that all are quadrilaterals with shared sides whole.
QuadMesh paired_and_cut(const std::vector<PlanePoint>& points, const Triangulation& triangulation);

}  // namespace cdfp
