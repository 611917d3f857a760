#include "monitor/monitor.hpp"

#include <algorithm>
#include <cmath>

#include "model/lookup.hpp"

namespace cdfp {

namespace {

std::vector<Index> parts_with_surface(const Model& model) {
  std::vector<Index> parts;
  for (const FacetSet& set : model.mesh.facet_sets) {
    const auto& surfaces = model.contact.surfaces;
    if (std::find(surfaces.begin(), surfaces.end(), set.name) == surfaces.end()) continue;
    for (const FacetUse use : set.facets) parts.push_back(model.mesh.parts[use.element]);
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

}  // namespace

Monitor::Monitor(const Model& model)
    : part_names_(model.mesh.part_names),
      part_of_element_(model.mesh.parts),
      layer_of_element_(model.mesh.layers),
      layers_of_part_(part_names_.size(), 0),
      first_cracks_(part_names_.size()),
      strain_max_(part_names_.size(), 0),
      hourglass_max_(part_names_.size(), 0) {
  for (std::size_t e = 0; e < layer_of_element_.size(); ++e) {
    Index& count = layers_of_part_[part_of_element_[e]];
    count = std::max(count, layer_of_element_[e] + 1);
  }
  for (const Part* part : parts_in_order(model)) cracks_.push_back(!part->cohesive_law.empty());
  for (std::size_t p = 0; p < part_names_.size(); ++p) first_cracks_[p].part = part_names_[p];
  for (const SymmetryPlane& plane : model.symmetry_planes) {
    mirrored_[plane.axis] = true;
    copies_ *= 2;
  }
  history_.columns = {"time_s",
                      "step",
                      "dt_s",
                      "kinetic_j",
                      "strain_j",
                      "hourglass_j",
                      "material_dissipated_j",
                      "cohesive_stored_j",
                      "cohesive_dissipated_j",
                      "cohesive_friction_j",
                      "contact_stored_j",
                      "contact_friction_j",
                      "external_work_j",
                      "energy_balance",
                      "cohesive_inserted",
                      "cohesive_broken"};
  for (const RigidBody& body : model.rigid_bodies) {
    for (const char* quantity : {"force", "velocity", "position"}) {
      const char* unit = quantity[0] == 'f' ? "n" : quantity[0] == 'v' ? "mps" : "m";
      for (const char* axis : {"x", "y", "z"}) {
        history_.columns.push_back(body.part + "_" + quantity + "_" + axis + "_" + unit);
      }
    }
  }
  const std::vector<Index> touching = parts_with_surface(model);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    for (std::size_t j = i + 1; j < touching.size(); ++j) {
      contact_pairs_.push_back({touching[i], touching[j]});
      const std::string pair = "contact_" + part_names_[touching[i]] + "_" + part_names_[touching[j]] + "_";
      for (const char* quantity : {"force_x_n", "force_y_n", "force_z_n", "stored_j", "friction_j"}) {
        history_.columns.push_back(pair + quantity);
      }
    }
  }
}

Vec3 Monitor::of_whole(Vec3 force) const {
  Vec3 sum;
  for (int d = 0; d < 3; ++d) sum[d] = mirrored_[d] ? 0 : copies_ * force[d];
  return sum;
}
double Monitor::whole(Vec3 force) const {
  return norm(of_whole(force));
}

void Monitor::watch_force(double time, Vec3 force_on_first_body) {
  const double force = whole(force_on_first_body);
  if (force > 0 && std::isnan(extremes_.first_contact_s)) extremes_.first_contact_s = time;
  if (force <= extremes_.peak_force_n) return;
  extremes_.peak_force_n = force;
  extremes_.peak_force_time_s = time;
}

void Monitor::watch_insertion(double time, const Topology& topology, const Insertion& insertion,
                              const Nodes& nodes) {
  const Index element = insertion.lower.element;
  const Index part = part_of_element_[element];
  Summary::FirstCrack& first = first_cracks_[part];
  if (!std::isnan(first.time_s)) return;
  first.time_s = time;
  const FacetNodes facet = topology.facet_nodes(insertion.lower);
  Vec3 center;
  for (const Index n : facet.view()) center += nodes.x0(n) / facet.count;
  center.store(first.position.data());
  if (layer_of_element_.empty()) return;
  const Index below = layer_of_element_[element];
  const Index above = layer_of_element_[insertion.upper.element];
  const Index layers = layers_of_part_[part];
  const auto number = [](Index layer) { return std::to_string(layer + 1); };
  first.layer = below;
  if (below != above) {
    first.layer_face = "between layers " + number(std::min(below, above)) + " and " +
                       number(std::max(below, above)) + " of " + std::to_string(layers);
  } else {
    const char* face = below == 0 ? "lower face" : below == layers - 1 ? "upper face" : "inside";
    first.layer_face = std::string(face) + " (layer " + number(below) + " of " + std::to_string(layers) + ")";
  }
}

void Monitor::record(double time, std::int64_t step, double step_size, const Energies& energies,
                     const std::vector<PartEnergy>& parts, Index inserted, Index broken,
                     const std::vector<Body>& bodies,
                     std::span<const SurfaceContact::BodyPair> contact_pairs) {
  const double balance = energies.balance();
  extremes_.energy_balance_min = std::min(extremes_.energy_balance_min, balance);
  extremes_.energy_balance_max = std::max(extremes_.energy_balance_max, balance);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    strain_max_[p] = std::max(strain_max_[p], parts[p].strain);
    hourglass_max_[p] = std::max(hourglass_max_[p], parts[p].hourglass);
  }
  std::vector<double>& row = history_.values;
  row.insert(row.end(), {time, static_cast<double>(step), step_size, energies.kinetic, energies.strain,
                         energies.hourglass, energies.material_dissipated, energies.cohesive_stored,
                         energies.cohesive_dissipated, energies.cohesive_friction, energies.contact_stored,
                         energies.contact_friction, energies.external_work, balance,
                         static_cast<double>(inserted), static_cast<double>(broken)});
  for (const Body& body : bodies) {
    for (const Vec3& v : {of_whole(body.force), body.velocity, body.position})
      row.insert(row.end(), {v.x, v.y, v.z});
  }
  for (const std::array<Index, 2>& key : contact_pairs_) {
    const auto pair = std::find_if(contact_pairs.begin(), contact_pairs.end(),
                                   [&](const SurfaceContact::BodyPair& p) { return p.parts == key; });
    const SurfaceContact::BodyPair now = pair != contact_pairs.end() ? *pair : SurfaceContact::BodyPair{};
    const Vec3 force = of_whole(Vec3::load(now.force.data()));
    row.insert(row.end(), {force.x, force.y, force.z, now.stored, now.friction_heat});
  }
}

void Monitor::archive(Archive& a) {
  a.require_same("monitor.columns", history_.columns.size());
  a("monitor.history", history_.values);
  a("monitor.energy_balance_min", extremes_.energy_balance_min);
  a("monitor.energy_balance_max", extremes_.energy_balance_max);
  a("monitor.first_contact", extremes_.first_contact_s);
  a("monitor.peak_force", extremes_.peak_force_n);
  a("monitor.peak_force_time", extremes_.peak_force_time_s);
  for (Summary::FirstCrack& first : first_cracks_) {
    a("monitor.first_crack.time", first.time_s);
    a("monitor.first_crack.position", first.position);
    a("monitor.first_crack.layer", first.layer);
    a("monitor.first_crack.layer_face", first.layer_face);
  }
  a("monitor.strain_max", strain_max_);
  a("monitor.hourglass_max", hourglass_max_);
}

void Monitor::fill(Summary& summary) const {
  summary.energy_balance_min = extremes_.energy_balance_min;
  summary.energy_balance_max = extremes_.energy_balance_max;
  summary.first_contact_s = extremes_.first_contact_s;
  summary.peak_force_n = extremes_.peak_force_n;
  summary.peak_force_time_s = extremes_.peak_force_time_s;
  for (std::size_t p = 0; p < part_names_.size(); ++p) {
    if (cracks_[p]) summary.first_cracks.push_back(first_cracks_[p]);
    if (strain_max_[p] <= 0) continue;
    const double ratio = hourglass_max_[p] / strain_max_[p];
    summary.hourglass_over_strain.emplace_back(part_names_[p], ratio);
    summary.hourglass_over_strain_max = std::max(summary.hourglass_over_strain_max, ratio);
  }
}

}  // namespace cdfp
