/// Boxes of any size in tables of cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "contact/cell_table.hpp"

namespace cdfp {

/// Boxes in tables by size: level j holds those no longer than `base * 2^j` along any axis, each in the cell
/// of its lowest corner, so a query needs to reach back by one cell only.
class BoxLevels {
 public:
  void reset(const RoughBox& space, double base) {
    space_ = space, base_ = static_cast<float>(base);
    used_ = 0;
  }
  /// Takes the boxes larger by `grow` on all sides.
  void build(std::span<const RoughBox> boxes, float grow, bool open) {
    const auto box_of = [&](Index i) { return grown(boxes[i], grow); };
    const auto is_small = [&](const RoughBox& box) { return level_of(box) == 0; };
    if (make_level(boxes.size()).build_if_all(box_of, boxes.size(), is_small, open)) return;
    used_ = 0;
    for (std::vector<Index>& ids : by_level_) ids.clear();
    std::size_t levels = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::size_t level = level_of(box_of(static_cast<Index>(i)));
      if (by_level_.size() <= level) by_level_.resize(level + 1);
      by_level_[level].push_back(static_cast<Index>(i));
      levels = std::max(levels, level + 1);
    }
    while (used_ < levels) {
      const std::vector<Index>& ids = by_level_[used_];
      make_level(ids.size()).build(box_of, ids, open);
    }
  }
  /// What only `build` needs; it takes it anew.
  void give_back_room() {
    by_level_ = std::vector<std::vector<Index>>();
    for (CellTable<true>& level : levels_) level.give_back_room();
  }
  void insert(const RoughBox& box, Index id) {
    const std::size_t level = level_of(box);
    while (used_ <= level) make_level(0).build([](Index) { return RoughBox{}; }, {}, true);
    levels_[level].insert(box, id);
  }
  /// `look(cells, low)` into each level: the lowest corners of what overlaps `box` lie above `low`.
  template <class Look>
  void visit(const RoughBox& box, const Look& look) const {
    float length = base_;
    for (const CellTable<true>& level : std::span(levels_).first(used_)) {
      if (level.size() > 0) look(level.view(), box.low - 1.0001F * length);
      length *= 2;
    }
  }
  void archive(Archive& a) {
    a("levels.space", space_);
    a("levels.base", base_);
    a("levels.used", used_);
    if (levels_.size() < used_) levels_.resize(used_);
    for (std::size_t level = 0; level < used_; ++level) levels_[level].archive(a);
  }
  std::size_t memory() const {
    std::size_t bytes = 0;
    for (const auto& level : levels_) bytes += level.memory();
    for (const auto& ids : by_level_) bytes += ids.capacity() * sizeof(Index);
    return bytes;
  }

 private:
  std::size_t level_of(const RoughBox& box) const {
    const Float4 size = box.high - box.low;
    const float extent = std::max({size[0], size[1], size[2]});
    std::size_t level = 0;
    for (float length = base_; length < extent && level < 60; length *= 2) ++level;
    return level;
  }
  CellTable<true>& make_level(std::size_t boxes) {
    if (levels_.size() == used_) levels_.emplace_back();
    CellTable<true>& level = levels_[used_];
    level.reset(space_, std::ldexp(base_, static_cast<int>(used_)), boxes);
    ++used_;
    return level;
  }

  RoughBox space_{};
  float base_ = 1;
  std::vector<CellTable<true>> levels_;  // the first `used_` of them; the others keep their room
  std::size_t used_ = 0;
  std::vector<std::vector<Index>> by_level_;
};

}  // namespace cdfp
