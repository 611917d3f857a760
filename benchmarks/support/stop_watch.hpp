/// Wall time, and processor time of one thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace bench {

using Clock = std::chrono::steady_clock;

/// s
inline double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// s that this thread has worked.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least processor time of a few repetitions, s.
template <class Work>
double least_seconds(int repetitions, Work&& work) {
  double least = 1e30;
  for (int i = 0; i < repetitions; ++i) {
    const double begin = processor_seconds();
    work();
    least = std::min(least, processor_seconds() - begin);
  }
  return least;
}

}  // namespace bench
