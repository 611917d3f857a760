// The step as a list of stages, put together once from what the scene holds.
//
//   stage            | reads                        | writes
//   -----------------+------------------------------+-------------------------------------------
//   drift            | velocity                     | position, rigid bodies; force = 0
//   material         | position, users' laws        | stress of users' laws, deleted elements
//   internal_force   | position, material state     | force, material state, critical elements; not of blocks
//                    |                              | of elements that have not moved yet
//   criterion        | critical elements, stress    | facets that open
//   insertion        | facets that open             | topology, nodes, element corners, cohesive elements
//   gravity, load    | mass, position, velocity     | force
//   surface          | broken cohesive and deleted  | contact segments and edges
//                    | elements                     |
//   global_search    | position, velocity           | candidate pairs (regular, if due)
//   adaptive_search  | new contact entities         | candidate pairs
//   local_search     | candidate pairs, position    | contacts: gap, slip
//   enforcement      | contacts                     | force
//   traction         | position, velocity, force    | force, cohesive state
//   accelerate       | force, mass                  | velocity, rigid bodies, constraints
//   record (if due)  | all                          | history
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "cdfp/error.hpp"
#include "core/numbered.hpp"
#include "integrator/central_difference.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

namespace {

constexpr std::int64_t kStepsBetweenEstimates = 50;  ///< of the stable step

}  // namespace

void Simulation::Stages::list_stages() {
  if (has_gravity()) {
    add_stage(move_, "gravity_work", [this] {
      external_work += gravity_work(gravity(), step_size, nodes, threads);
      for (const RigidMotion& body : bodies) external_work += body.gravity_work(gravity(), step_size);
    });
  }
  if (model.load) add_stage(move_, "load_work", [this] { external_work += 0.5 * step_size * load_work(); });
  add_stage(move_, "drift", [this] {
    drift(step_size, nodes, threads);
    for (RigidMotion& body : bodies) body.drift(step_size, nodes);
  });
  if (elements.has_user_laws()) {
    add_stage(move_, "material", [this] {
      const double end = time + step_size;
      for (const Index e : elements.advance_user_laws(nodes.position, end, step_size, threads)) {
        deleted.push_back({e, model.mesh.part_names[model.mesh.parts[e]], end});
        if (contact) gone_.push_back(e);
      }
    });
  }
  add_stage(forces_, "internal_force",
            [this] { elements.add_force(nodes.position, nodes.force, step_size, threads, nodes.reference); });
  if (criterion) {
    add_stage(forces_, "criterion", [this] {
      criterion->find(
          elements.critical_elements(), elements.critical_stresses(nodes.position, threads), topology,
          nodes.position, [this](Index e) { return elements.stress(e, nodes.position); }, open_, threads);
    });
    add_stage(forces_, "insertion", [this] { insert_open_facets(); });
  }
  if (has_gravity()) add_stage(forces_, "gravity", [this] { add_gravity(gravity(), nodes, threads); });
  if (model.load) add_stage(forces_, "load", [this] { add_load(); });
  if (contact) {
    if (cohesive || elements.has_user_laws()) add_stage(forces_, "surface", [this] { update_surface(); });
    regular_clock_ = clock.add("global_search");
    adaptive_clock_ = clock.add("adaptive_search");
    forces_.push_back({clock.add("search_due"), [this] { search(); }});
    add_stage(forces_, "local_search", [this] { contact->local_search(nodes, threads); });
    add_stage(forces_, "enforcement", [this] { contact->add_force(nodes, kick, threads); });
  }
  if (cohesive) add_stage(forces_, "traction", [this] { cohesive->add_force(nodes, kick, time, threads); });
  add_stage(finish_, "accelerate", [this] { accelerate_all(); });
}

void Simulation::Stages::step() {
  const auto begin = std::chrono::steady_clock::now();
  run(move_);
  positions_are_new = false;
  time += step_size;
  ++steps;
  if (steps % kStepsBetweenEstimates == 0) choose_step();
  kick = 0.5 * (step_size + next_step_);
  run(forces_);
  run(finish_);
  if (steps % model.output.history_interval == 0 || time + 0.5 * next_step_ >= model.time.end) record();
  step_size = next_step_;
  wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void Simulation::Stages::accelerate_all() {
  accelerate(kick, nodes, threads);
  for (RigidMotion& body : bodies) body.accelerate(kick, gravity(), nodes);
  if (constraints.any_moving()) {
    const Constraints::Work work = constraints.apply(time + 0.5 * next_step_, kick, nodes);
    external_work += work.step;
    work_ahead_ = work.ahead;
  }
  if (!bodies.empty()) monitor.watch_force(time, bodies.front().force());
}

void Simulation::Stages::choose_step() {
  std::vector<double> by_node;
  if (contact && contact->touching_count() > 0) {
    by_node.assign(nodes.count(), 0);
    contact->add_stiffness_over_mass(by_node);
  }
  const StepBounds bounds = elements.stable_steps(nodes.position, threads, by_node);
  stable = bounds.alone;
  if (!(stable.step > 0) || !std::isfinite(stable.step)) {
    throw Error(Status::diverged,
                "no stable step at time " + std::to_string(time) + " s: element " + numbered(stable.element) +
                    " is inverted or not finite; take a smaller step or a coarser mesh there");
  }
  const double fixed = model.time.fixed_step;
  if (fixed > stable.step && !warned_of_step_) warn_of_step();
  // Springs add to the squared frequency of the elements at their nodes at most their own.
  double springs = cohesive ? cohesive->stiffness_over_mass(nodes) : 0;
  stable = bounds.with_springs;
  double of_rigid = 0;
  for (std::size_t n = 0; n < by_node.size(); ++n) {
    if (nodes.body[n] != kNone) of_rigid = std::max(of_rigid, by_node[n]);
  }
  stable.step = std::min(stable.step, 2 / std::sqrt(of_rigid));
  stable.step = 2 / std::sqrt(4 / (stable.step * stable.step) + springs);
  next_step_ = fixed > 0 ? fixed : model.time.step_factor * stable.step;
}

void Simulation::Stages::warn_of_step() {
  warned_of_step_ = true;
  const Index part = model.mesh.parts[stable.element];
  warnings.push_back("the fixed step of " + std::to_string(1e9 * model.time.fixed_step) +
                     " ns is longer than the stable step of " + std::to_string(1e9 * stable.step) +
                     " ns of element " + std::to_string(stable.element) + " (part '" +
                     model.mesh.part_names[part] + "') at time " + std::to_string(1e6 * time) +
                     " us; shorten time.fixed_step or set it to 0");
}

}  // namespace cdfp
