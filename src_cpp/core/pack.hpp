/// `Pack`: as many doubles as one vector register holds, by compiler vector extensions. With
/// lanes.hpp the only file that names a SIMD type.
///
/// Kernels are compiled once for each instruction set. So that the linker never takes a function of one
/// variant for another's, everything here lives in a namespace of its own for each variant
/// (`CDFP_ISA`, set by the including source file) and is inlined by force.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#ifndef CDFP_ISA
#define CDFP_ISA host
#endif
#define CDFP_INLINE [[gnu::always_inline]] inline

#if defined(__GLIBC__) && defined(__x86_64__)
// glibc's vector mathematics; named by the vector function ABI of x86-64.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
__m512d _ZGVeN8vv_pow(__m512d, __m512d);
#elif defined(__AVX2__)
__m256d _ZGVdN4vv_pow(__m256d, __m256d);
#else
__m128d _ZGVbN2vv_pow(__m128d, __m128d);
#endif
}
// NOLINTEND(bugprone-reserved-identifier)
#endif

namespace cdfp::CDFP_ISA {

#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
inline constexpr int kWidth = 8;
#elif defined(__AVX__)
inline constexpr int kWidth = 4;
#else
inline constexpr int kWidth = 2;
#endif

struct Pack {
  typedef double Vector __attribute__((vector_size(8 * kWidth)));
  typedef long long Bits __attribute__((vector_size(8 * kWidth)));
  Vector v;

  Pack() = default;
  CDFP_INLINE Pack(double s) : v(s - Vector{}) {}
  CDFP_INLINE explicit Pack(Vector given) : v(given) {}

  CDFP_INLINE double operator[](int lane) const { return v[lane]; }
  CDFP_INLINE void set(int lane, double value) { v[lane] = value; }

