/// Facets open: topology, nodes, elements, cohesive zone and contact learn of it, each once.
#include <algorithm>
#include <array>

#include "scene/bonds.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

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

}  // namespace cdfp
