#include "driver/summary_table.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace cdfp {

namespace {

class Table {
 public:
  explicit Table(std::string& text) : text_(text) {}

  [[gnu::format(printf, 3, 4)]] void row(const char* name, const char* format, ...) {
    char value[160];
    std::va_list arguments;
    va_start(arguments, format);
    // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): it is started in the line above
    std::vsnprintf(value, sizeof value, format, arguments);
    va_end(arguments);
    char line[240];
    std::snprintf(line, sizeof line, "  %-34s %s\n", name, value);
    text_ += line;
  }

  void time_row(const char* name, double seconds) {
    if (std::isfinite(seconds)) {
      row(name, "%.2f us", seconds * 1e6);
    } else {
      row(name, "never");
    }
  }

 private:
  std::string& text_;
};

void add_events(const Summary& s, Table& table) {
  table.time_row("first contact", s.first_contact_s);
  for (const Summary::FirstCrack& crack : s.first_cracks) {
    const std::string name = "first crack, " + crack.part;
    if (!std::isfinite(crack.time_s)) {
      table.row(name.c_str(), "none");
      continue;
    }
    table.row(name.c_str(), "%.2f us, %s, x %.2f y %.2f mm", crack.time_s * 1e6, crack.layer_face.c_str(),
              crack.position[0] * 1e3, crack.position[1] * 1e3);
  }
  table.row("peak force", "%.1f N at %.2f us", s.peak_force_n, s.peak_force_time_s * 1e6);
  if (std::isfinite(s.impactor_rebound_mps)) {
    table.row("velocity of the impactor", "%.3f m/s", s.impactor_rebound_mps);
  }
  table.row("deepest penetration", "%.2f um", s.deepest_penetration_m * 1e6);
}

void add_balances(const Summary& s, Table& table) {
  table.row("energy balance", "%.5f to %.5f", s.energy_balance_min, s.energy_balance_max);
  table.row("hourglass over strain energy", "%.4f at most", s.hourglass_over_strain_max);
  table.row("cohesive elements", "%d inserted, %d broken", s.cohesive_inserted, s.cohesive_broken);
  if (!s.deleted.empty()) {
    table.row("deleted elements", "%zu, the first (%d of %s) at %.2f us", s.deleted.size(),
              s.deleted.front().element, s.deleted.front().part.c_str(), s.deleted.front().time_s * 1e6);
  }
  if (s.cohesive_broken > 0) table.row("dissipated over G A", "%.4f", s.cohesive_dissipated_over_ga);
}

void add_stages(const Summary& s, std::string& text) {
  double total = 0;
  for (const StageSeconds& stage : s.stages) total += stage.seconds;
  if (total <= 0) return;
  text += "\n  stage                    seconds   share      calls\n";
  for (const StageSeconds& stage : s.stages) {
    char line[160];
    std::snprintf(line, sizeof line, "  %-20s %11.2f %6.1f %% %10lld\n", stage.name.c_str(), stage.seconds,
                  100 * stage.seconds / total, static_cast<long long>(stage.calls));
    text += line;
  }
}

}  // namespace

std::string summary_table(const Summary& s) {
  std::string text = "\n" + s.title + "\n";
  Table table(text);
  table.row("elements", "%d", s.elements);
  table.row("nodes", "%d, at the end %d", s.nodes_initial, s.nodes_final);
  table.row("segments", "%d, at the end %d", s.segments_initial, s.segments_final);
  table.row("steps", "%lld to %.3f us, dt %.3e s", static_cast<long long>(s.steps), s.simulated_time_s * 1e6,
            s.dt_s);
  if (s.dt_element != kNone) {
    table.row("stable step", "%.3e s, by element %d", s.dt_stable_s, s.dt_element);
  }
  table.row("wall time", "%.1f s on %d %s, %.0f MB", s.wall_s, s.threads,
            s.threads == 1 ? "thread" : "threads", s.peak_rss_mb);
  add_events(s, table);
  add_balances(s, table);
  add_stages(s, text);
  for (const std::string& warning : s.warnings) text += "\n  warning: " + warning + "\n";
  return text;
}

}  // namespace cdfp
