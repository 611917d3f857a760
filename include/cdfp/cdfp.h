/** @file
 * The C interface of cdfp, also what the Fortran module `cdfp` stands on: one header a service, in cdfp/c.
 *
 * Rules of the door
 * - Every function returns a status: 0 (CDFP_OK) or one of the codes in cdfp/c/common.h; `cdfp_last_error`
 * has the text. Nothing prints, aborts or throws. When a call fails its results are not set, unless said
 * otherwise.
 * - Handles are made by `..._create` and given back by `..._free`, which nulls the caller's handle and may be
 *   called twice. A handle that was freed elsewhere is recognised and refused, never followed.
 * - Any number of threads may use different handles at once, or ask one handle questions at once. A call that
 *   changes an object while another one uses it is refused (CDFP_BAD_STATE).
 * - Views are a pointer and a count. They belong to the handle; each function says for how long they hold.
 * - Arrays of nodes are (n, 3) row-major, of hexahedra (n, 8), of facets (n, 2): element and local facet.
 * - Numbers of nodes, elements, facets, parts, layers and axes count from 0; -1 is "none". Units are SI.
 * - Strings that go in end with a null character. Strings that come out are copied into `text`, cut to
 *   `capacity - 1` characters and ended with a null; `length` is the length of the whole without the null.
 *   Ask with a capacity of 0 for the length alone.
 */
#ifndef CDFP_CDFP_H
#define CDFP_CDFP_H

#include "cdfp/c/cohesive.h"
#include "cdfp/c/common.h"
#include "cdfp/c/contact.h"
#include "cdfp/c/material.h"
#include "cdfp/c/mesh.h"
#include "cdfp/c/model.h"
#include "cdfp/c/simulation.h"
#include "cdfp/c/topology.h"

#endif
