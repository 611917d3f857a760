// Cracks against theory and published figures. Each case prints its figure beside what is wanted and leaves a
// picture in out/fracture/.
//   bench_fracture [CASE ...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "cdfp/simulation.hpp"
#include "cdfp/topology.hpp"
#include "output/chart.hpp"

namespace {

using namespace cdfp;

const std::filesystem::path kFolder = "out/fracture";

std::string shortfall;

void report(const std::string& what, double figure, double low, double high, const char* unit) {
  const bool holds = figure >= low && figure <= high;
  std::printf("  %-58s %12.5g   %10.5g .. %-10.5g %-5s %s\n", what.c_str(), figure, low, high, unit,
              holds ? "pass" : "SHORT");
  std::fflush(stdout);
  if (!holds) shortfall += " " + what + ";";
}

// ---- meshes ---------------------------------------------------------------------------------------------

/// A plate of nx x ny x 1 bricks in the x-y plane.
struct Plate {
  Index nx = 1, ny = 1;
  double width = 1, height = 1, thickness = 1;
  double y0 = 0;  ///< of the lower edge
  /// Nodes at y = 0 with x below this are doubled: a notch.
  double notch = -1;
  /// Places of nodes, for meshes that are no grid.
  std::function<std::array<double, 2>(double, double)> place = [](double x, double y) {
    return std::array<double, 2>{x, y};
  };
  std::function<Index(double, double)> part = [](double, double) { return 0; };  ///< by the element's middle
};

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

CohesiveLaw law_of(double strength, double energy, double kappa = 1, double eta = 1) {
  CohesiveLaw law;
  law.name = "law";
  law.strength = strength;
  law.fracture_energy = energy;
  law.mode_ratio = kappa;
  law.shear_ratio = eta;
  return law;
}

// ---- pictures -------------------------------------------------------------------------------------------

void chart(const std::string& name, const Chart& c) {
  std::filesystem::create_directories(kFolder);
  write_png(kFolder / (name + ".png"), 1500, 900, [&](Canvas& canvas) {
    draw_chart(canvas, {0, 60, 1460, 800}, c);
  });
}

struct CrackLine {
  Point a, b;
  double damage, time;
};

/// Cohesive facets of a plate seen along z, where the undeformed mesh had them.
std::vector<CrackLine> cracks_of(const Simulation& s) {
  const Frame frame = s.frame();
  std::vector<CrackLine> lines;
  for (const CrackFacet& f : frame.cracks) {
    std::array<Point, 4> p;
    for (int c = 0; c < 4; ++c) {
      const double* x = &frame.positions[3 * static_cast<std::size_t>(f.lower[c])];
      p[c] = {x[0], x[1]};
    }
    // Two corners lie over the other two.
    int far = 1;
    for (int c = 2; c < 4; ++c) {
      if (std::hypot(p[c].x - p[0].x, p[c].y - p[0].y) > std::hypot(p[far].x - p[0].x, p[far].y - p[0].y))
        far = c;
    }
    lines.push_back({p[0], p[far], f.damage, f.broken_time});
  }
  return lines;
}

void draw_cracks(const std::string& name, const std::vector<std::vector<CrackLine>>& panels, Point low,
                 Point high) {
  std::filesystem::create_directories(kFolder);
  const double scale = 900 / (high.x - low.x);
  const double height = scale * (high.y - low.y);
  const auto count = static_cast<int>(panels.size());
  write_png(kFolder / (name + ".png"), 60 + 960 * count, static_cast<int>(height) + 120, [&](Canvas& canvas) {
    for (int k = 0; k < count; ++k) {
      const Box box{60 + 960.0 * k, 60, 900, height};
      canvas.stroke(box, ink, 2);
      for (const CrackLine& line : panels[static_cast<std::size_t>(k)]) {
        const auto at = [&](Point p) {
          return Point{box.x + (p.x - low.x) * scale, box.bottom() - (p.y - low.y) * scale};
        };
        Colour colour = ink;
        colour.alpha = static_cast<float>(0.15 + 0.85 * line.damage);
        canvas.line(at(line.a), at(line.b), colour, 1 + 2 * line.damage);
      }
    }
  });
}

// ---- cases ----------------------------------------------------------------------------------------------

constexpr double kE = 275e9, kRho = 2750, kStrength = 300e6, kG = 100, kLength = 50e-3;

/// Zhou, Molinari, Ramesh 2006.
double expected_fragments(double rate) {
  const double c = std::sqrt(kE / kRho);
  const double size = kE * kG / (kStrength * kStrength);
  const double x = rate * kE * kE * kG / (c * kStrength * kStrength * kStrength);
  return kLength / (size * 4.5 / (1 + 0.77 * std::pow(x, 0.25) + 5.4 * std::pow(x, 0.75)));
}

/// Fragments of a bar that stretches at a constant rate. Without any scatter it breaks everywhere at once;
/// its strength varies by `scatter` (standard deviation over mean) in waves, the shortest a third of a
/// fragment, the same on any mesh.
Index fragments(double rate, Index elements, double scatter) {
  const double h = kLength / elements;
  const Plate bar{.nx = elements, .width = kLength, .height = h, .thickness = h};
  Model model = model_of(mesh_of(bar, {"bar"}), {kRho, kE, 0}, law_of(kStrength, kG), "bar");
  const int waves = static_cast<int>(3 * expected_fragments(rate));
  std::mt19937 random(1);
  model.strength_shares.assign(static_cast<std::size_t>(elements), 1.0);
  for (int k = 1; k <= waves; ++k) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(random()) / 0x1p32;
    for (Index e = 0; e < elements; ++e) {
      model.strength_shares[static_cast<std::size_t>(e)] +=
          scatter * std::sqrt(2.0 / waves) *
          std::cos(2 * std::numbers::pi * k * (e + 0.5) / elements + phase);
    }
  }
  const double speed = 0.5 * rate * kLength;
  model.prescribed_velocities = {{"left", {true, false, false}, {}, {-speed}},
                                 {"right", {true, false, false}, {}, {speed}}};
  model.initial_velocities = {{"bar", {-speed, 0, 0}, {rate, 0, 0, 0, 0, 0, 0, 0, 0}}};
  // Facets reach the strength at a strain of strength / E, then part by 2 G / strength.
  model.time.end =
      kStrength / kE / rate + 3 * 2 * kG / kStrength / (rate * kLength / expected_fragments(rate));
  Simulation s(std::move(model));
  s.advance(1000000);
  return s.broken_count() + 1;
}

