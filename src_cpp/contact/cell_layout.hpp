/// Where cells lie in space and in their table. Everything is inlined, as it is compiled for several
/// instruction sets.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/lanes.hpp"

namespace cdfp {

/// A box of space in single precision; the last lane means nothing. Rounding keeps the order of places, so
/// boxes that overlap in double precision overlap here.
struct RoughBox {
  Float4 low, high;
};

/// Larger on all sides by `by`, and enough for rounding.
CDFP_ALWAYS_INLINE RoughBox grown(const RoughBox& box, float by) {
  constexpr float kUlp = 1.2e-7F;
  const Float4 low = greater(box.low, -box.low), high = greater(box.high, -box.high);
  return {box.low - by - kUlp * low, box.high + by + kUlp * high};
}

/// Space in whole steps from `margin` steps before its lowest corner to as many past its highest; what lies
/// further outside counts to the last of them.
class Lattice {
 public:
  Lattice() = default;
  Lattice(const RoughBox& space, float step, float margin) {
    for (int d = 0; d < 3; ++d) {
      per_step_[d] = 1 / step;
      const float first = std::floor(std::max(space.low[d] / step, -kFarthest));
      first_[d] = first - margin;
      last_[d] = std::floor(std::clamp(space.high[d] / step - first, 0.0F, 2 * kFarthest - 1)) + 2 * margin;
    }
  }
  CDFP_ALWAYS_INLINE Int4 operator()(Float4 x) const {
    const Float4 steps = greater(x * per_step_ - first_, Float4{});
    return __builtin_convertvector(lesser(steps, last_), Int4);
  }
  Int4 last() const { return __builtin_convertvector(last_, Int4); }
  /// The same in parts: of max((x * per_step() - first()), 0), at most last_step(), what is whole.
  CDFP_ALWAYS_INLINE const Float4& per_step() const { return per_step_; }
  CDFP_ALWAYS_INLINE const Float4& first() const { return first_; }
  CDFP_ALWAYS_INLINE const Float4& last_step() const { return last_; }

 private:
  static constexpr float kFarthest = 1 << 23;  // single precision counts up to 2^24
  Float4 per_step_{}, first_{}, last_{};
};

/// A cell is as long as `kCell` steps along y and z and is cut into slices along x. If the space has more
/// slices than a few an entity, rows are folded onto one another.
class CellLayout {
 public:
  static constexpr int kCell = 128;
  static constexpr int kCellBits = 7, kSliceBits = 4;
  static constexpr std::int32_t kRowsTold = 1 << (16 - kCellBits);  // rows that places modulo 2^16 tell apart
  static constexpr std::uint32_t kGroup = 8;  // slices that share added entries; all of one row
  static_assert(1 << kCellBits == kCell);

  CellLayout() = default;
  CellLayout(const RoughBox& space, float cell_length, std::size_t entities)
      : lattice_(space, cell_length / kCell, 0), last_(lattice_.last()) {
    const Int4 last = last_;
    const std::int32_t farthest = std::max({last[0], last[1], last[2]});
    tells_ = farthest < 65535;
    const double slices = double((last[0] >> kSliceBits) + 1) * double((last[1] >> kCellBits) + 1) *
                          double((last[2] >> kCellBits) + 1);
    const std::size_t limit = std::max<std::size_t>(kSlicesAnEntity * entities, kShortest);
    flat_ = slices <= static_cast<double>(limit) && (last[1] >> kCellBits) < kRowsTold &&
            (last[2] >> kCellBits) < kRowsTold;
    if (!flat_) {
      size_ = static_cast<std::uint32_t>(std::bit_floor(limit));
      mask_ = size_ - 1;
      row_stride_ = 0x9E3779B1u;
      layer_stride_ = 0x85EBCA77u;
    } else {
      mask_ = ~0u;
      row_stride_ = ((static_cast<std::uint32_t>(last[0]) >> kSliceBits) / kGroup + 1) * kGroup;
      layer_stride_ = row_stride_ * ((static_cast<std::uint32_t>(last[1]) >> kCellBits) + 1);
      size_ = layer_stride_ * ((static_cast<std::uint32_t>(last[2]) >> kCellBits) + 1);
      if (farthest < 65535 - 2 * kMargin) {
        lattice_ = Lattice(space, cell_length / kCell, kMargin);
        margin_ = kMargin - Int4{};
      }
    }
  }
  CDFP_ALWAYS_INLINE const Lattice& lattice() const { return lattice_; }
  /// How many slices the table has.
  std::uint32_t size() const { return size_; }
  /// Whether places modulo 2^16 tell where a point of space is.
  CDFP_ALWAYS_INLINE bool tells() const { return tells_; }
  /// Whether a place along y or z is in a row, as far as places modulo 2^16 tell.
  CDFP_ALWAYS_INLINE static bool is_row(std::uint16_t place, std::int32_t row) {
    return ((place >> kCellBits) - row) % kRowsTold == 0;
  }
  /// Cells have no margin.
  CDFP_ALWAYS_INLINE Int4 in_cells(Int4 place) const {
    return lesser(greater(place - margin_, Int4{}), last_);
  }
  CDFP_ALWAYS_INLINE const Int4& margin() const { return margin_; }
  CDFP_ALWAYS_INLINE const Int4& last_in_cells() const { return last_; }
  CDFP_ALWAYS_INLINE std::uint32_t slot(Int4 of_lattice) const {
    const Int4 place = in_cells(of_lattice);
    return ((static_cast<std::uint32_t>(place[0]) >> kSliceBits) +
            (static_cast<std::uint32_t>(place[1]) >> kCellBits) * row_stride_ +
            (static_cast<std::uint32_t>(place[2]) >> kCellBits) * layer_stride_) &
           mask_;
  }

