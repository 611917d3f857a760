/// A few small numbers side by side, for rough tests that look at many at once. Needs no more than what every
/// x86-64 has.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/// For code that is compiled for several instruction sets: no copy of its own is left that the linker could
/// share.
#define CDFP_ALWAYS_INLINE [[gnu::always_inline]] inline

namespace cdfp {

typedef double Double2 __attribute__((vector_size(16)));
typedef float Float4 __attribute__((vector_size(16)));
typedef std::int32_t Int4 __attribute__((vector_size(16)));
typedef std::uint16_t Short8 __attribute__((vector_size(16)));
typedef std::int16_t Truth8 __attribute__((vector_size(16)));

template <class Lanes>
CDFP_ALWAYS_INLINE Lanes lesser(Lanes a, Lanes b) {
  return a < b ? a : b;
}
template <class Lanes>
CDFP_ALWAYS_INLINE Lanes greater(Lanes a, Lanes b) {
  return a > b ? a : b;
}
CDFP_ALWAYS_INLINE bool any_equal(Int4 a, Int4 b) {
  const Int4 equal = a == b;
#if defined(__SSE2__)
  return _mm_movemask_epi8(reinterpret_cast<__m128i>(equal)) != 0;
#else
  return (equal[0] | equal[1] | equal[2] | equal[3]) != 0;
#endif
}
CDFP_ALWAYS_INLINE Short8 load8(const std::uint16_t* p) {
  Short8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
/// The lower half of lane `kLane`, eight times.
template <int kLane>
CDFP_ALWAYS_INLINE Short8 low_half8(Int4 v) {
  return __builtin_shufflevector(reinterpret_cast<Short8>(v), Short8{}, 2 * kLane, 2 * kLane, 2 * kLane,
                                 2 * kLane, 2 * kLane, 2 * kLane, 2 * kLane, 2 * kLane);
}
CDFP_ALWAYS_INLINE Int4 load4(const std::int32_t* p) {
  Int4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
/// Bit i: whether lane i of a comparison holds.
CDFP_ALWAYS_INLINE unsigned lane_bits(Int4 first, Int4 last) {
#if defined(__SSE2__)
  const __m128i halves = _mm_packs_epi32(reinterpret_cast<__m128i>(first), reinterpret_cast<__m128i>(last));
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(halves, _mm_setzero_si128())));
#else
  unsigned bits = 0;
  for (int i = 0; i < 4; ++i) {
    bits |= (static_cast<unsigned>(first[i]) & 1U) << i | (static_cast<unsigned>(last[i]) & 1U) << (i + 4);
  }
  return bits;
#endif
}
CDFP_ALWAYS_INLINE unsigned lane_bits(Truth8 compared) {
#if defined(__SSE2__)
  const auto lanes = reinterpret_cast<__m128i>(compared);
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(lanes, _mm_setzero_si128())));
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= (static_cast<unsigned>(compared[i]) & 1U) << i;
  return bits;
#endif
}

/// The lanes that a bit mask of eight names, in order.
struct LaneList {
  std::uint8_t lanes[8]{};
  std::uint32_t count = 0;
};
struct LaneLists {
  LaneList lists[256];
  constexpr LaneLists() {
    for (unsigned mask = 0; mask < 256; ++mask) {
      for (std::uint8_t lane = 0; lane < 8; ++lane) {
        if (((mask >> lane) & 1U) != 0) lists[mask].lanes[lists[mask].count++] = lane;
      }
    }
  }
  CDFP_ALWAYS_INLINE const LaneList& operator[](unsigned mask) const { return lists[mask]; }
};
inline constexpr LaneLists kLaneLists;

/// Writes those of eight numbers that the bits name to `to`, which has room for eight; returns how many they
/// are.
CDFP_ALWAYS_INLINE std::uint32_t pick_of_eight(const std::int32_t* eight, unsigned bits, std::int32_t* to) {
  const LaneList& list = kLaneLists[bits];
  for (int i = 0; i < 4; ++i) to[i] = eight[list.lanes[i]];
  if (list.count > 4) {
    for (int i = 4; i < 8; ++i) to[i] = eight[list.lanes[i]];
  }
  return list.count;
}

}  // namespace cdfp
