/// A line on stderr that tells how far a run is.
#pragma once

#include <chrono>
#include <string>

#include "cdfp/simulation.hpp"

namespace cdfp {

class Progress {
 public:
  Progress();
  ~Progress();  ///< ends the line that is rewritten in place
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Once a second on a terminal, rewritten in place; every ten seconds, a line each, elsewhere.
  void show_if_due(const Simulation& simulation);
  void show(const Simulation& simulation);

 private:
  using Clock = std::chrono::steady_clock;

  std::string time_left(const Simulation& simulation);

  bool terminal_;
  bool shown_ = false;
  Clock::duration interval_;
  Clock::time_point next_;
  Clock::time_point last_shown_;
  double last_time_ = 0;
  double pace_ = 0;  ///< simulated over wall time, smoothed
};

}  // namespace cdfp
