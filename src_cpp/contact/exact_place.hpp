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

}  // namespace cdfp::CDFP_ISA
