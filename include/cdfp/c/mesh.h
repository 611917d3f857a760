/** @file
 * Meshes that cdfp makes.
 */
#ifndef CDFP_C_MESH_H
#define CDFP_C_MESH_H

#include <stdint.h>

#include "cdfp/c/common.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

enum {
  CDFP_REGULAR = 0,  /**< square grid */
  CDFP_GRADED = 1,   /**< grid that gets finer towards the impact point */
  CDFP_O_GRID = 2,   /**< rings around the impact point, turning into the square rim */
  CDFP_IRREGULAR = 3 /**< unstructured quadrilaterals */
};

/** Quarter model of a laminated plate on rubber under a rigid impactor. Lengths in m, z upwards, impact point
 *  at x = y = 0 on the top face. */
typedef struct cdfp_laminated_plate {
  double half_width;
  double lower_glass; /**< thicknesses */
  double pvb;
  double upper_glass;
  double support;
  int32_t lower_layers;
  int32_t pvb_layers;
  int32_t upper_layers;
  int32_t support_layers;
  int32_t columns; /**< along one side */
  int32_t layout;  /**< CDFP_REGULAR, CDFP_GRADED, CDFP_O_GRID or CDFP_IRREGULAR */
  double impactor_radius;
  double impactor_shaft; /**< length of the cylinder above the head */
  double impactor_gap;
  double impactor_refinement;
} cdfp_laminated_plate;

/** The geometry of examples/laminated_glass at the paper's full size. */
int32_t cdfp_laminated_plate_default(cdfp_laminated_plate* plate);

/** Parts: "lower_glass", "pvb", "upper_glass", "support", "impactor". Node sets: "support_bottom",
 *  "symmetry_x", "symmetry_y". Facet sets: "lower_glass_faces", "upper_glass_faces", "support_top",
 *  "impactor_head". */
int32_t cdfp_mesh_create_laminated_plate(const cdfp_laminated_plate* plate, cdfp_mesh** mesh);
int32_t cdfp_mesh_free(cdfp_mesh** mesh);

/* Views of a mesh hold until it is freed. */
int32_t cdfp_mesh_coordinates(const cdfp_mesh* mesh, const double** coordinates, int64_t* nodes);
int32_t cdfp_mesh_hexahedra(const cdfp_mesh* mesh, const int32_t** hexahedra, int64_t* elements);
int32_t cdfp_mesh_parts(const cdfp_mesh* mesh, const int32_t** parts, int64_t* elements);
/** Layer through the thickness from the bottom of its part. */
int32_t cdfp_mesh_layers(const cdfp_mesh* mesh, const int32_t** layers, int64_t* elements);
int32_t cdfp_mesh_part_count(const cdfp_mesh* mesh, int64_t* count);
int32_t cdfp_mesh_part_name(const cdfp_mesh* mesh, int64_t part, char* text, int64_t capacity,
                            int64_t* length);
int32_t cdfp_mesh_node_set(const cdfp_mesh* mesh, const char* name, const int32_t** nodes, int64_t* count);
int32_t cdfp_mesh_facet_set(const cdfp_mesh* mesh, const char* name, const int32_t** facets, int64_t* count);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