  CDFP_INLINE Pack& operator+=(Pack b) { return v += b.v, *this; }
  CDFP_INLINE Pack& operator-=(Pack b) { return v -= b.v, *this; }
  CDFP_INLINE Pack& operator*=(Pack b) { return v *= b.v, *this; }
  CDFP_INLINE friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  CDFP_INLINE friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  CDFP_INLINE friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  CDFP_INLINE friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  CDFP_INLINE friend Pack operator-(Pack a) { return Pack(-a.v); }
  CDFP_INLINE friend Pack max(Pack a, Pack b) { return Pack(a.v > b.v ? a.v : b.v); }
  CDFP_INLINE friend Pack min(Pack a, Pack b) { return Pack(a.v < b.v ? a.v : b.v); }
};

CDFP_INLINE double max(double a, double b) {
  return a > b ? a : b;
}
CDFP_INLINE double min(double a, double b) {
  return a < b ? a : b;
}

template <class T>
inline constexpr int kWidthOf = 1;
template <>
inline constexpr int kWidthOf<Pack> = kWidth;

/// `value(lane)` for each lane.
template <class T, class Value>
CDFP_INLINE T each_lane(Value&& value) {
  if constexpr (kWidthOf<T> == 1) {
    return value(0);
  } else {
    T result;
    for (int lane = 0; lane < kWidth; ++lane) result.set(lane, value(lane));
    return result;
  }
}

CDFP_INLINE double lane_of(double a, int) {
  return a;
}
CDFP_INLINE double lane_of(Pack a, int lane) {
  return a[lane];
}

CDFP_INLINE double square_root(double a) {
  return __builtin_sqrt(a);
}
CDFP_INLINE Pack square_root(Pack a) {
#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
  return Pack(Pack::Vector(_mm512_sqrt_pd(a.v)));
#elif defined(__AVX__)
  return Pack(Pack::Vector(_mm256_sqrt_pd(a.v)));
#elif defined(__SSE2__)
  return Pack(Pack::Vector(_mm_sqrt_pd(a.v)));
#else
  return each_lane<Pack>([&](int lane) { return __builtin_sqrt(a[lane]); });
#endif
}

/// x^n of each lane, x >= 0.
CDFP_INLINE double power(double x, double n) {
  return __builtin_pow(x, n);
}
CDFP_INLINE Pack power(Pack x, double n) {
  const Pack exponent(n);
#if !defined(__GLIBC__) || !defined(__x86_64__)
  return each_lane<Pack>([&](int lane) { return __builtin_pow(x[lane], n); });
#elif defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
  return Pack(Pack::Vector(_ZGVeN8vv_pow(x.v, exponent.v)));
#elif defined(__AVX2__)
  return Pack(Pack::Vector(_ZGVdN4vv_pow(x.v, exponent.v)));
#else
  return Pack(Pack::Vector(_ZGVbN2vv_pow(x.v, exponent.v)));
#endif
}

/// From consecutive doubles, for packs aligned to the pack's size.
template <class T>
CDFP_INLINE T load(const double* p) {
  if constexpr (kWidthOf<T> == 1) {
    return *p;
  } else {
    return Pack(*reinterpret_cast<const Pack::Vector*>(p));
  }
}
/// From consecutive floats, likewise.
CDFP_INLINE Pack load_single(const float* p) {
  typedef float Vector __attribute__((vector_size(4 * kWidth)));
  return Pack(__builtin_convertvector(*reinterpret_cast<const Vector*>(p), Pack::Vector));
}
CDFP_INLINE void store(double* p, double a) {
  *p = a;
}
CDFP_INLINE void store(double* p, Pack a) {
  *reinterpret_cast<Pack::Vector*>(p) = a.v;
}

/// Bit l: a >= b in lane l.
CDFP_INLINE std::uint64_t lanes_at_least(double a, double b) {
  return a >= b;
}
CDFP_INLINE std::uint64_t lanes_at_least(Pack a, Pack b) {
#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
  return _mm512_cmp_pd_mask(a.v, b.v, _CMP_GE_OQ);
#elif defined(__AVX__)
  return static_cast<std::uint64_t>(_mm256_movemask_pd(_mm256_cmp_pd(a.v, b.v, _CMP_GE_OQ)));
#elif defined(__SSE2__)
  return static_cast<std::uint64_t>(_mm_movemask_pd(_mm_cmpge_pd(a.v, b.v)));
#else
  std::uint64_t bits = 0;
  for (int lane = 0; lane < kWidth; ++lane) bits |= static_cast<std::uint64_t>(a[lane] >= b[lane]) << lane;
  return bits;
#endif
}

/// Three consecutive doubles of each lane, from `base + offset[lane]`, turned into three packs.
CDFP_INLINE void gather3(const double* base, const std::int32_t* offset, double (&a)[3]) {
  for (int d = 0; d < 3; ++d) a[d] = base[offset[0] + d];
}
CDFP_INLINE void gather3(const double* base, const std::int32_t* offset, Pack (&a)[3]) {
#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
  // Rows (x y z 0) of lanes l and l + 2 side by side, then a transposition in 128-bit pieces.
  const auto row = [&](int lane) { return _mm256_maskz_loadu_pd(7, base + offset[lane]); };
  const auto rows = [&](int lane) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(row(lane)), row(lane + 2), 1);
  };
  const __m512d r0 = rows(0), r1 = rows(1), r4 = rows(4), r5 = rows(5);
  const __m512d xz0 = _mm512_unpacklo_pd(r0, r1), xz4 = _mm512_unpacklo_pd(r4, r5);
  const __m512d y0 = _mm512_unpackhi_pd(r0, r1), y4 = _mm512_unpackhi_pd(r4, r5);
  a[0] = Pack(Pack::Vector(_mm512_shuffle_f64x2(xz0, xz4, 0x88)));
  a[1] = Pack(Pack::Vector(_mm512_shuffle_f64x2(y0, y4, 0x88)));
  a[2] = Pack(Pack::Vector(_mm512_shuffle_f64x2(xz0, xz4, 0xdd)));
