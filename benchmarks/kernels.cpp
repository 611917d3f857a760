// Each kernel alone, in cache, on one thread, by Google Benchmark (libbenchmark-dev).
//   benchmarks/run.sh kernels [--benchmark_filter=REGEX ...]
// CDFP_ISA=baseline, avx2 or avx512 picks an instruction set.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <numeric>
#include <vector>

#include "cdfp/contact.hpp"
#include "cdfp/topology.hpp"
#include "element/element_force.hpp"
#include "integrator/central_difference.hpp"
#include "support/plate.hpp"

namespace {

using namespace cdfp;
using bench::Shape;

constexpr Index kColumns = 16;

void report(benchmark::State& state, Index items) {
  state.SetItemsProcessed(state.iterations() * items);
}

void internal_force(benchmark::State& state, Shape shape, Formulation formulation, bool rate_dependent) {
  const Model model = bench::plate(shape, formulation, rate_dependent, kColumns);
  ElementForce elements(model);
  // Two states in turn, so that strains have a rate.
  const std::vector<double> here = model.mesh.coordinates;
  std::vector<double> there = here, force(here.size());
  for (std::size_t i = 0; i < there.size(); ++i) there[i] += 1e-9 * static_cast<double>(i % 7);
  bool turn = false;
  for (auto _ : state) {
    turn = !turn;
    elements.add_force(turn ? there : here, force, 6e-8, Threads(1));
  }
  report(state, model.mesh.element_count());
}
BENCHMARK_CAPTURE(internal_force, one_point_extruded, Shape::extruded, Formulation::one_point, false);
BENCHMARK_CAPTURE(internal_force, one_point_distorted, Shape::distorted, Formulation::one_point, false);
BENCHMARK_CAPTURE(internal_force, one_point_pvb, Shape::extruded, Formulation::one_point, true);
BENCHMARK_CAPTURE(internal_force, full_extruded, Shape::extruded, Formulation::full, false);
BENCHMARK_CAPTURE(internal_force, full_distorted, Shape::distorted, Formulation::full, false);
BENCHMARK_CAPTURE(internal_force, full_pvb, Shape::extruded, Formulation::full, true);
BENCHMARK_CAPTURE(internal_force, wedges, Shape::wedges, Formulation::one_point, false);
BENCHMARK_CAPTURE(internal_force, tetrahedra, Shape::tetrahedra, Formulation::one_point, false);

void stable_step(benchmark::State& state) {
  const Model model = bench::plate(Shape::extruded, Formulation::full, false, kColumns);
  const ElementForce elements(model);
  for (auto _ : state) benchmark::DoNotOptimize(elements.stable_step(model.mesh.coordinates, Threads(1)));
  report(state, model.mesh.element_count());
}
BENCHMARK(stable_step);

void advance_nodes(benchmark::State& state) {
  const Model model = bench::plate(Shape::extruded, Formulation::one_point, false, kColumns);
  Nodes nodes(model.mesh.coordinates);
  for (double& m : nodes.mass) m = 1;
  for (auto _ : state) {
    drift(6e-8, nodes, Threads(1));
    accelerate(6e-8, nodes, Threads(1));
  }
  report(state, nodes.count());
}
BENCHMARK(advance_nodes);

void project_on_warped_face(benchmark::State& state) {
  const std::array<double, 12> face{0, 0, 0, 1e-3, 0, 1e-5, 1.1e-3, 0.9e-3, 0, 0, 1e-3, 2e-5};
  std::array<double, 3> point{0.3e-3, 0.2e-3, -1e-6};
  for (auto _ : state) {
    point[0] = point[0] < 0.9e-3 ? point[0] + 1e-5 : 1e-4;
    benchmark::DoNotOptimize(project_on_face(point, face));
  }
  report(state, 1);
}
BENCHMARK(project_on_warped_face);

void build_topology(benchmark::State& state) {
  const Mesh mesh = bench::plate(Shape::extruded, Formulation::one_point, false, kColumns).mesh;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Topology(mesh.node_count(), mesh.types, mesh.connectivity).bulk_count());
  }
  report(state, mesh.element_count());
}
BENCHMARK(build_topology);

void insert_cohesive_elements(benchmark::State& state) {
  const Mesh mesh = bench::plate(Shape::extruded, Formulation::one_point, false, kColumns).mesh;
  Index inserted = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Topology topology(mesh.node_count(), mesh.types, mesh.connectivity);
    Insertion report;
    inserted = 0;
    state.ResumeTiming();
    for (Index e = 0; e < topology.bulk_count(); ++e) {
      const FacetUse facet{e, 0};
      if (topology.mate(facet).element == kNone) continue;
      topology.insert_cohesive(facet, report);
      ++inserted;
    }
  }
  report(state, inserted);
}
BENCHMARK(insert_cohesive_elements);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  std::printf("kernels: pass\n");
  return 0;
}