  /// `scan(begin, end)`, or `scan_row(begin, end, y, z)` where other rows may lie in the same slices, over
  /// all slices of [from, to]; `everything()` if that would take longer than to look at all `entities`.
  template <class Scan, class ScanRow, class Everything>
  CDFP_ALWAYS_INLINE void visit(Int4 from, Int4 to, std::size_t entities, const Scan& scan,
                                const ScanRow& scan_row, const Everything& everything) const {
    visit_cells(in_cells(from), in_cells(to), entities, scan, scan_row, everything);
  }
  /// The same without the margin, and only where that takes `scan` alone; returns whether it does.
  template <class Scan>
  CDFP_ALWAYS_INLINE bool visit_flat(Int4 low, Int4 high, std::size_t entities, const Scan& scan) const {
    const Int4 first_cell = low >> kCellBits, last_cell = high >> kCellBits;
    const auto x0 = static_cast<std::uint32_t>(low[0] >> kSliceBits);
    const std::uint32_t length = static_cast<std::uint32_t>(high[0] >> kSliceBits) - x0 + 1;
    const std::int32_t in_layer = last_cell[1] - first_cell[1] + 1;
    std::int32_t layers = last_cell[2] - first_cell[2] + 1;
    // In a flat table there are fewer than `kRowsTold` of either.
    if (!flat_ || static_cast<std::uint32_t>(in_layer * layers) > entities + 8) return false;
    std::uint32_t layer = static_cast<std::uint32_t>(first_cell[1]) * row_stride_ +
                          static_cast<std::uint32_t>(first_cell[2]) * layer_stride_ + x0;
    for (; layers > 0; --layers, layer += layer_stride_) {
      std::uint32_t row = layer;
      for (std::int32_t y = in_layer; y > 0; --y, row += row_stride_) scan(row, row + length);
    }
    return true;
  }
  /// The same without the margin.
  template <class Scan, class ScanRow, class Everything>
  CDFP_ALWAYS_INLINE void visit_cells(Int4 low, Int4 high, std::size_t entities, const Scan& scan,
                                      const ScanRow& scan_row, const Everything& everything) const {
    if (visit_flat(low, high, entities, scan)) return;
    if (flat_) return everything();
    const Int4 first_cell = low >> kCellBits, last_cell = high >> kCellBits;
    const auto x0 = static_cast<std::uint32_t>(low[0] >> kSliceBits);
    const std::uint32_t length = static_cast<std::uint32_t>(high[0] >> kSliceBits) - x0 + 1;
    const std::int32_t y0 = first_cell[1], z0 = first_cell[2], y1 = last_cell[1], z1 = last_cell[2];
    const auto rows = static_cast<std::uint64_t>(y1 - y0 + 1) * static_cast<std::uint64_t>(z1 - z0 + 1);
    std::uint32_t layer =
        static_cast<std::uint32_t>(y0) * row_stride_ + static_cast<std::uint32_t>(z0) * layer_stride_ + x0;
    const bool told = y1 - y0 < kRowsTold && z1 - z0 < kRowsTold && length + kGroup <= size_;
    if (!told || rows * length > entities + 8) return everything();
    for (std::int32_t z = z0; z <= z1; ++z, layer += layer_stride_) {
      std::uint32_t row = layer;
      for (std::int32_t y = y0; y <= y1; ++y, row += row_stride_) {
        const std::uint32_t begin = row & mask_, end = begin + length;
        scan_row(begin, end < size_ ? end : size_, y, z);
        if (end > size_) scan_row(0, end - size_, y, z);
      }
    }
  }

 private:
  static constexpr std::size_t kShortest = 256;
  static constexpr std::size_t kSlicesAnEntity = 2;
  /// Steps outside of space that are told apart, so that a box that reaches beyond surely holds its border.
  static constexpr std::int32_t kMargin = 4;

  Lattice lattice_;
  Int4 margin_{}, last_{};
  bool flat_ = false, tells_ = false;
  std::uint32_t mask_ = ~0u, row_stride_ = 1, layer_stride_ = 1, size_ = 0;
};

}  // namespace cdfp
