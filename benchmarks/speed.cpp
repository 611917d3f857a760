// How fast, and how near to what the machine can do.
//   benchmarks/run.sh speed [--large] [--keep] [--lulesh FILE]
//     --large        also meshes of a million elements (some minutes)
//     --keep         adds the figures to benchmarks/history/speed.csv
//     --lulesh FILE  a LULESH 2.0 program, timed beside ours on 36^3 elements
// CDFP_ISA=baseline, avx2 or avx512 picks an instruction set.
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "cdfp/laminated_plate.hpp"
#include "cdfp/simulation.hpp"
#include "driver/case_reader.hpp"
#include "driver/large_blocks.hpp"
#include "element/element_force.hpp"
#include "element/full_integration.hpp"
#include "element/kernels.hpp"
#include "element/one_point.hpp"
#include "element/tetrahedron.hpp"
#include "element/wedge.hpp"
#include "integrator/central_difference.hpp"
#include "material/elastic.hpp"
#include "material/rate_dependent.hpp"
#include "support/counted.hpp"
#include "support/plate.hpp"
#include "support/roofline.hpp"

namespace {

using namespace cdfp;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// ---- elements
// ----------------------------------------------------------------------------------------------

struct Work {
  double operations, bytes;
};

/// Of one update of an element, its share of the nodes' advance included.
template <class Formulation, class Law>
Work work_of_update() {
  using host::Counted;
  std::vector<double> constants(std::size_t(Formulation::kConstants) * kLanes, 0.5);
  std::vector<double> state(std::size_t(Formulation::kPoints * Law::kState + 1) * kLanes, 0.5);
  constexpr int kCorners = Formulation::kCorners;
  Counted x[kCorners][3], f[kCorners][3];
  const PartConstants part;
  const StepConstants step{1, 0.5};
  Counted::operations = 0;
  Formulation::force(part, constants.data(), x, f, [&](const host::Symmetric<Counted>& strain, int point) {
    return Law::advance(part.material, step, strain, &state[std::size_t(point * Law::kState) * kLanes]);
  });
  constexpr double kNodesAnElement = 1.25 / (kCorners == 4   ? 6
                                             : kCorners == 6 ? 2
                                                             : 1);  // of the plates below
  const double assembly = 3 * kCorners;
  const double advance = kNodesAnElement * (6 + 6 + 1);
  const double constants_and_corners = 8.0 * Formulation::kConstants + 4 * kCorners;
  const double of_state = 2 * 8.0 * Formulation::kPoints * Law::kState;
  const double of_nodes = kNodesAnElement * 8 * (3 + 6 /* force */ + 9 + 3 /* drift */ + 9 + 1 /* kick */);
  return {double(Counted::operations) + assembly + advance, constants_and_corners + of_state + of_nodes};
}

struct Scene {
  const char* name;
  bench::Shape shape;
  Formulation formulation;
  bool rate_dependent;
  Work work;
  double wanted[2];  ///< M/s on one and two threads; 0: nothing is
};

/// A plate whose nodes start with random velocities: each step moves them, sums the forces and accelerates.
class MovingPlate {
 public:
  explicit MovingPlate(const Model& model) : nodes_(model.mesh.coordinates), elements_(model) {
    elements_.add_mass(nodes_.mass);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> speed(-0.1, 0.1);
    for (double& v : nodes_.velocity) v = speed(random);
    step_ = 0.5 * elements_.stable_step(nodes_.position, Threads(1)).step;
  }

  /// Seconds of the fastest step in `budget` seconds.
  double least_step(int threads, double budget) {
    const Threads pool(threads);
    double least = INFINITY;
    for (const auto begin = Clock::now(); seconds_since(begin) < budget;) {
      const auto from = Clock::now();
      drift(step_, nodes_, pool);
      elements_.add_force(nodes_.position, nodes_.force, step_, pool);
      accelerate(step_, nodes_, pool);
      least = std::min(least, seconds_since(from));
    }
    return least;
  }
  std::size_t bytes() const { return elements_.memory(); }

