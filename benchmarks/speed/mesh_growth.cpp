#include "speed/mesh_growth.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cdfp/simulation.hpp"
#include "speed/impact_case.hpp"
#include "support/stop_watch.hpp"

namespace speed {

using namespace cdfp;
using bench::Clock, bench::seconds_since;

namespace {

struct Growth {
  Index elements = 0;
  std::int64_t steps = 0;
  double set_up_s = 0, pace_ns = 0, peak_mb = 0;
};

Growth grow(Index columns, int threads) {
  Model model = impact_case(columns);
  model.threads = threads;
  Growth g;
  g.elements = model.mesh.element_count();
  const auto begin = Clock::now();
  Simulation simulation(std::move(model));
  g.set_up_s = seconds_since(begin);
  const double elements = g.elements;
  simulation.advance(elements > 5e5 ? 1000
                                    : static_cast<std::int64_t>(std::clamp(2e7 / elements, 50.0, 4000.0)));
  const Summary s = simulation.summary();
  g.steps = s.steps;
  g.pace_ns = 1e9 * s.wall_s / elements / static_cast<double>(s.steps);
  g.peak_mb = s.peak_rss_mb;
  return g;
}

/// In a process of its own: a peak stays, and so does what earlier runs have left of the heap.
Growth grow_alone(Index columns, int threads) {
  Growth g;
  int ends[2];
  if (pipe(ends) != 0) return g;
  const pid_t child = fork();
  if (child == 0) {
    g = grow(columns, threads);
    _exit(write(ends[1], &g, sizeof g) == sizeof g ? 0 : 1);
  }
  close(ends[1]);
  if (child > 0 && read(ends[0], &g, sizeof g) != sizeof g) g = {};
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return g;
}

}  // namespace

void measure_growth(bool large, Results& results) {
  const int threads = thread_counts().back();
  std::printf(
      "The case on finer meshes, %d threads, at the automatic step. Memory: peak of a process, set-up\n"
      "included, above that of the coarsest mesh.\n\n%9s %7s %9s %16s %9s %18s\n",
      threads, "elements", "steps", "set-up s", "ns/element/step", "peak MB", "bytes an element");
  std::vector<Index> sizes{10, 32, 67, 118};
  if (large) sizes.push_back(316);
  Growth coarsest;
  for (const Index columns : sizes) {
    const Growth g = grow_alone(columns, threads);
    if (g.elements == 0) {
      results.want(false, "no run of " + std::to_string(columns) + " columns");
      continue;
    }
    std::printf("%9d %7lld %9.2f %16.1f %9.1f ", g.elements, static_cast<long long>(g.steps), g.set_up_s,
                g.pace_ns, g.peak_mb);
    results.add("growth", g.elements, threads, g.pace_ns, "ns");
    results.add("peak", g.elements, threads, g.peak_mb, "MB");
    if (columns == sizes.front()) {
      coarsest = g;
      std::printf("%18s\n", "-");
      continue;
    }
    const double bytes = 1048576 * (g.peak_mb - coarsest.peak_mb) / (g.elements - coarsest.elements);
    std::printf("%18.0f\n", bytes);
    results.add("memory", g.elements, threads, bytes, "B");
    results.want(g.elements < 40000 || bytes <= 700,
                 "memory above 700 B an element on " + std::to_string(g.elements) + " elements");
  }
}

}  // namespace speed
