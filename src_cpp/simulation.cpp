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
#include "cdfp/simulation.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "cdfp/error.hpp"
#include "cdfp/topology.hpp"
#include "cohesive/cohesive_zone.hpp"
#include "cohesive/criterion.hpp"
#include "contact/contact.hpp"
#include "core/archive.hpp"
#include "core/numbered.hpp"
#include "core/parallel.hpp"
#include "core/stage_clock.hpp"
#include "core/stress.hpp"
#include "element/element_force.hpp"
#include "integrator/central_difference.hpp"
#include "integrator/constraints.hpp"
#include "integrator/rigid_body.hpp"
#include "monitor/monitor.hpp"
#include "output/restart_file.hpp"
#include "scene/bonds.hpp"
#include "scene/fingerprint.hpp"
#include "scene/scene.hpp"
#include "state/nodes.hpp"

namespace cdfp {

namespace {

constexpr std::int64_t kStepsBetweenEstimates = 50;  ///< of the stable step

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

bool cracks(const Model& model) {
  return std::any_of(model.parts.begin(), model.parts.end(),
                     [](const Part& p) { return !p.cohesive_law.empty(); });
}

}  // namespace

struct Simulation::Stages {
  explicit Stages(Model given);

  void step();
  void record();
  Energies energies(const std::vector<PartEnergy>& parts) const;
  std::vector<PartEnergy> part_energies() const { return elements.energies(nodes.position, threads); }
  Summary summary() const;
  Frame frame() const;
  void archive(Archive& a);
  void archive_insertions(Archive& a);
  void set_state(std::vector<double>& field, std::span<const double> values, const char* name);
  void set_positions(std::span<const double> values);
  bool finished() const { return time + 0.5 * step_size >= model.time.end * (1 + 1e-12); }

  Model model;
  std::vector<std::pair<std::string, std::uint64_t>> digests;  ///< of the model before anything was split
  std::vector<std::string> warnings;
  Threads threads;
  Nodes nodes;
  Topology topology;
  ElementForce elements;
  std::vector<RigidMotion> bodies;
  Constraints constraints;
  std::optional<Criterion> criterion;
  std::optional<CohesiveZone> cohesive;
  std::optional<Contact> contact;
  Monitor monitor;
  StageClock clock;

  double time = 0;
  std::int64_t steps = 0;
  double step_size = 0;
  double kick = 0;  ///< span of the last change of velocity
  StepBound stable;
  std::vector<Summary::Deleted> deleted;
  double external_work = 0;
  double initial_energy = 0;
  double wall_seconds = 0;
  bool positions_are_new = false;  ///< set from outside since the last step
  Index nodes_initial = 0;
  Index segments_initial = 0;
  Index elements_initial = 0;  ///< of the topology, with bonds

 private:
  struct Stage {
    int clock;
    std::function<void()> work;
  };
  void add_stage(std::vector<Stage>& list, const char* name, std::function<void()> work) {
    list.push_back({clock.add(name), std::move(work)});
  }
  void take_shown_elasticity();
  void add_user_fields(Frame& f) const;
  void list_stages();
  void run(const std::vector<Stage>& list) {
    for (const Stage& stage : list) clock.time(stage.clock, stage.work);
  }

  void insert(FacetUse lower);
  void insert_bonds();
  void insert_open_facets();
  void divide_masses_and_forces();
  void update_surface();
  void search();
  void add_load();
  double load_work() const;
  void accelerate_all();
  void choose_step();
  void warn_of_step();

  bool has_gravity() const {
    return std::any_of(model.gravity.begin(), model.gravity.end(), [](double g) { return g != 0; });
  }
  Vec3 gravity() const { return Vec3::load(model.gravity.data()); }

