/// What acts from outside: a caller's load, positions and velocities that are set.
#include <cmath>
#include <string>

#include "cdfp/error.hpp"
#include "core/numbered.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

/// Over a drift a force does the work of its mean between the two ends.
void Simulation::Stages::add_load() {
  load_.assign(nodes.force.begin(), nodes.force.end());
  model.load({nodes.count(), time, nodes.position.data(), nodes.velocity.data(), nodes.force.data()});
  for (std::size_t i = 0; i < load_.size(); ++i) {
    load_[i] = nodes.force[i] - load_[i];
    if (!std::isfinite(load_[i])) {
      throw Error(Status::diverged, "the load at node " + numbered(i / 3) +
                                        " is not a finite number at time " + std::to_string(1e6 * time) +
                                        " us; check the load callback");
    }
  }
  if (steps > 0) external_work += 0.5 * step_size * load_work();
}

double Simulation::Stages::load_work() const {
  double sum = 0;
  for (std::size_t i = 0; i < load_.size(); ++i) sum += load_[i] * nodes.velocity[i];
  return sum;
}

void Simulation::Stages::set_state(std::vector<double>& field, std::span<const double> values,
                                   const char* name) {
  if (values.size() != field.size()) {
    throw Error(Status::bad_argument, std::string("'") + name + "' has " + std::to_string(values.size()) +
                                          " numbers; give three for each of the " +
                                          std::to_string(nodes.count()) + " nodes that there are now");
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw Error(Status::bad_argument,
                std::string("'") + name + "' of node " + numbered(i / 3) + " is not a finite number");
  }
  const auto energy = [this] {
    const Energies e = energies(part_energies());
    return e.kinetic + e.strain + e.hourglass;
  };
  const double before = energy();
  for (Index n = 0; n < nodes.count(); ++n) {
    if (nodes.body[n] != kNone) continue;
    for (int d = 0; d < 3; ++d) {
      const std::size_t i = 3 * static_cast<std::size_t>(n) + d;
      if (!(nodes.fixed[n] >> d & 1)) field[i] = values[i];
    }
  }
  external_work += energy() - before;
}

void Simulation::Stages::set_positions(std::span<const double> values) {
  set_state(nodes.position, values, "positions");
  search_anew_ = true;
  positions_are_new = true;
  choose_step();
  step_size = next_step_;
}

}  // namespace cdfp
