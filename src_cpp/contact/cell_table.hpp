/// Entities by cells: one entry each, rows of cells side by side in a table of bounded length.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

using Corner = std::array<double, 3>;

struct PointEntry {
  Corner place;
  Index id;
  const Corner& key() const { return place; }
};

struct BoxEntry {
  Corner low, high;
  Index id;
  const Corner& key() const { return low; }
};

inline bool overlap(const Corner& low_a, const Corner& high_a, const Corner& low_b, const Corner& high_b) {
  // All six at once: a branch for each would be foretold wrongly too often.
  const int apart = int(low_a[0] > high_b[0]) | int(low_b[0] > high_a[0]) | int(low_a[1] > high_b[1]) |
                    int(low_b[1] > high_a[1]) | int(low_a[2] > high_b[2]) | int(low_b[2] > high_a[2]);
  return apart == 0;
}

/// Cells of one length over a box of space; what lies outside counts to the border cells. If the space has
/// more slices of cells than four an entity, rows are folded onto one another, and an entry is checked for
/// its row.
template <class Entry>
class CellTable {
 public:
  void reset(const Corner& low, const Corner& high, double length, std::size_t entities) {
    origin_ = low;
    per_length_ = {kSlices / length, 1 / length, 1 / length};
    double cells = 1;
    for (int d = 0; d < 3; ++d) {
      const double n = std::min((high[d] - low[d]) * per_length_[d] + 1, double(kMostCells));
      count_[d] = static_cast<std::int32_t>(n);
      cells *= count_[d];
    }
    const std::size_t limit = std::max<std::size_t>(kSlices * entities, kShortest);
    folded_ = cells > static_cast<double>(limit);
    if (folded_) {
      std::size_t size = kShortest;
      while (2 * size < limit) size *= 2;
      mask_ = static_cast<std::uint32_t>(size - 1);
      row_stride_ = 0x9E3779B1u;
      layer_stride_ = 0x85EBCA77u;
      size_ = static_cast<std::uint32_t>(size);
    } else {
      mask_ = ~0u;
      row_stride_ = static_cast<std::uint32_t>(count_[0]);
      layer_stride_ = row_stride_ * static_cast<std::uint32_t>(count_[1]);
      size_ = static_cast<std::uint32_t>(cells);
    }
    first_.assign(size_ + 1, 0);
    sorted_.clear();
    added_.clear();
    added_next_.clear();
  }

  /// Takes all entries at once, ordered by cell, then as given. `open`: entries may be inserted later.
  void build(std::span<const Entry> entries, bool open) {
    slot_.resize(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
      slot_[i] = slot(entries[i].key());
      ++first_[slot_[i] + 1];
    }
    for (std::uint32_t s = 0; s < size_; ++s) first_[s + 1] += first_[s];
    sorted_.resize(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) sorted_[first_[slot_[i]]++] = entries[i];
    for (std::uint32_t s = size_; s > 0; --s) first_[s] = first_[s - 1];
    first_[0] = 0;
    if (open) added_head_.assign(size_, kNone);
  }

  void insert(const Entry& entry) {
    const std::uint32_t s = slot(entry.key());
    added_next_.push_back(added_head_[s]);
    added_head_[s] = static_cast<Index>(added_.size());
    added_.push_back(entry);
  }

  std::size_t size() const { return sorted_.size() + added_.size(); }
  std::size_t memory() const {
    return (first_.capacity() + slot_.capacity() + added_next_.capacity() + added_head_.capacity()) * 4 +
           (sorted_.capacity() + added_.capacity()) * sizeof(Entry);
  }

  /// `report(entry)` once for every entry that passes `test`; a passing entry's key must lie in [low, high].
  template <class Test, class Report>
  void visit(const Corner& low, const Corner& high, Test&& test, Report&& report) const {
    const std::int32_t x0 = cell(low[0], 0), x1 = cell(high[0], 0);
    const std::int32_t y0 = cell(low[1], 1), y1 = cell(high[1], 1);
    const std::int32_t z0 = cell(low[2], 2), z1 = cell(high[2], 2);
    const double rows = double(y1 - y0 + 1) * double(z1 - z0 + 1);
    const double length = double(x1) - x0 + 1;
    if (rows * (folded_ ? length : 1.0) > static_cast<double>(size() + 8) || length > size_) {
      for (const Entry& e : sorted_) {
        if (test(e)) report(e);
      }
      for (const Entry& e : added_) {
        if (test(e)) report(e);
      }
      return;
    }
    for (std::int32_t z = z0; z <= z1; ++z) {
      for (std::int32_t y = y0; y <= y1; ++y) {
        const std::uint32_t row =
            static_cast<std::uint32_t>(y) * row_stride_ + static_cast<std::uint32_t>(z) * layer_stride_;
        const std::uint32_t begin = (row + static_cast<std::uint32_t>(x0)) & mask_;
        const std::uint32_t end = begin + static_cast<std::uint32_t>(x1 - x0 + 1);
        if (!folded_) {
          scan(begin, end, test, report);
        } else {
          const auto here = [&](const Entry& e) {
            return test(e) && cell(e.key()[1], 1) == y && cell(e.key()[2], 2) == z;
          };
          scan(begin, std::min(end, size_), here, report);
          if (end > size_) scan(0, end - size_, here, report);
        }
      }
    }
  }

 private:
  static constexpr std::int32_t kMostCells = 1 << 30;
  static constexpr std::size_t kShortest = 256;
  static constexpr std::int32_t kSlices = 4;  // of a cell along its row: slices side by side cost no look-up

  std::int32_t cell(double x, int d) const {
    const double c = (x - origin_[d]) * per_length_[d];
    return c > 0 ? static_cast<std::int32_t>(std::min(c, double(count_[d] - 1))) : 0;
  }
  std::uint32_t slot(const Corner& x) const {
    return (static_cast<std::uint32_t>(cell(x[0], 0)) +
            static_cast<std::uint32_t>(cell(x[1], 1)) * row_stride_ +
            static_cast<std::uint32_t>(cell(x[2], 2)) * layer_stride_) &
           mask_;
  }
  template <class Test, class Report>
  void scan(std::uint32_t begin, std::uint32_t end, Test&& test, Report&& report) const {
    const Entry* const last = sorted_.data() + first_[end];
    for (const Entry* e = sorted_.data() + first_[begin]; e != last; ++e) {
      if (test(*e)) report(*e);
    }
    if (added_.empty()) return;
    for (std::uint32_t s = begin; s < end; ++s) {
      for (Index i = added_head_[s]; i != kNone; i = added_next_[i]) {
        if (test(added_[i])) report(added_[i]);
      }
    }
  }

  Corner origin_{};
  Corner per_length_{1, 1, 1};
  std::array<std::int32_t, 3> count_{1, 1, 1};
  bool folded_ = false;
  std::uint32_t mask_ = ~0u, row_stride_ = 1, layer_stride_ = 1, size_ = 0;
  std::vector<Index> first_;  // (size + 1): entries of a slot
  std::vector<Entry> sorted_;
  std::vector<std::uint32_t> slot_;
  std::vector<Entry> added_;
  std::vector<Index> added_next_, added_head_;
};

}  // namespace cdfp
