/// The stress that was worked out before, by a user's law: kept at each point with its energies.
#pragma once

#include "material/constants.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

struct Stored {
  // second Piola-Kirchhoff stress, work done on the point and what of it is lost (J/m3), stiffness over that
  // of the material's constants
  static constexpr int kStress = 0, kWork = 6, kDissipated = 7, kRatio = 8;
  static constexpr int kState = 9;

  template <class T>
  CDFP_INLINE static Symmetric<T> stress(const MaterialConstants&, const Symmetric<T>&, const double* state) {
    return load_symmetric<T>(state + kStress * kLanes, kLanes);
  }

  template <class T>
  CDFP_INLINE static Symmetric<T> advance(const MaterialConstants& material, const StepConstants&,
                                          const Symmetric<T>& strain, double* state) {
    return stress(material, strain, state);
  }

  template <class T>
  CDFP_INLINE static T energy(const MaterialConstants&, const Symmetric<T>&, const double* state) {
    return load<T>(state + kWork * kLanes) - load<T>(state + kDissipated * kLanes);
  }

  template <class T>
  CDFP_INLINE static T dissipated(const double* state) {
    return load<T>(state + kDissipated * kLanes);
  }

  template <class T>
  CDFP_INLINE static T stiffness_ratio(const MaterialConstants&, const double* state) {
    return max(T(1.0), load<T>(state + kRatio * kLanes));
  }
};

}  // namespace cdfp::CDFP_ISA
