/// Second Piola-Kirchhoff stress linear in the Green-Lagrange strain (St. Venant-Kirchhoff).
#pragma once

#include "material/constants.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

/// A law sees a point by its state: `kState` components, `kLanes` doubles apart.
struct Elastic {
  static constexpr int kState = 0;

  template <class T>
  CDFP_INLINE static Symmetric<T> stress(const MaterialConstants& material, const Symmetric<T>& strain,
                                         const double*) {
    return isotropic(T(material.lambda), T(material.mu), strain);
  }

  template <class T>
  CDFP_INLINE static Symmetric<T> advance(const MaterialConstants& material, const StepConstants&,
                                          const Symmetric<T>& strain, double* state) {
    return stress(material, strain, state);
  }

  /// J/m3 stored
  template <class T>
  CDFP_INLINE static T energy(const MaterialConstants& material, const Symmetric<T>& strain,
                              const double* state) {
    return T(0.5) * double_dot(stress(material, strain, state), strain);
  }

  /// J/m3 dissipated so far
  template <class T>
  CDFP_INLINE static T dissipated(const double*) {
    return T(0.0);
  }

  /// Stiffness over that of `material.lambda` and `material.mu`, at most, until the next estimate of the
  /// stable step.
  template <class T>
  CDFP_INLINE static T stiffness_ratio(const MaterialConstants&, const double*) {
    return T(1.0);
  }
};

}  // namespace cdfp::CDFP_ISA
