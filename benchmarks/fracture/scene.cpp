#include "fracture/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace bench {

using namespace cdfp;

Mesh mesh_of(const Plate& p, const std::vector<std::string>& parts) {
  Mesh mesh;
  mesh.part_names = parts;
  const double dx = p.width / p.nx, dy = p.height / p.ny;
  const auto y_of = [&](Index j) { return p.y0 + dy * j; };
  const auto notched = [&](Index i, Index j) { return std::abs(y_of(j)) < 1e-6 * dy && dx * i < p.notch; };
  std::vector<Index> number(static_cast<std::size_t>(2 * (p.nx + 1) * (p.ny + 1)));
  NodeSet all{"all", {}}, left{"left", {}}, right{"right", {}}, bottom{"bottom", {}}, top{"top", {}};
  const auto add = [&](Index i, Index j) {
    const auto [x, y] = p.place(dx * i, y_of(j));
    for (const double z : {0.0, p.thickness}) {
      const Index n = mesh.node_count();
      mesh.coordinates.insert(mesh.coordinates.end(), {x, y, z});
      all.nodes.push_back(n);
      if (i == 0) left.nodes.push_back(n);
      if (i == p.nx) right.nodes.push_back(n);
      if (j == 0) bottom.nodes.push_back(n);
      if (j == p.ny) top.nodes.push_back(n);
    }
    return mesh.node_count() - 2;
  };
  for (Index j = 0; j <= p.ny; ++j) {
    for (Index i = 0; i <= p.nx; ++i) {
      const std::size_t at = 2 * static_cast<std::size_t>(j * (p.nx + 1) + i);
      number[at] = number[at + 1] = add(i, j);
      if (notched(i, j)) number[at + 1] = add(i, j);  // the side above
    }
  }
  for (Index j = 0; j < p.ny; ++j) {
    for (Index i = 0; i < p.nx; ++i) {
      const auto node = [&](Index a, Index b) {
        return number[2 * static_cast<std::size_t>((j + b) * (p.nx + 1) + i + a) + (b == 0 ? 1 : 0)];
      };
      mesh.types.push_back(ElementType::hexahedron);
      mesh.parts.push_back(p.part(dx * (i + 0.5), y_of(j) + 0.5 * dy));
      for (const Index up : {0, 1}) {
        for (const Index n : {node(0, 0), node(1, 0), node(1, 1), node(0, 1)})
          mesh.connectivity.push_back(n + up);
      }
    }
  }
  mesh.node_sets = {all, left, right, bottom, top};
  return mesh;
}

/// Corners first, then sides, the notch, and the inside: thrown at random, but kept apart.
std::vector<PlanePoint> points_of(const IrregularPlate& p) {
  std::vector<PlanePoint> points{
      {0, p.y0}, {p.width, p.y0}, {p.width, p.y0 + p.height}, {0, p.y0 + p.height}};
  const auto nx = static_cast<int>(std::lround(p.width / p.h)),
             ny = static_cast<int>(std::lround(p.height / p.h));
  for (int i = 1; i < nx; ++i) {
    points.push_back({p.width * i / nx, p.y0});
    points.push_back({p.width * i / nx, p.y0 + p.height});
  }
  for (int j = 1; j < ny; ++j) {
    const double y = p.y0 + p.height * j / ny;
    points.push_back({0, std::abs(y) < 1e-6 * p.h ? 0 : y});
    points.push_back({p.width, std::abs(y) < 1e-6 * p.h ? 0 : y});
  }
  for (int i = 1; p.h * i < p.notch + 0.5 * p.h; ++i) points.push_back({p.h * i, 0});
  std::mt19937 random(p.seed);
  const auto draw = [&] { return static_cast<double>(random()) / 0x1p32; };
  // Darts that keep apart, with a grid of cells that hold one each.
  const double apart = 0.75 * p.h, cell = apart / std::numbers::sqrt2;
  const auto columns = static_cast<int>(p.width / cell) + 1, rows = static_cast<int>(p.height / cell) + 1;
  std::vector<Index> held(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), kNone);
  const auto place = [&](const PlanePoint& x) {
    return std::array{static_cast<int>(x[0] / cell), static_cast<int>((x[1] - p.y0) / cell)};
  };
  const auto throws = static_cast<long>(40 * p.width * p.height / (p.h * p.h));
  for (long k = 0; k < throws; ++k) {
    const PlanePoint x{p.width * draw(), p.y0 + p.height * draw()};
    const double from_side = std::min({x[0], p.width - x[0], x[1] - p.y0, p.y0 + p.height - x[1]});
    const double from_notch = p.notch > 0 ? std::hypot(x[1], std::max(0.0, x[0] - p.notch)) : p.width;
    if (std::min(from_side, from_notch) < 0.6 * p.h) continue;
    const auto [i, j] = place(x);
    bool free = true;
    for (int b = std::max(0, j - 2); b <= std::min(rows - 1, j + 2) && free; ++b) {
      for (int a = std::max(0, i - 2); a <= std::min(columns - 1, i + 2) && free; ++a) {
        const Index other = held[static_cast<std::size_t>(b) * static_cast<std::size_t>(columns) +
                                 static_cast<std::size_t>(a)];
        if (other == kNone) continue;
        const PlanePoint& y = points[static_cast<std::size_t>(other)];
        free = std::hypot(x[0] - y[0], x[1] - y[1]) >= apart;
      }
    }
    if (!free) continue;
    held[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)] =
        static_cast<Index>(points.size());
    points.push_back(x);
  }
  return points;
}

