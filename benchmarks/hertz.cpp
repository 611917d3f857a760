// Hertz: a steel ball on glass at 0.1, 1 and 3 m/s. Peak force and contact time against the closed formulas
// on finer and finer meshes: 2, 3, 4 (6) elements along the greatest contact radius.
//   benchmarks/run.sh hertz [FINEST]
// The convergence is drawn in out/hertz/convergence.png.
#include "hertz.hpp"

#include <cstdio>
#include <cstdlib>
#include <limits>

#include "support/picture.hpp"

namespace {

constexpr double kMeshes[] = {2, 3, 4, 6};  ///< elements along the greatest contact radius
constexpr double kNotRun = std::numeric_limits<double>::quiet_NaN();

/// Errors in percent over the meshes, force and time of one speed after the other.
void draw(std::vector<cdfp::Series> errors) {
  cdfp::Chart chart;
  chart.title = "Steel ball on glass against Hertz";
  chart.x_title = "elements along the contact radius";
  chart.y_title = "error in %";
  chart.x.assign(std::begin(kMeshes), std::end(kMeshes));
  chart.series = std::move(errors);
  chart.bands = {{-5, 5, "wanted on a fine mesh", cdfp::rgb(0x009e73, 0.15)}};
  chart.legend = true;
  bench::save_chart("out/hertz/convergence.png", chart);
}

}  // namespace

int main(int argc, char** argv) {
  const double finest = argc > 1 ? std::atof(argv[1]) : 4;
  std::string shortfall;
  std::vector<cdfp::Series> errors;
  std::printf(
      "  m/s  elements/radius  elements  steps    peak N  (Hertz)  error %%   contact us  (Hertz)  error %%  "
      " "
      "balance  wall s\n");
  for (const double speed : {3.0, 1.0, 0.1}) {
    const hertz::Exact exact = hertz::exact_values(speed);
    double force_error = 0, time_error = 0;
    char name[40];
    std::snprintf(name, sizeof name, "%.1f m/s", speed);
    const cdfp::Colour colour = cdfp::line_colour(errors.size() / 2);
    cdfp::Series force{std::string("force, ") + name, {}, colour},
        time{std::string("time, ") + name, {}, colour, 3, true};
    for (const double n : kMeshes) {
      if (n > finest) {
        force.y.push_back(kNotRun), time.y.push_back(kNotRun);
        continue;
      }
      const hertz::Result r = hertz::impact(speed, n);
      force_error = 100 * (r.force / exact.force - 1);
      time_error = 100 * (r.time / exact.time - 1);
      force.y.push_back(force_error), time.y.push_back(time_error);
      std::printf("%5.1f  %15.0f  %8d %6lld  %8.1f %8.1f  %7.1f   %10.2f %8.2f  %7.1f   %7.4f  %6.1f\n",
                  speed, n, r.elements, r.steps, r.force, exact.force, force_error, 1e6 * r.time,
                  1e6 * exact.time, time_error, r.balance, r.wall);
      std::fflush(stdout);
    }
    errors.push_back(std::move(force)), errors.push_back(std::move(time));
    char text[60];
    std::snprintf(text, sizeof text, " %.1f m/s: %+.1f %% force, %+.1f %% time;", speed, force_error,
                  time_error);
    if (std::abs(force_error) > 5 || std::abs(time_error) > 5) shortfall += text;
  }
  draw(std::move(errors));
  std::printf("hertz: %s%s\n", shortfall.empty() ? "pass" : "short:", shortfall.c_str());
  return 0;
}
