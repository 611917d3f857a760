#include "support/roofline.hpp"

#include <omp.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "support/stop_watch.hpp"

namespace bench {

namespace {

#if defined(__AVX512F__)
constexpr int kWidth = 8;
#elif defined(__AVX__)
constexpr int kWidth = 4;
#else
constexpr int kWidth = 2;
#endif
typedef double Vector __attribute__((vector_size(8 * kWidth)));

/// Seconds of the slowest thread, the least of some runs.
template <class Work>
double seconds_of_slowest(int threads, Work&& work) {
  double least = 1e30;
  for (int run = 0; run < 50; ++run) {
    double slowest = 0;
#pragma omp parallel num_threads(threads) reduction(max : slowest)
    {
      const int thread = omp_get_thread_num();
#pragma omp barrier
      const auto begin = Clock::now();
      work(thread);
      slowest = seconds_since(begin);
    }
    least = std::min(least, slowest);
  }
  return least;
}

double multiply_add(long rounds) {
  constexpr int kChains = 12;  // enough to hide the latency on two pipes
  Vector sum[kChains];
  for (int c = 0; c < kChains; ++c) sum[c] = Vector{} + 1e-3 * c;
  const Vector a = Vector{} + 0.999, b = Vector{} + 1e-3;
  for (long i = 0; i < rounds; ++i) {
#pragma GCC unroll 12
    for (int c = 0; c < kChains; ++c) {
      sum[c] = sum[c] * a + b;
      asm volatile("" : "+x"(sum[c]));  // stays in its register, and stays
    }
  }
  Vector total{};
  for (const Vector& s : sum) total += s;
  return total[0];
}

double add_up(const double* values, std::size_t count) {
  Vector sum[8]{};
  for (std::size_t i = 0; i + 8 * kWidth <= count; i += 8 * kWidth) {
    for (int k = 0; k < 8; ++k) {
      Vector v;
      __builtin_memcpy(&v, values + i + static_cast<std::size_t>(k * kWidth), sizeof v);
      sum[k] += v;
    }
  }
  Vector total{};
  for (const Vector& s : sum) total += s;
  return total[0];
}

}  // namespace

Roofline measure_roofline(int threads) {
  Roofline machine;
  std::vector<double> kept(static_cast<std::size_t>(threads) * 8);  // so that no work is for nothing
  constexpr long kRounds = 4'000'000;
  machine.flops = threads * 2.0 * 12 * kWidth * kRounds /
                  seconds_of_slowest(threads, [&](int t) { kept[8 * t] = multiply_add(kRounds); });

  constexpr std::size_t kInCache = 32 * 1024;
  std::vector<std::vector<double>> small(threads, std::vector<double>(kInCache, 1.0));
  constexpr int kPasses = 400;
  machine.l2 = 8.0 * threads * kInCache * kPasses / seconds_of_slowest(threads, [&](int t) {
                 for (int pass = 0; pass < kPasses; ++pass) {
                   kept[8 * t] += add_up(small[t].data(), kInCache);
                   asm volatile("" ::: "memory");
                 }
               });

  const std::size_t far = 32 * 1024 * 1024 / threads;
  std::vector<std::vector<double>> large(threads, std::vector<double>(far, 1.0));
  machine.memory = 8.0 * threads * static_cast<double>(far) /
                   seconds_of_slowest(threads, [&](int t) { kept[8 * t] += add_up(large[t].data(), far); });
  return machine;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace bench
