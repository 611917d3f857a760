/** @file
 * The cohesive law at single points, and cohesive elements between the caller's nodes.
 */
#ifndef CDFP_C_COHESIVE_H
#define CDFP_C_COHESIVE_H

#include <stdint.h>

#include "cdfp/c/model.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

/* ---- law at single points ---------------------------------------------------------------------------------
 */

/** State of one point of the extrinsic irreversible law; `cdfp_cohesive_law_start` fills it in. */
typedef struct cdfp_cohesive_point {
  double strength;   /**< Pa, effective traction at insertion */
  double reach;      /**< m, effective opening at which no traction is left */
  double largest;    /**< m, largest effective opening so far; broken once it is `reach` */
  double dissipated; /**< J/m2 */
  double opening[3]; /**< m, at the last call */
  double insertion_traction[3];
} cdfp_cohesive_point;

/* Vectors are (count, 3); the laws of cdfp/cohesive.hpp, which says more. */

/** Points that carry `traction` on faces with unit normals `normal`, from the lower to the upper side. */
int32_t cdfp_cohesive_law_start(const cdfp_cohesive_law* law, int64_t count, const double* traction,
                                const double* normal, cdfp_cohesive_point* points);
/** Traction at `opening`; the state goes along the straight segment from the last one. */
int32_t cdfp_cohesive_law_traction(const cdfp_cohesive_law* law, int64_t count, const double* opening,
                                   const double* normal, cdfp_cohesive_point* points, double* traction);
/** Mean traction over the increment: times the increment it is exactly the change of energy. */
int32_t cdfp_cohesive_law_mean_traction(const cdfp_cohesive_law* law, int64_t count, const double* opening,
                                        const double* normal, cdfp_cohesive_point* points, double* traction);
/** J/m2 that each point gives back when it closes: `stored` (count). */
int32_t cdfp_cohesive_law_stored(const cdfp_cohesive_law* law, int64_t count, const double* normal,
                                 const cdfp_cohesive_point* points, double* stored);

/* ---- elements between the caller's nodes ------------------------------------------------------------------
 */

/* For a driver of its own by central differences; the forces are those of a full simulation. In a step: move
 * the nodes, compute all other forces, open facets (`cdfp_cohesive_find_open`; for each of them
 * `cdfp_topology_insert_cohesive`, `cdfp_cohesive_follow`, `cdfp_cohesive_insert`),
 * `cdfp_cohesive_add_force`, and only then change the velocities by step * force / mass. */

/** Elements have consecutive numbers from `first_element` on: the count of bulk elements for those of a
 *  topology, 0 for those of a caller who numbers them alone. */
int32_t cdfp_cohesive_create(int32_t first_element, cdfp_cohesive** cohesive);
int32_t cdfp_cohesive_free(cdfp_cohesive** cohesive);

/** `number`: by which elements and parts name the law, from 0 in the order of these calls. */
int32_t cdfp_cohesive_add_law(cdfp_cohesive* cohesive, const cdfp_cohesive_law* law, int32_t* number);
/** A CDFP_USER law: see `cdfp_model_set_cohesive_callback`. */
int32_t cdfp_cohesive_add_user_law(cdfp_cohesive* cohesive, const cdfp_cohesive_law* law,
                                   cdfp_cohesive_callback callback, int32_t states, void* user_data,
                                   int32_t* number);
/** These nodes do not follow forces where `directions` (3) is not 0: prescribed, or of a rigid body. Their
 *  copies inherit it. */
int32_t cdfp_cohesive_hold(cdfp_cohesive* cohesive, int64_t count, const int32_t* nodes,
                           const int32_t* directions);

/** For `cdfp_cohesive_find_open`: `parts` (elements, the bulk ones), `law_of_part` (part_count, -1: does not
 *  crack), `recovery` (CDFP_ELEMENT_MEAN or CDFP_NODAL), `strength_shares` (elements, may be NULL). All laws
 *  must have been added. `coordinates` of the undeformed mesh. */
