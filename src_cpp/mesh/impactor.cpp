#include "mesh/impactor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/quad_mesh.hpp"

namespace cdfp {

namespace {

/// Divisions of the paper's counts: head 7^3 + 3 * 7 * 7 * 4 = 931 elements with 3 * 7 * 7 = 147 spherical
/// facets; shaft (12 * 13 + 25) * 7 = 1,267 with 25 * 7 = 175 cylindrical ones.
constexpr double kCore = 7, kShells = 4, kShaftX = 12, kShaftY = 13, kShaftRings = 1, kShaftLayers = 7;

Index divisions(double count, double refinement, Index least) {
  return std::max(least, static_cast<Index>(std::lround(count * refinement)));
}

/// Place in the octant of the unit ball of core point (i, j, k) of n (shell 0) or of what lies outwards of
/// it.
Vec3 ball_point(std::array<Index, 3> ijk, Index n, double shell_share) {
  constexpr double core = 0.5, bulge = 0.5;
  const auto equal_angles = [n](Index i) { return i == n ? 1.0 : std::tan(std::numbers::pi / 4 * i / n); };
  const Vec3 cube{equal_angles(ijk[0]), equal_angles(ijk[1]), equal_angles(ijk[2])};
  const double length = norm(cube);
  if (length == 0) return {};
  const double ball_radius = std::max({cube.x, cube.y, cube.z}) / length;
  const Vec3 inner = core * (1 - bulge + bulge * ball_radius) * cube;
  const Vec3 outer = cube / length;
  return (1 - shell_share) * inner + shell_share * outer;
}

class Head {
 public:
  Head(const ImpactorShape& shape, Index part, Mesh& mesh)
      : shape_(shape),
        part_(part),
        n_(divisions(kCore, shape.refinement, 2)),
        shells_(divisions(kShells, shape.refinement, 1)),
        mesh_(mesh) {}

  std::vector<FacetUse> add() {
    for (Index k = 0; k < n_; ++k) {
      for (Index j = 0; j < n_; ++j) {
        for (Index i = 0; i < n_; ++i) {
          add_element({node({i, j, k}, 0), node({i + 1, j, k}, 0), node({i + 1, j + 1, k}, 0),
                       node({i, j + 1, k}, 0), node({i, j, k + 1}, 0), node({i + 1, j, k + 1}, 0),
                       node({i + 1, j + 1, k + 1}, 0), node({i, j + 1, k + 1}, 0)});
        }
      }
    }
    std::vector<FacetUse> sphere;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (Index shell = 0; shell < shells_; ++shell) {
        for (Index j = 0; j < n_; ++j) {
          for (Index i = 0; i < n_; ++i) {
            std::array<Index, 8> corners{};
            for (std::size_t c = 0; c < 8; ++c) {
              static constexpr Index right[] = {0, 1, 1, 0}, up[] = {0, 0, 1, 1};
              std::array<Index, 3> ijk{};
              ijk[axis] = n_;
              ijk[(axis + 1) % 3] = i + right[c % 4];
              ijk[(axis + 2) % 3] = j + up[c % 4];
              corners[c] = node(ijk, shell + static_cast<Index>(c / 4));
            }
            add_element(corners);
            // The mirrored order has the outer corners first.
            if (shell == shells_ - 1) sphere.push_back({mesh_.element_count() - 1, 0});
          }
        }
      }
    }
    return sphere;
  }

 private:
  Index node(std::array<Index, 3> ijk, Index shell) {
    const auto [found, is_new] = numbers_.try_emplace({ijk[0], ijk[1], ijk[2], shell}, mesh_.node_count());
    if (is_new) {
      Vec3 p = ball_point(ijk, n_, static_cast<double>(shell) / shells_);
      if (shell == shells_) p = normalized(p);
      const double center = shape_.tip + shape_.radius;
      mesh_.coordinates.insert(
          mesh_.coordinates.end(),
          {shape_.radius * p.x, shape_.radius * p.y, p.z == 1 ? shape_.tip : center - shape_.radius * p.z});
    }
    return found->second;
  }

