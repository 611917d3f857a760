/// As many points side by side as the instruction set in use compares at once. For inclusion where CDFP_ISA
/// is set.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cdfp/types.hpp"
#include "core/lanes.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace cdfp::CDFP_ISA {

#if defined(__AVX512BW__) && defined(__AVX512VL__)

struct Wide {
  using Bits = std::uint32_t;
  static constexpr std::uint32_t kLanes = 32;

  /// Places from `low` to `high`, modulo 2^16, of points or boxes.
  template <bool kBoxes>
  struct Query {
    __m512i low[3], extent[3];
    Query() = default;
    CDFP_ALWAYS_INLINE Query(Int4 l, Int4 h) {
      const Int4 e = lesser(h - l, 65535 - Int4{});
      low[0] = low_words<0>(l), low[1] = low_words<1>(l), low[2] = low_words<2>(l);
      extent[0] = low_words<0>(e), extent[1] = low_words<1>(e), extent[2] = low_words<2>(e);
    }
    CDFP_ALWAYS_INLINE Bits overlap(const std::uint16_t* places, std::size_t stride) const {
      Bits bits = ~Bits{0};
      for (std::size_t d = 0; d < 3; ++d) {
        const __m512i at = _mm512_loadu_si512(places + d * stride);
        // Saturated, it reaches everywhere.
        const __m512i reach =
            kBoxes ? _mm512_adds_epu16(extent[d], _mm512_loadu_si512(places + (3 + d) * stride)) : extent[d];
        bits &= _mm512_cmple_epu16_mask(_mm512_sub_epi16(at, low[d]), reach);
      }
      return bits;
    }
    CDFP_ALWAYS_INLINE Bits overlap_sixteen(const std::uint16_t* places, std::size_t stride) const {
      __mmask16 bits = 0xFFFF;
      for (std::size_t d = 0; d < 3; ++d) {
        const __m256i at = load_sixteen(places + d * stride);
        const __m256i above = _mm256_sub_epi16(at, _mm512_castsi512_si256(low[d]));
        const __m256i most = _mm512_castsi512_si256(extent[d]);
        const __m256i reach =
            kBoxes ? _mm256_adds_epu16(most, load_sixteen(places + (3 + d) * stride)) : most;
        bits &= _mm256_cmple_epu16_mask(above, reach);
      }
      return bits;
    }
    /// Points that are two steps inside of it, or boxes that it is as far inside of, if it is one place.
    CDFP_ALWAYS_INLINE Bits well_inside(const std::uint16_t* places, std::size_t stride) const {
      Bits bits = ~Bits{0};
      for (std::size_t d = 0; d < 3; ++d) {
        const __m512i at = _mm512_sub_epi16(_mm512_loadu_si512(places + d * stride), low[d]);
        const __m512i room = kBoxes ? _mm512_loadu_si512(places + (3 + d) * stride) : extent[d];
        bits &= _mm512_cmplt_epu16_mask(_mm512_sub_epi16(at, _mm512_set1_epi16(2)),
                                        _mm512_subs_epu16(room, _mm512_set1_epi16(3)));
      }
      return bits;
    }
    CDFP_ALWAYS_INLINE Bits well_inside_sixteen(const std::uint16_t* places) const {
      __mmask16 bits = 0xFFFF;
      for (std::size_t d = 0; d < 3; ++d) {
        const __m256i at = _mm256_sub_epi16(load_sixteen(places + 16 * d), _mm512_castsi512_si256(low[d]));
        const __m256i room = kBoxes ? load_sixteen(places + 16 * (3 + d)) : _mm512_castsi512_si256(extent[d]);
        bits = _mm256_mask_cmplt_epu16_mask(bits, _mm256_sub_epi16(at, _mm256_set1_epi16(2)),
                                            _mm256_subs_epu16(room, _mm256_set1_epi16(3)));
      }
      return bits;
    }

