// Cracks against theory and published figures. Each case prints its figure beside what is wanted and leaves a
// picture in out/fracture/.
//   bench_fracture [CASE ...]
#include <cstdio>
#include <string>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "support/stop_watch.hpp"

namespace {

struct Case {
  const char* name;
  const char* title;
  void (*run)();
};

const Case kCases[] = {{"expanding_bar", "Expanding bar", bench::expanding_bar},
                       {"spall", "Spall", bench::spall},
                       {"strip", "Pre-strained strip", bench::strip},
                       {"double_cantilever", "Double cantilever beam", bench::double_cantilever},
                       {"kalthoff", "Kalthoff-Winkler plate", bench::kalthoff},
                       {"branching", "Branching in soda-lime glass", bench::branching},
                       {"mesh_angle", "How far the mesh steers a crack", bench::mesh_angle}};

}  // namespace

int main(int count, char** words) {
  for (const Case& c : kCases) {
    bool chosen = count == 1;
    for (int i = 1; i < count; ++i) chosen |= std::string(words[i]) == c.name;
    if (!chosen) continue;
    const auto begin = bench::Clock::now();
    std::printf("%s\n", c.title);
    c.run();
    std::printf("  (%.1f s)\n", bench::seconds_since(begin));
  }
  const std::string& shortfall = bench::shortfall();
  std::printf("fracture: %s%s\n", shortfall.empty() ? "pass" : "short:", shortfall.c_str());
  return 0;
}
