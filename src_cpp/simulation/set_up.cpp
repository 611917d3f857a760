/// A model becomes a simulation.
#include <algorithm>
#include <variant>

#include "cdfp/error.hpp"
#include "integrator/central_difference.hpp"
#include "model/lookup.hpp"
#include "scene/fingerprint.hpp"
#include "scene/scene.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

namespace {

bool cracks(const Model& model) {
  return std::any_of(model.parts.begin(), model.parts.end(),
                     [](const Part& p) { return !p.cohesive_law.empty(); });
}

}  // namespace

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

}  // namespace cdfp