 private:
  Nodes nodes_;
  ElementForce elements_;
  double step_;
};

// ---- results
// -----------------------------------------------------------------------------------------------

class Results {
 public:
  void add(const std::string& what, Index elements, int threads, double value, const char* unit) {
    rows_.push_back(what + "," + std::to_string(elements) + "," + std::to_string(threads) + "," +
                    std::to_string(value) + "," + unit);
  }
  void want(bool holds, const std::string& what) {
    if (!holds) missed_ += (missed_.empty() ? "" : "; ") + what;
  }
  void keep(const char* file) const {
    const bool is_new = !std::ifstream(file).good();
    std::ofstream out(file, std::ios::app);
    if (is_new) out << "date,processor,instructions,what,elements,threads,value,unit\n";
    char date[16];
    const std::time_t now = std::time(nullptr);
    std::strftime(date, sizeof date, "%Y-%m-%d", std::localtime(&now));
    for (const std::string& row : rows_) {
      out << date << ',' << bench::processor_name() << ',' << choose_kernels().name << ',' << row << '\n';
    }
  }
  int close() const {
    std::printf("%s\n", missed_.empty() ? "speed: pass" : ("speed: short: " + missed_).c_str());
    return 0;
  }

 private:
  std::vector<std::string> rows_;
  std::string missed_;
};

std::vector<int> thread_counts() {
  return omp_get_num_procs() > 1 ? std::vector<int>{1, 2} : std::vector<int>{1};
}

std::vector<bench::Roofline> measure_machine(Results& results) {
  std::printf("\n%s, instruction set %s\n\n%8s %12s %10s %12s\n", bench::processor_name().c_str(),
              choose_kernels().name, "threads", "FMA GFLOP/s", "L2 GB/s", "memory GB/s");
  std::vector<bench::Roofline> lines;
  for (const int threads : thread_counts()) {
    lines.push_back(bench::measure_roofline(threads));
    const bench::Roofline& m = lines.back();
    std::printf("%8d %12.1f %10.1f %12.1f\n", threads, m.flops / 1e9, m.l2 / 1e9, m.memory / 1e9);
    results.add("machine FMA", 0, threads, m.flops / 1e9, "GFLOP/s");
    results.add("machine L2", 0, threads, m.l2 / 1e9, "GB/s");
    results.add("machine memory", 0, threads, m.memory / 1e9, "GB/s");
  }
  return lines;
}

/// Returns million updates a second of the first scene on 46,656 elements, by thread count.
std::vector<double> measure_elements(const std::vector<bench::Roofline>& machine, bool large,
                                     Results& results) {
  using namespace host;
  const Scene scenes[] = {{"one point, extruded",
                           bench::Shape::extruded,
                           Formulation::one_point,
                           false,
                           work_of_update<OnePoint<Prism>, Elastic>(),
                           {14, 26}},
                          {"one point, distorted",
                           bench::Shape::distorted,
                           Formulation::one_point,
                           false,
                           work_of_update<OnePoint<Hexahedron>, Elastic>(),
                           {14, 26}},
                          {"one point, PVB",
                           bench::Shape::extruded,
                           Formulation::one_point,
                           true,
                           work_of_update<OnePoint<Prism>, RateDependent>(),
                           {0, 0}},
                          {"full, extruded",
                           bench::Shape::extruded,
                           Formulation::full,
                           false,
                           work_of_update<FullIntegration<PrismPoints>, Elastic>(),
                           {3, 5.5}},
                          {"full, distorted",
                           bench::Shape::distorted,
                           Formulation::full,
                           false,
                           work_of_update<FullIntegration<HexahedronPoints>, Elastic>(),
                           {3, 5.5}},
                          {"full, PVB",
                           bench::Shape::extruded,
                           Formulation::full,
                           true,
                           work_of_update<FullIntegration<PrismPoints>, RateDependent>(),
                           {0, 0}},
                          {"wedge",
                           bench::Shape::wedges,
                           Formulation::one_point,
                           false,
                           work_of_update<Wedge, Elastic>(),
                           {0, 0}},
                          {"tetrahedron",
                           bench::Shape::tetrahedra,
                           Formulation::one_point,
                           false,
                           work_of_update<Tetrahedron, Elastic>(),
                           {20, 0}}};
  std::printf(
      "\nElement updates: drift, internal force, assembly, acceleration; the fastest of many steps.\n"
      "Limit: FMA peak, or memory where elements and nodes do not fit into 16 MB, whichever is lower.\n\n"
      "%-21s %9s %7s %9s %7s %7s %9s %9s %9s\n",
      "element", "elements", "threads", "M/s", "flop", "bytes", "GFLOP/s", "GB/s", "of limit");
  std::vector<double> first;
  for (const Scene& scene : scenes) {
    for (const Index columns : {108, 188, 500}) {
      if (columns > 200 && !large) continue;
      const Model model = bench::plate(scene.shape, scene.formulation, scene.rate_dependent,
                                       scene.shape == bench::Shape::tetrahedra ? columns * 2 / 5
                                       : scene.shape == bench::Shape::wedges   ? columns * 5 / 7
                                                                               : columns);
      const Index count = model.mesh.element_count();
      MovingPlate moving(model);
      const std::vector<int> counts = thread_counts();
      for (std::size_t t = 0; t < counts.size(); ++t) {
        const double rate = count / moving.least_step(counts[t], 0.7);
        const bool in_cache = count * scene.work.bytes < 16e6;
        const double limit = in_cache ? machine[t].flops / scene.work.operations
                                      : std::min(machine[t].flops / scene.work.operations,
                                                 machine[t].memory / scene.work.bytes);
        std::printf("%-21s %9d %7d %9.2f %7.0f %7.0f %9.1f %9.1f %8.0f%%\n", scene.name, count, counts[t],
                    1e-6 * rate, scene.work.operations, scene.work.bytes, 1e-9 * rate * scene.work.operations,
                    1e-9 * rate * scene.work.bytes, 100 * rate / limit);
        results.add(scene.name, count, counts[t], 1e-6 * rate, "M/s");
        if (columns == 108 && &scene == scenes) first.push_back(1e-6 * rate);
        // Meshes that leave the caches may be slower by a quarter.
        results.want(1e-6 * rate >= (columns == 108 ? 1 : 0.75) * scene.wanted[t],
                     std::string(scene.name) + ", " + std::to_string(count) + " elements on " +
                         std::to_string(counts[t]) + " threads");
      }
    }
  }
  return first;
}

// ---- whole steps
// -------------------------------------------------------------------------------------------

Model impact_case(Index columns) {
  Model model = read_case("examples/laminated_glass/case.toml");
  if (columns != 67) {
    LaminatedPlate plate;
    plate.columns = columns;
    plate.layout = PlateColumns::regular;
    model.mesh = laminated_plate_mesh(plate);
    model.time.fixed_step = 0;
  }
  return model;
}

/// Wall seconds of an advance.
double advance_seconds(Simulation& simulation, std::int64_t steps) {
  const double before = simulation.summary().wall_s;
  simulation.advance(steps);
  return simulation.summary().wall_s - before;
}

constexpr int kSlices = 24, kRounds = 4;

/// Of all rounds, for each number of threads: the one that took least, and the least time of each slice.
struct Rounds {
  std::vector<Summary> fastest;
  std::vector<std::array<double, kSlices>> slices;  ///< s
};

/// What else the machine does only ever adds. Side by side in slices, so that it adds to all alike.
Rounds run_impact_side_by_side() {
  const std::vector<int> counts = thread_counts();
  Rounds rounds;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Simulation> simulations;
    for (const int threads : counts) {
      Model model = impact_case(67);
      model.threads = threads;
      simulations.emplace_back(std::move(model));
    }
    if (round == 0) rounds.slices.resize(counts.size());
    for (int slice = 0; slice < kSlices; ++slice) {
      for (std::size_t t = 0; t < counts.size(); ++t) {
        const double seconds = advance_seconds(simulations[t], 50);
        double& least = rounds.slices[t][slice];
        if (round == 0 || seconds < least) least = seconds;
      }
    }
    for (std::size_t t = 0; t < counts.size(); ++t) {
      Summary summary = simulations[t].summary();
      if (round == 0) {
        rounds.fastest.push_back(std::move(summary));
      } else if (summary.wall_s < rounds.fastest[t].wall_s) {
        rounds.fastest[t] = std::move(summary);
      }
    }
  }
  return rounds;
}

