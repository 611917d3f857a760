/** @file
 * What a user's bulk material receives: a block of material points, as laws in C, C++ and Fortran see it.
 *
 * Arrays are the simulation's own, component after component: component k of point i stands at
 * [k * count + i], in Fortran `array(count, components)`. Symmetric tensors have the order 11 22 33 12 23 31
 * with tensor shears; the deformation gradient 11 22 33 12 23 31 21 32 13. They hold until the law returns.
 *
 * Stretch, stress and strain increment stand in the corotated axes: with F = R U and U symmetric, U is the
 * stretch, the law's stress is R^T sigma R of the Cauchy stress sigma, and the strain increment is the
 * symmetric part of dU U_mid^-1, second order in the step and zero in any rigid motion. In fully integrated
 * hexahedra F has the mean volumetric strain of the element, in wedges (two points over one another) it is
 * that of the mean gradient with the bending strain added.
 *
 * What is to be written holds the old values (`stiffness`: 0) when the law is called.
 */
#ifndef CDFP_MATERIAL_H
#define CDFP_MATERIAL_H

#include <stdint.h>

/* NOLINTBEGIN(readability-identifier-naming,modernize-use-using): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cdfp_material_points {
  int64_t count;       /**< points: one of each of `count` elements */
  int32_t point;       /**< which of an element's integration points, from 0 */
  int32_t start;       /**< not 0: the first call, at time 0; see `cdfp_model_add_user_material` */
  int32_t state_count; /**< components of `state` */
  int32_t property_count;
  double time;                    /**< s, at the end of the step */
  double step;                    /**< s */
  const double* properties;       /**< (property_count) */
  const int32_t* elements;        /**< (count), from 0 */
  const double* position;         /**< (count, 3), m, at the end of the step */
  const double* length;           /**< m: cube root of the element's undeformed volume */
  const double* density;          /**< kg/m3, at the end of the step */
  const double* strain_increment; /**< (count, 6) */
  /** (count, 3): turn of the material against the corotated axes about axes 3, 1, 2 (dU U_mid^-1 of 21 32 13,
   *  less that of 12 23 31, halved) */
  const double* spin_increment;
  const double* stretch_old; /**< (count, 6) */
  const double* stretch;
  const double* gradient_old; /**< (count, 9): dx/dX */
  const double* gradient;
  const double* rotation;       /**< (count, 9): R at the end of the step, in the order of the gradient */
  const double* stress_old;     /**< (count, 6), Pa */
  const double* state_old;      /**< (count, state_count); 0 at the start */
  const double* energy_old;     /**< J/kg, as the law wrote it */
  const double* dissipated_old; /**< J/kg, as the law wrote it */
  double* stress;               /**< out: (count, 6) */
  double* state;                /**< out: (count, state_count) */
  double* energy;               /**< out: internal energy, for the law's own use */
  double* dissipated; /**< out: part of the internal energy that is lost; it enters the energy account */
  /** out: Pa, modulus of a plane wave (bulk + 4/3 shear) where the law is now stiffer than the material's
   *  elastic constants; the stable step follows it */
  double* stiffness;
  int64_t* failed; /**< out, -1: a point at which the law gives up; the step then fails with `message` */
  char* message;   /**< out: why, a C string */
  int64_t message_capacity;
} cdfp_material_points;

/** Computes stress and state at the end of the step. Must not throw, print or stop, nor call cdfp with the
 *  handles of the simulation that calls it. */
typedef void (*cdfp_material_callback)(const cdfp_material_points* points, void* user_data);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming,modernize-use-using) */

#endif
