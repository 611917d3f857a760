/// Work for a team of threads, of which each begins with a share of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace cdfp {

/// Gives [0, count) out one by one: a thread goes through its own contiguous share, the same each time, so
/// that what it works on stays in its caches; when it is done it takes from the ends of the others' shares.
class Shares {
 public:
  static constexpr std::int64_t kNothing = -1;

  explicit Shares(int threads) : threads_(threads), shares_(new Share[static_cast<std::size_t>(threads)]) {}

  /// Before the threads begin.
  void refill(std::int64_t count) {
    for (int t = 0; t < threads_; ++t) {
      const auto begin = static_cast<std::uint64_t>(count * t / threads_);
      const auto end = static_cast<std::uint64_t>(count * (t + 1) / threads_);
      shares_[t].range.store(begin << 32 | end, std::memory_order_relaxed);
    }
  }

  /// `thread` in [0, threads).
  std::int64_t next(int thread) {
    if (const std::int64_t mine = take(shares_[thread], true); mine != kNothing) return mine;
    for (int i = 1; i < threads_; ++i) {
      const std::int64_t others = take(shares_[(thread + i) % threads_], false);
      if (others != kNothing) return others;
    }
    return kNothing;
  }

 private:
  struct alignas(64) Share {
    std::atomic<std::uint64_t> range{0};  ///< begin and end, 32 bits each
  };

  static std::int64_t take(Share& share, bool first) {
    std::uint64_t range = share.range.load(std::memory_order_relaxed);
    for (;;) {
      const std::uint64_t begin = range >> 32, end = range & 0xffffffff;
      if (begin >= end) return kNothing;
      const std::uint64_t rest = first ? (begin + 1) << 32 | end : begin << 32 | (end - 1);
      if (share.range.compare_exchange_weak(range, rest, std::memory_order_relaxed))
        return static_cast<std::int64_t>(first ? begin : end - 1);
    }
  }

  int threads_;
  std::unique_ptr<Share[]> shares_;
};

}  // namespace cdfp
