#include "scene/fingerprint.hpp"

#include <variant>

#include "core/digest.hpp"

namespace cdfp {

namespace {

// The names of all members, so that one that is new is not forgotten.

template <class... Values>
void add(Digest& d, const Values&... values) {
  (d.add(values), ...);
}
template <class T, std::size_t N>
void add_each(Digest& d, const std::array<T, N>& values) {
  for (const T& value : values) d.add(value);
}
void add_names(Digest& d, const std::vector<std::string>& names) {
  d.add(names.size());
  for (const std::string& name : names) d.add(name);
}

void add_mesh(Digest& d, const Mesh& mesh) {
  const auto& [coordinates, types, connectivity, parts, layers, part_names, node_sets, facet_sets] = mesh;
  add(d, coordinates, types, connectivity, parts, layers);
  add_names(d, part_names);
  for (const auto& [name, nodes] : node_sets) add(d, name, nodes);
  for (const auto& [name, facets] : facet_sets) add(d, name, facets);
}

struct AddLaw {
  Digest& d;
  void operator()(const ElasticMaterial& law) const {
    const auto& [density, youngs_modulus, poissons_ratio] = law;
    add(d, density, youngs_modulus, poissons_ratio);
  }
  void operator()(const RateDependentMaterial& law) const {
    const auto& [density, poissons_ratio, static_modulus, rate_modulus, rate_exponent, smoothing_time] = law;
    add(d, density, poissons_ratio, static_modulus, rate_modulus, rate_exponent, smoothing_time);
  }
  void operator()(const RigidMaterial& law) const {
    const auto& [density, youngs_modulus, poissons_ratio] = law;
    add(d, density, youngs_modulus, poissons_ratio);
  }
  void operator()(const UserMaterial& law) const {
    const auto& [density, youngs_modulus, poissons_ratio, states, properties, state_names, deletion_state,
                 thread_safe, callback, warnings] = law;
    add(d, density, youngs_modulus, poissons_ratio, states, properties, deletion_state);
  }
};

void add_law(Digest& d, const CohesiveLaw& law) {
  const auto& [name, strength, fracture_energy, mode_ratio, shear_ratio, friction, friction_exponent,
               internal_friction, kind, stiffness, weibull_modulus, weibull_area, seed, rate_sensitivity,
               reference_rate, states, callback] = law;
  add(d, name, strength, fracture_energy, mode_ratio, shear_ratio, friction, friction_exponent,
      internal_friction, kind, stiffness, weibull_modulus, weibull_area, seed, rate_sensitivity,
      reference_rate, states);
}

void add_contact(Digest& d, const ContactSettings& settings) {
  const auto& [surfaces, cell_factor, buffer_factor, penalty_factor, friction, depth_limit,
               penetration_warning, edge_edge, adaptive] = settings;
  add_names(d, surfaces);
  add(d, cell_factor, buffer_factor, penalty_factor, friction, depth_limit, edge_edge, adaptive);
}

void add_body(Digest& d, const RigidBody& body) {
  const auto& [part, mass, inertia, velocity, angular_velocity, translation_fixed, rotation_fixed] = body;
  add(d, part, mass, inertia.has_value());
  if (inertia) add_each(d, *inertia);
  add_each(d, velocity);
  add_each(d, angular_velocity);
  add_each(d, translation_fixed);
  add_each(d, rotation_fixed);
}

}  // namespace

std::vector<std::pair<std::string, std::uint64_t>> fingerprint(const Model& model) {
  const auto& [title, mesh, materials, parts, cohesive_laws, bonds, stress_recovery, strength_shares,
               rigid_bodies, symmetry_planes, prescribed_velocities, initial_velocities, gravity, load,
               contact, time, output, threads] = model;
  std::vector<std::pair<std::string, std::uint64_t>> sections;
  const auto section = [&](const char* name, auto&& fill) {
    Digest d;
    fill(d);
    sections.emplace_back(name, d.value());
  };
  section("mesh", [&, &m = mesh](Digest& d) { add_mesh(d, m); });
  section("materials", [&, &all = materials](Digest& d) {
    for (const auto& [name, law] : all) {
      add(d, name, law.index());
      std::visit(AddLaw{d}, law);
    }
  });
  section("parts", [&, &all = parts](Digest& d) {
    for (const auto& [name, material, formulation, hourglass, cohesive_law] : all)
      add(d, name, material, formulation, hourglass, cohesive_law);
  });
  section("cohesive laws", [&, &all = cohesive_laws](Digest& d) {
    for (const CohesiveLaw& law : all) add_law(d, law);
  });
  section("bonds", [&, &all = bonds](Digest& d) {
    for (const auto& [facet_set, of_parts, law] : all) add(d, facet_set, of_parts[0], of_parts[1], law);
  });
  section("fracture", [&, &recovery = stress_recovery, &shares = strength_shares](Digest& d) {
    add(d, recovery, shares);
  });
  section("rigid bodies", [&, &all = rigid_bodies](Digest& d) {
    for (const RigidBody& body : all) add_body(d, body);
  });
  section("symmetry planes", [&, &all = symmetry_planes](Digest& d) {
    for (const auto& [axis, coordinate] : all) add(d, axis, coordinate);
  });
  section("prescribed velocities", [&, &all = prescribed_velocities](Digest& d) {
    for (const auto& [node_set, directions, times, values] : all) {
      add(d, node_set, times, values);
      add_each(d, directions);
    }
  });
  section("initial velocities", [&, &all = initial_velocities](Digest& d) {
    for (const auto& [part, velocity, gradient] : all) {
      d.add(part);
      add_each(d, velocity);
      add_each(d, gradient);
    }
  });
  section("gravity", [&, &g = gravity](Digest& d) { add_each(d, g); });
  section("contact", [&, &settings = contact](Digest& d) { add_contact(d, settings); });
  return sections;
}

}  // namespace cdfp
