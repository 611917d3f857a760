/// Boxes of any size in tables of cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/cell_table.hpp"

namespace cdfp {

/// Boxes in tables by size: level j holds those no longer than `base * 2^j` along any axis, each in the cell
/// of its lowest corner, so a query needs to reach back by one cell only.
class BoxLevels {
 public:
  void reset(const RoughBox& space, double base) {
    space_ = space, base_ = static_cast<float>(base);
    levels_.clear();
  }
  void build(std::span<const RoughBox> boxes, bool open) {
    std::vector<std::vector<Index>> by_level;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::size_t level = level_of(boxes[i]);
      if (by_level.size() <= level) by_level.resize(level + 1);
      by_level[level].push_back(static_cast<Index>(i));
    }
    for (const std::vector<Index>& ids : by_level) {
      make_level(ids.size());
      levels_.back().build(boxes, ids, open);
    }
  }
  void insert(const RoughBox& box, Index id) {
    const std::size_t level = level_of(box);
    while (levels_.size() <= level) {
      make_level(0);
      levels_.back().build({}, {}, true);
    }
    levels_[level].insert(box, id);
  }
  /// `look(cells, low)` into each level: the lowest corners of what overlaps `box` lie above `low`.
  template <class Look>
  void visit(const RoughBox& box, const Look& look) const {
    float length = base_;
    for (const CellTable<true>& level : levels_) {
      if (level.size() > 0) look(level.view(), box.low - 1.0001F * length);
      length *= 2;
    }
  }
  std::size_t memory() const {
    std::size_t bytes = 0;
    for (const auto& level : levels_) bytes += level.memory();
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
  void make_level(std::size_t boxes) {
    const float length = std::ldexp(base_, static_cast<int>(levels_.size()));
    levels_.emplace_back();
    levels_.back().reset(space_, length, boxes);
  }

  RoughBox space_{};
  float base_ = 1;
  std::vector<CellTable<true>> levels_;
};

}  // namespace cdfp
