/** @file
 * Contact search, and contact and friction forces, on the caller's arrays.
 */
#ifndef CDFP_C_CONTACT_H
#define CDFP_C_CONTACT_H

#include <stdint.h>

#include "cdfp/c/model.h"
#include "cdfp/c/topology.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

/* ---- search -----------------------------------------------------------------------------------------------
 */

/** `cell_factor` and `buffer_factor`: cell and buffer over the mean segment length (1.0 and 0.4 are usual).
 *  `adaptive`: not 0 if `cdfp_contact_search_adaptive` will be called. */
int32_t cdfp_contact_search_create(double cell_factor, double buffer_factor, int32_t adaptive,
                                   cdfp_contact_search** search);
int32_t cdfp_contact_search_free(cdfp_contact_search** search);

/** All candidate pairs. `contact_nodes` (contact_node_count); `segments` (segment_count, 4): corners, -1 last
 *  in a triangle; `edges` (edge_count, 2); `groups` (nodes): entities of one group >= 0 do not pair; may be
 *  NULL. */
int32_t cdfp_contact_search_regular(cdfp_contact_search* search, int64_t nodes, const double* position,
                                    int64_t contact_node_count, const int32_t* contact_nodes,
                                    int64_t segment_count, const int32_t* segments, int64_t edge_count,
                                    const int32_t* edges, const int32_t* groups, int32_t threads);
/** Adds the pairs of what was appended to the arrays since the last search, and of old segments and edges
 * that name other nodes at the same place. */
int32_t cdfp_contact_search_adaptive(cdfp_contact_search* search, int64_t nodes, const double* position,
                                     int64_t contact_node_count, const int32_t* contact_nodes,
                                     int64_t segment_count, const int32_t* segments, int64_t edge_count,
                                     const int32_t* edges, const int32_t* groups,
                                     int64_t renamed_segment_count, const int32_t* renamed_segments,
                                     int64_t renamed_edge_count, const int32_t* renamed_edges);
/** Once a step: whether entities may have moved so far that a regular search is due. */
int32_t cdfp_contact_search_due(cdfp_contact_search* search, double largest_speed, double step, int32_t* due);
/** m: cell length, buffer, bound on the relative movement since the last regular search. */
int32_t cdfp_contact_search_lengths(const cdfp_contact_search* search, double* cell, double* buffer,
                                    double* travel);
/** Pairs as compressed rows: the partners of row r stand in [start[r], start[r + 1]), ascending. Rows are
 *  places in `contact_nodes`, partners segments. The views hold until the next call with this handle. */
int32_t cdfp_contact_search_node_segments(cdfp_contact_search* search, const int32_t** start,
                                          const int32_t** partners, int64_t* rows);
/** The same for edges: the row is the smaller edge of each pair. */
int32_t cdfp_contact_search_edge_edges(cdfp_contact_search* search, const int32_t** start,
                                       const int32_t** partners, int64_t* rows);

/** The point of a face closest to `point` (3). `corners` is 3 or 4, `coordinates` (corners, 3) in outward
 *  order. `shape` has room for 4: shape functions of the corners there; `normal` (3): unit, outward; `gap`:
 *  negative behind the face; `outside`: how far past the face's border. */
int32_t cdfp_project_on_face(const double* point, int64_t corners, const double* coordinates, double* shape,
                             double* normal, double* gap, double* outside);

/* ---- forces -----------------------------------------------------------------------------------------------
 */

/* In a step, after all forces but the cohesive ones: `cdfp_contact_due`, the search that it names,
 * `cdfp_contact_local_search`, `cdfp_contact_add_force`. Arrays are those of all nodes of the mesh. */

/** What a model starts with. */
int32_t cdfp_contact_settings_default(cdfp_contact_settings* settings);
int32_t cdfp_contact_create(const cdfp_contact_settings* settings, cdfp_contact** contact);
int32_t cdfp_contact_free(cdfp_contact** contact);

/** For messages. */
int32_t cdfp_contact_name_part(cdfp_contact* contact, int32_t part, const char* name);
/** Segments: `segments` (count, 4) corners in outward order, -1 last in a triangle; `elements` that own them;
 *  `parts`; `bulk_modulus` in Pa; `area` in m2; `volume` of the element in m3. */
int32_t cdfp_contact_add_segments(cdfp_contact* contact, int64_t count, const int32_t* segments,
                                  const int32_t* elements, const int32_t* parts, const double* bulk_modulus,
                                  const double* area, const double* volume);
/** The same for facets (count, 2) of a topology, at the start or when the faces of a crack came free: mates
 * of the broken cohesive elements' facets. `coordinates` of the undeformed mesh, for nodes as they are
 * numbered now; `parts` of the bulk elements; `bulk_modulus` (part_count). */
