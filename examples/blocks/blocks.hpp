/// The two scenes of Chen, Zang, Xu 2015, section 6.2: elastic blocks that hit each other, without friction.
/// The paper gives material and speeds; the sizes here are assumed.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "cdfp/model.hpp"

namespace blocks {

using cdfp::Index;
using Vector = std::array<double, 3>;

struct Block {
  std::string name;
  Vector centre;         ///< m
  Vector size;           ///< m
  Index divisions;       ///< along each side
  Vector axis{0, 0, 1};  ///< turned about, unit
  double angle = 0;
};

inline Vector turned(const Vector& v, const Vector& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double along = (1 - c) * (axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2]);
  return {c * v[0] + s * (axis[1] * v[2] - axis[2] * v[1]) + along * axis[0],
          c * v[1] + s * (axis[2] * v[0] - axis[0] * v[2]) + along * axis[1],
          c * v[2] + s * (axis[0] * v[1] - axis[1] * v[0]) + along * axis[2]};
}

/// A part of its own, whose outside is a contact surface. Node set "<name>_left": its side of least x, before
/// it is turned.
inline void add(cdfp::Model& model, const Block& block) {
  cdfp::Mesh& mesh = model.mesh;
  const Index n = block.divisions, first = mesh.node_count(), first_element = mesh.element_count();
  const auto part = static_cast<Index>(mesh.part_names.size());
  mesh.part_names.push_back(block.name);
  const auto node = [&](Index i, Index j, Index k) { return first + (k * (n + 1) + j) * (n + 1) + i; };
  cdfp::NodeSet left{block.name + "_left", {}};
  for (Index k = 0; k <= n; ++k) {
    for (Index j = 0; j <= n; ++j) {
      for (Index i = 0; i <= n; ++i) {
        const Vector local{block.size[0] * (double(i) / n - 0.5), block.size[1] * (double(j) / n - 0.5),
                           block.size[2] * (double(k) / n - 0.5)};
        const Vector x = turned(local, block.axis, block.angle);
        for (std::size_t d = 0; d < 3; ++d) mesh.coordinates.push_back(block.centre[d] + x[d]);
        if (i == 0) left.nodes.push_back(node(i, j, k));
      }
    }
  }
  cdfp::FacetSet outside{block.name + "_outside", {}};
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) {
        mesh.types.push_back(cdfp::ElementType::hexahedron);
        mesh.parts.push_back(part);
        mesh.layers.push_back(k);
        for (const Index up : {k, k + 1}) {
          mesh.connectivity.insert(mesh.connectivity.end(), {node(i, j, up), node(i + 1, j, up),
                                                             node(i + 1, j + 1, up), node(i, j + 1, up)});
        }
        const Index e = first_element + (k * n + j) * n + i;
        const bool at_facet[6] = {k == 0, k == n - 1, j == 0, i == n - 1, j == n - 1, i == 0};
        for (Index f = 0; f < 6; ++f) {
          if (at_facet[f]) outside.facets.push_back({e, f});
        }
      }
    }
  }
  mesh.node_sets.push_back(left);
  mesh.facet_sets.push_back(outside);
  model.contact.surfaces.push_back(outside.name);
  cdfp::Part made;
  made.name = block.name;
  made.material = "glass";
  model.parts.push_back(made);
}

inline cdfp::Model empty(const std::string& title) {
  cdfp::Model model;
  model.title = title;
  model.materials.push_back({"glass", cdfp::ElasticMaterial{2456, 74e9, 0.2}});
  model.threads = 1;  // the scenes are small
  return model;
}

/// A block comes at a held one from above and aside: first its edge meets the other's, beside its centre, so
/// it starts to spin, until a corner meets a face. `divisions` of each side.
inline cdfp::Model case_1(Index divisions = 4) {
  cdfp::Model model = empty("block on a held block");
  const double a = 4e-3, way = 0.6e-3, beside = -0.42 * a, tilt = 0.3;
  const Vector ahead{std::sqrt(0.5), 0, std::sqrt(0.5)}, edge = turned({0, 1, 0}, ahead, tilt);
  add(model, {"held", {-0.5 * a, 0, -0.5 * a}, {a, 2 * a, a}, divisions});
  add(model,
      {"flying",
       {0.5 * a + way + beside * edge[0], 0.2 * a + beside * edge[1], 0.5 * a + way + beside * edge[2]},
       {a, a, a},
       divisions,
       ahead,
       tilt});
  model.prescribed_velocities.push_back({"held_left", {true, true, true}, {}, {0}});
  model.initial_velocities.push_back({"flying", {-3, 0, -3}});
  model.time = {0.5e-3, 0, 0.7};
  return model;
}

/// A block comes at a heap of loose ones. `divisions` of each side.
inline cdfp::Model case_2(Index divisions = 3) {
  cdfp::Model model = empty("block on a heap");
  const double a = 4e-3, gap = 1e-5;
  int number = 0;
  for (int level = 0; level < 3; ++level) {
    for (int i = 0; i < 3 - level; ++i) {
      add(model, {"heap_" + std::to_string(++number),
                  {(i + 0.5 * level) * (a + gap), 0, level * (a + gap)},
                  {a, a, a},
                  divisions});
    }
  }
  add(model,
      {"flying", {2.4 * a + 0.2e-3, 0.2 * a, 2.4 * a + 0.2e-3}, {a, a, a}, divisions, {0, 0.6, 0.8}, 0.5});
  model.initial_velocities.push_back({"flying", {-8, 0, -8}});
  model.time = {0.25e-3, 0, 0.7};
  return model;
}

}  // namespace blocks
