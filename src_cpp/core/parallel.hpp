/// Loops over threads whose results do not depend on how many there are: each index is worked on once and
/// writes only what is its own; sums are taken afterwards in index order.
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstdint>

#include "core/shares.hpp"

namespace cdfp {

/// The threads that a simulation may use. 0 asks for as many as the machine has.
class Threads {
 public:
  explicit Threads(int count = 1) : count_(count > 0 ? count : omp_get_num_procs()) {}
  int count() const { return count_; }

  /// `body(i)` for every i in [0, n), in contiguous shares. The body must not throw.
  template <class Body>
  void for_each(std::int64_t n, Body&& body) const {
    if (count_ == 1 || n < 2) {
      for (std::int64_t i = 0; i < n; ++i) body(i);
      return;
    }
#pragma omp parallel for schedule(static) num_threads(count_)
    for (std::int64_t i = 0; i < n; ++i) body(i);
  }

  /// `body(begin, end)` over pieces of `grain` indices: the pieces are the same for any number of threads.
  template <class Body>
  void for_ranges(std::int64_t n, std::int64_t grain, Body&& body) const {
    for_each(pieces_of(n, grain), piece_of(n, grain, body));
  }

  /// The same, where threads that are done help the others: for work that is unlike from place to place.
  template <class Body>
  void deal_ranges(std::int64_t n, std::int64_t grain, Body&& body) const {
    const std::int64_t pieces = pieces_of(n, grain);
    const auto piece = piece_of(n, grain, body);
    if (count_ == 1 || pieces < 2) {
      for (std::int64_t p = 0; p < pieces; ++p) piece(p);
      return;
    }
    Shares shares(count_);
    shares.refill(pieces);
#pragma omp parallel num_threads(count_)
    {
      const int thread = omp_get_thread_num();
      for (std::int64_t p = shares.next(thread); p != Shares::kNothing; p = shares.next(thread)) piece(p);
    }
  }

 private:
  static std::int64_t pieces_of(std::int64_t n, std::int64_t grain) {
    return (n + grain - 1) / grain;
  }
  template <class Body>
  static auto piece_of(std::int64_t n, std::int64_t grain, Body& body) {
    return [n, grain, &body](std::int64_t p) { body(p * grain, std::min(n, (p + 1) * grain)); };
  }

  int count_;
};

}  // namespace cdfp
