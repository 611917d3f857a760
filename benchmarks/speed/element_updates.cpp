#include "speed/element_updates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

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
#include "support/stop_watch.hpp"

namespace speed {

using namespace cdfp;
using bench::Clock, bench::seconds_since;

namespace {

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

}  // namespace

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

}  // namespace speed
