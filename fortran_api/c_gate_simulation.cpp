#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "c_gate.hpp"

using namespace cdfp;
using namespace cdfp::gate;

namespace {

void show(std::span<const double> values, std::size_t per_node, const double** data, int64_t* nodes,
          const char* name) {
  need(data, name);
  need(nodes, "nodes");
  *data = values.data();
  *nodes = static_cast<int64_t>(values.size() / per_node);
}

void need_folder(const char* folder) {
  need(folder, "folder");
  if (*folder == '\0') refuse("argument 'folder' is empty; name a folder, such as 'out'");
}

/// Parts whose cracks get a picture each.
std::vector<std::string> parts_that_crack(const Model& model) {
  std::vector<std::string> names;
  for (const Part& part : model.parts) {
    if (!part.cohesive_law.empty()) names.push_back(part.name);
  }
  return names;
}

}  // namespace

int32_t cdfp_simulation_create(const cdfp_model* model, cdfp_simulation** simulation) {
  return guarded(__func__, [&] {
    const Look m(model);
    need(simulation, "simulation");
    give(std::make_shared<Held<cdfp_simulation>::Object>(*m), simulation);
  });
}

int32_t cdfp_simulation_free(cdfp_simulation** simulation) {
  return free_handle(__func__, simulation);
}

namespace {

/// Steps until `done`. The monitor is called between the uses of the object, so that it may look and change.
template <class Done>
int64_t run(cdfp_simulation* simulation, const Done& done) {
  int64_t steps = 0;
  std::shared_ptr<bool> stepping;
  {
    const Change s(simulation);
    if (*s->stepping) {
      throw Error(Status::bad_state,
                  "the simulation is being stepped; its monitor may look at it and change its state, and "
                  "stops it by its result");
    }
    if (!s->monitor) {
      for (; !done(*s, steps); ++steps) s->step();
      return steps;
    }
    stepping = s->stepping;
    *stepping = true;
  }
  struct Ended {
    bool& stepping;
    ~Ended() { stepping = false; }
  } const ended{*stepping};
  while (true) {
    cdfp_step_callback monitor = nullptr;
    void* user_data = nullptr;
    {
      const Change s(simulation);
      if (done(*s, steps)) return steps;
      s->step();
      monitor = s->monitor;
      user_data = s->user_data;
    }
    ++steps;
    if (monitor && monitor(simulation, user_data) != 0) return steps;
  }
}

}  // namespace

int32_t cdfp_simulation_step(cdfp_simulation* simulation) {
  return guarded(__func__,
                 [&] { run(simulation, [](const Simulation&, int64_t done) { return done == 1; }); });
}

int32_t cdfp_simulation_advance(cdfp_simulation* simulation, int64_t steps, int64_t* done) {
  return guarded(__func__, [&] {
    if (steps < 0) refuse("argument 'steps' is negative (" + std::to_string(steps) + ")");
    const int64_t count =
        run(simulation, [steps](const Simulation& s, int64_t now) { return now >= steps || s.finished(); });
    if (done) *done = count;
  });
}

int32_t cdfp_simulation_advance_to(cdfp_simulation* simulation, double time, int64_t* done) {
  return guarded(__func__, [&] {
    if (!(time >= 0)) refuse("argument 'time' is " + std::to_string(time) + "; it must not be negative");
    const int64_t count = run(simulation, [time](const Simulation& s, int64_t) {
      return s.finished() || s.time() + 0.5 * s.step_size() >= time;
    });
    if (done) *done = count;
  });
}

int32_t cdfp_simulation_set_monitor(cdfp_simulation* simulation, cdfp_step_callback callback,
                                    void* user_data) {
  return guarded(__func__, [&] {
    const Change s(simulation);
    s->monitor = callback;
    s->user_data = user_data;
  });
}

int32_t cdfp_simulation_save(const cdfp_simulation* simulation, const char* path) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need(path, "path");
    s->save(path);
  });
}

int32_t cdfp_simulation_restore(cdfp_simulation* simulation, const char* path) {
  return guarded(__func__, [&] {
    const Change s(simulation);
    need(path, "path");
    s->restore(path);
  });
}

