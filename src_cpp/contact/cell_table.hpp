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
#include "contact/cells_view.hpp"
#include "contact/search_kernels.hpp"
#include "core/archive.hpp"
#include "core/lanes.hpp"

namespace cdfp {

/// Entries keep their places modulo 2^16 steps, so that many are looked at with each comparison. An entry is
/// in the slice of its lowest corner.
template <bool kBoxes>
class CellTable {
 public:
  using Place = std::conditional_t<kBoxes, RoughBox, Float4>;
  static constexpr std::size_t kSpare = CellsView<kBoxes>::kSpare;

  void reset(const RoughBox& space, float cell_length, std::size_t entities) {
    layout_ = CellLayout(space, cell_length, entities);
    first_.assign(layout_.size() + 2, 0);
    sorted_ = 0;
    late_.clear();
    links_.clear();
    added_ = 0;
  }

  /// Takes entries at once, ordered by slice, then as given: `ids[i]` is at `place_of(ids[i])`. `open`: more
  /// may be inserted later.
  template <class PlaceOf>
  void build(const PlaceOf& place_of, std::span<const Index> ids, bool open) {
    slot_.resize(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) count(i, place_of(ids[i]));
    sort(
        place_of, [&](std::size_t i) { return ids[i]; }, open);
  }
  /// The same for `place_of(0)` to `place_of(n - 1)`, `n` being the number given to `reset`; stops and
  /// returns false at the first that does not pass.
  template <class PlaceOf, class Passes>
  bool build_if_all(const PlaceOf& place_of, std::size_t n, const Passes& passes, bool open) {
    slot_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Place place = place_of(static_cast<Index>(i));
      if (!passes(place)) return false;
      count(i, place);
    }
    sort(
        place_of, [](std::size_t i) { return static_cast<Index>(i); }, open);
    return true;
  }

  /// Takes all points; `names[i]` becomes the node of the i-th point in the table.
  void build(const SearchKernels& kernels, std::span<const Float4> points, std::span<const Index> nodes,
             std::vector<Index>& names, bool open) {
    sorted_ = points.size();
    stride_ = sorted_ + kSpare;
    slot_.resize(sorted_);
    ids_.resize(stride_);
    names.resize(stride_);
    places_.resize(kFields * stride_);
    kernels.sort_points({layout_, points.data(), nodes.data(), sorted_, slot_.data(), first_.data(),
                         ids_.data(), names.data(), places_.data(), stride_});
    if (open) group_late_.assign(layout_.size() / kGroup, kNone);
  }

  /// What only `build` needs; it takes it anew.
  void give_back_room() { slot_ = std::vector<std::uint32_t>(); }

  void insert(const Place& place, Index id) {
    Index& head = group_late_[layout_.slot(lattice()(low_of(place))) / kGroup];
    if (head == kNone || links_[head].count == 16) {
      links_.push_back({head, 0});
      late_.resize(links_.size());
      head = static_cast<Index>(links_.size()) - 1;
    }
    const std::uint32_t at = links_[head].count++;
    put(place, &late_[head].places[at], 16);
    late_[head].ids[at] = id;
    ++added_;
  }

  void archive(Archive& a) {
    a("cells.layout", layout_);
    a("cells.first", first_);
    a("cells.places", places_);
    a("cells.stride", stride_);
    a("cells.ids", ids_);
    late_.archive(a, "cells.late");
    a("cells.links", links_);
    a("cells.group_late", group_late_);
    a("cells.sorted", sorted_);
    a("cells.added", added_);
  }

  std::size_t size() const { return sorted_ + added_; }
  std::size_t memory() const {
    return (first_.capacity() + slot_.capacity() + group_late_.capacity() + ids_.capacity()) * 4 +
           places_.capacity() * 2 + late_.memory() + links_.capacity() * sizeof(LateLink);
  }

  CellsView<kBoxes> view() const {
    return {layout_, first_.data(), places_.data(),     stride_,       ids_.data(), sorted_,
            late_,   links_.data(), group_late_.data(), links_.size(), added_};
  }
  const CellLayout& layout() const { return layout_; }
  /// What `build` took, ordered: those of slice s are [first()[s], first()[s + 1]).
  const std::uint32_t* first() const { return first_.data(); }
  const std::uint16_t* places() const { return places_.data(); }  ///< along x, then y, then z
  std::size_t stride() const { return stride_; }                  ///< from one of them to the next
  std::span<const Index> ids() const { return {ids_.data(), sorted_}; }

 private:
  void count(std::size_t i, const Place& place) {
    slot_[i] = layout_.slot(lattice()(low_of(place)));
    ++first_[slot_[i] + 2];
  }
  template <class PlaceOf, class IdOf>
  void sort(const PlaceOf& place_of, const IdOf& id_of, bool open) {
    sorted_ = slot_.size();
    stride_ = sorted_ + kSpare;
    for (std::uint32_t s = 0; s < layout_.size(); ++s) first_[s + 2] += first_[s + 1];
    ids_.resize(stride_);
    places_.resize(kFields * stride_);
    for (std::size_t i = 0; i < sorted_; ++i) {
      const Index id = id_of(i);
      const std::size_t at = first_[slot_[i] + 1]++;
      ids_[at] = id;
      put(place_of(id), &places_[at], stride_);
    }
    if (open) group_late_.assign(layout_.size() / kGroup, kNone);
  }

  static constexpr std::size_t kFields = cdfp::kFields<kBoxes>;
  static constexpr std::uint32_t kGroup = CellLayout::kGroup;

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

  CellLayout layout_;
  std::vector<std::uint32_t> first_;   // entries of a slice s: [first_[s], first_[s + 1])
  std::vector<std::uint16_t> places_;  // field after field
  std::size_t stride_ = 0;
  std::vector<Index> ids_;
  std::vector<std::uint32_t> slot_;
  LateList<kBoxes> late_;
  std::vector<LateLink> links_;
  std::vector<Index> group_late_;
  std::size_t sorted_ = 0, added_ = 0;
};

}  // namespace cdfp
