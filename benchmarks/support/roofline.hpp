/// What this machine can do at most, measured: the lines that a kernel's speed is held against.
#pragma once

#include <string>

namespace bench {

struct Roofline {
  double flops = 0;   ///< 1/s, fused multiply-adds count as two
  double l2 = 0;      ///< B/s read from 256 KiB a thread
  double memory = 0;  ///< B/s read from 256 MiB in all
};

/// The best of short runs on `threads` threads.
Roofline measure_roofline(int threads);

std::string processor_name();

}  // namespace bench
