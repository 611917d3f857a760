/// The public door.
#include "cdfp/simulation.hpp"

#include <string>
#include <utility>

#include "cdfp/error.hpp"
#include "core/archive.hpp"
#include "core/numbered.hpp"
#include "output/restart_file.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

Simulation::Simulation(Model model) : stages_(std::make_unique<Stages>(std::move(model))) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::step() {
  stages_->step();
}

std::int64_t Simulation::advance(std::int64_t steps) {
  std::int64_t done = 0;
  while (done < steps && !finished()) {
    step();
    ++done;
  }
  return done;
}

bool Simulation::finished() const {
  return stages_->finished();
}
double Simulation::time() const {
  return stages_->time;
}
double Simulation::step_size() const {
  return stages_->step_size;
}
double Simulation::stable_step() const {
  return stages_->stable.step;
}
Index Simulation::controlling_element() const {
  return stages_->stable.element;
}
std::int64_t Simulation::step_count() const {
  return stages_->steps;
}

std::span<const double> Simulation::positions() const {
  return stages_->nodes.position;
}
std::span<const double> Simulation::velocities() const {
  return stages_->nodes.velocity;
}
std::span<const double> Simulation::forces() const {
  return stages_->nodes.force;
}
std::span<const double> Simulation::masses() const {
  return stages_->nodes.mass;
}
Index Simulation::node_count() const {
  return stages_->nodes.count();
}

std::vector<double> Simulation::stresses() const {
  const Stages& s = *stages_;
  const Index count = s.model.mesh.element_count();
  std::vector<double> all(6 * static_cast<std::size_t>(count));
  const auto put = [&](std::int64_t e, const Mat3& m) {
    double* out = &all[6 * static_cast<std::size_t>(e)];
    out[0] = m(0, 0), out[1] = m(1, 1), out[2] = m(2, 2);
    out[3] = m(0, 1), out[4] = m(1, 2), out[5] = m(2, 0);
  };
  s.threads.for_ranges(count, 256, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      put(e, s.elements.stress(static_cast<Index>(e), s.nodes.position));
    }
  });
  // To the bit what the criterion has looked at.
  if (s.criterion && !s.positions_are_new) {
    const std::span<const Index> critical = s.elements.critical_elements();
    for (std::size_t i = 0; i < critical.size(); ++i) {
      put(critical[i], s.elements.last_critical_stresses()[i]);
    }
  }
  return all;
}

void Simulation::set_positions(std::span<const double> positions) {
  stages_->set_positions(positions);
}
void Simulation::set_velocities(std::span<const double> velocities) {
  stages_->set_state(stages_->nodes.velocity, velocities, "velocities");
}

void Simulation::save(const std::string& path) const {
  Archive state;
  stages_->archive(state);
  write_restart(path, stages_->digests, state.bytes());
}
void Simulation::restore(const std::string& path) {
  if (step_count() > 0) {
    throw Error(Status::bad_state, "the simulation has made " + std::to_string(step_count()) +
                                       " steps; restore into one that was just built from the model");
  }
  Archive state(read_restart(path, stages_->digests));
  stages_->archive(state);
}

const Model& Simulation::model() const {
  return stages_->model;
}
const Topology& Simulation::topology() const {
  return stages_->topology;
}

Index Simulation::body_count() const {
  return static_cast<Index>(stages_->bodies.size());
}

Simulation::BodyState Simulation::body(Index rigid_body) const {
  if (rigid_body < 0 || rigid_body >= body_count()) {
    throw Error(Status::bad_argument, "there is no rigid body " + numbered(rigid_body) + "; the scene has " +
                                          std::to_string(body_count()));
  }
  const RigidMotion& motion = stages_->bodies[rigid_body];
  BodyState state;
  motion.center().store(state.position.data());
  motion.velocity().store(state.velocity.data());
  motion.angular_velocity().store(state.angular_velocity.data());
  motion.force().store(state.contact_force.data());
  return state;
}

Index Simulation::cohesive_count() const {
  return stages_->cohesive ? stages_->cohesive->count() : 0;
}
Index Simulation::broken_count() const {
  return stages_->cohesive ? stages_->cohesive->broken_count() : 0;
}

Energies Simulation::energies() const {
  return stages_->energies(stages_->part_energies());
}
const History& Simulation::history() const {
  return stages_->monitor.history();
}
Frame Simulation::frame() const {
  return stages_->frame();
}
Summary Simulation::summary() const {
  return stages_->summary();
}

}  // namespace cdfp