  std::vector<Stage> move_;
  std::vector<Stage> forces_;
  std::vector<Stage> finish_;
  std::vector<OpenFacet> open_;
  Insertion insertion_;
  std::vector<Index> split_;  ///< nodes whose elements changed in this step
  std::vector<VertexUse> around_;
  std::vector<FacetUse> freed_;
  std::vector<Index> gone_;  ///< deleted in this step
  double next_step_ = 0;
  double work_ahead_ = 0;
  int adaptive_clock_ = 0;
  int regular_clock_ = 0;
  bool warned_of_step_ = false;
  bool search_anew_ = false;
  std::vector<double> load_;  ///< N, (n, 3): of the caller
};

Simulation::Stages::Stages(Model given)
    : model(std::move(given)),
      warnings(check_model(model)),
      threads(model.threads),
      nodes(model.mesh.coordinates),
      topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity),
      elements(model),
      bodies([this] {
        std::vector<RigidMotion> motions;
        for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
          motions.emplace_back(model, static_cast<Index>(b), nodes);
        }
        return motions;
      }()),
      constraints([this] {
        const std::span<const Index> first = elements.first_corners();
        for (const InitialVelocity& initial : model.initial_velocities) {
          const Index part = part_number(model.mesh, initial.part);
          for (Index e = 0; e < model.mesh.element_count(); ++e) {
            if (model.mesh.parts[e] != part) continue;
            for (Index i = first[e]; i < first[e + 1]; ++i) {
              const Index n = model.mesh.connectivity[i];
              const double* g = initial.gradient.data();
              const Mat3 gradient{{Vec3::load(g), Vec3::load(g + 3), Vec3::load(g + 6)}};
              (Vec3::load(initial.velocity.data()) + gradient * nodes.x0(n))
                  .store(&nodes.velocity[3 * static_cast<std::size_t>(n)]);
            }
          }
        }
        return Constraints(model, nodes);
      }()),
      monitor(model),
      nodes_initial(model.mesh.node_count()) {
  take_shown_elasticity();
  digests = fingerprint(model);
  elements.add_mass(nodes.mass);
  for (Index n = 0; n < nodes.count(); ++n) {
    if (nodes.mass[n] == 0) nodes.fixed[n] = 7;
  }
  if (cracks(model)) {
    criterion.emplace(model);
    for (Index p = 0; p < static_cast<Index>(model.mesh.part_names.size()); ++p) {
      elements.set_least_strength(p, criterion->strength().least_of_part(p));
    }
  }
  if (cracks(model) || !model.bonds.empty()) cohesive.emplace(model);
  if (!model.contact.surfaces.empty()) {
    contact.emplace(model, topology);
    segments_initial = contact->segment_count();
  }
  insert_bonds();
  elements_initial = topology.element_count();
  list_stages();

  choose_step();
  step_size = next_step_;
  kick = 0.5 * step_size;
  run(forces_);
  const bool moving = constraints.any_moving();
  accelerate(kick, nodes, threads);
  for (RigidMotion& body : bodies) body.accelerate(kick, gravity(), nodes);
  if (moving) constraints.apply(0.5 * step_size, kick, nodes);
  kick = step_size;
  const Energies start = energies(part_energies());
  initial_energy = start.kinetic + start.strain;
  record();
}

/// Users' materials whose elastic constants their laws have shown.
void Simulation::Stages::take_shown_elasticity() {
  for (const Part& part : model.parts) {
    for (Material& m : model.materials) {
      auto* user = std::get_if<UserMaterial>(&m.law);
      if (m.name != part.material || !user || user->youngs_modulus > 0) continue;
      const ElementForce::Elasticity shown = elements.shown_elasticity(part_number(model.mesh, part.name));
      user->youngs_modulus = shown.youngs_modulus;
      user->poissons_ratio = shown.poissons_ratio;
    }
  }
}

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

/// A cohesive element in the topology, and all but the cohesive zone told of it.
void Simulation::Stages::insert(FacetUse lower) {
  topology.insert_cohesive(lower, insertion_);
  for (const auto& [node, mother] : insertion_.new_nodes) {
    nodes.clone(mother, model.mesh.coordinates);
    split_.push_back(mother);
    split_.push_back(node);
  }
  for (const Insertion::Renumbered& r : insertion_.renumbered) {
    if (r.element >= topology.bulk_count()) continue;
    elements.replace_node(r.element, r.corner, r.new_node);
    model.mesh.connectivity[elements.first_corners()[r.element] + r.corner] = r.new_node;
  }
  constraints.follow(insertion_);
  if (contact) contact->follow(insertion_);
}

