#include "mesh/quad_mesh.hpp"

#include <cmath>
#include <numbers>

namespace cdfp {

namespace {

using Point = std::array<double, 2>;

/// Share of roundness of the core: 0 a rectangle, 1 a disc (flat angles at its corners).
constexpr double kBulge = 0.5;

Point mix(Point a, Point b, double share) {
  return {(1 - share) * a[0] + share * b[0], (1 - share) * a[1] + share * b[1]};
}

}  // namespace

QuadMesh quad_grid(Index m, Index n) {
  QuadMesh grid;
  for (Index j = 0; j <= n; ++j) {
    for (Index i = 0; i <= m; ++i) grid.points.push_back({static_cast<double>(i), static_cast<double>(j)});
  }
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < m; ++i) {
      const Index a = i + (m + 1) * j;
      grid.quads.push_back({a, a + 1, a + m + 2, a + m + 1});
    }
  }
  return grid;
}

QuadMesh quarter_disc(Index m, Index n, Index rings, double core) {
  constexpr double right_angle = std::numbers::pi / 2;
  const double corner_angle = right_angle * n / (m + n);
  QuadMesh disc = quad_grid(m, n);
  for (Point& p : disc.points) {
    const double u = p[0] / m;
    const double v = p[1] / n;
    const double radius = std::max(u, v);
    const double angle = u == 0 && v == 0 ? 0
                         : u >= v         ? corner_angle * v / u
                                          : right_angle - (right_angle - corner_angle) * u / v;
    p = mix({u, v}, {u == 0 ? 0 : radius * std::cos(angle), radius * std::sin(angle)}, kBulge);
    p = {core * p[0], core * p[1]};
  }
  const auto rim = [&](Index ring, Index s) -> Index {
    if (ring > 0) return (m + 1) * (n + 1) + (ring - 1) * (m + n + 1) + s;
    return s <= n ? m + (m + 1) * s : (m + n - s) + (m + 1) * n;
  };
  for (Index ring = 1; ring <= rings; ++ring) {
    for (Index s = 0; s <= m + n; ++s) {
      const double angle = right_angle * s / (m + n);
      const Point circle = {s == m + n ? 0 : std::cos(angle), std::sin(angle)};
      disc.points.push_back(
          mix(disc.points[static_cast<std::size_t>(rim(0, s))], circle, static_cast<double>(ring) / rings));
    }
    for (Index s = 0; s < m + n; ++s) {
      disc.quads.push_back({rim(ring - 1, s), rim(ring, s), rim(ring, s + 1), rim(ring - 1, s + 1)});
    }
  }
  return disc;
}

Index extrude(const QuadMesh& plane, std::span<const double> levels, std::span<const Index> parts,
              Mesh& mesh) {
  const Index first_node = mesh.node_count();
  const Index first_element = mesh.element_count();
  const Index stride = static_cast<Index>(plane.points.size());
  const std::size_t elements = parts.size() * plane.quads.size();
  mesh.coordinates.reserve(mesh.coordinates.size() + 3 * levels.size() * plane.points.size());
  mesh.connectivity.reserve(mesh.connectivity.size() + 8 * elements);
  mesh.types.reserve(mesh.types.size() + elements);
  mesh.parts.reserve(mesh.parts.size() + elements);
  mesh.layers.reserve(mesh.layers.size() + elements);
  for (const double z : levels) {
    for (const Point& p : plane.points) {
      mesh.coordinates.insert(mesh.coordinates.end(), {p[0], p[1], z});
    }
  }
  Index layer = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    layer = k > 0 && parts[k] == parts[k - 1] ? layer + 1 : 0;
    const Index bottom = first_node + static_cast<Index>(k) * stride;
    for (const auto& quad : plane.quads) {
      for (const Index corner : quad) mesh.connectivity.push_back(bottom + corner);
      for (const Index corner : quad) mesh.connectivity.push_back(bottom + stride + corner);
      mesh.types.push_back(ElementType::hexahedron);
      mesh.parts.push_back(parts[k]);
      mesh.layers.push_back(layer);
    }
  }
  return first_element;
}

}  // namespace cdfp
