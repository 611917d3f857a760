#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <variant>

#include "cohesive/check_law.hpp"
#include "core/numbered.hpp"
#include "core/require.hpp"
#include "model/lookup.hpp"
#include "scene/scene.hpp"

namespace cdfp {

namespace {

void require_finite(const std::array<double, 3>& value, const std::string& what) {
  for (const double v : value) require(std::isfinite(v), what + " is not a finite number");
}

void check_poisson(double nu, const std::string& where) {
  require(nu > -1 && nu < 0.5,
          where + ": poissons_ratio is " + std::to_string(nu) +
              "; it must lie between -1 and 0.5 (0.49 for a nearly incompressible material)");
}

/// It names an array in files for others' programs, next to those that are always there.
void check_state_name(const std::string& name, const std::string& where) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
  require(plain, where + ": state name '" + name + "' may hold letters, digits, '_', '-' and '.' only");
  const auto names = {"part", "velocity", "von_mises", "max_principal", "deleted"};
  require(std::find(names.begin(), names.end(), name) == names.end(),
          where + ": state name '" + name + "' is an output's already; take another");
  require(!name.starts_with("stress_"), where + ": state names that start with 'stress_' are the stress's");
}

void check_user_material(const UserMaterial& law, const std::string& where) {
  require(law.callback != nullptr, where + ": a user material needs a callback");
  require(law.states >= 0, where + ": states must not be negative");
  require(std::isfinite(law.youngs_modulus) && law.youngs_modulus >= 0,
          where + ": youngs_modulus must not be negative (0: as the law's first call shows)");
  require(law.youngs_modulus > 0 || law.poissons_ratio == 0,
          where + ": poissons_ratio means nothing without youngs_modulus; give both or neither");
  require(law.deletion_state >= -1 && law.deletion_state < law.states,
          where + ": deletion_state is " + std::to_string(law.deletion_state) + "; the law has states 0 to " +
              std::to_string(law.states - 1) + " (-1: none deletes)");
  require(law.state_names.size() <= static_cast<std::size_t>(law.states),
          where + ": there are more state_names (" + std::to_string(law.state_names.size()) +
              ") than states (" + std::to_string(law.states) + ")");
  for (std::size_t i = 0; i < law.state_names.size(); ++i) {
    check_state_name(law.state_names[i], where);
    require(std::find(law.state_names.begin(), law.state_names.begin() + static_cast<std::ptrdiff_t>(i),
                      law.state_names[i]) == law.state_names.begin() + static_cast<std::ptrdiff_t>(i),
            where + ": two states are named '" + law.state_names[i] + "'");
  }
  for (const double p : law.properties) require(std::isfinite(p), where + ": a property is not finite");
}

void check_material(const Material& m) {
  const std::string where = "material '" + m.name + "'";
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        require_positive(law.density, where + ": density");
        check_poisson(law.poissons_ratio, where);
        if constexpr (std::is_same_v<Law, RateDependentMaterial>) {
          require_positive(law.static_modulus, where + ": static_modulus");
          require(law.rate_modulus >= 0, where + ": rate_modulus must not be negative");
          require(law.rate_exponent >= 0, where + ": rate_exponent must not be negative");
          require_positive(law.smoothing_time, where + ": smoothing_time");
        } else if constexpr (std::is_same_v<Law, UserMaterial>) {
          check_user_material(law, where);
        } else {
          require_positive(law.youngs_modulus, where + ": youngs_modulus");
        }
      },
      m.law);
}

void check_bonds(const Model& model) {
  for (const Bond& bond : model.bonds) {
    const CohesiveLaw& law = cohesive_law(model, bond.cohesive_law);
    require(law.kind == CohesiveKind::bilinear || law.kind == CohesiveKind::user,
            "bond: cohesive law '" + law.name +
                "' is extrinsic and starts at its strength; take a bilinear or "
                "user law");
    require(bond.facet_set.empty() != (bond.parts[0].empty() && bond.parts[1].empty()),
            "bond: give either a facet set or two parts");
    if (!bond.facet_set.empty()) {
      facet_set(model.mesh, bond.facet_set);
      continue;
    }
    for (const std::string& name : bond.parts) {
      const Index part = part_number(model.mesh, name);
      require(!is_rigid(model, *parts_in_order(model)[part]), "bond: part '" + name + "' is rigid");
    }
    require(bond.parts[0] != bond.parts[1], "bond: the two parts are the same, '" + bond.parts[0] + "'");
  }
}

void check_strength_shares(const Model& model) {
  if (model.strength_shares.empty()) return;
  require(model.strength_shares.size() == model.mesh.types.size(),
          "strength_shares has " + std::to_string(model.strength_shares.size()) +
              " numbers; give one for each "
              "of the " +
              std::to_string(model.mesh.types.size()) + " elements, or none");
  for (const double share : model.strength_shares) require_positive(share, "strength_shares: a share");
}

