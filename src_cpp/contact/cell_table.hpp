/// Points or boxes by cells: one entry each, rows of cells side by side in a table of bounded length.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "cdfp/types.hpp"
#include "core/lanes.hpp"

namespace cdfp {

/// A box of space in single precision; the last lane means nothing. Rounding keeps the order of places, so
/// boxes that overlap in double precision overlap here.
struct RoughBox {
  Float4 low, high;
};

/// Space in whole steps from its lowest corner; what lies outside counts to the border.
class Lattice {
 public:
  Lattice() = default;
  Lattice(const RoughBox& space, float step) {
    for (int d = 0; d < 3; ++d) {
      per_step_[d] = 1 / step;
      first_[d] = std::floor(std::max(space.low[d] / step, -kFarthest));
      last_[d] = std::floor(std::clamp(space.high[d] / step - first_[d], 0.0F, 2 * kFarthest - 1));
    }
  }
  Int4 operator()(Float4 x) const {
    const Float4 steps = greater(x * per_step_ - first_, Float4{});
    return __builtin_convertvector(lesser(steps, last_), Int4);
  }
  Int4 last() const { return __builtin_convertvector(last_, Int4); }

 private:
  static constexpr float kFarthest = 1 << 23;  // single precision counts up to 2^24
  Float4 per_step_{}, first_{}, last_{};
};

/// The lanes that a bit mask of eight names, in order.
struct LaneList {
  std::array<std::uint8_t, 8> lanes{};
  std::uint32_t count = 0;
};
inline constexpr std::array<LaneList, 256> kLaneLists = [] {
  std::array<LaneList, 256> lists{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    for (std::uint8_t lane = 0; lane < 8; ++lane) {
      if (((mask >> lane) & 1U) != 0) lists[mask].lanes[lists[mask].count++] = lane;
    }
  }
  return lists;
}();

/// Entries keep their places modulo 2^16 steps, and eight are looked at with each comparison: a visit reports
/// all entries that overlap, and few others.
///
/// A cell is as long as `kCell` steps along y and z and is cut into slices along x. An entry is in the slice
/// of its lowest corner. If the space has more slices than a few an entity, rows are folded onto one another,
/// and an entry is checked for its row.
template <bool kBoxes>
class CellTable {
 public:
  static constexpr int kCell = 128;
  using Place = std::conditional_t<kBoxes, RoughBox, Float4>;

  void reset(const RoughBox& space, float cell_length, std::size_t entities) {
    lattice_ = Lattice(space, cell_length / kCell);
    const Int4 last = lattice_.last();
    const double slices = double((last[0] >> kSliceBits) + 1) * double((last[1] >> kCellBits) + 1) *
                          double((last[2] >> kCellBits) + 1);
    const std::size_t limit = std::max<std::size_t>(kSlicesAnEntity * entities, kShortest);
    folded_ = slices > static_cast<double>(limit);
    if (folded_) {
      size_ = static_cast<std::uint32_t>(std::bit_floor(limit));
      mask_ = size_ - 1;
      row_stride_ = 0x9E3779B1u;
      layer_stride_ = 0x85EBCA77u;
    } else {
      mask_ = ~0u;
      row_stride_ = ((static_cast<std::uint32_t>(last[0]) >> kSliceBits) / kGroup + 1) * kGroup;
      layer_stride_ = row_stride_ * ((static_cast<std::uint32_t>(last[1]) >> kCellBits) + 1);
      size_ = layer_stride_ * ((static_cast<std::uint32_t>(last[2]) >> kCellBits) + 1);
    }
    first_.assign(size_ + 2, 0);
    sorted_ = 0;
    chunks_.clear();
    added_ = 0;
  }

  /// Takes entries at once, ordered by slice, then as given: `ids[i]` is at `places[ids[i]]`. `open`: more
  /// may be inserted later.
  void build(std::span<const Place> places, std::span<const Index> ids, bool open) {
    sorted_ = ids.size();
    stride_ = sorted_ + 8;  // all eight of the last are looked at
    slot_.resize(sorted_);
    for (std::size_t i = 0; i < sorted_; ++i) {
      slot_[i] = slot(lattice_(low_of(places[ids[i]])));
      ++first_[slot_[i] + 2];
    }
    for (std::uint32_t s = 0; s < size_; ++s) first_[s + 2] += first_[s + 1];
    ids_.resize(stride_);
    places_.resize(kFields * stride_);
    for (std::size_t i = 0; i < sorted_; ++i) {
      const std::size_t at = first_[slot_[i] + 1]++;
      ids_[at] = ids[i];
      put(places[ids[i]], &places_[at], stride_);
    }
    if (open) group_chunk_.assign(size_ / kGroup, kNone);
  }

