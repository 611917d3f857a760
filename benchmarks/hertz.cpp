// Hertz: a steel ball on glass at 0.1, 1 and 3 m/s. Peak force and contact time against the closed formulas
// on finer and finer meshes: 2, 3, 4 (6) elements along the greatest contact radius.
//   benchmarks/run.sh hertz [FINEST]
#include "hertz.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  const double finest = argc > 1 ? std::atof(argv[1]) : 4;
  std::string shortfall;
  std::printf(
      "  m/s  elements/radius  elements  steps    peak N  (Hertz)  error %%   contact us  (Hertz)  error %%  "
      " "
      "balance  wall s\n");
  for (const double speed : {3.0, 1.0, 0.1}) {
    const hertz::Exact exact = hertz::exact_values(speed);
    double force_error = 0, time_error = 0;
    for (const double n : {2.0, 3.0, 4.0, 6.0}) {
      if (n > finest) break;
      const hertz::Result r = hertz::impact(speed, n);
      force_error = 100 * (r.force / exact.force - 1);
      time_error = 100 * (r.time / exact.time - 1);
      std::printf("%5.1f  %15.0f  %8d %6lld  %8.1f %8.1f  %7.1f   %10.2f %8.2f  %7.1f   %7.4f  %6.1f\n",
                  speed, n, r.elements, r.steps, r.force, exact.force, force_error, 1e6 * r.time,
                  1e6 * exact.time, time_error, r.balance, r.wall);
      std::fflush(stdout);
    }
    char text[60];
    std::snprintf(text, sizeof text, " %.1f m/s: %+.1f %% force, %+.1f %% time;", speed, force_error,
                  time_error);
    if (std::abs(force_error) > 5 || std::abs(time_error) > 5) shortfall += text;
  }
  std::printf("hertz: %s%s\n", shortfall.empty() ? "pass" : "short:", shortfall.c_str());
  return 0;
}