void Simulation::Stages::insert_bonds() {
  if (model.bonds.empty()) return;
  split_.clear();
  for (const Bond& bond : model.bonds) {
    for (const FacetUse& lower : bonded_facets(model, bond, topology)) {
      insert(lower);
      cohesive->insert_bond(topology, insertion_, bond.cohesive_law, nodes);
    }
  }
  divide_masses_and_forces();
}

void Simulation::Stages::insert_open_facets() {
  if (open_.empty()) return;
  split_.clear();
  for (const OpenFacet& facet : open_) {
    insert(facet.lower);
    cohesive->insert(topology, insertion_, facet, nodes, time);
    monitor.watch_insertion(time, topology, insertion_, nodes);
  }
  divide_masses_and_forces();
}

/// A split node and its copies carry the masses and internal forces of the elements that are theirs now.
void Simulation::Stages::divide_masses_and_forces() {
  std::sort(split_.begin(), split_.end());
  split_.erase(std::unique(split_.begin(), split_.end()), split_.end());
  std::array<double, 24> corner{};
  for (const Index node : split_) {
    topology.elements_around_node(node, around_);
    double mass = 0;
    Vec3 force;
    for (const VertexUse& use : around_) {
      if (use.element >= topology.bulk_count()) continue;
      mass += elements.corner_mass(use.element);
      elements.corner_force(use.element, nodes.position, corner);
      force += Vec3::load(&corner[3 * static_cast<std::size_t>(use.corner)]);
    }
    nodes.mass[node] = mass;
    force.store(&nodes.force[3 * static_cast<std::size_t>(node)]);
  }
}

void Simulation::Stages::update_surface() {
  if (!gone_.empty()) {
    contact->remove_elements(gone_, topology, nodes);
    gone_.clear();
  }
  const std::span<const Index> broken = cohesive ? cohesive->broken_now() : std::span<const Index>();
  if (broken.empty()) return;
  freed_.clear();
  for (const Index e : broken) {
    freed_.push_back(topology.mate({e, 0}));
    freed_.push_back(topology.mate({e, 1}));
  }
  contact->add_segments(freed_, topology, nodes);
}

void Simulation::Stages::search() {
  Contact::Search due = contact->due(nodes, step_size);
  if (search_anew_) due = Contact::Search::regular;
  search_anew_ = false;
  switch (due) {
    case Contact::Search::none:
      break;
    case Contact::Search::regular:
      clock.time(regular_clock_, [this] { contact->regular_search(nodes, threads); });
      break;
    case Contact::Search::adaptive:
      clock.time(adaptive_clock_, [this] { contact->adaptive_search(nodes); });
      break;
  }
}

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
  stable = elements.stable_step(nodes.position, threads);
  if (!(stable.step > 0) || !std::isfinite(stable.step)) {
    throw Error(Status::diverged,
                "no stable step at time " + std::to_string(time) + " s: element " + numbered(stable.element) +
                    " is inverted or not finite; take a smaller step or a coarser mesh there");
  }
  const double fixed = model.time.fixed_step;
  if (fixed > stable.step && !warned_of_step_) warn_of_step();
  // Springs between bodies and faces add to the elements' squared frequency at most their own.
  double springs = cohesive ? cohesive->stiffness_over_mass(nodes) : 0;
  if (contact) springs += contact->stiffness_over_mass();
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

void Simulation::Stages::record() {
  const std::vector<PartEnergy> parts = part_energies();
  const Energies now = energies(parts);
  if (!std::isfinite(now.balance())) {
    const Index element = elements.first_inverted(nodes.position);
    const std::string at = element == kNone ? ""
                                            : "element " + numbered(element) + " (part '" +
                                                  model.mesh.part_names[model.mesh.parts[element]] +
                                                  "') is the first that is inverted; ";
    throw Error(Status::diverged, "the state is no longer finite at time " + std::to_string(1e6 * time) +
                                      " us, step " + std::to_string(steps) + ": " + at +
                                      "take a smaller step (stable: " + std::to_string(1e9 * stable.step) +
                                      " ns)");
  }
  std::vector<Monitor::Body> shown;
  shown.reserve(bodies.size());
  for (const RigidMotion& body : bodies) shown.push_back({body.center(), body.velocity(), body.force()});
  monitor.record(time, steps, step_size, now, parts, cohesive ? cohesive->count() : 0,
                 cohesive ? cohesive->broken_count() : 0, shown,
                 contact ? contact->body_pairs() : std::span<const SurfaceContact::BodyPair>());
}

