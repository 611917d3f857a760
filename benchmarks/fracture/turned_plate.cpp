#include "fracture/turned_plate.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

namespace {

/// Cells of three or four points, counter-clockwise.
struct Plan {
  std::vector<PlanePoint> points;
  std::vector<std::vector<Index>> cells;
};

/// Squares, or triangles with diagonals by turns, in the square of n spacings about the origin.
Plan grid(Index n, double h, bool triangles) {
  Plan plan;
  const auto at = [n](Index i, Index j) { return j * (n + 1) + i; };
  for (Index j = 0; j <= n; ++j) {
    for (Index i = 0; i <= n; ++i) plan.points.push_back({(i - 0.5 * n) * h, (j - 0.5 * n) * h});
  }
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (!triangles) {
        plan.cells.push_back({a, b, c, d});
      } else if ((i + j) % 2 == 0) {
        plan.cells.push_back({a, b, c});
        plan.cells.push_back({a, c, d});
      } else {
        plan.cells.push_back({a, b, d});
        plan.cells.push_back({b, c, d});
      }
    }
  }
  return plan;
}

Plan irregular(Index n, double h, unsigned seed) {
  IrregularPlate square{.h = h, .width = n * h, .height = n * h, .thickness = h};
  square.seed = seed;
  Plan plan;
  plan.points = points_of(square);
  for (const std::array<Index, 3>& t : delaunay(plan.points).triangles)
    plan.cells.push_back({t[0], t[1], t[2]});
  for (PlanePoint& x : plan.points) x = {x[0] - 0.5 * n * h, x[1] - 0.5 * n * h};
  return plan;
}

}  // namespace

Mesh mesh_of(const TurnedPlate& p) {
  const auto n = static_cast<Index>(
                     std::ceil(p.side * (std::abs(std::cos(p.angle)) + std::abs(std::sin(p.angle))) / p.h)) +
                 3;
  Plan plan = p.irregular ? irregular(n, p.h, p.seed) : grid(n, p.h, p.cells != Cells::bricks);
  std::mt19937 random(p.seed);
  const auto draw = [&] { return p.shift * p.h * (2 * static_cast<double>(random()) / 0x1p32 - 1); };
  const double c = std::cos(p.angle), s = std::sin(p.angle);
  for (PlanePoint& x : plan.points) {
    x[0] += draw(), x[1] += draw();
    x = {c * x[0] - s * x[1], s * x[0] + c * x[1]};
  }

  Mesh mesh;
  mesh.part_names = {"plate"};
  NodeSet all{"all", {}}, rim{"rim", {}};
  std::vector<Index> number(plan.points.size(), kNone);
  const auto outside = [&](const PlanePoint& x, double inset) {
    return std::max(std::abs(x[0]), std::abs(x[1])) > 0.5 * p.side - inset;
  };
  const auto node = [&](Index point) {
    Index& below = number[static_cast<std::size_t>(point)];
    if (below != kNone) return below;
    below = mesh.node_count();
    const PlanePoint& x = plan.points[static_cast<std::size_t>(point)];
    for (const double z : {0.0, p.h}) {
      mesh.coordinates.insert(mesh.coordinates.end(), {x[0], x[1], z});
      all.nodes.push_back(mesh.node_count() - 1);
      if (outside(x, p.h)) rim.nodes.push_back(mesh.node_count() - 1);
    }
    return below;
  };
  for (std::vector<Index> cell : plan.cells) {
    PlanePoint middle{};
    for (const Index corner : cell) {
      const PlanePoint& x = plan.points[static_cast<std::size_t>(corner)];
      middle[0] += x[0] / static_cast<double>(cell.size()),
          middle[1] += x[1] / static_cast<double>(cell.size());
    }
    if (outside(middle, 0)) continue;
    if (p.cells == Cells::bricks) {
      mesh.types.push_back(ElementType::hexahedron);
      mesh.parts.push_back(0);
      for (const Index up : {0, 1}) {
        for (const Index corner : cell) mesh.connectivity.push_back(node(corner) + up);
      }
      continue;
    }
    const auto point = [&](Index corner) { return plan.points[static_cast<std::size_t>(corner)]; };
    std::sort(cell.begin(), cell.end());
    const bool clockwise = turn(point(cell[0]), point(cell[1]), point(cell[2])) < 0;
    std::array<Index, 6> nodes{};
    for (std::size_t k = 0; k < 3; ++k) {
      nodes[k] = node(cell[k]);
      nodes[k + 3] = nodes[k] + 1;
    }
    add_prism(mesh, nodes, clockwise, p.cells == Cells::wedges);
  }
  mesh.node_sets = {all, rim};
  return mesh;
}

}  // namespace bench
