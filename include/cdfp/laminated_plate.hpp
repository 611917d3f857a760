/// The laminated-glass case as a mesh: quarter model of glass - PVB - glass on rubber with a rigid impactor.
#pragma once

#include <string>

#include "cdfp/mesh.hpp"

namespace cdfp {

enum class PlateColumns {
  regular,   ///< square grid
  graded,    ///< grid that gets finer towards the impact point
  o_grid,    ///< rings around the impact point, turning into the square rim
  irregular  ///< unstructured quadrilaterals
};

/// Assumed geometry (the paper's figure is lost): see examples/laminated_glass. Lengths in m, z upwards from
/// the plate's bottom face, impact point at x = y = 0 on its top face.
struct LaminatedPlate {
  double half_width = 75e-3;
  double lower_glass = 2.5e-3, pvb = 0.76e-3, upper_glass = 2.5e-3, support = 5e-3;
  Index lower_layers = 5, pvb_layers = 1, upper_layers = 3, support_layers = 1;
  Index columns = 67;  ///< along one side; other layouts aim at its square as the count a layer
  PlateColumns layout = PlateColumns::irregular;
  double impactor_radius = 10e-3;
  double impactor_shaft = 7.73e-3;   ///< length of the cylinder above the head; steel of 35.5 g in all
  double impactor_gap = 0;           ///< between the impactor's lowest point and the plate
  double impactor_refinement = 1.0;  ///< scales the impactor's divisions (1: 2,198 elements, 322 segments)
};

/// Parts: "lower_glass", "pvb", "upper_glass", "support", "impactor". Node sets: "support_bottom",
/// "symmetry_x", "symmetry_y". Facet sets: "lower_glass_faces" and "upper_glass_faces" (both faces and the
/// outer rim, bonded ones included), "support_top", "impactor_head" (what may touch). Plate and support do
/// not share nodes.
Mesh laminated_plate_mesh(const LaminatedPlate& plate);

}  // namespace cdfp