void add_prism(Mesh& mesh, const std::array<Index, 6>& nodes, bool clockwise, bool wedge) {
  const auto add = [&](ElementType type, std::initializer_list<std::size_t> corners) {
    mesh.types.push_back(type);
    mesh.parts.push_back(0);
    for (const std::size_t c : corners) mesh.connectivity.push_back(nodes[c]);
  };
  const std::size_t b = clockwise ? 2 : 1, c = clockwise ? 1 : 2;
  if (wedge) {
    add(ElementType::wedge, {0, b, c, 3, 3 + b, 3 + c});
    return;
  }
  // Sides split from the lesser point up.
  for (const std::array<std::size_t, 4>& t :
       {std::array<std::size_t, 4>{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}}) {
    add(ElementType::tetrahedron, {t[0], t[b], t[c], t[3]});
  }
}

Mesh mesh_of(const IrregularPlate& p, const std::vector<std::string>& parts) {
  const std::vector<PlanePoint> points = points_of(p);
  Mesh mesh;
  mesh.part_names = parts;
  NodeSet all{"all", {}}, left{"left", {}}, right{"right", {}}, bottom{"bottom", {}}, top{"top", {}};
  std::vector<std::array<Index, 2>> number;  // below and above the notch; the node over it comes next
  const auto add = [&](const PlanePoint& x) {
    for (const double z : {0.0, p.thickness}) {
      const Index n = mesh.node_count();
      mesh.coordinates.insert(mesh.coordinates.end(), {x[0], x[1], z});
      all.nodes.push_back(n);
      if (x[0] == 0) left.nodes.push_back(n);
      if (x[0] == p.width) right.nodes.push_back(n);
      if (x[1] == p.y0) bottom.nodes.push_back(n);
      if (x[1] == p.y0 + p.height) top.nodes.push_back(n);
    }
    return mesh.node_count() - 2;
  };
  for (const PlanePoint& x : points) {
    const Index below = add(x);
    number.push_back({below, x[1] == 0 && x[0] < p.notch - 0.5 * p.h ? add(x) : below});
  }
  for (std::array<Index, 3> t : delaunay(points).triangles) {
    double middle = 0;
    for (const Index c : t) middle += points[static_cast<std::size_t>(c)][1];
    std::sort(t.begin(), t.end());
    const bool clockwise =
        turn(points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
             points[static_cast<std::size_t>(t[2])]) < 0;
    std::array<Index, 6> n{};  // three below, three over them
    for (std::size_t c = 0; c < 3; ++c) {
      n[c] = number[static_cast<std::size_t>(t[c])][middle > 0 ? 1 : 0];
      n[c + 3] = n[c] + 1;
    }
    add_prism(mesh, n, clockwise, p.wedges);
  }
  mesh.node_sets = {all, left, right, bottom, top};
  return mesh;
}

const std::vector<std::string> kPath = {"bulk", "path_a", "path_b"};
std::function<Index(double, double)> path_of(double h) {
  return [h](double x, double y) { return std::abs(y) > h ? 0 : 1 + static_cast<Index>(x / h) % 2; };
}

PrescribedVelocity hold(const std::string& set, std::array<bool, 3> directions) {
  return {set, directions, {}, {0.0}};
}

Model model_of(Mesh mesh, const ElasticMaterial& material, const CohesiveLaw& law,
               const std::string& cracking) {
  Model model;
  model.mesh = std::move(mesh);
  model.materials = {{"solid", material}};
  model.cohesive_laws = {law};
  for (const std::string& name : model.mesh.part_names) {
    Part part;
    part.name = name;
    part.material = "solid";
    if (name.starts_with(cracking)) part.cohesive_law = law.name;
    model.parts.push_back(part);
  }
  model.output.history_interval = 1000000;
  model.threads = 1;
  return model;
}

CohesiveLaw law_of(double strength, double energy, double kappa, double eta) {
  CohesiveLaw law;
  law.name = "law";
  law.strength = strength;
  law.fracture_energy = energy;
  law.mode_ratio = kappa;
  law.shear_ratio = eta;
  return law;
}

}  // namespace bench
