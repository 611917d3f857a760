/// Quarter of a cylinder with a hemispherical head, pointing down.
#pragma once

#include "cdfp/mesh.hpp"

namespace cdfp {

struct ImpactorShape {
  double radius = 0;
  double shaft = 0;       ///< length of the cylinder
  double tip = 0;         ///< z of the lowest point
  double refinement = 1;  ///< scales the divisions; 1 gives 2,198 elements and 322 facets that may touch
};

/// Head and shaft need not match where they meet: they move as one rigid body. Returns the facets that may
/// touch: the spherical and the cylindrical surface.
std::vector<FacetUse> add_impactor(const ImpactorShape& shape, Index part, Mesh& mesh);

}  // namespace cdfp
