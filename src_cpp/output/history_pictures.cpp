#include "output/history_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "output/chart.hpp"
#include "output/columns.hpp"
#include "output/scale.hpp"

namespace cdfp {
namespace {

constexpr int width = 2000;

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

std::vector<double> in_unit(std::vector<double> values, const Unit& unit) {
  for (double& value : values) value /= unit.size;
  return values;
}

void write_both(const std::filesystem::path& folder, const char* name, int height, const Drawing& drawing) {
  write_png(folder / (std::string(name) + ".png"), width, height, drawing);
  write_svg(folder / (std::string(name) + ".svg"), width, height, drawing);
}

std::vector<Mark> crack_marks(const Summary& summary, const Unit& time_unit) {
  std::vector<Mark> marks;
  std::size_t number = 1;
  for (const Summary::FirstCrack& crack : summary.first_cracks) {
    if (std::isfinite(crack.time_s)) {
      const double at = crack.time_s / time_unit.size;
      marks.push_back({at,
                       "first crack, " + spoken(crack.part) + ": " + short_label(at) + " " + time_unit.name,
                       line_colour(number)});
    }
    ++number;
  }
  std::sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.x < b.x; });
  return marks;
}

void draw_force(const std::filesystem::path& folder, const History& history, const Summary& summary) {
  const std::vector<double> times = column(history, "time_s");
  const std::vector<double> force = column(history, "impactor_force_z_n");
  if (times.empty() || force.empty()) return;
  const Unit time_unit = readable_unit(largest(times), "s");
  const double peak = std::isfinite(summary.peak_force_n) ? summary.peak_force_n : 0;
  const Unit force_unit = readable_unit(std::max(largest(force), peak), "N");
  Chart chart;
  chart.title = "Contact force on the impactor";
  chart.x_title = "time [" + time_unit.name + "]";
  chart.y_title = "force [" + force_unit.name + "]";
  chart.x = in_unit(times, time_unit);
  chart.series = {{"force", in_unit(force, force_unit), line_colour(0)}};
  chart.marks = crack_marks(summary, time_unit);
  if (peak > 0) {
    const Point at{summary.peak_force_time_s / time_unit.size, peak / force_unit.size};
    chart.y_high = at.y;
    chart.spots = {{at,
                    "peak " + short_label(at.y) + " " + force_unit.name + " at " + short_label(at.x) + " " +
                        time_unit.name,
                    line_colour(0)}};
  }
  const int height = 1000;
  write_both(folder, "force", height, [&](Canvas& canvas) {
    draw_chart(canvas, {20, 30, width - 40, height - 40}, chart);
  });
}

Chart energies(const History& history, const std::vector<double>& times, const Unit& time_unit) {
  struct Kind {
    const char* column;
    const char* name;
  };
  static constexpr Kind kinds[] = {{"kinetic_j", "kinetic"},
                                   {"strain_j", "strain"},
                                   {"cohesive_dissipated_j", "fracture"},
                                   {"material_dissipated_j", "dissipated in materials"},
                                   {"contact_stored_j", "contact, stored"},
                                   {"contact_friction_j", "contact, friction"},
                                   {"cohesive_friction_j", "crack faces, friction"},
                                   {"cohesive_stored_j", "cohesive, stored"},
                                   {"hourglass_j", "hourglass"},
                                   {"external_work_j", "external work"}};
  double most = 0;
  for (const Kind& kind : kinds) most = std::max(most, largest(column(history, kind.column)));
  const Unit unit = readable_unit(most, "J");
  Chart chart;
  chart.title = "Energies";
  chart.y_title = "energy [" + unit.name + "]";
  chart.x = in_unit(times, time_unit);
  chart.legend = true;
  std::size_t number = 0;
  for (const Kind& kind : kinds) {
    const std::vector<double> values = column(history, kind.column);
    if (largest(values) > 0)
      chart.series.push_back({kind.name, in_unit(values, unit), line_colour(number), 3, number > 6});
    ++number;
  }
  return chart;
}

Chart balance(const History& history, const std::vector<double>& times, const Unit& time_unit) {
  Chart chart;
  chart.title = "Energy balance";
  chart.x_title = "time [" + time_unit.name + "]";
  chart.y_title = "found / put in";
  chart.x = in_unit(times, time_unit);
  chart.series = {{"balance", column(history, "energy_balance"), ink}};
  chart.bands = {{0.98, 1.02, "±2 %", rgb(0x009e73, 0.14)}};
  chart.y_low = 0.975;
  chart.y_high = 1.025;
  chart.legend = true;
  return chart;
}

void draw_energy(const std::filesystem::path& folder, const History& history) {
  const std::vector<double> times = column(history, "time_s");
  if (times.empty()) return;
  const Unit time_unit = readable_unit(largest(times), "s");
  Chart upper = energies(history, times, time_unit);
  const Chart lower = balance(history, times, time_unit);
  if (upper.series.empty()) return;
  const bool both = !lower.series[0].y.empty();
  if (!both) upper.x_title = lower.x_title;
  const int height = both ? 1420 : 960;
  write_both(folder, "energy", height, [&](Canvas& canvas) {
    draw_chart(canvas, {20, 30, width - 40, 900}, upper);
    if (both) draw_chart(canvas, {20, 950, width - 40, 450}, lower);
  });
}

}  // namespace

void draw_history(const std::filesystem::path& folder, const History& history, const Summary& summary) {
  draw_force(folder, history, summary);
  draw_energy(folder, history);
}

}  // namespace cdfp
