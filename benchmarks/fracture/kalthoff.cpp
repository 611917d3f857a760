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

constexpr double kNotch = 50e-3, kH = 1e-3, kIrregular = 100e-3 / 64, kLow = -25e-3, kSide = 100e-3;

/// Upper half of the plate; the notch is at y = 0. The grid's inner nodes are shifted by up to `shift` of its
/// spacing.
Mesh bricks(double shift) {
  Plate plate{.nx = 100, .ny = 100, .width = kSide, .height = kSide, .thickness = kH};
  plate.y0 = kLow;
  plate.notch = kNotch;
  std::mt19937 random(1);
  plate.place = [&](double x, double y) {
    const auto draw = [&] { return shift * kH * (2 * static_cast<double>(random()) / 0x1p32 - 1); };
    const bool inner =
        x > 0.5 * kH && x < kSide - 0.5 * kH && y > kLow + 0.5 * kH && y < kLow + kSide - 0.5 * kH;
    if (!inner || (std::abs(y) < 0.5 * kH && x < kNotch + 0.5 * kH)) return std::array<double, 2>{x, y};
    return std::array<double, 2>{x + draw(), y + draw()};
  };
  return mesh_of(plate, {"plate"});
}

Mesh irregular(unsigned seed, bool wedges) {
  IrregularPlate plate{.h = kIrregular, .width = kSide, .height = kSide, .thickness = kIrregular};
  plate.y0 = kLow;
  plate.notch = kNotch;
  plate.seed = seed;
  plate.wedges = wedges;
  return mesh_of(plate, {"plate"});
}

struct Run {
  double angle = 0;  ///< degrees, of the crack's centre seen from the notch
  double speed = 0;  ///< m/s, over the crack's second half
  double balance = 0;
  std::vector<CrackLine> cracks;
};

Run run(Mesh mesh) {
  Model model = model_of(std::move(mesh), {8000, 190e9, 0.3}, law_of(844e6, 2.213e4), "plate");
  NodeSet hit{"hit", {}};
  for (const Index n : model.mesh.node_sets[1].nodes) {
    if (model.mesh.coordinates[3 * static_cast<std::size_t>(n) + 1] < -0.5 * kH) hit.nodes.push_back(n);
  }
  model.mesh.node_sets.push_back(hit);
  model.prescribed_velocities = {{"hit", {true, false, false}, {}, {16.5}},
                                 hold("bottom", {false, true, false}),
                                 hold("all", {false, false, true})};
  model.time.end = 85e-6;
  Simulation s(std::move(model));
  s.advance(1000000);
  Run r;
  r.cracks = cracks_of(s);
  r.balance = s.energies().balance();
  const auto way = [](const CrackLine& c) {
    return c.damage >= 1 && c.a.y > 0 ? std::hypot(c.a.x - kNotch, c.a.y) : 0;
  };
  double far = 0, x = 0, y = 0;
  for (const CrackLine& crack : r.cracks) {
    if (way(crack) == 0) continue;
    far = std::max(far, way(crack));
    x += crack.a.x - kNotch;
    y += crack.a.y;
  }
  r.angle = std::atan2(y, x) * 180 / std::numbers::pi;
  double half = 1, end = 0;
  for (const CrackLine& crack : r.cracks) {
    if (way(crack) > 0.5 * far) half = std::min(half, crack.time);
    if (way(crack) > 0.98 * far) end = std::max(end, crack.time);
  }
  r.speed = 0.48 * far / (end - half);
  return r;
}

}  // namespace

/// Kalthoff and Winkler 1987: a plate with two notches is hit between them. Bricks in rows offer cracks two
/// directions only; how far that steers them is `mesh_angle`'s matter.
void kalthoff() {
  std::vector<std::vector<CrackLine>> panels;
  const auto show = [&](const std::string& mesh, Mesh of) {
    panels.emplace_back();
    const Run r = run(std::move(of));
    panels.back() = r.cracks;
    report("Kalthoff-Winkler, " + mesh + ": speed over c_R", r.speed / 2800, 0.2, 1, "");
    report("  energy balance", r.balance, 0.99, 1.01, "");
    return r.angle;
  };
  report("  angle", show("tetrahedra", irregular(1, false)), 60, 75, "deg");
  report("  angle", show("other tetrahedra", irregular(2, false)), 60, 75, "deg");
  report("  angle", show("wedges", irregular(1, true)), 60, 75, "deg");
  report("  angle", show("other wedges", irregular(2, true)), 60, 75, "deg");
  note("  angle", show("regular bricks", bricks(0)), "deg");
  note("  angle", show("shifted bricks", bricks(0.25)), "deg");
  draw_cracks("kalthoff", panels, {0, kLow}, {105e-3, 80e-3});
}

}  // namespace bench
