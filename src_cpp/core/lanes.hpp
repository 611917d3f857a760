/// A few small numbers side by side, for rough tests that look at many at once. Needs no more than what every
/// x86-64 has.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace cdfp {

typedef double Double2 __attribute__((vector_size(16)));
typedef float Float4 __attribute__((vector_size(16)));
typedef std::int32_t Int4 __attribute__((vector_size(16)));
typedef std::uint16_t Short8 __attribute__((vector_size(16)));
typedef std::int16_t Truth8 __attribute__((vector_size(16)));

template <class Lanes>
Lanes lesser(Lanes a, Lanes b) {
  return a < b ? a : b;
}
template <class Lanes>
Lanes greater(Lanes a, Lanes b) {
  return a > b ? a : b;
}
inline bool any_equal(Int4 a, Int4 b) {
  const Int4 equal = a == b;
#if defined(__SSE2__)
  return _mm_movemask_epi8(reinterpret_cast<__m128i>(equal)) != 0;
#else
  return (equal[0] | equal[1] | equal[2] | equal[3]) != 0;
#endif
}
inline Short8 load8(const std::uint16_t* p) {
  Short8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
/// The lower half of lane `kLane`, eight times.
template <int kLane>
Short8 low_half8(Int4 v) {
  return __builtin_shufflevector(reinterpret_cast<Short8>(v), Short8{}, 2 * kLane, 2 * kLane, 2 * kLane,
                                 2 * kLane, 2 * kLane, 2 * kLane, 2 * kLane, 2 * kLane);
}
/// Bit i: whether lane i of a comparison holds.
inline unsigned lane_bits(Truth8 compared) {
#if defined(__SSE2__)
  const auto lanes = reinterpret_cast<__m128i>(compared);
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(lanes, _mm_setzero_si128())));
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= (static_cast<unsigned>(compared[i]) & 1U) << i;
  return bits;
#endif
}

}  // namespace cdfp
