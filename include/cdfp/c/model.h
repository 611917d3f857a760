/** @file
 * What to simulate.
 */
#ifndef CDFP_C_MODEL_H
#define CDFP_C_MODEL_H

#include <stdint.h>

#include "cdfp/c/common.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

enum {
  CDFP_ONE_POINT = 0, /**< mean gradient, one point, assumed-strain hourglass control */
  CDFP_FULL = 1       /**< 2 x 2 x 2 points, mean volumetric strain (does not lock at nu 0.49) */
};

/** An empty model. Names tie its entries together; `cdfp_simulation_create` resolves and checks them, so the
 *  entries may come in any order. All arrays and strings are copied. */
int32_t cdfp_model_create(cdfp_model** model);
int32_t cdfp_model_free(cdfp_model** model);

int32_t cdfp_model_set_title(cdfp_model* model, const char* title);

/** `hexahedra`: corners in the order of VTK (bottom 0-1-2-3, top 4-5-6-7). `parts`: part of each element, by
 *  the order of `cdfp_model_add_part`. `layers` may be NULL. */
int32_t cdfp_model_set_mesh(cdfp_model* model, int64_t nodes, const double* coordinates, int64_t elements,
                            const int32_t* hexahedra, const int32_t* parts, const int32_t* layers);
/** The same for any bulk elements: `types` (elements) of CDFP_HEXAHEDRON and the like; `corners`: how many
 *  numbers `connectivity` holds, the corners of all elements one after the other. A simulation takes
 *  hexahedra, tetrahedra and wedges. */
int32_t cdfp_model_set_mixed_mesh(cdfp_model* model, int64_t nodes, const double* coordinates,
                                  int64_t elements, const int32_t* types, int64_t corners,
                                  const int32_t* connectivity, const int32_t* parts, const int32_t* layers);
int32_t cdfp_model_add_node_set(cdfp_model* model, const char* name, int64_t count, const int32_t* nodes);
int32_t cdfp_model_add_facet_set(cdfp_model* model, const char* name, int64_t count, const int32_t* facets);

int32_t cdfp_model_add_elastic_material(cdfp_model* model, const char* name, double density,
                                        double youngs_modulus, double poissons_ratio);
/** E = static_modulus + rate_modulus * (rate / 1 s^-1)^rate_exponent, rate smoothed over `smoothing_time`. */
int32_t cdfp_model_add_rate_dependent_material(cdfp_model* model, const char* name, double density,
                                               double poissons_ratio, double static_modulus,
                                               double rate_modulus, double rate_exponent,
                                               double smoothing_time);
int32_t cdfp_model_add_rigid_material(cdfp_model* model, const char* name, double density,
                                      double youngs_modulus, double poissons_ratio);

enum {
  CDFP_LINEAR = 0,        /**< extrinsic, irreversible, path-dependent (Snozzi and Molinari 2013) */
  CDFP_CAMACHO_ORTIZ = 1, /**< extrinsic, from a potential while it loads: mode_ratio 1 */
  CDFP_BILINEAR = 2,      /**< intrinsic, for bonds */
  CDFP_USER = 3           /**< by `cdfp_model_set_cohesive_callback` */
};

/** Cohesive law: fill it by `cdfp_cohesive_law_default`, then give strength and fracture energy. */
typedef struct cdfp_cohesive_law {
  double strength;          /**< Pa */
  double fracture_energy;   /**< G_I, J/m2 */
  double mode_ratio;        /**< G_II / G_I */
  double shear_ratio;       /**< peak shear over strength */
  double friction;          /**< Coulomb coefficient between closed faces */
  double friction_exponent; /**< of the growth of friction with damage */
  double internal_friction; /**< share of a pressure that holds the shear on a facet back */
  double stiffness;        /**< Pa/m: of a bilinear law before its strength; steepest slope of a user's law */
  double weibull_modulus;  /**< of the scatter of the strength over facets; 0: none */
  double weibull_area;     /**< m2 that `strength` belongs to; 0: each facet's own area */
  double rate_sensitivity; /**< c of the factor 1 + c ln(1 + opening rate / reference_rate); 0: none */
  double reference_rate;   /**< m/s */
  int64_t seed;            /**< of the scatter */
  int32_t kind;            /**< CDFP_LINEAR and the like */
} cdfp_cohesive_law;

int32_t cdfp_cohesive_law_default(cdfp_cohesive_law* law);
int32_t cdfp_model_add_cohesive_law(cdfp_model* model, const char* name, const cdfp_cohesive_law* law);

/** What a user's law is asked for: all its points at a step. Vectors are (count, 3). */
typedef struct cdfp_cohesive_points {
  int64_t count;
  double time;                      /**< s */
  double step;                      /**< s */
  const double* opening;            /**< m, upper side minus lower side */
  const double* normal;             /**< from lower to upper */
  const double* insertion_traction; /**< Pa, what the law must give at no opening; 0 in a bond */
  double* state;                    /**< (count, states), 0 at insertion; the law's own */
  double* traction;                 /**< out: Pa, that the upper side exerts on the lower one */
  double* stored;                   /**< out: J/m2 that closing gives back */
  double* damage;                   /**< out: 0 to 1; broken for good at 1 */
} cdfp_cohesive_points;

typedef void (*cdfp_cohesive_callback)(const cdfp_cohesive_points* points, void* user_data);

