#include "driver/run_case.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

#include "cdfp/recorder.hpp"
#include "cdfp/simulation.hpp"
#include "driver/interrupt.hpp"
#include "driver/progress.hpp"
#include "driver/summary_table.hpp"

namespace cdfp {

namespace {

constexpr std::chrono::seconds kFlushInterval{5};

std::vector<std::string> parts_that_crack(const Model& model) {
  std::vector<std::string> names;
  for (const Part& part : model.parts) {
    if (!part.cohesive_law.empty()) names.push_back(part.name);
  }
  return names;
}

/// Snapshot times in ascending order, and which come next.
class Schedule {
 public:
  explicit Schedule(std::vector<double> times) : times_(std::move(times)) {
    std::sort(times_.begin(), times_.end());
  }
  /// True at the step nearest to a time that has not been shown.
  bool due(double time, double step) {
    const std::size_t before = next_;
    while (next_ < times_.size() && time >= times_[next_] - 0.5 * step) ++next_;
    return next_ > before;
  }

 private:
  std::vector<double> times_;
  std::size_t next_ = 0;
};

void step_to_end(Simulation& simulation, Recorder& recorder, Schedule& schedule,
                 const std::string& restart_file) {
  Progress progress;
  auto next_flush = std::chrono::steady_clock::now() + kFlushInterval;
  const std::int64_t restart_interval = simulation.model().output.restart_interval;
  if (schedule.due(simulation.time(), simulation.step_size())) recorder.snapshot(simulation.frame());
  while (!simulation.finished() && !interrupted()) {
    simulation.step();
    if (schedule.due(simulation.time(), simulation.step_size())) recorder.snapshot(simulation.frame());
    const bool last = simulation.finished() || interrupted();
    if (restart_interval > 0 && (last || simulation.step_count() % restart_interval == 0)) {
      simulation.save(restart_file);
    }
    progress.show_if_due(simulation);
    if (std::chrono::steady_clock::now() >= next_flush) {
      recorder.history(simulation.history());
      next_flush = std::chrono::steady_clock::now() + kFlushInterval;
    }
  }
  progress.show(simulation);
}

}  // namespace

bool run_case(Model model, const std::string& folder, const std::string& restart) {
  const std::vector<std::string> crack_parts = parts_that_crack(model);
  Simulation simulation(std::move(model));
  Schedule schedule(simulation.model().output.snapshot_times);
  if (!restart.empty()) {
    simulation.restore(restart);
    schedule.due(simulation.time(), simulation.step_size());
  }
  Recorder recorder = restart.empty() ? Recorder(folder, crack_parts)
                                      : Recorder::continued(folder, crack_parts, simulation.time());
  watch_interrupts();
  std::exception_ptr failure;
  try {
    step_to_end(simulation, recorder, schedule, folder + "/restart.cdfp");
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  const Summary summary = simulation.summary();
  recorder.finish(simulation.frame(), simulation.history(), summary);
  std::fputs(summary_table(summary).c_str(), stdout);
  std::printf("\n  results in %s\n", folder.c_str());
  if (failure) std::rethrow_exception(failure);
  return simulation.finished();
}

}  // namespace cdfp
