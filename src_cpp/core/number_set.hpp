/// A set of numbers below a bound, one bit each, that knows the place of each in their ascending list.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

class NumberSet {
 public:
  NumberSet() = default;
  explicit NumberSet(std::size_t bound) : words_((bound + 63) / 64, 0), before_(words_.size(), 0) {}

  /// Whether it was made for no number at all.
  bool is_void() const { return words_.empty(); }

  void clear() { std::fill(words_.begin(), words_.end(), 0); }
  /// Their places stand after `list`.
  void insert(Index number) { words_[word(number)] |= bit(number); }
  /// Appends its numbers, any of them in linear time.
  void list(std::vector<Index>& numbers) {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      before_[w] = static_cast<Index>(numbers.size());
      for (std::uint64_t bits = words_[w]; bits; bits &= bits - 1) {
        numbers.push_back(static_cast<Index>(64 * w) + std::countr_zero(bits));
      }
    }
  }

  /// Of an empty set: takes an ascending list.
  void take(std::span<const Index> numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (words_[word(numbers[i])] == 0) before_[word(numbers[i])] = static_cast<Index>(i);
      insert(numbers[i]);
    }
  }
  /// Empties a set that has taken this list.
  void drop(std::span<const Index> numbers) {
    for (const Index number : numbers) words_[word(number)] = 0;
  }

  /// In the list, or kNone.
  Index place(Index number) const {
    const std::uint64_t bits = words_[word(number)];
    if ((bits & bit(number)) == 0) return kNone;
    return before_[word(number)] + static_cast<Index>(std::popcount(bits & (bit(number) - 1)));
  }

 private:
  static std::size_t word(Index number) { return static_cast<std::size_t>(number) / 64; }
  static std::uint64_t bit(Index number) { return std::uint64_t{1} << (number % 64); }

  std::vector<std::uint64_t> words_;
  std::vector<Index> before_;  ///< numbers in words before each
};

}  // namespace cdfp
