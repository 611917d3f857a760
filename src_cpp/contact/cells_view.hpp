/// What a table of cells holds, laid out for those that look into it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cdfp/contact.hpp"
#include "contact/cell_layout.hpp"

namespace cdfp {

/// Highest corner of an entry, in steps modulo 2^16; of a box also its extent.
template <bool kBoxes>
inline constexpr std::size_t kFields = kBoxes ? 6 : 3;

/// Sixteen entries that came after the table was built, field after field.
template <bool kBoxes>
struct alignas(32) LateEntries {
  std::array<std::uint16_t, 16 * kFields<kBoxes>> places;
  std::array<Index, 16> ids;
};
template <bool kBoxes>
using LateList = GrowingList<LateEntries<kBoxes>, 6>;
struct LateLink {
  Index next;
  std::uint32_t count;  ///< of the sixteen
};

/// Arrays of entries may be read `kSpare` past their end.
template <bool kBoxes>
struct CellsView {
  static constexpr std::size_t kSpare = 32;

  const CellLayout& layout;
  const std::uint32_t* first;   ///< entries of slice s: [first[s], first[s + 1])
  const std::uint16_t* places;  ///< field after field
  std::size_t stride;           ///< from one of them to the next
  const Index* ids;
  std::size_t sorted;
  const LateList<kBoxes>& late;  ///< by groups of slices, the newest first
  const LateLink* links;
  const Index* group_late;
  std::size_t late_blocks, late_count;
};

/// What was found, in order. A count past the room says that there was not enough of it.
struct FoundIds {
  Index* ids;
  std::size_t count, room;
  bool full() const { return count > room; }
};

/// The same for entries of a table, by their places there.
struct FoundPlaces {
  PairRows::Places* places;
  std::size_t count, room;
};

}  // namespace cdfp
