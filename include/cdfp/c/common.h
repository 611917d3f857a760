/** @file
 * Status, messages and handles, for all of the C interface: its rules are in cdfp/cdfp.h.
 */
#ifndef CDFP_C_COMMON_H
#define CDFP_C_COMMON_H

#include <stdint.h>

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

enum {
  CDFP_OK = 0,
  CDFP_BAD_ARGUMENT = 1, /**< a value, size, name or handle that the caller gave */
  CDFP_BAD_INPUT = 2,    /**< a file's contents */
  CDFP_BAD_MESH = 3,     /**< inverted, degenerate or inconsistent elements */
  CDFP_BAD_STATE = 4,    /**< a call that the object cannot take now */
  CDFP_DIVERGED = 5,     /**< NaN, inverted element or runaway energy while stepping */
  CDFP_IO = 6,           /**< a file that cannot be opened, read or written */
  CDFP_UNAVAILABLE = 7,  /**< an optional part that this build lacks */
  CDFP_INTERNAL = 8      /**< out of memory, or a fault of cdfp */
};

/** Text of the last call that failed on this thread; empty if none did. */
int32_t cdfp_last_error(char* text, int64_t capacity, int64_t* length);
/** The same for callers who count elements, nodes, facets and parts from 1. */
int32_t cdfp_last_error_from_1(char* text, int64_t capacity, int64_t* length);

/** Version of the library that runs: major, minor, patch. */
int32_t cdfp_version(int32_t* major, int32_t* minor, int32_t* patch);

typedef struct cdfp_mesh cdfp_mesh;
typedef struct cdfp_model cdfp_model;
typedef struct cdfp_simulation cdfp_simulation;
typedef struct cdfp_recorder cdfp_recorder;
typedef struct cdfp_topology cdfp_topology;
typedef struct cdfp_cohesive cdfp_cohesive;
typedef struct cdfp_contact_search cdfp_contact_search;
typedef struct cdfp_contact cdfp_contact;

/** One more owner of the object behind a handle of any kind: `copy` is a handle of its own to the same
 * object, and each of the two must be freed. The object goes with its last owner. */
int32_t cdfp_share(const void* handle, void** copy);

/** What all the `..._free` below do, for a handle of any kind. */
int32_t cdfp_free(void** handle);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
