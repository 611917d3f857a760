/** @file
 * Users' bulk materials of a model. What such a law receives is in cdfp/material.h.
 */
#ifndef CDFP_C_MATERIAL_H
#define CDFP_C_MATERIAL_H

#include <stdint.h>

#include "cdfp/c/common.h"
#include "cdfp/material.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

/** A material whose law is the user's: fill it by `cdfp_user_material_default`, then give density, states and
 *  properties. */
typedef struct cdfp_user_material {
  double density;
  double youngs_modulus; /**< of hourglass modes and contact; 0: as the law's first call shows */
  double poissons_ratio;
  const double* properties; /**< (property_count), copied; may be NULL if there are none */
  int64_t property_count;
  int32_t states;         /**< numbers kept at each point */
  int32_t deletion_state; /**< a point where the law makes this state 0 is deleted; -1: none */
  int32_t thread_safe;    /**< not 0: several threads may call the law at once */
} cdfp_user_material;

int32_t cdfp_user_material_default(cdfp_user_material* material);

/** The law's first call comes when a simulation is made: at time 0, with a tiny strain increment, whose
 * stress shows the elastic constants and is dropped while its state is kept. Then it is called once a step
 * for each block of points. `user_data` must live as long as the model and its simulations. */
int32_t cdfp_model_add_user_material(cdfp_model* model, const char* name, const cdfp_user_material* material,
                                     cdfp_material_callback callback, void* user_data);
/** By a `cdfp_material_callback` in a shared library; its user data are NULL. */
int32_t cdfp_model_add_library_material(cdfp_model* model, const char* name,
                                        const cdfp_user_material* material, const char* library,
                                        const char* function);

/** What a VUMAT is told besides. */
typedef struct cdfp_vumat {
  double temperature;
  const double* fields; /**< (field_count), copied; may be NULL if there are none */
  int64_t field_count;
  int32_t single_precision; /**< not 0: its reals have four bytes */
} cdfp_vumat;

int32_t cdfp_vumat_default(cdfp_vumat* vumat);

/** By the subroutine VUMAT of a shared library, which is given `name` as cmname, in capitals. See
 *  cdfp/material_library.hpp. */
int32_t cdfp_model_add_vumat_material(cdfp_model* model, const char* name, const cdfp_user_material* material,
                                      const cdfp_vumat* vumat, const char* library);
/** Names a state of a user's material in output. */
int32_t cdfp_model_set_state_name(cdfp_model* model, const char* material, int32_t state, const char* name);

/** Compiles a source (Fortran, C or C++) to a shared library, as `cdfp build-material` does. */
int32_t cdfp_build_material(const char* source, const char* library, int32_t single_precision);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