void expanding_bar() {
  Chart picture;
  picture.title = "Fragments of an expanding bar of 50 mm";
  picture.x_title = "log10 of the strain rate in 1/s";
  picture.y_title = "log10 of the number of fragments";
  Series theory{"Zhou, Molinari, Ramesh", {}, line_colour(0)}, found{"cdfp", {}, line_colour(1)};
  for (const auto& [rate, elements] : {std::pair{1e3, 2000}, {1e4, 4000}, {1e5, 8000}, {1e6, 16000}}) {
    const double wanted = expected_fragments(rate);
    const Index count = fragments(rate, elements, 0.005);
    char what[80];
    std::snprintf(what, sizeof what, "fragments at %.0e 1/s (%d) over %.0f", rate, count, wanted);
    report(what, count / wanted, 0.7, 1.3, "");
    picture.x.push_back(std::log10(rate));
    theory.y.push_back(std::log10(wanted));
    found.y.push_back(std::log10(count));
  }
  const double coarse = fragments(1e4, 2000, 0.01), fine = fragments(1e4, 4000, 0.01);
  report("1 % of scatter, 1e4 1/s: 4000 elements over 2000", fine / coarse, 0.95, 1.05, "");
  picture.series = {theory, found};
  picture.legend = true;
  chart("expanding_bar", picture);
}

