/// Elastic with a second branch whose modulus follows the strain rate: E_v = rate_modulus * rate^exponent.
///
/// C1 is the elastic tensor of unit modulus. Stress S = C_static : E + S_v. In a step
///   rate = sqrt(2/3 dev dE : dev dE) / step, smoothed by a first-order filter,
///   E_v falls from a to b: S_v := b/a S_v (the stored energy falls with it);
///   E_v rises: S_v stays (the stored energy S_v : C1^-1 : S_v / (2 E_v) falls);
///   S_v := S_v + E_v C1 : dE.
/// No change of modulus creates energy, so the law dissipates or stores what it is given. From the virgin
/// state at constant rate the stress is E(rate) times the strain, once the filter has settled.
#pragma once

#include "material/constants.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

struct RateDependent {
  // strain and S_v at the last step, smoothed rate, E_v, dissipated energy density
  static constexpr int kStrain = 0, kStress = 6, kRate = 12, kModulus = 13, kDissipated = 14;
  static constexpr int kState = 15;

  /// Rate up to which the stable step holds without a new estimate, 1/s.
  static constexpr double kRateForStep = 1e4;

  template <class T>
  CDFP_INLINE static Symmetric<T> stress(const MaterialConstants& material, const Symmetric<T>& strain,
                                         const double* state) {
    return isotropic(T(material.lambda), T(material.mu), strain) +
           load_symmetric<T>(state + kStress * kLanes, kLanes);
  }

  template <class T>
  CDFP_INLINE static Symmetric<T> advance(const MaterialConstants& material, const StepConstants& step,
                                          const Symmetric<T>& strain, double* state) {
    const auto at = [&](int component) { return state + component * kLanes; };
    const Symmetric<T> change = strain - load_symmetric<T>(at(kStrain), kLanes);
    const T third = change.trace() * T(1.0 / 3);
    const T square =
        T(2.0 / 3) * max(double_dot(change, change) - T(3.0) * third * third, T(0.0));  // dev dE : dev dE
    const T rate_now = square_root(square) * T(step.per_step);
    const T rate_before = load<T>(at(kRate));
    const T rate = rate_before + T(step.rate_blend) * (rate_now - rate_before);
    const T modulus = T(material.rate_modulus) * power(rate, material.rate_exponent);

    const T modulus_before = load<T>(at(kModulus));
    const Symmetric<T> before = load_symmetric<T>(at(kStress), kLanes);
    const T tiny(1e-300);
    const T kept = min(modulus / max(modulus_before, tiny), T(1.0));
    const Symmetric<T> now =
        kept * before + modulus * isotropic(T(material.unit_lambda), T(material.unit_mu), change);

    const T work = T(0.5) * double_dot(before + now, change);
    const T stored = unit_energy(material, now) / max(modulus, tiny);
    const T stored_before = unit_energy(material, before) / max(modulus_before, tiny);
    store(at(kDissipated), load<T>(at(kDissipated)) + (work - (stored - stored_before)));
    store_symmetric(at(kStrain), kLanes, strain);
    store_symmetric(at(kStress), kLanes, now);
    store(at(kRate), rate);
    store(at(kModulus), modulus);
    return isotropic(T(material.lambda), T(material.mu), strain) + now;
  }

  template <class T>
  CDFP_INLINE static T energy(const MaterialConstants& material, const Symmetric<T>& strain,
                              const double* state) {
    const T lasting = T(0.5) * double_dot(isotropic(T(material.lambda), T(material.mu), strain), strain);
    const Symmetric<T> s = load_symmetric<T>(state + kStress * kLanes, kLanes);
    return lasting + unit_energy(material, s) / max(load<T>(state + kModulus * kLanes), T(1e-300));
  }

  template <class T>
  CDFP_INLINE static T dissipated(const double* state) {
    return load<T>(state + kDissipated * kLanes);
  }

  template <class T>
  CDFP_INLINE static T stiffness_ratio(const MaterialConstants& material, const double* state) {
    const double foreseen = material.rate_modulus * power(kRateForStep, material.rate_exponent);
    const T modulus = max(load<T>(state + kModulus * kLanes), T(foreseen));
    return T(1.0) + modulus * T(material.unit_mu / material.mu);
  }

 private:
  /// s : C1^-1 : s / 2
  template <class T>
  CDFP_INLINE static T unit_energy(const MaterialConstants& material, const Symmetric<T>& s) {
    const double per_mu = 1 / (2 * material.unit_mu);
    const double mean = material.unit_lambda / (3 * material.unit_lambda + 2 * material.unit_mu);
    const T trace = s.trace();
    return T(0.5 * per_mu) * (double_dot(s, s) - T(mean) * trace * trace);
  }
};

}  // namespace cdfp::CDFP_ISA