int32_t cdfp_simulation_finished(const cdfp_simulation* simulation, int32_t* finished) {
  return guarded(__func__, [&] { set(finished, int32_t{Look(simulation)->finished()}, "finished"); });
}

int32_t cdfp_simulation_time(const cdfp_simulation* simulation, double* time) {
  return guarded(__func__, [&] { set(time, Look(simulation)->time(), "time"); });
}

int32_t cdfp_simulation_step_size(const cdfp_simulation* simulation, double* step_size) {
  return guarded(__func__, [&] { set(step_size, Look(simulation)->step_size(), "step_size"); });
}

int32_t cdfp_simulation_stable_step(const cdfp_simulation* simulation, double* stable_step) {
  return guarded(__func__, [&] { set(stable_step, Look(simulation)->stable_step(), "stable_step"); });
}

int32_t cdfp_simulation_controlling_element(const cdfp_simulation* simulation, int32_t* element) {
  return guarded(__func__, [&] { set(element, Look(simulation)->controlling_element(), "element"); });
}

int32_t cdfp_simulation_step_count(const cdfp_simulation* simulation, int64_t* steps) {
  return guarded(__func__, [&] { set(steps, Look(simulation)->step_count(), "steps"); });
}

int32_t cdfp_simulation_node_count(const cdfp_simulation* simulation, int64_t* nodes) {
  return guarded(__func__, [&] { set(nodes, int64_t{Look(simulation)->node_count()}, "nodes"); });
}

int32_t cdfp_simulation_positions(const cdfp_simulation* simulation, const double** positions,
                                  int64_t* nodes) {
  return guarded(__func__, [&] { show(Look(simulation)->positions(), 3, positions, nodes, "positions"); });
}

int32_t cdfp_simulation_velocities(const cdfp_simulation* simulation, const double** velocities,
                                   int64_t* nodes) {
  return guarded(__func__, [&] { show(Look(simulation)->velocities(), 3, velocities, nodes, "velocities"); });
}

int32_t cdfp_simulation_forces(const cdfp_simulation* simulation, const double** forces, int64_t* nodes) {
  return guarded(__func__, [&] { show(Look(simulation)->forces(), 3, forces, nodes, "forces"); });
}

int32_t cdfp_simulation_masses(const cdfp_simulation* simulation, const double** masses, int64_t* nodes) {
  return guarded(__func__, [&] { show(Look(simulation)->masses(), 1, masses, nodes, "masses"); });
}

int32_t cdfp_simulation_get_stresses(const cdfp_simulation* simulation, int64_t elements, double* stress) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need_array(stress, elements, "stress");
    const auto count = static_cast<int64_t>(s->model().mesh.types.size());
    if (elements != count) {
      refuse("'stress' has room for " + std::to_string(elements) + " elements; the simulation has " +
             std::to_string(count));
    }
    const std::vector<double> all = s->stresses();
    std::copy(all.begin(), all.end(), stress);
  });
}

int32_t cdfp_simulation_set_positions(cdfp_simulation* simulation, int64_t nodes, const double* positions) {
  return guarded(__func__,
                 [&] { Change(simulation)->set_positions(vectors(positions, nodes, "positions")); });
}

int32_t cdfp_simulation_set_velocities(cdfp_simulation* simulation, int64_t nodes, const double* velocities) {
  return guarded(__func__,
                 [&] { Change(simulation)->set_velocities(vectors(velocities, nodes, "velocities")); });
}

int32_t cdfp_simulation_body_count(const cdfp_simulation* simulation, int64_t* bodies) {
  return guarded(__func__, [&] { set(bodies, int64_t{Look(simulation)->body_count()}, "bodies"); });
}

int32_t cdfp_simulation_body(const cdfp_simulation* simulation, int64_t body, cdfp_body_state* state) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need(state, "state");
    need_number(body, s->body_count(), "rigid body");
    const Simulation::BodyState now = s->body(static_cast<Index>(body));
    std::copy_n(now.position.begin(), 3, state->position);
    std::copy_n(now.velocity.begin(), 3, state->velocity);
    std::copy_n(now.angular_velocity.begin(), 3, state->angular_velocity);
    std::copy_n(now.contact_force.begin(), 3, state->contact_force);
  });
}