   private:
    /// The lower half of lane `kLane` everywhere.
    template <int kLane>
    CDFP_ALWAYS_INLINE static __m512i low_words(Int4 v) {
      return _mm512_broadcastw_epi16(_mm_bsrli_si128(reinterpret_cast<__m128i>(v), 4 * kLane));
    }
    CDFP_ALWAYS_INLINE static __m256i load_sixteen(const std::uint16_t* places) {
      return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(places));
    }
  };
  /// The corners of a segment.
  struct Corners {
    __m512i corner[4];
    CDFP_ALWAYS_INLINE explicit Corners(const Index* corners) {
      for (int i = 0; i < 4; ++i) corner[i] = _mm512_set1_epi32(corners[i]);
    }
    CDFP_ALWAYS_INLINE Bits among(const Index* nodes) const {
      const __m512i first = _mm512_loadu_si512(nodes), last = _mm512_loadu_si512(nodes + 16);
      Bits of_first = 0, of_last = 0;
      for (int i = 0; i < 4; ++i) {
        of_first |= _mm512_cmpeq_epi32_mask(first, corner[i]);
        of_last |= _mm512_cmpeq_epi32_mask(last, corner[i]);
      }
      return of_first | of_last << 16;
    }
    CDFP_ALWAYS_INLINE Bits among_sixteen(const Index* nodes) const {
      const __m512i sixteen = _mm512_loadu_si512(nodes);
      Bits of_these = 0;
      for (const __m512i& c : corner) of_these |= _mm512_cmpeq_epi32_mask(sixteen, c);
      return of_these;
    }
  };
  /// Those whose bits are set, in order; writes up to `kLanes`.
  CDFP_ALWAYS_INLINE static void pick(const Index* ids, Bits bits, Index* to) {
    const auto first = static_cast<__mmask16>(bits), last = static_cast<__mmask16>(bits >> 16);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(first, _mm512_loadu_si512(ids)));
    if (last == 0) return;
    _mm512_storeu_si512(to + __builtin_popcount(first),
                        _mm512_maskz_compress_epi32(last, _mm512_loadu_si512(ids + 16)));
  }
  /// One more where bits are set; the others may be written too.
  CDFP_ALWAYS_INLINE static void count(Bits bits, std::uint32_t* counts) {
    const auto first = static_cast<__mmask16>(bits), last = static_cast<__mmask16>(bits >> 16);
    const auto add = [](__mmask16 mask, std::uint32_t* to) {
      const __m512i sum = _mm512_loadu_si512(to);
      _mm512_storeu_si512(to, _mm512_mask_add_epi32(sum, mask, sum, _mm512_set1_epi32(1)));
    };
    add(first, counts);
    if (last != 0) add(last, counts + 16);
  }
  CDFP_ALWAYS_INLINE static void pick_eight(const Index* ids, Bits bits, Index* to) {
    const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), eight));
  }
};

#elif defined(__AVX2__)

struct Wide {
  using Bits = std::uint32_t;
  static constexpr std::uint32_t kLanes = 16;

  template <bool kBoxes>
  struct Query {
    __m256i low[3], extent[3];
    Query() = default;
    CDFP_ALWAYS_INLINE Query(Int4 l, Int4 h) {
      const Int4 e = lesser(h - l, 65535 - Int4{});
      low[0] = low_words<0>(l), low[1] = low_words<1>(l), low[2] = low_words<2>(l);
      extent[0] = low_words<0>(e), extent[1] = low_words<1>(e), extent[2] = low_words<2>(e);
    }
    CDFP_ALWAYS_INLINE Bits overlap(const std::uint16_t* places, std::size_t stride) const {
      __m256i all = _mm256_set1_epi16(-1);
      for (std::size_t d = 0; d < 3; ++d) {
        const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(places + d * stride));
        const __m256i above = _mm256_sub_epi16(at, low[d]);
        __m256i reach = extent[d];
        if (kBoxes) {
          const auto* of_box = reinterpret_cast<const __m256i*>(places + (3 + d) * stride);
          reach = _mm256_adds_epu16(reach, _mm256_loadu_si256(of_box));  // saturated, it reaches everywhere
        }
        all = _mm256_and_si256(all, _mm256_cmpeq_epi16(_mm256_min_epu16(above, reach), above));
      }
      return bits_of(all);
    }
    CDFP_ALWAYS_INLINE Bits overlap_sixteen(const std::uint16_t* places, std::size_t stride) const {
      return overlap(places, stride);
    }
    CDFP_ALWAYS_INLINE Bits well_inside(const std::uint16_t* places, std::size_t stride) const {
      const auto load = [&](std::size_t field) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(places + field * stride));
      };
      __m256i any = _mm256_setzero_si256();
      for (std::size_t d = 0; d < 3; ++d) {
        const __m256i past = _mm256_sub_epi16(_mm256_sub_epi16(load(d), low[d]), _mm256_set1_epi16(2));
        const __m256i room = _mm256_subs_epu16(kBoxes ? load(3 + d) : extent[d], _mm256_set1_epi16(3));
        any = _mm256_or_si256(any, _mm256_cmpeq_epi16(_mm256_max_epu16(past, room), past));  // past >= room
      }
      return ~bits_of(any) & 0xFFFFU;
    }
    CDFP_ALWAYS_INLINE Bits well_inside_sixteen(const std::uint16_t* places) const {
      return well_inside(places, 16);
    }

   private:
    template <int kLane>
    CDFP_ALWAYS_INLINE static __m256i low_words(Int4 v) {
      return _mm256_broadcastw_epi16(_mm_bsrli_si128(reinterpret_cast<__m128i>(v), 4 * kLane));
    }
  };
  struct Corners {
    __m256i corner[4];
    CDFP_ALWAYS_INLINE explicit Corners(const Index* corners) {
      for (int i = 0; i < 4; ++i) corner[i] = _mm256_set1_epi32(corners[i]);
    }
    CDFP_ALWAYS_INLINE Bits among(const Index* nodes) const {
      return among_eight(nodes) | among_eight(nodes + 8) << 8;
    }
    CDFP_ALWAYS_INLINE Bits among_eight(const Index* nodes) const {
      const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(nodes));
      __m256i any = _mm256_cmpeq_epi32(eight, corner[0]);
      for (int i = 1; i < 4; ++i) any = _mm256_or_si256(any, _mm256_cmpeq_epi32(eight, corner[i]));
      return static_cast<Bits>(_mm256_movemask_ps(_mm256_castsi256_ps(any)));
    }
    CDFP_ALWAYS_INLINE Bits among_sixteen(const Index* nodes) const { return among(nodes); }
  };
  CDFP_ALWAYS_INLINE static void pick(const Index* ids, Bits bits, Index* to) {
    const Bits first = bits & 0xFFU;
    pick_eight(ids, first, to);
    if (bits >> 8 != 0) pick_eight(ids + 8, bits >> 8, to + __builtin_popcount(first));
  }

  CDFP_ALWAYS_INLINE static void count(Bits bits, std::uint32_t* counts) {
    const __m256i lanes = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    for (; bits != 0; bits >>= 8, counts += 8) {
      auto* const eight = reinterpret_cast<__m256i*>(counts);
      const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), lanes);
      _mm256_storeu_si256(eight, _mm256_sub_epi32(_mm256_loadu_si256(eight), _mm256_cmpeq_epi32(set, lanes)));
    }
  }
  CDFP_ALWAYS_INLINE static void pick_eight(const Index* ids, Bits bits, Index* to) {
    const __m256i lanes =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(kLaneLists[bits].lanes)));
    const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(eight, lanes));
  }

 private:
  CDFP_ALWAYS_INLINE static Bits bits_of(__m256i truth) {
    const __m256i bytes = _mm256_packs_epi16(truth, _mm256_setzero_si256());
    const auto bits = static_cast<Bits>(_mm256_movemask_epi8(bytes));
    return (bits & 0xFFU) | (bits >> 8 & 0xFF00U);
  }
};

