#include "support/plate.hpp"

#include <random>
#include <vector>

namespace bench {

using namespace cdfp;

Model plate(Shape shape, Formulation formulation, bool rate_dependent, Index columns) {
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
        const double own = shape == Shape::distorted ? shift(random) : 0;
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
  auto elements = std::size_t(kLayers) * std::size_t(columns) * std::size_t(columns);
  mesh.types.assign(elements, ElementType::hexahedron);
  if (shape == Shape::tetrahedra) {
    static constexpr int kCut[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                       {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    std::vector<Index> cut;
    for (std::size_t e = 0; e < elements; ++e) {
      for (const auto& corners : kCut) {
        for (const int c : corners) cut.push_back(mesh.connectivity[8 * e + std::size_t(c)]);
      }
    }
    mesh.connectivity = std::move(cut);
    elements *= 6;
    mesh.types.assign(elements, ElementType::tetrahedron);
  }
  if (shape == Shape::wedges) {
    static constexpr int kCut[2][6] = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
    std::vector<Index> cut;
    for (std::size_t e = 0; e < elements; ++e) {
      for (const auto& corners : kCut) {
        for (const int c : corners) cut.push_back(mesh.connectivity[8 * e + std::size_t(c)]);
      }
    }
    mesh.connectivity = std::move(cut);
    elements *= 2;
    mesh.types.assign(elements, ElementType::wedge);
  }
  mesh.parts.assign(elements, 0);
  mesh.part_names = {"plate"};
  if (rate_dependent) {
    model.materials.push_back({"law", RateDependentMaterial{1000, 0.49, 5.88e6, 29.21e6, 0.176, 1e-6}});
  } else {
    model.materials.push_back({"law", ElasticMaterial{2500, 74e9, 0.2}});
  }
  Part part;
  part.name = "plate";
  part.material = "law";
  part.formulation = formulation;
  model.parts.push_back(part);
  return model;
}

}  // namespace bench
