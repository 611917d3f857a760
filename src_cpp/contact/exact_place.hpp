/// Places and boxes in double precision. For inclusion where CDFP_ISA is set.
#pragma once

#include "contact/cell_layout.hpp"
#include "core/lanes.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace cdfp::CDFP_ISA {

struct Place {
#if defined(__AVX2__)
  __m256d x;  // x, y, y, z

  CDFP_ALWAYS_INLINE explicit Place(const double* p)
      : x(_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p)), _mm_loadu_pd(p + 1), 1)) {}
  /// In single precision.
  CDFP_ALWAYS_INLINE Float4 about(const Place& origin) const {
    const auto lanes = reinterpret_cast<Float4>(_mm256_cvtpd_ps(_mm256_sub_pd(x, origin.x)));
    return __builtin_shufflevector(lanes, lanes, 0, 1, 3, 3);
  }
#else
  Double2 xy, z;

  CDFP_ALWAYS_INLINE explicit Place(const double* p) : xy{p[0], p[1]}, z{p[2], 0} {}
  CDFP_ALWAYS_INLINE Float4 about(const Place& origin) const {
    typedef float Float2 __attribute__((vector_size(8)));
    const auto flat = __builtin_convertvector(xy - origin.xy, Float2);
    const auto high = __builtin_convertvector(z - origin.z, Float2);
    return __builtin_shufflevector(flat, high, 0, 1, 2, 3);
  }
#endif
};

struct PlaceBox {
  Place low, high;

#if defined(__AVX2__)
  CDFP_ALWAYS_INLINE void include(const Place& p) {
    low.x = _mm256_min_pd(p.x, low.x);
    high.x = _mm256_max_pd(p.x, high.x);
  }
  /// Grown by `by` on all sides.
  CDFP_ALWAYS_INLINE bool holds(const Place& p, double by) const {
    const __m256d more = _mm256_set1_pd(by);
    const __m256d above = _mm256_cmp_pd(p.x, _mm256_sub_pd(low.x, more), _CMP_GE_OQ);
    const __m256d below = _mm256_cmp_pd(p.x, _mm256_add_pd(high.x, more), _CMP_LE_OQ);
    return _mm256_movemask_pd(_mm256_and_pd(above, below)) == 15;
  }
#else
  CDFP_ALWAYS_INLINE void include(const Place& p) {
    low.xy = lesser(p.xy, low.xy), low.z = lesser(p.z, low.z);
    high.xy = greater(p.xy, high.xy), high.z = greater(p.z, high.z);
  }
  CDFP_ALWAYS_INLINE bool holds(const Place& p, double by) const {
    const auto in =
        (p.xy >= low.xy - by) & (p.xy <= high.xy + by) & (p.z >= low.z - by) & (p.z <= high.z + by);
    return (in[0] & in[1]) != 0;
  }
#endif
};

/// |(b - a) x (d - c)|^2.
CDFP_ALWAYS_INLINE double cross_squared(const Place& a, const Place& b, const Place& c, const Place& d) {
#if defined(__AVX2__)
  constexpr int kYzx = 1 | 3 << 2 | 0 << 4, kZxy = 3 | 0 << 2 | 1 << 4;
  const __m256d p = _mm256_sub_pd(b.x, a.x), q = _mm256_sub_pd(d.x, c.x);
  const __m256d n =
      _mm256_sub_pd(_mm256_mul_pd(_mm256_permute4x64_pd(p, kYzx), _mm256_permute4x64_pd(q, kZxy)),
                    _mm256_mul_pd(_mm256_permute4x64_pd(p, kZxy), _mm256_permute4x64_pd(q, kYzx)));
  const __m256d squares = _mm256_mul_pd(n, n);
  const __m128d xy = _mm256_castpd256_pd128(squares), z = _mm256_extractf128_pd(squares, 1);
  return _mm_cvtsd_f64(_mm_add_sd(_mm_add_sd(xy, _mm_unpackhi_pd(xy, xy)), z));
#else
  const Double2 p = b.xy - a.xy, q = d.xy - c.xy;
  const double p2 = b.z[0] - a.z[0], q2 = d.z[0] - c.z[0];
  const double n0 = p[1] * q2 - p2 * q[1], n1 = p2 * q[0] - p[0] * q2, n2 = p[0] * q[1] - p[1] * q[0];
  return n0 * n0 + n1 * n1 + n2 * n2;
#endif
}

}  // namespace cdfp::CDFP_ISA