/** The traction of the CDFP_USER law of that name. It keeps `states` numbers at each point. Simulations of
 *  the model call it, once a step; it must not call cdfp with their handles, and `user_data` must live as
 *  long as they do. */
int32_t cdfp_model_set_cohesive_callback(cdfp_model* model, const char* cohesive_law,
                                         cdfp_cohesive_callback callback, int32_t states, void* user_data);

/** Cohesive elements from the start between all elements of two parts that share nodes, or on the facets of a
 *  set, by a CDFP_BILINEAR or CDFP_USER law. */
int32_t cdfp_model_add_bond(cdfp_model* model, const char* first_part, const char* second_part,
                            const char* cohesive_law);
int32_t cdfp_model_add_bonded_facets(cdfp_model* model, const char* facet_set, const char* cohesive_law);

/** How the traction on a facet follows from the stresses of elements. */
enum {
  CDFP_ELEMENT_MEAN = 0, /**< mean of the facet's two elements */
  CDFP_NODAL = 1         /**< mean over the elements of a part around each corner, then over the corners */
};
int32_t cdfp_model_set_stress_recovery(cdfp_model* model, int32_t recovery);

/** `shares` (count, one an element): share of its law's strength that an element has; a facet has the mean of
 *  its two elements. A count of 0: all have all of it. */
int32_t cdfp_model_set_strength_shares(cdfp_model* model, int64_t count, const double* shares);

/** The first part added is number 0 of the mesh's `parts`. `cohesive_law` may be NULL or empty: does not
 *  crack. `hourglass`: share of the assumed-strain stiffness (CDFP_ONE_POINT). */
int32_t cdfp_model_add_part(cdfp_model* model, const char* name, const char* material, int32_t formulation,
                            double hourglass, const char* cohesive_law);

/** All elements of a part move as one. `inertia` (9, kg m2 about the centre of mass) may be NULL: from the
 *  mesh; the velocities (3) and the flags (3, not 0: held) may be NULL: zero. */
int32_t cdfp_model_add_rigid_body(cdfp_model* model, const char* part, double mass, const double* inertia,
                                  const double* velocity, const double* angular_velocity,
                                  const int32_t* translation_fixed, const int32_t* rotation_fixed);

int32_t cdfp_model_add_symmetry_plane(cdfp_model* model, int32_t axis, double coordinate);

/** `directions` (3): not 0 where the velocity is prescribed. `times` (count) ascend; NULL with a count of 1:
 *  `values[0]` for good. */
int32_t cdfp_model_add_prescribed_velocity(cdfp_model* model, const char* node_set, const int32_t* directions,
                                           int64_t count, const double* times, const double* values);
/** velocity + gradient * position. `velocity` (3), m/s; `gradient` (9, row by row), 1/s, may be NULL: none.
 */
int32_t cdfp_model_add_initial_velocity(cdfp_model* model, const char* part, const double* velocity,
                                        const double* gradient);
int32_t cdfp_model_set_gravity(cdfp_model* model, const double* gravity);

/** What a load is given at a step. Vectors are (nodes, 3); nodes that cracks made are among them. */
typedef struct cdfp_nodal_load {
  int64_t nodes;
  double time;            /**< s */
  const double* position; /**< m */
  const double* velocity; /**< m/s, at the half step that led to `position` */
  double* force;          /**< N: of elements and gravity so far; the load is what is added */
} cdfp_nodal_load;

typedef void (*cdfp_load_callback)(const cdfp_nodal_load* load, void* user_data);

/** Forces of the caller's own, once a step; their work is external work. The callback must not call cdfp with
 *  the simulation's handle, and `user_data` must live as long as the model's simulations do. */
int32_t cdfp_model_set_load_callback(cdfp_model* model, cdfp_load_callback callback, void* user_data);

/** What `cdfp_model_get_contact` fills and `cdfp_model_set_contact` takes: get, change what differs, set. */
typedef struct cdfp_contact_settings {
  double cell_factor;         /**< w1: cell length over mean segment length */
  double buffer_factor;       /**< w2: buffer over mean segment length */
  double penalty_factor;      /**< zeta in k = zeta K A^2 / V */
  double friction;            /**< Coulomb coefficient */
  double depth_limit;         /**< deepest penetration that counts, over the segment's element height */
  double penetration_warning; /**< share of that height from which a warning names the pair */
  int32_t edge_edge;          /**< 0: node-face pairs only */
  int32_t adaptive;           /**< 0: a regular search whenever contact entities are new */
} cdfp_contact_settings;

/** A facet set that may touch others and itself; without any the scene has no contact. */
int32_t cdfp_model_add_contact_surface(cdfp_model* model, const char* facet_set);
int32_t cdfp_model_get_contact(const cdfp_model* model, cdfp_contact_settings* settings);
int32_t cdfp_model_set_contact(cdfp_model* model, const cdfp_contact_settings* settings);

int32_t cdfp_model_set_end_time(cdfp_model* model, double end);
/** 0: automatic, a share of the stable step that `cdfp_model_set_step_factor` sets. */
int32_t cdfp_model_set_fixed_step(cdfp_model* model, double fixed_step);
int32_t cdfp_model_set_step_factor(cdfp_model* model, double step_factor);
/** Steps between rows of the history. */
int32_t cdfp_model_set_history_interval(cdfp_model* model, int64_t history_interval);
/** 0: as many as the machine has. Results are the same bits for any number. */
int32_t cdfp_model_set_threads(cdfp_model* model, int32_t threads);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