int32_t cdfp_cohesive_set_parts(cdfp_cohesive* cohesive, const cdfp_topology* topology, int64_t nodes,
                                const double* coordinates, int64_t elements, const int32_t* parts,
                                int64_t part_count, const int32_t* law_of_part, int32_t recovery,
                                const double* strength_shares);
/** Facets between two elements of one part that reach their strength. `stress` (elements, 6): Cauchy, xx yy
 *  zz xy yz zx. `facets` (count, 3): element, facet, law; `tractions` (count, 3). The views hold until the
 *  next such call. */
int32_t cdfp_cohesive_find_open(cdfp_cohesive* cohesive, const cdfp_topology* topology, int64_t nodes,
                                const double* position, int64_t elements, const double* stress,
                                int32_t threads, const int32_t** facets, const double** tractions,
                                int64_t* count);

/** What `cdfp_topology_insert_cohesive` has reported, after each insertion and before `cdfp_cohesive_insert`:
 *  `new_nodes` (new_node_count, 2), `renumbered` (renumbered_count, 4). */
int32_t cdfp_cohesive_follow(cdfp_cohesive* cohesive, int64_t new_node_count, const int32_t* new_nodes,
                             int64_t renumbered_count, const int32_t* renumbered);
/** The next element. `corners` is 6 or 8: the upper face, then the lower face, as
 *  `cdfp_topology_element_nodes` gives them. `traction` (3): what the upper side exerts on the lower one now;
 *  NULL: nothing, for bonds. */
int32_t cdfp_cohesive_insert(cdfp_cohesive* cohesive, int32_t element, int32_t law, int64_t corners,
                             const int32_t* connectivity, const double* traction, int64_t nodes,
                             const double* position, double time);
/** Adds to `force`, which holds all others of the step. `velocity`: at the half step that led to `position`.
 */
int32_t cdfp_cohesive_add_force(cdfp_cohesive* cohesive, int64_t nodes, const double* position,
                                const double* velocity, const double* mass, double* force, double step,
                                double time, int32_t threads);

int32_t cdfp_cohesive_count(const cdfp_cohesive* cohesive, int64_t* elements, int64_t* broken);
/** Elements whose faces came free in the last `cdfp_cohesive_add_force`, ascending; the view holds until the
 *  next. */
int32_t cdfp_cohesive_broken_now(const cdfp_cohesive* cohesive, const int32_t** elements, int64_t* count);

/** A node pair after the last `cdfp_cohesive_add_force`. */
typedef struct cdfp_cohesive_pair {
  double area;     /**< m2 that it stands for */
  double strength; /**< Pa, effective traction at insertion */
  double reach;    /**< m, effective opening at which no traction is left */
  double largest;  /**< m, largest effective opening so far */
  double damage;   /**< 0 to 1 */
  double stored;   /**< J/m2 */
  double dissipated;
  int32_t upper; /**< node */
  int32_t lower; /**< node; the same while the two sides hold together there */
} cdfp_cohesive_pair;

/** `pairs` has room for 4. */
int32_t cdfp_cohesive_pairs(const cdfp_cohesive* cohesive, int32_t element, cdfp_cohesive_pair* pairs,
                            int64_t* count);

/** J: stored, dissipated by the cohesive tractions, friction heat between closed faces, and what the laws say
 *  that the same openings dissipate. */
int32_t cdfp_cohesive_energies(const cdfp_cohesive* cohesive, double* stored, double* dissipated,
                               double* friction, double* by_law);
/** omega^2 in 1/s2 that users' laws add to the elements' for the stable step 2/omega; the others add none. */
int32_t cdfp_cohesive_stiffness_over_mass(const cdfp_cohesive* cohesive, int64_t nodes, const double* mass,
                                          double* stiffness_over_mass);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
