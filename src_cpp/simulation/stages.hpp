/// What a simulation is made of, and what its stages do.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cdfp/simulation.hpp"
#include "cdfp/topology.hpp"
#include "cohesive/cohesive_zone.hpp"
#include "cohesive/criterion.hpp"
#include "contact/contact.hpp"
#include "core/parallel.hpp"
#include "core/stage_clock.hpp"
#include "core/vec3.hpp"
#include "element/element_force.hpp"
#include "integrator/constraints.hpp"
#include "integrator/rigid_body.hpp"
#include "monitor/monitor.hpp"
#include "state/nodes.hpp"

namespace cdfp {

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

}  // namespace cdfp
