// Small meshes and models for physics tests.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cdfp/model.hpp"

namespace cdfp::scenes {

/// A box of nx * ny * nz hexahedra appended to `mesh` as a part of its own. Facet set "<name>_faces": its
/// outside. Node sets "<name>_low_x" and "<name>_high_x".
inline void add_box(Mesh& mesh, const std::string& name, std::array<Index, 3> divisions,
                    std::array<double, 3> size, std::array<double, 3> origin = {}) {
  const Index nx = divisions[0], ny = divisions[1], nz = divisions[2];
  const Index first_node = mesh.node_count();
  const Index first_element = mesh.element_count();
  const Index part = static_cast<Index>(mesh.part_names.size());
  mesh.part_names.push_back(name);
  const auto node = [&](Index i, Index j, Index k) { return first_node + (k * (ny + 1) + j) * (nx + 1) + i; };
  NodeSet low{name + "_low_x", {}};
  NodeSet high{name + "_high_x", {}};
  for (Index k = 0; k <= nz; ++k) {
    for (Index j = 0; j <= ny; ++j) {
      for (Index i = 0; i <= nx; ++i) {
        mesh.coordinates.insert(
            mesh.coordinates.end(),
            {origin[0] + size[0] * i / nx, origin[1] + size[1] * j / ny, origin[2] + size[2] * k / nz});
        if (i == 0) low.nodes.push_back(node(i, j, k));
        if (i == nx) high.nodes.push_back(node(i, j, k));
      }
    }
  }
  FacetSet faces{name + "_faces", {}};
  const auto element = [&](Index i, Index j, Index k) { return first_element + (k * ny + j) * nx + i; };
  for (Index k = 0; k < nz; ++k) {
    for (Index j = 0; j < ny; ++j) {
      for (Index i = 0; i < nx; ++i) {
        mesh.types.push_back(ElementType::hexahedron);
        mesh.parts.push_back(part);
        mesh.layers.push_back(k);
        mesh.connectivity.insert(
            mesh.connectivity.end(),
            {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
             node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
        const Index e = element(i, j, k);
        if (k == 0) faces.facets.push_back({e, 0});
        if (k == nz - 1) faces.facets.push_back({e, 1});
        if (j == 0) faces.facets.push_back({e, 2});
        if (i == nx - 1) faces.facets.push_back({e, 3});
        if (j == ny - 1) faces.facets.push_back({e, 4});
        if (i == 0) faces.facets.push_back({e, 5});
      }
    }
  }
  mesh.node_sets.push_back(low);
  mesh.node_sets.push_back(high);
  mesh.facet_sets.push_back(faces);
}

/// Cuts each hexahedron of a box in elements with these of its corners.
template <std::size_t kPieces, std::size_t kCorners>
void cut(Mesh& mesh, ElementType type, const int (&pieces)[kPieces][kCorners]) {
  std::vector<Index> corners, parts;
  for (std::size_t e = 0; e < mesh.parts.size(); ++e) {
    for (const auto& piece : pieces) {
      for (const int c : piece) corners.push_back(mesh.connectivity[8 * e + static_cast<std::size_t>(c)]);
      parts.push_back(mesh.parts[e]);
    }
  }
  mesh.connectivity = std::move(corners);
  mesh.parts = std::move(parts);
  mesh.types.assign(mesh.parts.size(), type);
  mesh.layers.clear();
  mesh.facet_sets.clear();
}

/// Six around the diagonal 0-6.
inline void cut_into_tetrahedra(Mesh& mesh) {
  cut(mesh, ElementType::tetrahedron,
      {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}});
}

/// Two, upright along x (0) or z (2).
inline void cut_into_wedges(Mesh& mesh, int upright) {
  if (upright == 0) {
    cut(mesh, ElementType::wedge, {{0, 3, 7, 1, 2, 6}, {0, 7, 4, 1, 6, 5}});
  } else {
    cut(mesh, ElementType::wedge, {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}});
  }
}

inline Model with_part(Model model, const std::string& name, const ElasticMaterial& law,
                       Formulation formulation = Formulation::one_point) {
  model.materials.push_back({name, law});
  Part part;
  part.name = name;
  part.material = name;
  part.formulation = formulation;
  model.parts.push_back(part);
  model.threads = 1;  // small meshes: threads would only wait for one another
  return model;
}

}  // namespace cdfp::scenes
