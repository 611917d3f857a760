/** @file
 * TopS on the caller's connectivity.
 */
#ifndef CDFP_C_TOPOLOGY_H
#define CDFP_C_TOPOLOGY_H

#include <stdint.h>

#include "cdfp/c/common.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

enum {
  CDFP_HEXAHEDRON = 0,
  CDFP_TETRAHEDRON = 1,
  CDFP_WEDGE = 2,
  CDFP_PYRAMID = 3,
  CDFP_COHESIVE_QUADRILATERAL = 4, /**< 8 nodes: upper face 0-1-2-3, lower face 4-5-6-7 */
  CDFP_COHESIVE_TRIANGLE = 5       /**< 6 nodes: upper face 0-1-2, lower face 3-4-5 */
};

/** `types` (elements) may be NULL: all hexahedra. `corners`: how many numbers `connectivity` holds, the
 *  corners of all elements one after the other. */
int32_t cdfp_topology_create(int64_t nodes, int64_t elements, const int32_t* types, int64_t corners,
                             const int32_t* connectivity, cdfp_topology** topology);
int32_t cdfp_topology_free(cdfp_topology** topology);

int32_t cdfp_topology_node_count(const cdfp_topology* topology, int64_t* nodes);
/** `elements`: bulk and cohesive; the bulk elements come first. */
int32_t cdfp_topology_element_count(const cdfp_topology* topology, int64_t* elements, int64_t* bulk);
int32_t cdfp_topology_element_type(const cdfp_topology* topology, int32_t element, int32_t* type);
/** Corners of an element now; the view holds until the next insertion. */
int32_t cdfp_topology_element_nodes(const cdfp_topology* topology, int32_t element, const int32_t** nodes,
                                    int64_t* count);
int32_t cdfp_topology_facet_count(const cdfp_topology* topology, int32_t element, int64_t* facets);
int32_t cdfp_topology_edge_count(const cdfp_topology* topology, int32_t element, int64_t* edges);
/** The facet on the other side: of a cohesive element if one stands between, -1 and -1 at the boundary.
 *  Facet 0 of a cohesive element is its upper face, facet 1 its lower face. */
int32_t cdfp_topology_mate(const cdfp_topology* topology, int32_t element, int32_t facet,
                           int32_t* mate_element, int32_t* mate_facet);
/** `nodes` has room for 4; outward order. */
int32_t cdfp_topology_facet_nodes(const cdfp_topology* topology, int32_t element, int32_t facet,
                                  int32_t* nodes, int64_t* count);
/** `nodes` has room for 2. Local facets and edges are numbered as in cdfp/topology.hpp. */
int32_t cdfp_topology_edge_nodes(const cdfp_topology* topology, int32_t element, int32_t edge,
                                 int32_t* nodes);
/** Pairs of element and local edge around an edge, in cyclic order. `uses` has room for `capacity` pairs;
 *  `count` is that of all pairs, those included for which there was no room. */
int32_t cdfp_topology_elements_around_edge(const cdfp_topology* topology, int32_t element, int32_t edge,
                                           int64_t capacity, int32_t* uses, int64_t* count);
/** Pairs of element and corner around a node, ascending; room and count as above. */
int32_t cdfp_topology_elements_around_node(const cdfp_topology* topology, int32_t node, int64_t capacity,
                                           int32_t* uses, int64_t* count);

/** Inserts a cohesive element at an inner facet between two bulk elements. `new_nodes`: pairs of new node
 *  and the node that it copies, in the order of their numbers. `renumbered`: element, corner, old node, new
 *  node for every corner that changed. Both views hold until the next insertion. */
int32_t cdfp_topology_insert_cohesive(cdfp_topology* topology, int32_t element, int32_t facet,
                                      int32_t* cohesive_element, const int32_t** new_nodes,
                                      int64_t* new_node_count, const int32_t** renumbered,
                                      int64_t* renumbered_count);
/** The first relation that does not hold; length 0 if all do. */
int32_t cdfp_topology_check(const cdfp_topology* topology, char* text, int64_t capacity, int64_t* length);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
