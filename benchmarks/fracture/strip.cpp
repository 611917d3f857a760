#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

namespace {

/// Of the steady state: the share of a strip's length that is broken, from left to right.
double crack_tip(const Simulation& s) {
  double tip = 0;
  for (const CrackLine& crack : cracks_of(s)) {
    if (crack.damage >= 1 && std::abs(crack.a.y) < 1e-3 && std::abs(crack.b.y) < 1e-3)
      tip = std::max({tip, crack.a.x, crack.b.x});
  }
  return tip;
}

constexpr double kGlassE = 74e9, kGlassNu = 0.2, kGlassRho = 2500, kGlassRayleigh = 3199.3;

struct StripRun {
  double speed;  ///< m/s, over the second half of the way
  double tip;    ///< m
  double balance, over_ga;
  std::vector<Point> way;  ///< time in us, tip in mm
};

/// A strip in plane strain with a notch, its edges moved apart until G of the strip ahead of the crack is
/// `share` of G_c, as if no crack ran meanwhile: G = E (1-nu)/((1+nu)(1-2nu)) d^2 / (2 H), with d the
/// distance by which edges H apart have moved.
StripRun run_strip(double share, double ramp, double end) {
  const double h = 0.25e-3, height = 16e-3, width = 64e-3, notch = 16e-3, gc = 10;
  Plate plate{.nx = 256, .ny = 64, .width = width, .height = height, .thickness = h};
  plate.y0 = -0.5 * height;
  plate.notch = notch;
  plate.part = path_of(h);
  Model model = model_of(mesh_of(plate, kPath), {kGlassRho, kGlassE, kGlassNu}, law_of(30e6, gc), "path");
  const double modulus = kGlassE * (1 - kGlassNu) / ((1 + kGlassNu) * (1 - 2 * kGlassNu));
  const double moved = std::sqrt(2 * share * gc * height / modulus);
  const double v = 0.5 * moved / ramp;
  const double late = 1.0001 * ramp;
  model.prescribed_velocities = {{"top", {false, true, false}, {0, ramp, late}, {v, v, 0}},
                                 {"bottom", {false, true, false}, {0, ramp, late}, {-v, -v, 0}},
                                 hold("top", {true, false, false}),
                                 hold("bottom", {true, false, false}),
                                 hold("all", {false, false, true})};
  // The strip starts as the ramp will have it, but for the strain: no wave runs from the edges.
  for (const std::string& part : kPath)
    model.initial_velocities.push_back({part, {}, {0, 0, 0, 0, 2 * v / height, 0, 0, 0, 0}});
  model.time.end = end;
  Simulation s(std::move(model));
  StripRun run{};
  double half_time = 0;
  const double half = 0.5 * (notch + width);
  while (!s.finished()) {
    s.advance(10);
    const double tip = std::max(notch, crack_tip(s));
    run.way.push_back({1e6 * s.time(), 1e3 * tip});
    if (tip > half && half_time == 0) half_time = s.time();
    if (half_time > 0 && tip < width - 8e-3) run.speed = (tip - half) / std::max(1e-9, s.time() - half_time);
    run.tip = tip;
    if (tip > width - 2e-3) break;
  }
  run.balance = s.energies().balance();
  run.over_ga = s.summary().cohesive_dissipated_over_ga;
  return run;
}

}  // namespace

void strip() {
  Chart picture;
  picture.title = "Crack tip in a strip of glass in plane strain";
  picture.x_title = "time in us";
  picture.y_title = "tip in mm";
  const auto draw = [&](const char* name, const StripRun& run, std::size_t colour) {
    Series series{name, {}, line_colour(colour)};
    for (double t = 0; t < 60; t += 0.2) {
      const auto at = std::find_if(run.way.begin(), run.way.end(), [&](Point p) { return p.x >= t; });
      series.y.push_back(at == run.way.end() ? std::nan("") : at->y);
      if (picture.series.empty()) picture.x.push_back(t);
    }
    picture.series.push_back(series);
  };
  const StripRun below = run_strip(0.9, 40e-6, 80e-6);
  report("strip at 0.9 G_c: way of the crack, mm", 1e3 * (below.tip - 16e-3), 0, 3, "mm");
  draw("0.9 G_c", below, 0);
  const StripRun above = run_strip(1.2, 40e-6, 110e-6);
  report("strip at 1.2 G_c: way of the crack, mm", 1e3 * (above.tip - 16e-3), 40, 48, "mm");
  draw("1.2 G_c", above, 1);
  for (const auto& [share, colour] : {std::pair{2.0, 2u}, {4.0, 3u}}) {
    const StripRun run = run_strip(share, 4e-6, 60e-6);
    char what[60];
    std::snprintf(what, sizeof what, "strip at %.0f G_c: speed over c_R", share);
    report(what, run.speed / kGlassRayleigh, 0.2, 1.0, "");
    report("  dissipated over G A", run.over_ga, 0.99, 1.01, "");
    report("  energy balance", run.balance, 0.99, 1.01, "");
    draw(share == 2 ? "2 G_c" : "4 G_c", run, colour);
  }
  picture.legend = true;
  chart("strip", picture);
}

}  // namespace bench
