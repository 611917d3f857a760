/// What a snapshot shows.
#include <limits>
#include <string>
#include <tuple>
#include <variant>

#include "core/stress.hpp"
#include "model/lookup.hpp"
#include "simulation/stages.hpp"

namespace cdfp {

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

}  // namespace cdfp
