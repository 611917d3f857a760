#include "driver/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cdfp {

namespace {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  char text[48];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole / 60 % 60);
  } else if (whole >= 60) {
    std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld s", whole);
  }
  return text;
}

}  // namespace

Progress::Progress()
    : terminal_(isatty(STDERR_FILENO) == 1),
      interval_(std::chrono::seconds(terminal_ ? 1 : 10)),
      next_(Clock::now() + std::chrono::seconds(1)),
      last_shown_(Clock::now()) {}

Progress::~Progress() {
  if (terminal_ && shown_) std::fputc('\n', stderr);
}

void Progress::show_if_due(const Simulation& simulation) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + interval_;
  show(simulation);
}

void Progress::show(const Simulation& simulation) {
  shown_ = true;
  const std::string left = time_left(simulation);
  std::string element;
  if (simulation.controlling_element() != kNone) {
    element = "  dt by element " + std::to_string(simulation.controlling_element());
  }
  std::fprintf(stderr, "%sstep %lld  t %.3f us  energy %.4f  cohesive %d (%d broken)%s  %s%s",
               terminal_ ? "\r\033[K" : "", static_cast<long long>(simulation.step_count()),
               simulation.time() * 1e6, simulation.energies().balance(), simulation.cohesive_count(),
               simulation.broken_count(), element.c_str(), left.c_str(), terminal_ ? "" : "\n");
  std::fflush(stderr);
}

std::string Progress::time_left(const Simulation& simulation) {
  if (simulation.finished()) return "done";
  const Clock::time_point now = Clock::now();
  const double wall = std::chrono::duration<double>(now - last_shown_).count();
  if (wall > 0 && simulation.time() > last_time_) {
    const double pace = (simulation.time() - last_time_) / wall;
    pace_ = pace_ > 0 ? 0.7 * pace_ + 0.3 * pace : pace;
  }
  last_shown_ = now;
  last_time_ = simulation.time();
  if (!(pace_ > 0)) return "time left unknown";
  return duration_text((simulation.model().time.end - simulation.time()) / pace_) + " left";
}

}  // namespace cdfp
