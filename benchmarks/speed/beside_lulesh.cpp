#include "speed/beside_lulesh.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace speed {

using namespace cdfp;

void measure_beside_lulesh(const char* program, const std::vector<double>& ours, Results& results) {
  std::printf(
      "\nBeside LULESH on 36^3 elements (its updates hold more: artificial viscosity, equation of "
      "state).\n\n");
  const std::vector<int> counts = thread_counts();
  const double wanted[] = {11, 14};
  for (std::size_t t = 0; t < counts.size(); ++t) {
    const std::string command =
        "OMP_NUM_THREADS=" + std::to_string(counts[t]) + " '" + program + "' -s 36 -i 60";
    double theirs = 0;
    for (int run = 0; run < 3; ++run) {
      std::FILE* out = popen(command.c_str(), "r");
      if (out == nullptr) continue;
      char line[256];
      while (std::fgets(line, sizeof line, out) != nullptr) {
        double fom = 0;
        if (std::sscanf(line, "FOM = %lf", &fom) == 1) theirs = std::max(theirs, 1e-3 * fom);
      }
      pclose(out);
    }
    if (theirs <= 0) {
      results.want(false, std::string("no figure from ") + program);
      return;
    }
    std::printf("%d threads: LULESH %.2f M/s, ours %.2f M/s, ratio %.1f\n", counts[t], theirs, ours[t],
                ours[t] / theirs);
    results.add("ratio to LULESH", 46656, counts[t], ours[t] / theirs, "");
    results.want(ours[t] / theirs >= wanted[t],
                 "ratio to LULESH on " + std::to_string(counts[t]) + " threads");
  }
}

}  // namespace speed