/// A bar pushed at its left by a pulse that rises soon and falls linearly: its reflection at the free end
/// breaks off a slice of half the pulse's length times strength over peak.
void spall() {
  const double rho = 2500, e = 74e9, c = std::sqrt(e / rho), strength = 60e6, g = 10;
  const double h = 0.0625e-3, peak = 90e6, rise = 0.5e-6, pulse = 5e-6;
  const Plate bar{.nx = 1200, .width = 1200 * h, .height = h, .thickness = h};
  Model model = model_of(mesh_of(bar, {"bar"}), {rho, e, 0}, law_of(strength, g), "bar");
  const double v = peak / (rho * c);
  model.prescribed_velocities = {{"left", {true, false, false}, {0, rise, rise + pulse}, {0, v, 0}}};
  model.time.end = bar.width / c + 1.2 * (rise + pulse);
  const auto end_node = static_cast<std::size_t>(model.mesh.node_sets[2].nodes.front());
  Simulation s(std::move(model));
  Chart picture;
  picture.title = "Free end of the bar that spalls";
  picture.x_title = "time in us";
  picture.y_title = "velocity in m/s";
  Series velocity{"free end", {}, line_colour(0)};
  while (s.advance(5) > 0) {
    picture.x.push_back(1e6 * s.time());
    velocity.y.push_back(s.velocities()[3 * end_node]);
  }
  picture.series = {velocity};
  chart("spall", picture);
  const Summary summary = s.summary();
  double spalled = 0, first = 1;
  for (const CrackLine& crack : cracks_of(s)) {
    if (crack.time >= first) continue;
    first = crack.time;
    spalled = crack.a.x;
  }
  const Frame frame = s.frame();
  double end = 0;
  for (std::size_t n = 0; n < frame.positions.size(); n += 3) end = std::max(end, frame.positions[n]);
  const double slice = 0.5 * c * pulse * strength / peak;
  report("spalled slice over theory", (end - spalled) / slice, 0.95, 1.05, "");
  report("dissipated over G A", summary.cohesive_dissipated_over_ga, 0.99, 1.01, "");
  report("energy balance", s.energies().balance(), 0.99, 1.01, "");
}

/// Of the steady state: the share of a strip's length that is broken, from left to right.
double crack_tip(const Simulation& s) {
  double tip = 0;
  for (const CrackLine& crack : cracks_of(s)) {
    if (crack.damage >= 1 && std::abs(crack.a.y) < 1e-3 && std::abs(crack.b.y) < 1e-3)
      tip = std::max({tip, crack.a.x, crack.b.x});
  }
  return tip;
}