Energies Simulation::Stages::energies(const std::vector<PartEnergy>& parts) const {
  Energies sum;
  sum.initial = initial_energy;
  sum.external_work = external_work + work_ahead_;
  sum.kinetic = kinetic_energy(kick, nodes, threads);
  for (const RigidMotion& body : bodies) sum.kinetic += body.kinetic_energy(kick);
  for (const PartEnergy& part : parts) {
    sum.strain += part.strain;
    sum.hourglass += part.hourglass;
    sum.material_dissipated += part.dissipated;
  }
  if (cohesive) {
    const CohesiveZone::Energy energy = cohesive->energy();
    sum.cohesive_stored = energy.stored;
    sum.cohesive_dissipated = energy.dissipated;
    sum.cohesive_friction = energy.friction;
  }
  if (contact) {
    const Contact::Energy energy = contact->energy();
    sum.contact_stored = energy.stored;
    sum.contact_friction = energy.friction;
  }
  return sum;
}

Frame Simulation::Stages::frame() const {
  Frame f;
  f.time = time;
  f.step = steps;
  f.reference = nodes.reference;
  f.positions = nodes.position;
  f.velocities = nodes.velocity;
  f.connectivity = model.mesh.connectivity;
  f.first_corner = elements.first_corners();
  f.parts = model.mesh.parts;
  f.part_names = model.mesh.part_names;
  for (const SymmetryPlane& plane : model.symmetry_planes)
    f.symmetry_planes.emplace_back(plane.axis, plane.coordinate);
  if (cohesive) f.cracks = cohesive->facets(topology);

  const Index count = model.mesh.element_count();
  f.von_mises.resize(count);
  f.max_principal.resize(count);
  threads.for_ranges(count, 256, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      const Mat3 s = elements.stress(static_cast<Index>(e), nodes.position);
      f.von_mises[e] = von_mises(s);
      f.max_principal[e] = max_principal(s);
    }
  });
  if (elements.has_user_laws()) add_user_fields(f);
  return f;
}

/// States of users' laws by name; laws that give one name to a state of theirs share the field. Stress by
/// component, and what has been deleted.
void Simulation::Stages::add_user_fields(Frame& f) const {
  const auto count = static_cast<std::size_t>(model.mesh.element_count());
  const auto field = [&](const std::string& name, double start) -> std::vector<double>& {
    for (ElementField& known : f.fields) {
      if (known.name == name) return known.values;
    }
    f.fields.push_back({name, std::vector<double>(count, start)});
    return f.fields.back().values;
  };
  const std::vector<const Part*> parts = parts_in_order(model);
  bool deletes = false;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto* law = std::get_if<UserMaterial>(&material(model, parts[p]->material).law);
    if (!law) continue;
    deletes = deletes || law->deletion_state >= 0;
    for (int k = 0; k < law->states; ++k) {
      std::vector<double>& values = field(state_name(*law, k), std::numeric_limits<double>::quiet_NaN());
      for (std::size_t e = 0; e < count; ++e) {
        if (model.mesh.parts[e] == static_cast<Index>(p))
          values[e] = elements.mean_state(static_cast<Index>(e), k);
      }
    }
  }
  static constexpr std::tuple<const char*, int, int> kComponents[] = {
      {"stress_xx", 0, 0}, {"stress_yy", 1, 1}, {"stress_zz", 2, 2},
      {"stress_xy", 0, 1}, {"stress_yz", 1, 2}, {"stress_zx", 2, 0}};
  const std::size_t first = f.fields.size();
  for (const auto& component : kComponents) field(std::get<0>(component), 0);
  threads.for_ranges(model.mesh.element_count(), 256, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      const Mat3 s = elements.stress(static_cast<Index>(e), nodes.position);
      std::size_t at = first;
      for (const auto& [name, i, j] : kComponents) f.fields[at++].values[e] = s(i, j);
    }
  });
  if (!deletes) return;
  std::vector<double>& gone = field("deleted", 0);
  for (const Summary::Deleted& d : deleted) gone[static_cast<std::size_t>(d.element)] = 1;
}

