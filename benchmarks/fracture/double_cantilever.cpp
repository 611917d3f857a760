#include <algorithm>
#include <cmath>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

/// Double cantilever beam, opened slowly: a + 0.64 h = (0.75 E h^3 w^2 / G_c)^(1/4), w the deflection of one
/// arm of height h; 0.64 h for the root's compliance. The crack's length is that of its energy.
void double_cantilever() {
  const double e = 74e9, gc = 10, arm = 4e-3, width = 44e-3, notch = 14e-3, longest = 26e-3, h = 0.25e-3;
  Plate plate{.nx = 176, .ny = 32, .width = width, .height = 2 * arm, .thickness = h};
  plate.y0 = -arm;
  plate.notch = notch;
  plate.part = path_of(h);
  Model model = model_of(mesh_of(plate, kPath), {2500, e, 0}, law_of(18e6, gc), "path");
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

}  // namespace bench
