/* Compressible neo-Hookean solid as a law in C: s = mu / J (U^2 - 1) + lambda ln J / J.
 * properties: 0 shear modulus, 1 Poisson's ratio. state: 0 energy, J/m3 undeformed */
#include <math.h>

#include "cdfp/material.h"

void neo_hookean(const cdfp_material_points* p, void* user_data) {
  const int64_t n = p->count;
  const double mu = p->properties[0], nu = p->properties[1], lambda = 2 * mu * nu / (1 - 2 * nu);
  (void)user_data;
  if (p->property_count != 2 || p->state_count != 1) {
    static const char why[] = "neo_hookean takes 2 properties (shear modulus, Poisson's ratio) and 1 state";
    for (int i = 0; i < (int)sizeof why && i < p->message_capacity; ++i) p->message[i] = why[i];
    *p->failed = 0;
    return;
  }
  for (int64_t i = 0; i < n; ++i) {
    const double xx = p->stretch[i], yy = p->stretch[n + i], zz = p->stretch[2 * n + i];
    const double xy = p->stretch[3 * n + i], yz = p->stretch[4 * n + i], zx = p->stretch[5 * n + i];
    const double b[6] = {xx * xx + xy * xy + zx * zx, xy * xy + yy * yy + yz * yz, zx * zx + yz * yz + zz * zz,
                         xx * xy + xy * yy + zx * yz, xy * zx + yy * yz + yz * zz, xx * zx + xy * yz + zx * zz};
    const double j = xx * (yy * zz - yz * yz) + xy * (yz * zx - xy * zz) + zx * (xy * yz - yy * zx);
    for (int k = 0; k < 6; ++k) {
      p->stress[k * n + i] = (k < 3 ? mu * (b[k] - 1) + lambda * log(j) : mu * b[k]) / j;
    }
    p->state[i] = 0.5 * mu * (b[0] + b[1] + b[2] - 3 - 2 * log(j)) + 0.5 * lambda * log(j) * log(j);
  }
}
