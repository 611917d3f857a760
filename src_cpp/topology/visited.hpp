/// The elements that a local search has met: few as a rule, but never more than linear time for many.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

class Visited {
 public:
  Visited() { first_.fill(kNone); }

  void clear() {
    first_.fill(kNone);
    table_.clear();
    count_ = 0;
  }

  bool contains(Index element) const {
    return table_.empty() ? in_first(element) : table_[slot(element)] == element;
  }

  /// False if the element was there already.
  bool insert(Index element) {
    if (table_.empty()) {
      if (in_first(element)) return false;
      if (count_ < kFirst) {
        first_[count_++] = element;
        return true;
      }
      rehash(8 * kFirst);
    } else if (2 * (count_ + 1) > table_.size()) {
      rehash(2 * table_.size());
    }
    const std::size_t at = slot(element);
    if (table_[at] == element) return false;
    table_[at] = element;
    ++count_;
    return true;
  }

 private:
  static constexpr std::size_t kFirst = 32;

  // Without an early exit the compiler compares several elements at once.
  bool in_first(Index element) const {
    const std::size_t end = (count_ + 7) / 8 * 8;
    int hits = 0;
    for (std::size_t i = 0; i < end; i += 8) {
      for (std::size_t j = 0; j < 8; ++j) hits |= first_[i + j] == element;
    }
    return hits != 0;
  }

  std::size_t slot(Index element) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = (static_cast<std::uint32_t>(element) * 0x9E3779B1u) >> (32 - std::bit_width(mask));
    while (table_[at] != kNone && table_[at] != element) at = (at + 1) & mask;
    return at;
  }

  void rehash(std::size_t size) {
    std::vector<Index> old(size, kNone);
    old.swap(table_);
    if (old.empty()) old.assign(first_.begin(), first_.end());
    for (const Index element : old) {
      if (element != kNone) table_[slot(element)] = element;
    }
  }

  std::array<Index, kFirst> first_;
  std::vector<Index> table_;  ///< open addressing, a power of two; in use beyond the first kFirst
  std::size_t count_ = 0;
};

}  // namespace cdfp