void check_parts(const Model& model) {
  for (const Part* part : parts_in_order(model)) {
    const std::string where = "part '" + part->name + "'";
    const bool rigid = is_rigid(model, *part);
    bool has_body = false;
    for (const RigidBody& body : model.rigid_bodies) has_body |= body.part == part->name;
    require(!rigid || has_body, where + " has a rigid material but no rigid body; define one with its mass");
    require(rigid || !has_body,
            where + " has a rigid body but a deformable material; give it a rigid material");
    if (!part->cohesive_law.empty()) {
      require(cohesive_law(model, part->cohesive_law).kind != CohesiveKind::bilinear,
              where + ": cohesive law '" + part->cohesive_law +
                  "' is bilinear and stands from the start; use it in a bond, and an extrinsic law here");
      require(!rigid, where + " is rigid and cannot crack; leave its cohesive law out");
    }
    require(part->hourglass > 0, where + ": hourglass must be positive (1 is the assumed-strain stiffness)");
  }
}

void check_rigid_nodes(const Model& model) {
  const Mesh& mesh = model.mesh;
  std::vector<bool> rigid_part;
  for (const Part* part : parts_in_order(model)) rigid_part.push_back(is_rigid(model, *part));
  std::vector<Index> owner(mesh.node_count(), kNone);
  const std::vector<Index> first = first_corners(mesh);
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const Index part = mesh.parts[e];
    for (Index i = first[e]; i < first[e + 1]; ++i) {
      const Index node = mesh.connectivity[i];
      Index& seen = owner[node];
      if (seen != kNone && seen != part && (rigid_part[part] || rigid_part[seen])) {
        refuse(
            "node " + numbered(node) + " belongs to part '" + mesh.part_names[part] + "' and part '" +
            mesh.part_names[seen] +
            "', of which one is rigid; give the rigid part nodes of its own and let them touch by contact");
      }
      seen = part;
    }
  }
}

void check_motion(const Model& model) {
  for (const RigidBody& body : model.rigid_bodies) {
    const std::string where = "rigid body '" + body.part + "'";
    part_number(model.mesh, body.part);
    require_positive(body.mass, where + ": mass");
    require_finite(body.velocity, where + ": velocity");
    require_finite(body.angular_velocity, where + ": angular_velocity");
  }
  for (const SymmetryPlane& plane : model.symmetry_planes) {
    require(plane.axis >= 0 && plane.axis < 3, "symmetry plane: axis must be 0, 1 or 2 (x, y, z)");
    require(std::isfinite(plane.coordinate), "symmetry plane: coordinate is not a finite number");
  }
  for (const PrescribedVelocity& p : model.prescribed_velocities) {
    node_set(model.mesh, p.node_set);
    const std::string where = "prescribed velocity of '" + p.node_set + "'";
    require(!p.values.empty(), where + ": values are missing");
    require(p.times.empty() ? p.values.size() == 1 : p.times.size() == p.values.size(),
            where + ": there must be one value for each time (or one value and no times)");
    for (std::size_t i = 1; i < p.times.size(); ++i)
      require(p.times[i] > p.times[i - 1], where + ": times must ascend");
    for (const double v : p.values) require(std::isfinite(v), where + ": a value is not a finite number");
  }
  for (const InitialVelocity& v : model.initial_velocities) {
    const Index part = part_number(model.mesh, v.part);
    require(!is_rigid(model, *parts_in_order(model)[part]),
            "initial velocity of '" + v.part + "': the part is rigid; give the velocity to its rigid body");
    require_finite(v.velocity, "initial velocity of '" + v.part + "'");
    for (const double g : v.gradient)
      require(std::isfinite(g), "initial velocity of '" + v.part + "': its gradient is not finite");
  }
  require_finite(model.gravity, "gravity");
}

void check_settings(const Model& model) {
  const ContactSettings& c = model.contact;
  for (const std::string& name : c.surfaces) facet_set(model.mesh, name);
  require_positive(c.cell_factor, "contact: cell_factor");
  require_positive(c.buffer_factor, "contact: buffer_factor");
  require_positive(c.penalty_factor, "contact: penalty_factor");
  require_positive(c.depth_limit, "contact: depth_limit");
  require_positive(c.penetration_warning, "contact: penetration_warning");
  require(c.friction >= 0, "contact: friction must not be negative");
  require_positive(model.time.end, "time: end");
  require(model.time.fixed_step >= 0,
          "time: fixed_step must not be negative (0 chooses the step automatically)");
  require(model.time.step_factor > 0 && model.time.step_factor <= 1, "time: step_factor must lie in (0, 1]");
  require(model.output.history_interval >= 1, "output: history_interval must be at least 1 step");
  require(model.output.restart_interval >= 0, "output: restart_interval must not be negative");
  for (const double t : model.output.snapshot_times) require(t >= 0, "output: a snapshot time is negative");
  require(model.threads >= 0, "threads must not be negative (0: as many as the machine has)");
}

}  // namespace

std::vector<std::string> check_model(const Model& model) {
  std::vector<std::string> warnings = check_mesh(model.mesh);
  for (const ElementType type : model.mesh.types) {
    require(type == ElementType::hexahedron || type == ElementType::tetrahedron || type == ElementType::wedge,
            "a simulation takes hexahedra, tetrahedra and wedges only; cut each pyramid into two tetrahedra");
  }
  for (const Material& m : model.materials) check_material(m);
  for (const CohesiveLaw& law : model.cohesive_laws) check_law(law);
  check_parts(model);
  check_rigid_nodes(model);
  check_bonds(model);
  check_strength_shares(model);
  check_motion(model);
  check_settings(model);
  return warnings;
}

}  // namespace cdfp