  void insert(const Place& place, Index id) {
    Index& head = group_chunk_[slot(lattice_(low_of(place))) / kGroup];
    if (head == kNone || chunks_[head].count == 8) {
      chunks_.push_back({});
      chunks_.back().next = head;
      head = static_cast<Index>(chunks_.size()) - 1;
    }
    Chunk& chunk = chunks_[head];
    put(place, &chunk.places[chunk.count], 8);
    chunk.ids[chunk.count++] = id;
    ++added_;
  }

  std::size_t size() const { return sorted_ + added_; }
  std::size_t memory() const {
    return (first_.capacity() + slot_.capacity() + group_chunk_.capacity() + ids_.capacity()) * 4 +
           places_.capacity() * 2 + chunks_.capacity() * sizeof(Chunk);
  }

  /// `report(ids)` with entries at most once each, and with every one that overlaps `box`; the span may be
  /// written to. The lowest corner of such an entry must lie in [low, box.high].
  template <class Report>
  void visit(Float4 low, const RoughBox& box, Report&& report) const {
    const Int4 from = lattice_(low), to = lattice_(box.high);
    const Query query(lattice_(box.low), to);
    const std::int32_t x0 = from[0] >> kSliceBits, y0 = from[1] >> kCellBits, z0 = from[2] >> kCellBits;
    const std::int32_t y1 = to[1] >> kCellBits, z1 = to[2] >> kCellBits;
    const auto length = static_cast<std::uint32_t>((to[0] >> kSliceBits) - x0 + 1);
    const bool told = y1 - y0 < kRowsTold && z1 - z0 < kRowsTold && length + kGroup <= size_;
    const std::int64_t rows = std::int64_t{y1 - y0 + 1} * (z1 - z0 + 1);
    Hits hits;
    if (!told || rows * (folded_ ? length : 1) > static_cast<std::int64_t>(size() + 8)) {
      const auto any = [](const Lanes&, unsigned lanes) { return lanes; };
      look_at({places_.data(), stride_, ids_.data()}, static_cast<std::uint32_t>(sorted_), query, any, hits,
              report);
      for (const Chunk& c : chunks_) look_at(lanes(c), c.count, query, any, hits, report);
      if (hits.count > 0) hits.give(report);
      return;
    }
    for (std::int32_t z = z0; z <= z1; ++z) {
      std::uint32_t row = static_cast<std::uint32_t>(y0) * row_stride_ +
                          static_cast<std::uint32_t>(z) * layer_stride_ + static_cast<std::uint32_t>(x0);
      for (std::int32_t y = y0; y <= y1; ++y, row += row_stride_) {
        const std::uint32_t begin = row & mask_, end = begin + length;
        if (!folded_) {
          scan(
              begin, end, query, [](const Lanes&, unsigned lanes) { return lanes; }, hits, report);
        } else {
          const auto in_row = [&](const Lanes& at, unsigned lanes) { return at.of_row(y, z, lanes); };
          scan(begin, std::min(end, size_), query, in_row, hits, report);
          if (end > size_) scan(0, end - size_, query, in_row, hits, report);
        }
      }
    }
    if (hits.count > 0) hits.give(report);
  }

 private:
  static constexpr int kFields = kBoxes ? 6 : 3;  // highest corner; boxes: and extent
  static constexpr int kCellBits = 7, kSliceBits = 4;
  static constexpr std::int32_t kRowsTold = 1 << (16 - kCellBits);  // rows that places modulo 2^16 tell apart
  static constexpr std::size_t kShortest = 256;
  static constexpr std::size_t kSlicesAnEntity = 2;
  static constexpr std::uint32_t kGroup = 8;  // slices that share added entries; all of one row
  static_assert(1 << kCellBits == kCell);

  struct Chunk {
    std::array<std::uint16_t, 8 * kFields> places;
    std::array<Index, 8> ids;
    Index next;
    std::uint32_t count;
  };

  struct Query {
    Short8 low[3], extent[3];
    Query(Int4 l, Int4 h) {
      const Int4 most = 65535 - Int4{};
      const Int4 e = lesser(h - l, most);
      low[0] = low_half8<0>(l), low[1] = low_half8<1>(l), low[2] = low_half8<2>(l);
      extent[0] = low_half8<0>(e), extent[1] = low_half8<1>(e), extent[2] = low_half8<2>(e);
    }
  };

  std::uint32_t slot(Int4 q) const {
    return ((static_cast<std::uint32_t>(q[0]) >> kSliceBits) +
            (static_cast<std::uint32_t>(q[1]) >> kCellBits) * row_stride_ +
            (static_cast<std::uint32_t>(q[2]) >> kCellBits) * layer_stride_) &
           mask_;
  }
  static Float4 low_of(Float4 point) { return point; }
  static Float4 low_of(const RoughBox& box) { return box.low; }
  void put(Float4 point, std::uint16_t* at, std::size_t stride) const {
    const Int4 q = lattice_(point);
    for (std::size_t d = 0; d < 3; ++d) at[d * stride] = static_cast<std::uint16_t>(q[d]);
  }
  void put(const RoughBox& box, std::uint16_t* at, std::size_t stride) const {
    put(box.high, at, stride);
    const Int4 extent = lattice_(box.high) - lattice_(box.low);
    for (std::size_t d = 0; d < 3; ++d) at[(3 + d) * stride] = static_cast<std::uint16_t>(extent[d]);
  }

