/// Polar decomposition F = R U and what else corotated stresses need, of packs or doubles.
#pragma once

#include "core/pack.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

template <class T>
CDFP_INLINE T determinant_of(const T (&a)[3][3]) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) +
         a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

/// The nearest rotation, by Newton's iteration R := (R + R^-T) / 2 (Higham 1986), quadratic. A matrix whose
/// determinant is not positive gives no rotation.
template <class T>
CDFP_INLINE void rotation_of(const T (&f)[3][3], T (&r)[3][3]) {
  constexpr int kMost = 40;
  constexpr double kDone = 1e-18;  // squared change; the next one is its square
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r[i][j] = f[i][j];
  }
  for (int k = 0; k < kMost; ++k) {
    const T half_inverse = T(0.5) / determinant_of(r);
    T next[3][3], change(0.0);
    for (int i = 0; i < 3; ++i) {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      for (int j = 0; j < 3; ++j) {
        const int c = (j + 1) % 3, d = (j + 2) % 3;
        next[i][j] = T(0.5) * r[i][j] + half_inverse * (r[a][c] * r[b][d] - r[a][d] * r[b][c]);
        const T step = next[i][j] - r[i][j];
        change += step * step;
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) r[i][j] = next[i][j];
    }
    if (lanes_at_least(change, T(kDone)) == 0) return;
  }
}

/// Symmetric part of R^T F.
template <class T>
CDFP_INLINE Symmetric<T> stretch_of(const T (&r)[3][3], const T (&f)[3][3]) {
  const auto dot = [&](int i, int j) { return r[0][i] * f[0][j] + r[1][i] * f[1][j] + r[2][i] * f[2][j]; };
  const auto mean = [&](int i, int j) { return T(0.5) * (dot(i, j) + dot(j, i)); };
  return {dot(0, 0), dot(1, 1), dot(2, 2), mean(0, 1), mean(1, 2), mean(0, 2)};
}

/// The square root of C, positive definite: the stretch of its Cholesky factor.
template <class T>
CDFP_INLINE Symmetric<T> root_of(const Symmetric<T>& c) {
  const T a = square_root(c.xx), b = c.xy / a, d = c.xz / a;
  const T e = square_root(c.yy - b * b), g = (c.yz - b * d) / e;
  const T f[3][3] = {{a, b, d}, {T(0.0), e, g}, {T(0.0), T(0.0), square_root(c.zz - d * d - g * g)}};
  T r[3][3];
  rotation_of(f, r);
  return stretch_of(r, f);
}

template <class T>
CDFP_INLINE T determinant_of(const Symmetric<T>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.yz) + a.xy * (a.yz * a.xz - a.xy * a.zz) +
         a.xz * (a.xy * a.yz - a.yy * a.xz);
}

template <class T>
CDFP_INLINE Symmetric<T> inverse_of(const Symmetric<T>& a) {
  const T s = T(1.0) / determinant_of(a);
  return {s * (a.yy * a.zz - a.yz * a.yz), s * (a.xx * a.zz - a.xz * a.xz), s * (a.xx * a.yy - a.xy * a.xy),
          s * (a.yz * a.xz - a.xy * a.zz), s * (a.xy * a.xz - a.xx * a.yz), s * (a.xy * a.yz - a.yy * a.xz)};
}

template <class T>
CDFP_INLINE void full_of(const Symmetric<T>& a, T (&m)[3][3]) {
  m[0][0] = a.xx, m[0][1] = a.xy, m[0][2] = a.xz;
  m[1][0] = a.xy, m[1][1] = a.yy, m[1][2] = a.yz;
  m[2][0] = a.xz, m[2][1] = a.yz, m[2][2] = a.zz;
}

/// A B, in full.
template <class T>
CDFP_INLINE void product_of(const Symmetric<T>& a, const Symmetric<T>& b, T (&m)[3][3]) {
  T left[3][3], right[3][3];
  full_of(a, left);
  full_of(b, right);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      m[i][j] = left[i][0] * right[0][j] + left[i][1] * right[1][j] + left[i][2] * right[2][j];
  }
}

/// Q A Q^T
template <class T>
CDFP_INLINE Symmetric<T> turned(const T (&q)[3][3], const Symmetric<T>& a) {
  T m[3][3], qa[3][3];
  full_of(a, m);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) qa[i][j] = q[i][0] * m[0][j] + q[i][1] * m[1][j] + q[i][2] * m[2][j];
  }
  const auto at = [&](int i, int j) { return qa[i][0] * q[j][0] + qa[i][1] * q[j][1] + qa[i][2] * q[j][2]; };
  return {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(0, 2)};
}

}  // namespace cdfp::CDFP_ISA