/// Parts of a plate that cracks along y = 0 only: a row of bricks on either side, its columns by turns of two
/// parts, between which no facet opens.
const std::vector<std::string> kPath = {"bulk", "path_a", "path_b"};
std::function<Index(double, double)> path_of(double h) {
  return [h](double x, double y) { return std::abs(y) > h ? 0 : 1 + static_cast<Index>(x / h) % 2; };
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

/// Double cantilever beam, opened slowly: a + 0.64 h = (0.75 E h^3 w^2 / G_c)^(1/4), w the deflection of one
/// arm of height h; 0.64 h for the root's compliance. The crack's length is that of its energy.
void double_cantilever() {
  const double e = 74e9, gc = 10, arm = 4e-3, width = 44e-3, notch = 14e-3, longest = 26e-3, h = 0.25e-3;
  Plate plate{.nx = 176, .ny = 32, .width = width, .height = 2 * arm, .thickness = h};
  plate.y0 = -arm;
  plate.notch = notch;
  plate.part = path_of(h);
  Model model = model_of(mesh_of(plate, kPath), {2500, e, 0}, law_of(22e6, gc), "path");
  const double end = 3e-3, bending = 0.75 * e * arm * arm * arm;  // N m
  const double v = std::sqrt(gc * std::pow(longest + 0.64 * arm, 4) / bending) / (0.75 * end);
  NodeSet upper{"upper_end", {}}, lower{"lower_end", {}};
  for (const Index n : model.mesh.node_sets[1].nodes) {
    const double y = model.mesh.coordinates[3 * static_cast<std::size_t>(n) + 1];
    if (std::abs(y - 0.5 * arm) < 1e-6) upper.nodes.push_back(n);
    if (std::abs(y + 0.5 * arm) < 1e-6) lower.nodes.push_back(n);
  }
  model.mesh.node_sets.push_back(upper);
  model.mesh.node_sets.push_back(lower);
  // The speed grows first, so that the arms do not ring.
  model.prescribed_velocities = {{"upper_end", {false, true, false}, {0, 0.5 * end}, {0, v}},
                                 {"lower_end", {false, true, false}, {0, 0.5 * end}, {0, -v}},
                                 hold("right", {true, true, true})};
  model.time.end = end;
  Simulation s(std::move(model));
  Chart picture;
  picture.title = "Double cantilever beam";
  picture.x_title = "deflection of an arm in um";
  picture.y_title = "crack in mm";
  Series beam{"beam theory", {}, line_colour(0)}, found{"cdfp", {}, line_colour(1)};
  double worst = 0;
  while (!s.finished()) {
    s.advance(800);
    const double w = std::abs(s.positions()[3 * static_cast<std::size_t>(upper.nodes[0]) + 1] - 0.5 * arm);
    const double a = std::pow(bending * w * w / gc, 0.25) - 0.64 * arm;
    const double crack = notch + s.energies().cohesive_dissipated / (gc * h);
    picture.x.push_back(1e6 * w);
    beam.y.push_back(1e3 * std::max(a, notch));
    found.y.push_back(1e3 * crack);
    if (a > notch + 2e-3) worst = std::max(worst, std::abs(crack / a - 1));
  }
  report("double cantilever: crack off beam theory at most", worst, 0, 0.05, "");
  report("  dissipated over G A", s.summary().cohesive_dissipated_over_ga, 0.99, 1.01, "");
  report("  energy balance", s.energies().balance(), 0.99, 1.01, "");
  picture.series = {beam, found};
  picture.legend = true;
  chart("double_cantilever", picture);
}

/// Kalthoff and Winkler 1987: a plate with two notches is hit between them. Upper half; the notch is at y = 0
/// here. The grid's inner nodes are shifted by up to `shift` of its spacing, since bricks in rows offer
/// cracks two directions only.
double kalthoff_angle(double shift, std::vector<CrackLine>& cracks) {
  const double h = 1e-3, notch = 50e-3;
  Plate plate{.nx = 100, .ny = 100, .width = 100e-3, .height = 100e-3, .thickness = h};
  plate.y0 = -25e-3;
  plate.notch = notch;
  std::mt19937 random(1);
  plate.place = [&](double x, double y) {
    const auto draw = [&] { return shift * h * (2 * static_cast<double>(random()) / 0x1p32 - 1); };
    const bool inner = x > 0.5 * h && x < 99.5e-3 && y > -24.5e-3 && y < 74.5e-3;
    if (!inner || (std::abs(y) < 0.5 * h && x < notch + 0.5 * h)) return std::array<double, 2>{x, y};
    return std::array<double, 2>{x + draw(), y + draw()};
  };
  Model model = model_of(mesh_of(plate, {"plate"}), {8000, 190e9, 0.3}, law_of(844e6, 2.213e4), "plate");
  NodeSet hit{"hit", {}};
  for (const Index n : model.mesh.node_sets[1].nodes) {
    if (model.mesh.coordinates[3 * static_cast<std::size_t>(n) + 1] < -0.5 * h) hit.nodes.push_back(n);
  }
  model.mesh.node_sets.push_back(hit);
  model.prescribed_velocities = {{"hit", {true, false, false}, {}, {16.5}},
                                 hold("bottom", {false, true, false}),
                                 hold("all", {false, false, true})};
  model.time.end = 85e-6;
  Simulation s(std::move(model));
  s.advance(1000000);
  cracks = cracks_of(s);
  // The broken face that lies farthest from the notch's tip on the far side.
  double far = 0, angle = 0;
  for (const CrackLine& crack : cracks) {
    const double x = crack.a.x - notch, y = crack.a.y;
    if (crack.damage < 1 || y <= 0 || std::hypot(x, y) < far) continue;
    far = std::hypot(x, y);
    angle = std::atan2(y, x) * 180 / std::numbers::pi;
  }
  std::printf("  crack of %.1f mm\n", 1e3 * far);
  return angle;
}

void kalthoff() {
  std::vector<std::vector<CrackLine>> panels(2);
  report("Kalthoff-Winkler, regular grid: angle", kalthoff_angle(0, panels[0]), 60, 75, "deg");
  report("Kalthoff-Winkler, shifted nodes: angle", kalthoff_angle(0.25, panels[1]), 60, 75, "deg");
  draw_cracks("kalthoff", panels, {0, -25e-3}, {105e-3, 80e-3});
}

struct Case {
  const char* name;
  const char* title;
  void (*run)();
};

const Case kCases[] = {{"expanding_bar", "Expanding bar", expanding_bar},
                       {"spall", "Spall", spall},
                       {"strip", "Pre-strained strip", strip},
                       {"double_cantilever", "Double cantilever beam", double_cantilever},
                       {"kalthoff", "Kalthoff-Winkler plate", kalthoff}};

}  // namespace

int main(int count, char** words) {
  for (const Case& c : kCases) {
    bool chosen = count == 1;
    for (int i = 1; i < count; ++i) chosen |= std::string(words[i]) == c.name;
    if (!chosen) continue;
    const auto begin = std::chrono::steady_clock::now();
    std::printf("%s\n", c.title);
    c.run();
    std::printf("  (%.1f s)\n",
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::printf("fracture: %s%s\n", shortfall.empty() ? "pass" : "short:", shortfall.c_str());
  return 0;
}
