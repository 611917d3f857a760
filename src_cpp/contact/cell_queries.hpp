/// Looks into a table of cells. For inclusion where CDFP_ISA is set.
#pragma once

#include "contact/cells_view.hpp"
#include "contact/wide.hpp"

namespace cdfp::CDFP_ISA {

/// Takes whatever overlaps.
struct NoDoubt {
  CDFP_ALWAYS_INLINE Wide::Bits sure(const std::uint16_t*, std::size_t) const { return ~Wide::Bits{0}; }
  CDFP_ALWAYS_INLINE Wide::Bits sure_sixteen(const std::uint16_t*) const { return ~Wide::Bits{0}; }
  CDFP_ALWAYS_INLINE bool passes(Index) const { return true; }
};

/// `Doubt`: tells which entries are in beyond doubt, and whether another one passes.
template <bool kBoxes, class Doubt>
struct CellQuery {
  const CellsView<kBoxes>& cells;
  FoundIds& found;
  Wide::Query<kBoxes> query;
  const Doubt& doubt;

  template <class Filter>
  CDFP_ALWAYS_INLINE void scan_sorted(std::uint32_t at, std::uint32_t end, const Filter& filter) {
    for (; at < end; at += Wide::kLanes) {
      const std::uint16_t* const places = cells.places + at;
      Wide::Bits bits = query.overlap(places, cells.stride);
      const std::uint32_t left = end - at;
      if (left < Wide::kLanes) bits &= (Wide::Bits{1} << left) - 1;
      if (bits == 0) continue;
      filter(places, cells.stride, bits);
      settle(cells.ids + at, bits & ~doubt.sure(places, cells.stride), bits);
      if (!has_room()) return;
      Wide::pick(cells.ids + at, bits, found.ids + found.count);
      found.count += static_cast<std::size_t>(__builtin_popcount(bits));
    }
  }
  template <class Filter>
  CDFP_ALWAYS_INLINE void look_at_late(Index block, const Filter& filter) {
    const LateEntries<kBoxes>& late = cells.late[static_cast<std::size_t>(block)];
    const std::uint16_t* const places = late.places.data();
    Wide::Bits bits = query.overlap_sixteen(places, 16) & (0xFFFFU >> (16 - cells.links[block].count));
    if (bits == 0) return;
    filter(places, 16, bits);
    settle(late.ids.data(), bits & ~doubt.sure_sixteen(places), bits);
    if (!has_room()) return;
    take_eight(late.ids.data() + 8, bits >> 8);
    take_eight(late.ids.data(), bits & 0xFFU);
  }
  CDFP_ALWAYS_INLINE void take_eight(const Index* ids, Wide::Bits bits) {
    Wide::pick_eight(ids, bits, found.ids + found.count);
    found.count += static_cast<std::size_t>(__builtin_popcount(bits));
  }
  CDFP_ALWAYS_INLINE void settle(const Index* ids, Wide::Bits doubtful, Wide::Bits& bits) {
    for (; doubtful != 0; doubtful &= doubtful - 1) {
      if (!doubt.passes(ids[__builtin_ctz(doubtful)])) bits &= ~(doubtful & -doubtful);
    }
  }
  template <class Filter>
  CDFP_ALWAYS_INLINE void scan(std::uint32_t begin, std::uint32_t end, const Filter& filter) {
    scan_sorted(cells.first[begin], cells.first[end], filter);
    if (cells.late_count == 0) return;
    for (std::uint32_t g = begin / CellLayout::kGroup; g <= (end - 1) / CellLayout::kGroup; ++g) {
      for (Index block = cells.group_late[g]; block != kNone; block = cells.links[block].next) {
        look_at_late(block, filter);
      }
    }
  }
  CDFP_ALWAYS_INLINE bool has_room() {
    if (found.count + kMostAtOnce <= found.room) return true;
    found.count = found.room + 1;
    return false;
  }

 private:
  static constexpr std::size_t kMostAtOnce = 32;
};

template <bool kBoxes>
CDFP_ALWAYS_INLINE bool in_row(const std::uint16_t* places, std::size_t stride, std::int32_t y,
                               std::int32_t z) {
  std::uint16_t at_y = places[stride], at_z = places[2 * stride];
  if (kBoxes) at_y -= places[4 * stride], at_z -= places[5 * stride];
  return CellLayout::is_row(at_y, y) && CellLayout::is_row(at_z, z);
}

/// Adds the entries that overlap `box`, and few others, each once. Their lowest corners lie in [low,
/// box.high].
template <bool kBoxes, class Doubt>
CDFP_ALWAYS_INLINE void find(const CellsView<kBoxes>& cells, Float4 low, const RoughBox& box,
                             const Doubt& doubt, FoundIds& found_ids) {
  // A copy, which nothing that is written can alias.
  FoundIds found = found_ids;
  const CellLayout& layout = cells.layout;
  const Int4 to = layout.lattice()(box.high);
  CellQuery<kBoxes, Doubt> query{cells, found, {layout.lattice()(box.low), to}, doubt};
  const auto any = [](const std::uint16_t*, std::size_t, Wide::Bits&) {};
  layout.visit(
      layout.lattice()(low), to, cells.sorted + cells.late_count,
      [&](std::uint32_t begin, std::uint32_t end) { query.scan(begin, end, any); },
      [&](std::uint32_t begin, std::uint32_t end, std::int32_t y, std::int32_t z) {
        query.scan(begin, end, [&](const std::uint16_t* places, std::size_t stride, Wide::Bits& bits) {
          for (Wide::Bits rest = bits; rest != 0; rest &= rest - 1) {
            if (!in_row<kBoxes>(places + __builtin_ctz(rest), stride, y, z)) bits &= ~(rest & -rest);
          }
        });
      },
      [&] {
        query.scan_sorted(0, static_cast<std::uint32_t>(cells.sorted), any);
        for (std::size_t block = 0; block < cells.late_blocks; ++block) {
          query.look_at_late(static_cast<Index>(block), any);
        }
      });
  found_ids.count = found.count;
}

}  // namespace cdfp::CDFP_ISA
