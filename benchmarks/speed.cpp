// How fast, and how near to what the machine can do.
//   benchmarks/run.sh speed [--large] [--keep] [--lulesh FILE]
//     --large        also meshes of a million elements (some minutes)
//     --keep         adds the figures to benchmarks/history/speed.csv
//     --lulesh FILE  a LULESH 2.0 program, timed beside ours on 36^3 elements
// CDFP_ISA=baseline, avx2 or avx512 picks an instruction set.
#include <cstdio>
#include <string>
#include <vector>

#include "driver/large_blocks.hpp"
#include "speed/beside_lulesh.hpp"
#include "speed/element_updates.hpp"
#include "speed/impact_stages.hpp"
#include "speed/mesh_growth.hpp"

int main(int argc, char** argv) {
  bool large = false, keep = false;
  const char* lulesh = nullptr;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--large") {
      large = true;
    } else if (word == "--keep") {
      keep = true;
    } else if (word == "--lulesh" && i + 1 < argc) {
      lulesh = argv[++i];
    } else {
      std::fprintf(stderr, "usage: benchmarks/run.sh speed [--large] [--keep] [--lulesh FILE]\n");
      return 2;
    }
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  cdfp::give_large_blocks_back();
  speed::Results results;
  speed::measure_growth(large, results);
  const std::vector<bench::Roofline> machine = speed::measure_machine(results);
  const std::vector<double> ours = speed::measure_elements(machine, large, results);
  if (lulesh != nullptr) speed::measure_beside_lulesh(lulesh, ours, results);
  speed::measure_stages(results);
  if (keep) results.keep("benchmarks/history/speed.csv");
  results.close();
}
