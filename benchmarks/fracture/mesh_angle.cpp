#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"
#include "fracture/turned_plate.hpp"

namespace bench {

using namespace cdfp;

namespace {

constexpr double kSide = 60e-3, kBrick = 1e-3, kTriangle = 1.5e-3, kScratch = 5e-3, kEnergy = 200;

double middle_of(const Mesh& m, std::size_t first, std::size_t corners, std::size_t axis) {
  double sum = 0;
  for (std::size_t c = first; c < first + corners; ++c)
    sum += m.coordinates[3 * static_cast<std::size_t>(m.connectivity[c]) + axis];
  return sum / static_cast<double>(corners);
}

struct Found {
  double off = 0;         ///< degrees, of the line from end to end
  double dissipated = 0;  ///< over what a straight crack from end to end takes
  std::vector<CrackLine> cracks;
};

/// A plate is stretched along y, with a scratch along x in its middle. In a plate without grain the crack
/// goes on along the scratch.
Found found(const TurnedPlate& plate) {
  Model model = model_of(mesh_of(plate), {2500, 74e9, 0.2}, law_of(60e6, kEnergy), "plate");
  const Mesh& m = model.mesh;
  std::size_t corner = 0;
  for (const ElementType type : m.types) {
    const std::size_t corners = type == ElementType::hexahedron ? 8 : type == ElementType::wedge ? 6 : 4;
    const double x = middle_of(m, corner, corners, 0), y = middle_of(m, corner, corners, 1);
    model.strength_shares.push_back(std::abs(x) < kScratch && std::abs(y) < 1e-3 ? 0.05 : 1.0);
    corner += corners;
  }
  // The rim moves as a plate does that is stretched evenly; so does the plate at first.
  const double rate = 12;
  for (const Index node : m.node_sets[1].nodes) {
    const std::string name = "rim_" + std::to_string(node);
    model.prescribed_velocities.push_back(
        {name, {false, true, false}, {}, {rate * m.coordinates[3 * static_cast<std::size_t>(node) + 1]}});
  }
  for (const Index node : std::vector<Index>(m.node_sets[1].nodes))
    model.mesh.node_sets.push_back({"rim_" + std::to_string(node), {node}});
  model.prescribed_velocities.push_back(hold("rim", {true, false, false}));
  model.prescribed_velocities.push_back(hold("all", {false, false, true}));
  model.initial_velocities = {{"plate", {}, {0, 0, 0, 0, rate, 0, 0, 0, 0}}};
  model.time.end = 120e-6;
  Simulation s(std::move(model));
  double ends[2] = {0, 0};
  Point at[2];
  Found f;
  while (!s.finished() && std::min(ends[0], ends[1]) < 18e-3) {
    s.advance(20);
    f.cracks = cracks_of(s);
    for (const CrackLine& c : f.cracks) {
      const Point q{0.5 * (c.a.x + c.b.x), 0.5 * (c.a.y + c.b.y)};
      const int side = q.x > 0;
      const double far = std::hypot(q.x, q.y);
      if (c.damage < 1 || far <= ends[side]) continue;
      ends[side] = far;
      at[side] = q;
    }
  }
  f.off = std::abs(std::atan2(at[1].y - at[0].y, at[1].x - at[0].x)) * 180 / std::numbers::pi;
  f.dissipated = s.energies().cohesive_dissipated / (kEnergy * plate.h * (ends[0] + ends[1]));
  return f;
}

}  // namespace

/// The mesh is turned against the plate: as a grid, with its nodes moved at random, and between points thrown
/// at random, the latter two several times.
void mesh_angle() {
  Chart picture;
  picture.title = "Turn of a crack by the mesh";
  picture.x_title = "angle of the mesh against the plate, degrees";
  picture.y_title = "how far off the crack is at most, degrees";
  picture.legend = true;
  picture.x = {0, 15, 22.5, 30, 45};
  std::vector<std::vector<CrackLine>> panels;
  /// Without a pass line where `most` is 0.
  const auto study = [&](const std::string& name, TurnedPlate plate, double most, const Series& style) {
    const bool at_random = plate.irregular || plate.shift > 0;
    Series series = style;
    series.name = name;
    double worst = 0, dearest = 0;
    for (const double angle : picture.x) {
      series.y.push_back(0);
      for (plate.seed = 1; plate.seed <= (at_random ? 3U : 1U); ++plate.seed) {
        plate.angle = angle * std::numbers::pi / 180;
        Found f = found(plate);
        series.y.back() = std::max(series.y.back(), f.off);
        dearest = std::max(dearest, f.dissipated);
        if (angle == 30 && plate.seed == 1) panels.push_back(std::move(f.cracks));
      }
      worst = std::max(worst, series.y.back());
    }
    picture.series.push_back(series);
    const std::string what = name + ": crack off its direction at most";
    if (most > 0) {
      report(what, worst, 0, most, "deg");
    } else {
      note(what, worst, "deg");
    }
    note("  dissipates, over a straight crack, at most", dearest, "");
  };
  const auto family = [&](const std::string& name, Cells cells, double most) {
    TurnedPlate plate{.cells = cells, .h = cells == Cells::bricks ? kBrick : kTriangle, .side = kSide};
    const Colour colour = line_colour(static_cast<std::size_t>(cells));
    study(name + ", grid", plate, most, {{}, {}, colour});
    plate.shift = 0.2;
    study(name + ", nodes moved", plate, most, {{}, {}, colour, 3, true});
    if (cells == Cells::bricks) return;
    plate.shift = 0;
    plate.irregular = true;
    study(name + ", irregular", plate, most, {{}, {}, colour, 1.5});
  };
  family("bricks", Cells::bricks, 0);
  family("wedges", Cells::wedges, 10);
  family("tetrahedra", Cells::tetrahedra, 10);
  chart("mesh_angle", picture);
  draw_cracks("mesh_angle_cracks", panels, {-0.5 * kSide, -0.5 * kSide}, {0.5 * kSide, 0.5 * kSide});
}

}  // namespace bench
