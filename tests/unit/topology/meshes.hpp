/// Small conforming meshes of all element types, mixed, with elements missing, numbered at random.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "cdfp/mesh.hpp"
#include "core/vec3.hpp"
#include "topology/templates.hpp"

namespace cdfp::test {

struct SmallMesh {
  std::vector<Vec3> points;
  std::vector<ElementType> types;
  std::vector<std::vector<Index>> elements;

  Index node_count() const { return static_cast<Index>(points.size()); }
  Index element_count() const { return static_cast<Index>(types.size()); }
  std::vector<Index> connectivity() const {
    std::vector<Index> all;
    for (const auto& corners : elements) all.insert(all.end(), corners.begin(), corners.end());
    return all;
  }
  void add(ElementType type, std::vector<Index> corners) {
    types.push_back(type);
    elements.push_back(std::move(corners));
  }
};

/// How a cell of the box is filled. A centre cell has a node in its middle and fits any neighbour: a pyramid
/// on each whole face, two tetrahedra on each face that the neighbour splits.
enum class Cell { hexahedron, wedges, tetrahedra, centre };

/// Faces are split along the diagonal from their lowest to their highest corner.
inline bool splits(Cell cell, int axis) {
  return cell == Cell::tetrahedra || (cell == Cell::wedges && axis == 2);
}

inline SmallMesh box(int nx, int ny, int nz, std::vector<Cell> cells) {
  SmallMesh mesh;
  const auto node = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  const auto cell = [&](int i, int j, int k) -> Cell& { return cells[i + nx * (j + ny * k)]; };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) mesh.points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
    }
  }
  const std::array<std::array<int, 3>, 6> beyond{
      {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}};
  const auto neighbour = [&](int i, int j, int k, int face, Cell otherwise) {
    const auto [di, dj, dk] = beyond[face];
    const bool inside =
        i + di >= 0 && i + di < nx && j + dj >= 0 && j + dj < ny && k + dk >= 0 && k + dk < nz;
    return inside ? cell(i + di, j + dj, k + dk) : otherwise;
  };
  const std::array<int, 6> axis{2, 2, 1, 0, 1, 0};
  const auto each = [&](auto&& visit) {
    for (int k = 0; k < nz; ++k) {
      for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) visit(i, j, k);
      }
    }
  };
  each([&](int i, int j, int k) {
    for (int face = 0; face < 6; ++face) {
      const Cell here = cell(i, j, k);
      const Cell there = neighbour(i, j, k, face, here);
      if (here != Cell::centre && there != Cell::centre &&
          splits(here, axis[face]) != splits(there, axis[face])) {
        cell(i, j, k) = Cell::centre;
      }
    }
  });
  each([&](int i, int j, int k) {
    const std::array<Index, 8> c{
        node(i, j, k),     node(i + 1, j, k),     node(i + 1, j + 1, k),     node(i, j + 1, k),
        node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)};
    switch (cell(i, j, k)) {
      case Cell::hexahedron:
        mesh.add(ElementType::hexahedron, {c.begin(), c.end()});
        break;
      case Cell::wedges:
        mesh.add(ElementType::wedge, {c[0], c[1], c[2], c[4], c[5], c[6]});
        mesh.add(ElementType::wedge, {c[0], c[2], c[3], c[4], c[6], c[7]});
        break;
      case Cell::tetrahedra:
        for (const auto& [p, q] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}) {
          mesh.add(ElementType::tetrahedron, {c[0], c[p], c[q], c[6]});
        }
        break;
      case Cell::centre: {
        const Index middle = mesh.node_count();
        mesh.points.push_back({i + 0.5, j + 0.5, k + 0.5});
        const ElementTemplate& hexahedron = element_template(ElementType::hexahedron);
        for (int face = 0; face < 6; ++face) {
          std::array<Index, 4> f;
          for (int s = 0; s < 4; ++s) f[s] = c[hexahedron.facets[face][3 - s]];
          if (!splits(neighbour(i, j, k, face, Cell::hexahedron), axis[face])) {
            mesh.add(ElementType::pyramid, {f[0], f[1], f[2], f[3], middle});
            continue;
          }
          std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
          mesh.add(ElementType::tetrahedron, {f[0], f[1], f[2], middle});
          mesh.add(ElementType::tetrahedron, {f[0], f[2], f[3], middle});
        }
        break;
      }
    }
  });
  return mesh;
}

inline SmallMesh box(int nx, int ny, int nz, Cell cell) {
  return box(nx, ny, nz, std::vector<Cell>(nx * ny * nz, cell));
}

inline SmallMesh mixed_box(int nx, int ny, int nz, std::mt19937& random) {
  std::vector<Cell> cells(nx * ny * nz);
  for (Cell& cell : cells) cell = static_cast<Cell>(random() % 4);
  return box(nx, ny, nz, cells);
}

/// Tetrahedra around one edge, from node 0 to node 1.
inline SmallMesh fan(int count) {
  SmallMesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979 * i / count;
    mesh.points.push_back({std::cos(angle), std::sin(angle), 0.5});
    mesh.add(ElementType::tetrahedron, {0, 1, 2 + i, 2 + (i + 1) % count});
  }
  return mesh;
}

/// The ways to number the corners of an element that leave its facets outward.
inline std::vector<std::vector<int>> rotations(ElementType type) {
  const ElementTemplate& t = element_template(type);
  const auto turned = [](std::vector<int> facet) {
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    return facet;
  };
  std::vector<std::vector<int>> facets;
  for (int f = 0; f < t.facet_count; ++f) {
    facets.push_back(turned({t.facet(f).begin(), t.facet(f).end()}));
  }
  std::vector<std::vector<int>> found;
  std::vector<int> p(t.corner_count);
  std::iota(p.begin(), p.end(), 0);
  do {
    const bool keeps = std::all_of(facets.begin(), facets.end(), [&](std::vector<int> facet) {
      for (int& c : facet) c = p[c];
      return std::find(facets.begin(), facets.end(), turned(facet)) != facets.end();
    });
    if (keeps) found.push_back(p);
  } while (std::next_permutation(p.begin(), p.end()));
  return found;
}

/// Renumbers nodes and elements, turns each element's corners, and drops elements with the given chance.
inline SmallMesh shuffled(const SmallMesh& mesh, double drop, std::mt19937& random) {
  static const std::array<std::vector<std::vector<int>>, 4> turns{
      rotations(ElementType::hexahedron), rotations(ElementType::tetrahedron), rotations(ElementType::wedge),
      rotations(ElementType::pyramid)};
  std::vector<Index> nodes(mesh.points.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  std::shuffle(nodes.begin(), nodes.end(), random);
  std::vector<Index> order(mesh.types.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);

  SmallMesh out;
  out.points.resize(mesh.points.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) out.points[nodes[n]] = mesh.points[n];
  for (const Index e : order) {
    if (std::uniform_real_distribution<>()(random) < drop) continue;
    const auto& choices = turns[static_cast<std::size_t>(mesh.types[e])];
    const auto& turn = choices[random() % choices.size()];
    std::vector<Index> corners;
    for (const int c : turn) corners.push_back(nodes[mesh.elements[e][c]]);
    out.add(mesh.types[e], corners);
  }
  return out;
}

}  // namespace cdfp::test