void measure_stages(Results& results) {
  std::printf(
      "\nThe paper's case, 1,200 steps (72 us: impact and most cracks), fastest of %d rounds;\n"
      "ns an element and step.\n\n",
      kRounds);
  const Rounds rounds = run_impact_side_by_side();
  const std::vector<Summary>& summaries = rounds.fastest;
  const double updates = double(summaries[0].elements) * 1200;
  std::printf("%-18s", "stage");
  for (const Summary& s : summaries) std::printf(" %6d threads %7s", s.threads, "share");
  std::printf("\n");
  std::vector<double> rest;
  for (const Summary& s : summaries) rest.push_back(s.wall_s);
  for (std::size_t i = 0; i < summaries[0].stages.size(); ++i) {
    std::printf("%-18s", summaries[0].stages[i].name.c_str());
    for (std::size_t t = 0; t < summaries.size(); ++t) {
      const double seconds = summaries[t].stages[i].seconds;
      rest[t] -= seconds;
      std::printf(" %14.2f %6.1f%%", 1e9 * seconds / updates, 100 * seconds / summaries[t].wall_s);
      results.add("case " + summaries[t].stages[i].name, summaries[t].elements, summaries[t].threads,
                  1e9 * seconds / updates, "ns");
    }
    std::printf("\n");
  }
  std::printf("%-18s", "history");
  for (std::size_t t = 0; t < summaries.size(); ++t) {
    std::printf(" %14.2f %6.1f%%", 1e9 * rest[t] / updates, 100 * rest[t] / summaries[t].wall_s);
  }
  std::printf("\n%-18s", "step");
  for (const Summary& s : summaries) std::printf(" %14.2f %6.1f%%", 1e9 * s.wall_s / updates, 100.0);
  std::printf("\n");
  for (const Summary& s : summaries) {
    results.add("case step", s.elements, s.threads, 1e9 * s.wall_s / updates, "ns");
    const double whole = s.wall_s / 1200 * 10000;
    std::printf("10,000 steps at this pace: %.1f s on %d threads\n", whole, s.threads);
    if (s.threads == 2) results.want(whole <= 40, "the paper's case above 40 s");
  }
  if (summaries.size() == 2) {
    std::array<double, 2> seconds{};
    for (std::size_t t = 0; t < 2; ++t)
      seconds[t] = std::accumulate(rounds.slices[t].begin(), rounds.slices[t].end(), 0.0);
    const double efficiency = seconds[0] / seconds[1] / 2;
    std::printf(
        "efficiency on two threads: %.0f %% (each slice of 50 steps in the least time of %d rounds)\n",
        100 * efficiency, kRounds);
    results.add("case efficiency", summaries[0].elements, 2, 100 * efficiency, "%");
    results.want(efficiency >= 0.85, "two threads below 85 % efficiency");
  }
}

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

/// Before any thread is started, which no child would have.
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

}  // namespace

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
  give_large_blocks_back();
  Results results;
  measure_growth(large, results);
  const std::vector<bench::Roofline> machine = measure_machine(results);
  const std::vector<double> ours = measure_elements(machine, large, results);
  if (lulesh != nullptr) measure_beside_lulesh(lulesh, ours, results);
  measure_stages(results);
  if (keep) results.keep("benchmarks/history/speed.csv");
  return results.close();
}