#else

struct Wide {
  using Bits = std::uint32_t;
  static constexpr std::uint32_t kLanes = 8;

  template <bool kBoxes>
  struct Query {
    Short8 low[3], extent[3];
    Query() = default;
    CDFP_ALWAYS_INLINE Query(Int4 l, Int4 h) {
      const Int4 e = lesser(h - l, 65535 - Int4{});
      low[0] = low_half8<0>(l), low[1] = low_half8<1>(l), low[2] = low_half8<2>(l);
      extent[0] = low_half8<0>(e), extent[1] = low_half8<1>(e), extent[2] = low_half8<2>(e);
    }
    CDFP_ALWAYS_INLINE Bits overlap(const std::uint16_t* places, std::size_t stride) const {
      Truth8 all{};
      all = ~all;
      for (std::size_t d = 0; d < 3; ++d) {
        const Short8 above = load8(places + d * stride) - low[d];
        if (kBoxes) {
          const Short8 of_box = load8(places + (3 + d) * stride), reach = of_box + extent[d];
          all &= (above <= reach) | (reach < of_box);  // the sum ran over: it reaches everywhere
        } else {
          all &= above <= extent[d];
        }
      }
      return lane_bits(all);
    }
    CDFP_ALWAYS_INLINE Bits overlap_sixteen(const std::uint16_t* places, std::size_t stride) const {
      return overlap(places, stride) | overlap(places + 8, stride) << 8;
    }
    CDFP_ALWAYS_INLINE Bits well_inside(const std::uint16_t* places, std::size_t stride) const {
      Truth8 all{};
      all = ~all;
      for (std::size_t d = 0; d < 3; ++d) {
        const Short8 at = load8(places + d * stride) - low[d],
                     room = kBoxes ? load8(places + (3 + d) * stride) : extent[d];
        all &= (room > 3) & (static_cast<Short8>(at - 2) < static_cast<Short8>(room - 3));
      }
      return lane_bits(all);
    }
    CDFP_ALWAYS_INLINE Bits well_inside_sixteen(const std::uint16_t* places) const {
      return well_inside(places, 16) | well_inside(places + 8, 16) << 8;
    }
  };
  struct Corners {
    Int4 corner[4];
    CDFP_ALWAYS_INLINE explicit Corners(const Index* corners) {
      for (int i = 0; i < 4; ++i) corner[i] = corners[i] - Int4{};
    }
    CDFP_ALWAYS_INLINE Bits among(const Index* nodes) const {
      const Int4 first = load4(nodes), last = load4(nodes + 4);
      Int4 of_first{}, of_last{};
      for (int i = 0; i < 4; ++i) of_first |= first == corner[i], of_last |= last == corner[i];
      return lane_bits(of_first, of_last);
    }
    CDFP_ALWAYS_INLINE Bits among_sixteen(const Index* nodes) const {
      return among(nodes) | among(nodes + 8) << 8;
    }
  };
  CDFP_ALWAYS_INLINE static void pick(const Index* ids, Bits bits, Index* to) {
    pick_of_eight(ids, bits, to);
  }
  CDFP_ALWAYS_INLINE static void count(Bits bits, std::uint32_t* counts) {
    for (; bits != 0; bits &= bits - 1) ++counts[__builtin_ctz(bits)];
  }
  CDFP_ALWAYS_INLINE static void pick_eight(const Index* ids, Bits bits, Index* to) {
    pick_of_eight(ids, bits, to);
  }
};

#endif

}  // namespace cdfp::CDFP_ISA