int32_t cdfp_simulation_cohesive_count(const cdfp_simulation* simulation, int64_t* inserted,
                                       int64_t* broken) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need(inserted, "inserted");
    need(broken, "broken");
    *inserted = s->cohesive_count();
    *broken = s->broken_count();
  });
}

int32_t cdfp_simulation_energies(const cdfp_simulation* simulation, cdfp_energies* energies) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need(energies, "energies");
    const Energies e = s->energies();
    *energies = {.kinetic = e.kinetic,
                 .strain = e.strain,
                 .hourglass = e.hourglass,
                 .material_dissipated = e.material_dissipated,
                 .cohesive_stored = e.cohesive_stored,
                 .cohesive_dissipated = e.cohesive_dissipated,
                 .cohesive_friction = e.cohesive_friction,
                 .contact_stored = e.contact_stored,
                 .contact_friction = e.contact_friction,
                 .external_work = e.external_work,
                 .initial = e.initial,
                 .balance = e.balance()};
  });
}

int32_t cdfp_simulation_summary(const cdfp_simulation* simulation, cdfp_summary* summary) {
  return guarded(__func__, [&] {
    const Look sim(simulation);
    need(summary, "summary");
    const Summary s = sim->summary();
    *summary = {.elements = s.elements,
                .nodes_initial = s.nodes_initial,
                .nodes_final = s.nodes_final,
                .segments_initial = s.segments_initial,
                .segments_final = s.segments_final,
                .steps = s.steps,
                .threads = s.threads,
                .dt_element = s.dt_element,
                .cohesive_inserted = s.cohesive_inserted,
                .cohesive_broken = s.cohesive_broken,
                .simulated_time_s = s.simulated_time_s,
                .dt_s = s.dt_s,
                .dt_stable_s = s.dt_stable_s,
                .wall_s = s.wall_s,
                .peak_rss_mb = s.peak_rss_mb,
                .energy_balance_min = s.energy_balance_min,
                .energy_balance_max = s.energy_balance_max,
                .hourglass_over_strain_max = s.hourglass_over_strain_max,
                .cohesive_dissipated_over_ga = s.cohesive_dissipated_over_ga,
                .cohesive_slope_cost_j = s.cohesive_slope_cost_j,
                .first_contact_s = s.first_contact_s,
                .peak_force_n = s.peak_force_n,
                .peak_force_time_s = s.peak_force_time_s,
                .impactor_rebound_mps = s.impactor_rebound_mps,
                .deepest_penetration_m = s.deepest_penetration_m};
  });
}

int32_t cdfp_simulation_first_crack(const cdfp_simulation* simulation, const char* part, double* time,
                                    int32_t* layer, double* position) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need(part, "part");
    need(time, "time");
    need(layer, "layer");
    need(position, "position");
    const Summary summary = s->summary();
    for (const Summary::FirstCrack& crack : summary.first_cracks) {
      if (crack.part != part) continue;
      *time = crack.time_s;
      *layer = crack.layer;
      std::copy_n(crack.position.begin(), 3, position);
      return;
    }
    refuse("no part '" + std::string(part) + "' that may crack; give the part a cohesive law");
  });
}

int32_t cdfp_simulation_contact_pair_count(const cdfp_simulation* simulation, int64_t* count) {
  return guarded(__func__, [&] {
    set(count, static_cast<int64_t>(Look(simulation)->summary().contact_pairs.size()), "count");
  });
}

int32_t cdfp_simulation_contact_pair(const cdfp_simulation* simulation, int64_t pair,
                                     cdfp_contact_pair* values) {
  return guarded(__func__, [&] {
    const std::vector<Summary::ContactPair> pairs = Look(simulation)->summary().contact_pairs;
    need_number(pair, static_cast<int64_t>(pairs.size()), "contact pair");
    need(values, "values");
    const Summary::ContactPair& p = pairs[pair];
    *values = {.peak_force_n = p.peak_force_n,
               .stored_j = p.stored_j,
               .friction_heat_j = p.friction_heat_j,
               .deepest_penetration_m = p.deepest_penetration_m};
  });
}