int32_t cdfp_contact_add_facets(cdfp_contact* contact, const cdfp_topology* topology, int64_t nodes,
                                const double* coordinates, int64_t count, const int32_t* facets,
                                int64_t elements, const int32_t* parts, int64_t part_count,
                                const double* bulk_modulus);
/** What `cdfp_topology_insert_cohesive` has reported, after each insertion: renames corners of segments, and
 *  shares the springs between split nodes. */
int32_t cdfp_contact_follow(cdfp_contact* contact, int64_t new_node_count, const int32_t* new_nodes,
                            int64_t renumbered_count, const int32_t* renumbered);

/** Elements that are no more: their segments and edges leave, and what touches them is let go. Numbers of
 *  segments stay. The faces of neighbours that are free now come by `cdfp_contact_add_facets`. */
int32_t cdfp_contact_remove_elements(cdfp_contact* contact, int64_t count, const int32_t* elements);

enum {
  CDFP_SEARCH_NONE = 0,
  CDFP_SEARCH_REGULAR = 1, /**< call `cdfp_contact_regular_search` */
  CDFP_SEARCH_ADAPTIVE = 2 /**< call `cdfp_contact_adaptive_search` */
};

/** Once a step. `velocity` that led to the positions. */
int32_t cdfp_contact_due(cdfp_contact* contact, int64_t nodes, const double* velocity, double step,
                         int32_t threads, int32_t* search);
/** `groups` (nodes): rigid body of each node or -1; may be NULL. */
int32_t cdfp_contact_regular_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                    const int32_t* groups, int32_t threads);
int32_t cdfp_contact_adaptive_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                     const int32_t* groups);
int32_t cdfp_contact_local_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                  int32_t threads);
/** Adds to `force`. */
int32_t cdfp_contact_add_force(cdfp_contact* contact, int64_t nodes, const double* velocity,
                               const double* mass, double* force, double step, int32_t threads);

/** Contact nodes, segments (removed ones included), edges, and pairs that touch. */
int32_t cdfp_contact_counts(const cdfp_contact* contact, int64_t* nodes, int64_t* segments, int64_t* edges,
                            int64_t* touching);
/** The contact nodes, which are the rows of `cdfp_contact_node_segments`; holds until segments or splits are
 *  new. */
int32_t cdfp_contact_nodes(const cdfp_contact* contact, const int32_t** nodes, int64_t* count);
/** Candidate pairs as compressed rows: see `cdfp_contact_search_node_segments`. */
int32_t cdfp_contact_node_segments(cdfp_contact* contact, const int32_t** start, const int32_t** partners,
                                   int64_t* rows);
int32_t cdfp_contact_edge_edges(cdfp_contact* contact, const int32_t** start, const int32_t** partners,
                                int64_t* rows);

/** A pair that touches: `force` acts on the first `first_count` nodes by their weights, its opposite on the
 *  others by theirs. */
typedef struct cdfp_touch {
  double weights[5]; /**< positive on the first side, negative on the other; each side sums to 1 */
  double normal[3];  /**< out of the other side */
  double gap;        /**< m, negative */
  double force[3];   /**< N */
  int32_t nodes[5];
  int32_t first_count; /**< 1: node on face; 2: edge on edge */
  int32_t count;       /**< of nodes */
  int32_t parts[2];
} cdfp_touch;

/** The view holds until the next call with this handle. */
int32_t cdfp_contact_touches(cdfp_contact* contact, const cdfp_touch** touches, int64_t* count);

/** Two parts that have touched, in ascending order, or one that touched itself. */
typedef struct cdfp_body_pair {
  double force[3];      /**< N, on the first by the second at the last `cdfp_contact_add_force` */
  double stored;        /**< J, in springs then */
  double friction_heat; /**< J, so far */
  double peak_force;    /**< N, so far */
  double deepest;       /**< m, so far */
  int32_t parts[2];
} cdfp_body_pair;

/** In the order in which they first touched; the view holds until the next call with this handle. */
int32_t cdfp_contact_body_pairs(cdfp_contact* contact, const cdfp_body_pair** pairs, int64_t* count);
/** J stored in springs, J of friction heat so far, m of the deepest penetration so far. */
int32_t cdfp_contact_energies(const cdfp_contact* contact, double* stored, double* friction_heat,
                              double* deepest);
/** omega^2 in 1/s2 that the contact springs add to the elements' for the stable step 2/omega. */
int32_t cdfp_contact_stiffness_over_mass(const cdfp_contact* contact, double* stiffness_over_mass);
int32_t cdfp_contact_warning_count(const cdfp_contact* contact, int64_t* count);
int32_t cdfp_contact_warning(const cdfp_contact* contact, int64_t warning, char* text, int64_t capacity,
                             int64_t* length);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
