/// What is saved and restored.
#include "core/archive.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

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

}  // namespace cdfp