int32_t cdfp_simulation_contact_pair_part(const cdfp_simulation* simulation, int64_t pair, int32_t side,
                                          char* text, int64_t capacity, int64_t* length) {
  return guarded(__func__, [&] {
    const std::vector<Summary::ContactPair> pairs = Look(simulation)->summary().contact_pairs;
    need_number(pair, static_cast<int64_t>(pairs.size()), "contact pair");
    need_number(side, 2, "side of a contact pair");
    copy_text(pairs[pair].parts[side], text, capacity, length);
  });
}

int32_t cdfp_simulation_stage_count(const cdfp_simulation* simulation, int64_t* count) {
  return guarded(__func__, [&] {
    set(count, static_cast<int64_t>(Look(simulation)->summary().stages.size()), "count");
  });
}

int32_t cdfp_simulation_stage(const cdfp_simulation* simulation, int64_t stage, double* seconds,
                              int64_t* calls, char* text, int64_t capacity, int64_t* length) {
  return guarded(__func__, [&] {
    const Summary summary = Look(simulation)->summary();
    need_number(stage, static_cast<int64_t>(summary.stages.size()), "stage");
    set(seconds, summary.stages[stage].seconds, "seconds");
    set(calls, int64_t{summary.stages[stage].calls}, "calls");
    copy_text(summary.stages[stage].name, text, capacity, length);
  });
}

int32_t cdfp_simulation_warning_count(const cdfp_simulation* simulation, int64_t* count) {
  return guarded(__func__, [&] {
    set(count, static_cast<int64_t>(Look(simulation)->summary().warnings.size()), "count");
  });
}

int32_t cdfp_simulation_warning(const cdfp_simulation* simulation, int64_t warning, char* text,
                                int64_t capacity, int64_t* length) {
  return guarded(__func__, [&] {
    const std::vector<std::string> warnings = Look(simulation)->summary().warnings;
    need_number(warning, static_cast<int64_t>(warnings.size()), "warning");
    copy_text(warnings[warning], text, capacity, length);
  });
}

int32_t cdfp_simulation_history(const cdfp_simulation* simulation, const double** values, int64_t* rows,
                                int64_t* columns) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need(values, "values");
    need(rows, "rows");
    need(columns, "columns");
    const History& history = s->history();
    *values = history.values.data();
    *rows = static_cast<int64_t>(history.rows());
    *columns = static_cast<int64_t>(history.columns.size());
  });
}

int32_t cdfp_simulation_history_column(const cdfp_simulation* simulation, int64_t column, char* text,
                                       int64_t capacity, int64_t* length) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    const std::vector<std::string>& columns = s->history().columns;
    need_number(column, static_cast<int64_t>(columns.size()), "column");
    copy_text(columns[column], text, capacity, length);
  });
}

int32_t cdfp_recorder_create(const cdfp_simulation* simulation, const char* folder,
                             cdfp_recorder** recorder) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need_folder(folder);
    need(recorder, "recorder");
    give(std::make_shared<Recorder>(folder, parts_that_crack(s->model())), recorder);
  });
}

int32_t cdfp_recorder_continue(const cdfp_simulation* simulation, const char* folder,
                               cdfp_recorder** recorder) {
  return guarded(__func__, [&] {
    const Look s(simulation);
    need_folder(folder);
    need(recorder, "recorder");
    give(std::make_shared<Recorder>(Recorder::continued(folder, parts_that_crack(s->model()), s->time())),
         recorder);
  });
}

int32_t cdfp_recorder_free(cdfp_recorder** recorder) {
  return free_handle(__func__, recorder);
}

int32_t cdfp_recorder_snapshot(cdfp_recorder* recorder, const cdfp_simulation* simulation) {
  return guarded(__func__, [&] {
    const Change r(recorder);
    const Look s(simulation);
    r->snapshot(s->frame());
    r->history(s->history());
  });
}

int32_t cdfp_recorder_finish(cdfp_recorder* recorder, const cdfp_simulation* simulation) {
  return guarded(__func__, [&] {
    const Change r(recorder);
    const Look s(simulation);
    r->finish(s->frame(), s->history(), s->summary());
  });
}