  /// Where eight entries stand: a field is `stride` from the one before.
  struct Lanes {
    const std::uint16_t* places;
    std::size_t stride;
    const Index* ids;

    void next() { places += 8, ids += 8; }
    const std::uint16_t* field(std::size_t f) const { return places + f * stride; }
    unsigned overlap(const Query& query) const {
      Truth8 all{};
      all = ~all;
      for (std::size_t d = 0; d < 3; ++d) {
        const Short8 above = load8(field(d)) - query.low[d];
        if constexpr (kBoxes) {
          const Short8 extent = load8(field(3 + d)), reach = extent + query.extent[d];
          all &= (above <= reach) | (reach < extent);  // the sum ran over: it reaches everywhere
        } else {
          all &= above <= query.extent[d];
        }
      }
      return lane_bits(all);
    }
    unsigned of_row(std::int32_t y, std::int32_t z, unsigned lanes) const {
      unsigned in_row = 0;
      for (unsigned i = 0; i < 8; ++i) {
        const bool is_in = ((lowest(1, i) >> kCellBits) - y) % kRowsTold == 0 &&
                           ((lowest(2, i) >> kCellBits) - z) % kRowsTold == 0;
        in_row |= static_cast<unsigned>(is_in) << i;
      }
      return lanes & in_row;
    }
    std::uint16_t lowest(std::size_t d, std::size_t i) const {
      if constexpr (kBoxes) return field(d)[i] - field(3 + d)[i];
      return field(d)[i];
    }
  };

  /// Collected before they are given on: a branch at each candidate would be foretold wrongly too often.
  struct Hits {
    static constexpr std::size_t kMost = 256;
    std::array<Index, kMost> ids;
    std::size_t count = 0;

    void take(const Index* eight, unsigned lanes) {
      const LaneList& list = kLaneLists[lanes];
      Index* const to = ids.data() + count;
      for (int i = 0; i < 4; ++i) to[i] = eight[list.lanes[i]];
      if (list.count > 4) {
        for (int i = 4; i < 8; ++i) to[i] = eight[list.lanes[i]];
      }
      count += list.count;
    }
    template <class Report>
    void give(Report& report) {
      report(std::span<Index>(ids.data(), count));
      count = 0;
    }
  };

  template <class Filter, class Report>
  [[gnu::always_inline]] static inline void look_at(Lanes at, std::uint32_t count, const Query& query,
                                                    const Filter& filter, Hits& hits, Report& report) {
    for (; count > 0; at.next()) {
      unsigned lanes = at.overlap(query);
      const std::uint32_t taken = std::min(count, 8U);
      count -= taken;
      lanes &= 0xFFU >> (8 - taken);
      if (lanes == 0) continue;
      if (hits.count + 8 >= Hits::kMost) hits.give(report);
      hits.take(at.ids, filter(at, lanes));
    }
  }
  template <class Filter, class Report>
  [[gnu::always_inline]] inline void scan(std::uint32_t begin, std::uint32_t end, const Query& query,
                                          const Filter& filter, Hits& hits, Report& report) const {
    const std::uint32_t first = first_[begin];
    look_at({places_.data() + first, stride_, ids_.data() + first}, first_[end] - first, query, filter, hits,
            report);
    if (added_ > 0) scan_added(begin, end, query, filter, hits, report);
  }
  template <class Filter, class Report>
  void scan_added(std::uint32_t begin, std::uint32_t end, const Query& query, const Filter& filter,
                  Hits& hits, Report& report) const {
    for (std::uint32_t g = begin / kGroup; g <= (end - 1) / kGroup; ++g) {
      for (Index c = group_chunk_[g]; c != kNone; c = chunks_[c].next) {
        look_at(lanes(chunks_[c]), chunks_[c].count, query, filter, hits, report);
      }
    }
  }
  static Lanes lanes(const Chunk& chunk) { return {chunk.places.data(), 8, chunk.ids.data()}; }

  Lattice lattice_;
  bool folded_ = false;
  std::uint32_t mask_ = ~0u, row_stride_ = 1, layer_stride_ = 1, size_ = 0;
  std::vector<std::uint32_t> first_;   // entries of a slice s: [first_[s], first_[s + 1])
  std::vector<std::uint16_t> places_;  // field after field
  std::size_t stride_ = 0;
  std::vector<Index> ids_;
  std::vector<std::uint32_t> slot_;
  std::vector<Chunk> chunks_;  // entries that came later, by groups of slices
  std::vector<Index> group_chunk_;
  std::size_t sorted_ = 0, added_ = 0;
};

}  // namespace cdfp
