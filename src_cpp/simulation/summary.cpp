#include <sys/resource.h>
#include <variant>

#include "simulation/stages.hpp"

namespace cdfp {

namespace {

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

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

}  // namespace cdfp