/// Facets that have opened, in their order: they make the same topology again, and what follows from it.
void Simulation::Stages::archive_insertions(Archive& a) {
  std::vector<FacetUse> opened;
  for (Index e = elements_initial; e < topology.element_count(); ++e) opened.push_back(topology.mate({e, 1}));
  a("insertions", opened);
  if (a.reads()) {
    for (const FacetUse& lower : opened) insert(lower);
    split_.clear();
  }
  a.require_same("nodes", static_cast<std::uint64_t>(nodes.count()));
  a.require_same("cohesive_elements", static_cast<std::uint64_t>(topology.element_count()));
}

void Simulation::Stages::archive(Archive& a) {
  archive_insertions(a);
  nodes.archive(a);
  elements.archive(a);
  a.require_same("rigid_bodies", bodies.size());
  for (RigidMotion& body : bodies) body.archive(a);
  a.require_same("cohesive", cohesive.has_value());
  if (cohesive) cohesive->archive(a);
  a.require_same("contact", contact.has_value());
  if (contact) contact->archive(a);
  monitor.archive(a);
  clock.archive(a);
  a("time", time);
  a("steps", steps);
  a("step_size", step_size);
  a("next_step", next_step_);
  a("kick", kick);
  a("stable", stable);
  a("external_work", external_work);
  a("work_ahead", work_ahead_);
  a("initial_energy", initial_energy);
  a("wall_seconds", wall_seconds);
  a("positions_are_new", positions_are_new);
  a("search_anew", search_anew_);
  a("load", load_);
  a("warnings", warnings);
  a("warned_of_step", warned_of_step_);
  std::uint64_t gone = deleted.size();
  a("deleted", gone);
  deleted.resize(gone);
  for (Summary::Deleted& d : deleted) {
    a("deleted.element", d.element);
    a("deleted.part", d.part);
    a("deleted.time", d.time_s);
  }
}

Summary Simulation::Stages::summary() const {
  Summary s;
  s.title = model.title;
  s.elements = model.mesh.element_count();
  s.nodes_initial = nodes_initial;
  s.nodes_final = nodes.count();
  s.segments_initial = segments_initial;
  s.segments_final = contact ? contact->segment_count() : 0;
  s.steps = steps;
  s.simulated_time_s = time;
  s.dt_s = step_size;
  s.dt_stable_s = stable.step;
  s.dt_element = stable.element;
  s.wall_s = wall_seconds;
  s.threads = threads.count();
  s.peak_rss_mb = peak_rss_mb();
  monitor.fill(s);
  if (cohesive) {
    s.cohesive_inserted = cohesive->count();
    s.cohesive_broken = cohesive->broken_count();
    const CohesiveZone::Energy energy = cohesive->energy();
    s.cohesive_dissipated_over_ga = energy.ga > 0 ? energy.dissipated / energy.ga : 0;
    s.cohesive_slope_cost_j = energy.slope_cost;
  }
  if (!bodies.empty()) {
    const Vec3 before = Vec3::load(model.rigid_bodies.front().velocity.data());
    if (norm(before) > 0) s.impactor_rebound_mps = -dot(bodies.front().velocity(), normalized(before));
  }
  s.deleted = deleted;
  s.warnings = warnings;
  for (const Material& m : model.materials) {
    const auto* user = std::get_if<UserMaterial>(&m.law);
    if (!user || !user->warnings) continue;
    for (const std::string& said : user->warnings())
      s.warnings.push_back("material '" + m.name + "': " + said);
  }
  if (contact) {
    s.deepest_penetration_m = contact->deepest_penetration();
    for (const SurfaceContact::BodyPair& pair : contact->body_pairs()) {
      s.contact_pairs.push_back({{model.mesh.part_names[pair.parts[0]], model.mesh.part_names[pair.parts[1]]},
                                 pair.peak_force,
                                 pair.stored,
                                 pair.friction_heat,
                                 pair.deepest});
    }
    const std::vector<std::string> more = contact->warnings();
    s.warnings.insert(s.warnings.end(), more.begin(), more.end());
  }
  for (const StageClock::Stage& stage : clock.stages())
    s.stages.push_back({stage.name, stage.seconds, stage.calls});
  return s;
}

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
