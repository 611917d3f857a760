#include <algorithm>
#include <cmath>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

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

}  // namespace bench