#elif defined(__AVX__)
  const auto pair = [&](int lane) { return _mm_loadu_pd(base + offset[lane]); };
  const auto third = [&](int lane) {
    return _mm_loadh_pd(_mm_load_sd(base + offset[lane] + 2), base + offset[lane + 1] + 2);
  };
  const __m256d r0 = _mm256_insertf128_pd(_mm256_castpd128_pd256(pair(0)), pair(2), 1);
  const __m256d r1 = _mm256_insertf128_pd(_mm256_castpd128_pd256(pair(1)), pair(3), 1);
  a[0] = Pack(Pack::Vector(_mm256_unpacklo_pd(r0, r1)));
  a[1] = Pack(Pack::Vector(_mm256_unpackhi_pd(r0, r1)));
  a[2] = Pack(Pack::Vector(_mm256_insertf128_pd(_mm256_castpd128_pd256(third(0)), third(2), 1)));
#else
  for (int d = 0; d < 3; ++d) {
    a[d] = each_lane<Pack>([&](int lane) { return base[offset[lane] + d]; });
  }
#endif
}

/// `base[offset[lane] + d] -= a[d]`, lane after lane, for the first `lanes` lanes.
CDFP_INLINE void scatter_subtract3(double* base, const std::int32_t* offset, int, const double (&a)[3]) {
  for (int d = 0; d < 3; ++d) base[offset[0] + d] -= a[d];
}
CDFP_INLINE void scatter_subtract3(double* base, const std::int32_t* offset, int lanes, const Pack (&a)[3]) {
#if defined(__SSE2__)
  const auto subtract = [&](int lane, __m128d xy, __m128d z) {
    double* p = base + offset[lane];
    _mm_storeu_pd(p, _mm_sub_pd(_mm_loadu_pd(p), xy));
    _mm_store_sd(p + 2, _mm_sub_sd(_mm_load_sd(p + 2), z));
  };
#endif
#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
  const __m512d even = _mm512_unpacklo_pd(a[0].v, a[1].v), odd = _mm512_unpackhi_pd(a[0].v, a[1].v);
  const __m512d z = a[2].v, z_odd = _mm512_unpackhi_pd(z, z);
  if (lanes == kWidth) [[likely]] {
    subtract(0, _mm512_castpd512_pd128(even), _mm512_castpd512_pd128(z));
    subtract(1, _mm512_castpd512_pd128(odd), _mm512_castpd512_pd128(z_odd));
    subtract(2, _mm512_extractf64x2_pd(even, 1), _mm512_extractf64x2_pd(z, 1));
    subtract(3, _mm512_extractf64x2_pd(odd, 1), _mm512_extractf64x2_pd(z_odd, 1));
    subtract(4, _mm512_extractf64x2_pd(even, 2), _mm512_extractf64x2_pd(z, 2));
    subtract(5, _mm512_extractf64x2_pd(odd, 2), _mm512_extractf64x2_pd(z_odd, 2));
    subtract(6, _mm512_extractf64x2_pd(even, 3), _mm512_extractf64x2_pd(z, 3));
    subtract(7, _mm512_extractf64x2_pd(odd, 3), _mm512_extractf64x2_pd(z_odd, 3));
    return;
  }
#elif defined(__AVX__)
  const __m256d even = _mm256_unpacklo_pd(a[0].v, a[1].v), odd = _mm256_unpackhi_pd(a[0].v, a[1].v);
  const __m256d z = a[2].v, z_odd = _mm256_unpackhi_pd(z, z);
  if (lanes == kWidth) [[likely]] {
    subtract(0, _mm256_castpd256_pd128(even), _mm256_castpd256_pd128(z));
    subtract(1, _mm256_castpd256_pd128(odd), _mm256_castpd256_pd128(z_odd));
    subtract(2, _mm256_extractf128_pd(even, 1), _mm256_extractf128_pd(z, 1));
    subtract(3, _mm256_extractf128_pd(odd, 1), _mm256_extractf128_pd(z_odd, 1));
    return;
  }
#elif defined(__SSE2__)
  if (lanes == kWidth) [[likely]] {
    subtract(0, _mm_unpacklo_pd(a[0].v, a[1].v), a[2].v);
    subtract(1, _mm_unpackhi_pd(a[0].v, a[1].v), _mm_unpackhi_pd(a[2].v, a[2].v));
    return;
  }
#endif
  for (int lane = 0; lane < lanes; ++lane) {
    for (int d = 0; d < 3; ++d) base[offset[lane] + d] -= a[d][lane];
  }
}

}  // namespace cdfp::CDFP_ISA
