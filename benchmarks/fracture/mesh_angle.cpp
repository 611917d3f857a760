#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

namespace {

constexpr double kSide = 60e-3, kH = 1e-3, kScratch = 5e-3;

/// A plate is stretched across the direction `angle`, with a scratch along it in its middle. In a plate
/// without grain the crack goes on along the scratch. Instead of the mesh, the load is turned.
double found_angle(Mesh mesh, double angle, std::vector<CrackLine>& cracks) {
  const double strength = 60e6, e = 74e9, rho = 2500;
  const double along[2] = {std::cos(angle), std::sin(angle)};
  const double middle = 0.5 * kSide;
  const auto place = [&](Point p) {
    return Point{along[0] * (p.x - middle) + along[1] * (p.y - middle),
                 along[0] * (p.y - middle) - along[1] * (p.x - middle)};
  };
  Model model = model_of(std::move(mesh), {rho, e, 0.2}, law_of(strength, 200), "plate");
  const Mesh& m = model.mesh;
  std::size_t corner = 0;
  for (const ElementType type : m.types) {
    const std::size_t corners = type == ElementType::hexahedron ? 8 : 4;
    Point p;
    for (std::size_t c = 0; c < corners; ++c, ++corner) {
      const double* x = &m.coordinates[3 * static_cast<std::size_t>(m.connectivity[corner])];
      p.x += x[0] / static_cast<double>(corners), p.y += x[1] / static_cast<double>(corners);
    }
    const Point q = place(p);
    model.strength_shares.push_back(std::abs(q.x) < kScratch && std::abs(q.y) < kH ? 0.05 : 1.0);
  }
  // Edges move as a plate does that is stretched evenly; so does the plate at first.
  const double rate = 12;
  const double n[2] = {-along[1], along[0]};
  const double g[4] = {rate * n[0] * n[0], rate * n[0] * n[1], rate * n[1] * n[0], rate * n[1] * n[1]};
  for (Index node = 0; node < m.node_count(); ++node) {
    const double x = m.coordinates[3 * static_cast<std::size_t>(node)],
                 y = m.coordinates[3 * static_cast<std::size_t>(node) + 1];
    if (std::min({x, y, kSide - x, kSide - y}) > 1e-9) continue;
    const std::string name = "rim_" + std::to_string(node);
    model.mesh.node_sets.push_back({name, {node}});
    model.prescribed_velocities.push_back({name, {true, false, false}, {}, {g[0] * x + g[1] * y}});
    model.prescribed_velocities.push_back({name, {false, true, false}, {}, {g[2] * x + g[3] * y}});
  }
  model.prescribed_velocities.push_back(hold("all", {false, false, true}));
  model.initial_velocities = {{"plate", {}, {g[0], g[1], 0, g[2], g[3], 0, 0, 0, 0}}};
  model.time.end = 120e-6;
  Simulation s(std::move(model));
  double ends[2] = {0, 0};
  Point at[2];
  while (!s.finished() && std::min(ends[0], ends[1]) < 18e-3) {
    s.advance(20);
    cracks = cracks_of(s);
    for (const CrackLine& c : cracks) {
      const Point q = place({0.5 * (c.a.x + c.b.x), 0.5 * (c.a.y + c.b.y)});
      const int side = q.x > 0;
      const double far = std::hypot(q.x, q.y);
      if (c.damage < 1 || far <= ends[side]) continue;
      ends[side] = far;
      at[side] = q;
    }
  }
  return std::abs(std::atan2(at[1].y - at[0].y, at[1].x - at[0].x)) * 180 / std::numbers::pi;
}

Mesh bricks(double shift) {
  Plate plate{.nx = 60, .ny = 60, .width = kSide, .height = kSide, .thickness = kH};
  std::mt19937 random(1);
  plate.place = [&](double x, double y) {
    const auto draw = [&] { return shift * kH * (2 * static_cast<double>(random()) / 0x1p32 - 1); };
    const bool inner = std::min({x, y, kSide - x, kSide - y}) > 0.5 * kH;
    return inner ? std::array<double, 2>{x + draw(), y + draw()} : std::array<double, 2>{x, y};
  };
  return mesh_of(plate, {"plate"});
}

}  // namespace

void mesh_angle() {
  Chart picture;
  picture.title = "Turn of a crack by the mesh";
  picture.x_title = "angle between the crack that the load asks for and the grid, degrees";
  picture.y_title = "how far off the crack is, degrees";
  std::vector<std::vector<CrackLine>> panels;
  const std::vector<double> angles{0, 15, 30, 45};
  picture.x = angles;
  const auto study = [&](const char* name, const Mesh& mesh) {
    Series series{name, {}, line_colour(picture.series.size())};
    for (const double angle : angles) {
      panels.emplace_back();
      series.y.push_back(found_angle(mesh, angle * std::numbers::pi / 180, panels.back()));
      if (angle != 30) panels.pop_back();
    }
    const double most = *std::max_element(series.y.begin(), series.y.end());
    picture.series.push_back(series);
    return most;
  };
  note("regular bricks: crack off its direction at most", study("regular bricks", bricks(0)), "deg");
  note("shifted bricks: crack off its direction at most", study("shifted bricks", bricks(0.25)), "deg");
  IrregularPlate plate{.h = 1.5e-3, .width = kSide, .height = kSide, .thickness = 1.5e-3};
  report("tetrahedra: crack off its direction at most", study("tetrahedra", mesh_of(plate, {"plate"})), 0, 10,
         "deg");
  picture.legend = true;
  chart("mesh_angle", picture);
  draw_cracks("mesh_angle_cracks", panels, {0, 0}, {kSide, kSide});
}

}  // namespace bench
