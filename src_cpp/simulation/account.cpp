/// Energies, and their row in the history.
#include <cmath>
#include <string>

#include "cdfp/error.hpp"
#include "core/numbered.hpp"
#include "integrator/central_difference.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

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

}  // namespace cdfp
