/// Corner values of a hexahedron as sums with the signs of its modes, and back.
///
/// Order of corners as in VTK: signs of (xi, eta, zeta) are --- +-- ++- -+- --+ +-+ +++ -++.
#pragma once

#include "core/pack.hpp"

namespace cdfp::CDFP_ISA {

/// Modes in their order: 0 xi, 1 eta, 2 zeta, 3 eta zeta, 4 xi zeta, 5 xi eta, 6 xi eta zeta.
inline constexpr int kModes = 7;

/// m[mode][d] = sum over corners of sign * x[corner][d], by sums and differences of opposite corners.
template <class T>
CDFP_INLINE void to_modes(const T (&x)[8][3], T (&m)[kModes][3]) {
  for (int d = 0; d < 3; ++d) {
    const T d0 = x[6][d] - x[0][d], d1 = x[7][d] - x[1][d], d2 = x[4][d] - x[2][d], d3 = x[5][d] - x[3][d];
    const T s0 = x[6][d] + x[0][d], s1 = x[7][d] + x[1][d], s2 = x[4][d] + x[2][d], s3 = x[5][d] + x[3][d];
    const T a = d0 + d2, b = d0 - d2, c = d1 + d3, e = d1 - d3;
    m[0][d] = b - e;
    m[1][d] = b + e;
    m[2][d] = a + c;
    m[6][d] = a - c;
    const T p = s0 - s2, q = s1 - s3;
    m[3][d] = p + q;
    m[4][d] = p - q;
    m[5][d] = (s0 - s1) + (s2 - s3);
  }
}

/// f[corner][d] = sum over modes of sign * m[mode][d].
template <class T>
CDFP_INLINE void to_corners(const T (&m)[kModes][3], T (&f)[8][3]) {
  for (int d = 0; d < 3; ++d) {
    const T a = m[2][d] + m[6][d], b = m[2][d] - m[6][d], c = m[0][d] + m[1][d], e = m[1][d] - m[0][d];
    const T p = m[3][d] + m[4][d], q = m[3][d] - m[4][d];
    const T odd0 = a + c, odd1 = b + e, odd2 = a - c, odd3 = b - e;
    const T even0 = m[5][d] + p, even1 = q - m[5][d], even2 = m[5][d] - p, even3 = m[5][d] + q;
    f[6][d] = even0 + odd0, f[0][d] = even0 - odd0;
    f[7][d] = even1 + odd1, f[1][d] = even1 - odd1;
    f[4][d] = even2 + odd2, f[2][d] = even2 - odd2;
    f[5][d] = odd3 - even3, f[3][d] = -even3 - odd3;
  }
}

/// (F^T F - I) / 2 of a deformation gradient given by columns.
template <class T, class Strain>
CDFP_INLINE void green_strain(const T (&f)[3][3], Strain& e) {
  const auto dot = [&](int i, int j) { return f[i][0] * f[j][0] + f[i][1] * f[j][1] + f[i][2] * f[j][2]; };
  const T half(0.5);
  e.xx = half * dot(0, 0) - half;
  e.yy = half * dot(1, 1) - half;
  e.zz = half * dot(2, 2) - half;
  e.xy = half * dot(0, 1);
  e.yz = half * dot(1, 2);
  e.xz = half * dot(0, 2);
}

template <class T>
CDFP_INLINE T determinant(const T (&f)[3][3]) {
  return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) +
         f[0][1] * (f[1][2] * f[2][0] - f[1][0] * f[2][2]) +
         f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

/// F S, columns.
template <class T, class Stress>
CDFP_INLINE void first_piola_kirchhoff(const T (&f)[3][3], const Stress& s, T (&p)[3][3]) {
  for (int d = 0; d < 3; ++d) {
    p[0][d] = f[0][d] * s.xx + f[1][d] * s.xy + f[2][d] * s.xz;
    p[1][d] = f[0][d] * s.xy + f[1][d] * s.yy + f[2][d] * s.yz;
    p[2][d] = f[0][d] * s.xz + f[1][d] * s.yz + f[2][d] * s.zz;
  }
}

/// F S F^T
template <class T, class Stress>
CDFP_INLINE void push_forward(const T (&f)[3][3], const Stress& s, T (&sigma)[3][3]) {
  for (int d = 0; d < 3; ++d) {
    const T x = f[0][d] * s.xx + f[1][d] * s.xy + f[2][d] * s.xz;
    const T y = f[0][d] * s.xy + f[1][d] * s.yy + f[2][d] * s.yz;
    const T z = f[0][d] * s.xz + f[1][d] * s.yz + f[2][d] * s.zz;
    for (int e = 0; e < 3; ++e) sigma[d][e] = x * f[0][e] + y * f[1][e] + z * f[2][e];
  }
}

}  // namespace cdfp::CDFP_ISA
