// Element updates a second: internal force with hourglass and assembly, stable step and energies beside it.
//   benchmarks/run.sh element [LARGEST]
// Plates of 4 layers from 46,656 elements up to LARGEST (150,000 unless given), of the shapes that a mesh may
// have. The best of many short runs; wall time. CDFP_ISA=baseline, avx2 or avx512 picks an instruction set.
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "element/element_force.hpp"

namespace {

using namespace cdfp;

enum class Shape { columns, distorted };

struct Scene {
  const char* name;
  Shape shape;
  Formulation formulation;
  bool rate_dependent;
};

Model plate(const Scene& scene, Index columns) {
  constexpr Index kLayers = 4;
  const Index side = columns + 1;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.15e-3, 0.15e-3);
  Model model;
  Mesh& mesh = model.mesh;
  std::vector<double> columns_at(2 * std::size_t(side) * std::size_t(side));
  for (double& c : columns_at) c = shift(random);
  for (Index k = 0; k <= kLayers; ++k) {
    for (Index j = 0; j < side; ++j) {
      for (Index i = 0; i < side; ++i) {
        const std::size_t column = 2 * std::size_t(i + side * j);
        const double own = scene.shape == Shape::distorted ? shift(random) : 0;
        mesh.coordinates.insert(
            mesh.coordinates.end(),
            {1.1e-3 * i + columns_at[column], 1.1e-3 * j + columns_at[column + 1], 0.83e-3 * k + own});
      }
    }
  }
  const auto node = [&](Index i, Index j, Index k) { return i + side * (j + side * k); };
  for (Index k = 0; k < kLayers; ++k) {
    for (Index j = 0; j < columns; ++j) {
      for (Index i = 0; i < columns; ++i) {
        for (Index up = k; up < k + 2; ++up) {
          mesh.connectivity.insert(mesh.connectivity.end(), {node(i, j, up), node(i + 1, j, up),
                                                             node(i + 1, j + 1, up), node(i, j + 1, up)});
        }
      }
    }
  }
  const auto elements = std::size_t(kLayers) * std::size_t(columns) * std::size_t(columns);
  mesh.types.assign(elements, ElementType::hexahedron);
  mesh.parts.assign(elements, 0);
  mesh.part_names = {"plate"};
  if (scene.rate_dependent) {
    model.materials.push_back({"law", RateDependentMaterial{1000, 0.49, 5.88e6, 29.21e6, 0.176, 1e-6}});
  } else {
    model.materials.push_back({"law", ElasticMaterial{2500, 74e9, 0.2}});
  }
  Part part;
  part.name = "plate";
  part.material = "law";
  part.formulation = scene.formulation;
  model.parts.push_back(part);
  return model;
}

template <class Work>
double least_seconds(double budget, Work&& work) {
  using Clock = std::chrono::steady_clock;
  double least = INFINITY;
  const auto begin = Clock::now();
  do {
    const auto from = Clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - from).count());
  } while (std::chrono::duration<double>(Clock::now() - begin).count() < budget);
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 150e3;
  const Scene scenes[] = {{"one point, extruded", Shape::columns, Formulation::one_point, false},
                          {"one point, distorted", Shape::distorted, Formulation::one_point, false},
                          {"one point, PVB", Shape::columns, Formulation::one_point, true},
                          {"full, extruded", Shape::columns, Formulation::full, false}};
  const double wanted[2][2] = {{14, 26}, {3, 5.5}};  // M/s: one-point and full, one and two threads
  std::string missed;
  std::printf("%-22s %9s %8s %12s %9s %12s %9s\n", "element", "elements", "threads", "updates M/s", "step ms",
              "energies ms", "bytes");
  for (const Scene& scene : scenes) {
    for (const Index columns : {108, 188, 500}) {
      const Index count = 4 * columns * columns;
      if (count > largest) continue;
      Model model = plate(scene, columns);
      ElementForce elements(model);
      std::vector<double> x = model.mesh.coordinates;
      std::mt19937 random(2);
      std::uniform_real_distribution<double> shift(-1e-7, 1e-7);
      for (double& c : x) c += shift(random);
      std::vector<double> force(x.size(), 0.0);
      for (const int threads : {1, 2}) {
        if (threads > omp_get_num_procs()) continue;
        const Threads pool(threads);
        const double speed =
            1e-6 * count / least_seconds(1.5, [&] { elements.add_force(x, force, 6e-8, pool); });
        const double step = least_seconds(0.2, [&] { elements.stable_step(x, pool); });
        const double energies = least_seconds(0.2, [&] { elements.energies(x, pool); });
        std::printf("%-22s %9d %8d %12.2f %9.3f %12.3f %9zu\n", scene.name, count, threads, speed, 1e3 * step,
                    1e3 * energies, elements.memory());
        const bool judged = columns == 108 && scene.shape == Shape::columns && !scene.rate_dependent;
        const double least = wanted[scene.formulation == Formulation::full][threads - 1];
        if (judged && speed < least) {
          missed += std::string(missed.empty() ? "" : "; ") + scene.name + " on " + std::to_string(threads) +
                    " threads below " + std::to_string(least).substr(0, 4) + " M/s";
        }
      }
    }
  }
  std::printf("%s\n", missed.empty() ? "element: pass" : ("element: short: " + missed).c_str());
  return 0;
}
