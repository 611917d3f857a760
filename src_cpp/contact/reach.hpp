/// Where a segment looks for nodes. For inclusion where CDFP_ISA is set.
#pragma once

#include "contact/cell_layout.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace cdfp::CDFP_ISA {

/// Places of a grown box, and the same without the lattice's margin.
struct Reach {
  Int4 low, high, from, to;
};

/// Grows boxes and places them; both corners side by side where that is one register.
class Reaches {
 public:
#if defined(__AVX2__)
  CDFP_ALWAYS_INLINE Reaches(const CellLayout& layout, float grow)
      : grow_(_mm256_set_m128(_mm_set1_ps(grow), _mm_set1_ps(-grow))),
        ulp_(_mm256_set_m128(_mm_set1_ps(kUlp), _mm_set1_ps(-kUlp))),
        per_step_(twice(layout.lattice().per_step())),
        first_(twice(layout.lattice().first())),
        last_step_(twice(layout.lattice().last_step())),
        margin_(twice(layout.margin())),
        last_(twice(layout.last_in_cells())) {}
  CDFP_ALWAYS_INLINE Reach operator()(RoughBox& box) const {
    auto* const corners = reinterpret_cast<float*>(&box);
    const __m256 x = _mm256_loadu_ps(corners);
    const __m256 size = _mm256_andnot_ps(_mm256_set1_ps(-0.0F), x);
    const __m256 grown = _mm256_add_ps(_mm256_add_ps(x, grow_), _mm256_mul_ps(ulp_, size));
    _mm256_storeu_ps(corners, grown);
    const __m256 steps = _mm256_sub_ps(_mm256_mul_ps(grown, per_step_), first_);
    const __m256 inside = _mm256_min_ps(_mm256_max_ps(steps, _mm256_setzero_ps()), last_step_);
    const __m256i places = _mm256_cvttps_epi32(inside);
    const __m256i cells =
        _mm256_min_epi32(_mm256_max_epi32(_mm256_sub_epi32(places, margin_), _mm256_setzero_si256()), last_);
    return {low_half(places), high_half(places), low_half(cells), high_half(cells)};
  }

 private:
  CDFP_ALWAYS_INLINE static __m256 twice(Float4 x) {
    const auto lanes = reinterpret_cast<__m128>(x);
    return _mm256_set_m128(lanes, lanes);
  }
  CDFP_ALWAYS_INLINE static __m256i twice(Int4 x) {
    const auto lanes = reinterpret_cast<__m128i>(x);
    return _mm256_set_m128i(lanes, lanes);
  }
  CDFP_ALWAYS_INLINE static Int4 low_half(__m256i x) {
    return reinterpret_cast<Int4>(_mm256_castsi256_si128(x));
  }
  CDFP_ALWAYS_INLINE static Int4 high_half(__m256i x) {
    return reinterpret_cast<Int4>(_mm256_extracti128_si256(x, 1));
  }
  static constexpr float kUlp = 1.2e-7F;
  __m256 grow_, ulp_, per_step_, first_, last_step_;
  __m256i margin_, last_;
#else
  CDFP_ALWAYS_INLINE Reaches(const CellLayout& layout, float grow) : layout_(layout), grow_(grow) {}
  CDFP_ALWAYS_INLINE Reach operator()(RoughBox& box) const {
    box = grown(box, grow_);
    const Int4 low = layout_.lattice()(box.low), high = layout_.lattice()(box.high);
    return {low, high, layout_.in_cells(low), layout_.in_cells(high)};
  }

 private:
  const CellLayout& layout_;
  float grow_;
#endif
};

}  // namespace cdfp::CDFP_ISA