  /// The head points down, so the octant is mirrored: bottom and top corners change places.
  void add_element(const std::array<Index, 8>& corners) {
    mesh_.connectivity.insert(mesh_.connectivity.end(), corners.begin() + 4, corners.end());
    mesh_.connectivity.insert(mesh_.connectivity.end(), corners.begin(), corners.begin() + 4);
    mesh_.types.push_back(ElementType::hexahedron);
    mesh_.parts.push_back(part_);
    mesh_.layers.push_back(0);
  }

  const ImpactorShape& shape_;
  Index part_;
  Index n_;
  Index shells_;
  Mesh& mesh_;
  std::map<std::array<Index, 4>, Index> numbers_;
};

/// Appends `piece`, taking the nodes of `mesh` from `first` on where they are at the same place.
void append(const Mesh& piece, Index first, Mesh& mesh) {
  const auto place = [](const Mesh& m, Index node) {
    const double* x = &m.coordinates[3 * static_cast<std::size_t>(node)];
    return std::array<double, 3>{x[0], x[1], x[2]};
  };
  std::map<std::array<double, 3>, Index> there;
  for (Index n = first; n < mesh.node_count(); ++n) there.emplace(place(mesh, n), n);
  std::vector<Index> number;
  for (Index n = 0; n < piece.node_count(); ++n) {
    const auto [found, is_new] = there.try_emplace(place(piece, n), mesh.node_count());
    if (is_new) mesh.coordinates.insert(mesh.coordinates.end(), found->first.begin(), found->first.end());
    number.push_back(found->second);
  }
  for (const Index n : piece.connectivity) mesh.connectivity.push_back(number[static_cast<std::size_t>(n)]);
  mesh.types.insert(mesh.types.end(), piece.types.begin(), piece.types.end());
  mesh.parts.insert(mesh.parts.end(), piece.parts.begin(), piece.parts.end());
  mesh.layers.insert(mesh.layers.end(), piece.layers.begin(), piece.layers.end());
}

std::vector<FacetUse> add_shaft(const ImpactorShape& shape, Index part, Index head_nodes, Mesh& mesh) {
  const Index m = divisions(kShaftX, shape.refinement, 2);
  const Index n = divisions(kShaftY, shape.refinement, 2);
  const Index rings = divisions(kShaftRings, shape.refinement, 1);
  const Index layers = divisions(kShaftLayers, shape.refinement, 1);
  QuadMesh section = quarter_disc(m, n, rings, 0.75);
  for (auto& p : section.points) p = {shape.radius * p[0], shape.radius * p[1]};
  std::vector<double> levels;
  for (Index k = 0; k <= layers; ++k) {
    levels.push_back(shape.tip + shape.radius + shape.shaft * k / layers);
  }
  const std::vector<Index> parts(static_cast<std::size_t>(layers), part);
  Mesh shaft;
  extrude(section, levels, parts, shaft);
  const Index first = mesh.element_count();
  append(shaft, head_nodes, mesh);
  std::vector<FacetUse> side;
  const Index quads = static_cast<Index>(section.quads.size());
  for (Index k = 0; k < layers; ++k) {
    for (Index q = quads - (m + n); q < quads; ++q) side.push_back({first + k * quads + q, 3});
  }
  return side;
}

}  // namespace

std::vector<FacetUse> add_impactor(const ImpactorShape& shape, Index part, Mesh& mesh) {
  const Index head_nodes = mesh.node_count();
  std::vector<FacetUse> facets = Head(shape, part, mesh).add();
  const std::vector<FacetUse> side = add_shaft(shape, part, head_nodes, mesh);
  facets.insert(facets.end(), side.begin(), side.end());
  return facets;
}

}  // namespace cdfp
