/// Symmetric 3 x 3 tensors of packs or doubles.
#pragma once

#include "core/pack.hpp"

namespace cdfp::CDFP_ISA {

template <class T>
struct Symmetric {
  T xx, yy, zz, xy, yz, xz;

  CDFP_INLINE T trace() const { return xx + yy + zz; }
};

template <class T>
CDFP_INLINE Symmetric<T> operator+(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.xz + b.xz};
}
template <class T>
CDFP_INLINE Symmetric<T> operator-(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.xz - b.xz};
}
template <class T>
CDFP_INLINE Symmetric<T> operator*(T s, const Symmetric<T>& a) {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.yz, s * a.xz};
}

/// a : b
template <class T>
CDFP_INLINE T double_dot(const Symmetric<T>& a, const Symmetric<T>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + T(2.0) * (a.xy * b.xy + a.yz * b.yz + a.xz * b.xz);
}

/// lambda tr(e) I + 2 mu e
template <class T>
CDFP_INLINE Symmetric<T> isotropic(T lambda, T mu, const Symmetric<T>& e) {
  const T two_mu = mu + mu;
  const T mean = lambda * e.trace();
  return {mean + two_mu * e.xx, mean + two_mu * e.yy, mean + two_mu * e.zz,
          two_mu * e.xy,        two_mu * e.yz,        two_mu * e.xz};
}

template <class T>
CDFP_INLINE Symmetric<T> load_symmetric(const double* first, int stride) {
  return {load<T>(first),
          load<T>(first + stride),
          load<T>(first + 2 * stride),
          load<T>(first + 3 * stride),
          load<T>(first + 4 * stride),
          load<T>(first + 5 * stride)};
}
template <class T>
CDFP_INLINE void store_symmetric(double* first, int stride, const Symmetric<T>& a) {
  store(first, a.xx), store(first + stride, a.yy), store(first + 2 * stride, a.zz);
  store(first + 3 * stride, a.xy), store(first + 4 * stride, a.yz), store(first + 5 * stride, a.xz);
}

}  // namespace cdfp::CDFP_ISA
