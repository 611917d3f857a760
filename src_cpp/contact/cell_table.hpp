/// Points or boxes by cells: one entry each, rows of cells side by side in a table of bounded length.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "cdfp/types.hpp"
#include "contact/cell_layout.hpp"
#include "core/archive.hpp"
#include "core/lanes.hpp"

namespace cdfp {

/// Entries keep their places modulo 2^16 steps, and eight are looked at with each comparison: a visit reports
/// all entries that overlap, and few others. An entry is in the slice of its lowest corner.
template <bool kBoxes>
class CellTable {
 public:
  using Place = std::conditional_t<kBoxes, RoughBox, Float4>;
  /// Entries that may be looked at past the last.
  static constexpr std::size_t kSpare = 32;

  void reset(const RoughBox& space, float cell_length, std::size_t entities) {
    layout_ = CellLayout(space, cell_length, entities);
    first_.assign(layout_.size() + 2, 0);
    sorted_ = 0;
    chunks_.clear();
    added_ = 0;
  }

  /// Takes entries at once, ordered by slice, then as given: `ids[i]` is at `places[ids[i]]`. `open`: more
  /// may be inserted later.
  void build(std::span<const Place> places, std::span<const Index> ids, bool open) {
    sorted_ = ids.size();
    stride_ = sorted_ + kSpare;
    slot_.resize(sorted_);
    for (std::size_t i = 0; i < sorted_; ++i) {
      slot_[i] = layout_.slot(lattice()(low_of(places[ids[i]])));
      ++first_[slot_[i] + 2];
    }
    for (std::uint32_t s = 0; s < layout_.size(); ++s) first_[s + 2] += first_[s + 1];
    ids_.resize(stride_);
    places_.resize(kFields * stride_);
    for (std::size_t i = 0; i < sorted_; ++i) {
      const std::size_t at = first_[slot_[i] + 1]++;
      ids_[at] = ids[i];
      put(places[ids[i]], &places_[at], stride_);
    }
    if (open) group_chunk_.assign(layout_.size() / kGroup, kNone);
  }

  void insert(const Place& place, Index id) {
    Index& head = group_chunk_[layout_.slot(lattice()(low_of(place))) / kGroup];
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

  void archive(Archive& a) {
    a("cells.layout", layout_);
    a("cells.first", first_);
    a("cells.places", places_);
    a("cells.stride", stride_);
    a("cells.ids", ids_);
    a("cells.chunks", chunks_);
    a("cells.group_chunk", group_chunk_);
    a("cells.sorted", sorted_);
    a("cells.added", added_);
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
    const Int4 to = lattice()(box.high);
    const Query query(lattice()(box.low), to);
    const auto any = [](const Lanes&, unsigned lanes) { return lanes; };
    Hits hits;
    layout_.visit(
        lattice()(low), to, size(),
        [&](std::uint32_t begin, std::uint32_t end) { scan(begin, end, query, any, hits, report); },
        [&](std::uint32_t begin, std::uint32_t end, std::int32_t y, std::int32_t z) {
          const auto in_row = [&](const Lanes& at, unsigned lanes) { return at.of_row(y, z, lanes); };
          scan(begin, end, query, in_row, hits, report);
        },
        [&] {
          look_at({places_.data(), stride_, ids_.data()}, static_cast<std::uint32_t>(sorted_), query, any,
                  hits, report);
          for (const Chunk& c : chunks_) look_at(lanes(c), c.count, query, any, hits, report);
        });
    if (hits.count > 0) hits.give(report);
  }

  const CellLayout& layout() const { return layout_; }
  /// What `build` took, ordered: those of slice s are [first()[s], first()[s + 1]).
  const std::uint32_t* first() const { return first_.data(); }
  const std::uint16_t* places() const { return places_.data(); }  ///< along x, then y, then z
  std::size_t stride() const { return stride_; }                  ///< from one of them to the next
  std::span<const Index> ids() const { return {ids_.data(), sorted_}; }

 private:
  static constexpr int kFields = kBoxes ? 6 : 3;  // highest corner; boxes: and extent
  static constexpr std::uint32_t kGroup = CellLayout::kGroup;

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

  const Lattice& lattice() const { return layout_.lattice(); }
  static Float4 low_of(Float4 point) { return point; }
  static Float4 low_of(const RoughBox& box) { return box.low; }
  void put(Float4 point, std::uint16_t* at, std::size_t stride) const {
    const Int4 q = lattice()(point);
    for (std::size_t d = 0; d < 3; ++d) at[d * stride] = static_cast<std::uint16_t>(q[d]);
  }
  void put(const RoughBox& box, std::uint16_t* at, std::size_t stride) const {
    put(box.high, at, stride);
    const Int4 extent = lattice()(box.high) - lattice()(box.low);
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
        const bool is_in = CellLayout::is_row(lowest(1, i), y) && CellLayout::is_row(lowest(2, i), z);
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
      count += pick_of_eight(eight, lanes, ids.data() + count);
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

  CellLayout layout_;
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
