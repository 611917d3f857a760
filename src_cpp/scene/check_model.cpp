#include <cmath>
#include <string>
#include <variant>

#include "cdfp/error.hpp"
#include "scene/scene.hpp"

namespace cdfp {

namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw Error(Status::bad_argument, message);
}

void require(bool holds, const std::string& message) {
  if (!holds) refuse(message);
}

void require_positive(double value, const std::string& what) {
  require(std::isfinite(value) && value > 0, what + " is " + std::to_string(value) + "; it must be positive");
}

void require_not_negative(double value, const std::string& what) {
  require(std::isfinite(value) && value >= 0,
          what + " is " + std::to_string(value) + "; it must not be negative");
}

void require_finite(const std::array<double, 3>& value, const std::string& what) {
  for (const double v : value) require(std::isfinite(v), what + " is not a finite number");
}

void check_poisson(double nu, const std::string& where) {
  require(nu > -1 && nu < 0.5,
          where + ": poissons_ratio is " + std::to_string(nu) +
              "; it must lie between -1 and 0.5 (0.49 for a nearly incompressible material)");
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
        } else {
          require_positive(law.youngs_modulus, where + ": youngs_modulus");
        }
      },
      m.law);
}

void check_law(const CohesiveLaw& law) {
  const std::string where = "cohesive law '" + law.name + "'";
  require_positive(law.strength, where + ": strength");
  require_positive(law.fracture_energy, where + ": fracture_energy");
  require_positive(law.mode_ratio, where + ": mode_ratio");
  require_positive(law.shear_ratio, where + ": shear_ratio");
  require_not_negative(law.friction, where + ": friction");
  require_positive(law.friction_exponent, where + ": friction_exponent");
  require_not_negative(law.internal_friction, where + ": internal_friction");
  require_not_negative(law.weibull_modulus, where + ": weibull_modulus");
  require_not_negative(law.weibull_area, where + ": weibull_area");
  require(law.weibull_area == 0 || law.weibull_modulus > 0,
          where + ": weibull_area means nothing without scatter; give weibull_modulus or leave it out");
  require_not_negative(law.rate_sensitivity, where + ": rate_sensitivity");
  require_not_negative(law.reference_rate, where + ": reference_rate");
  require(
      (law.rate_sensitivity > 0) == (law.reference_rate > 0),
      where + ": rate_sensitivity and reference_rate mean nothing without one another; give both or none");
  const bool user = law.kind == CohesiveKind::user;
  require(
      !user || law.rate_sensitivity == 0,
      where + ": rate_sensitivity is not of user laws; they are told the step and may keep the last opening");
  const bool bilinear = law.kind == CohesiveKind::bilinear;
  require(
      law.kind != CohesiveKind::camacho_ortiz || law.mode_ratio == 1,
      where + ": camacho_ortiz has a potential for mode_ratio 1 only; leave mode_ratio out or take linear");
  if (user) require(law.callback != nullptr, where + ": a user law needs a callback");
  require(user || (!law.callback && law.states == 0),
          where + ": callback and states are of user laws only; set its kind to user");
  require(law.states >= 0, where + ": states must not be negative");
  if (bilinear) {
    require_positive(law.stiffness, where + ": stiffness");
    const double least = law.strength * law.strength / (2 * law.fracture_energy);
    require(law.stiffness > least,
            where + ": stiffness is " + std::to_string(law.stiffness) + " Pa/m; above " +
                std::to_string(least) +
                " (strength^2 / 2 fracture_energy) the bond softens after its strength");
  } else {
    require_not_negative(law.stiffness, where + ": stiffness");
    require(
        user || law.stiffness == 0,
        where + ": stiffness is of bilinear and user laws only; an extrinsic law is rigid until it opens");
  }
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
            "node " + std::to_string(node) + " belongs to part '" + mesh.part_names[part] + "' and part '" +
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
  require(c.friction >= 0, "contact: friction must not be negative");
  require_positive(model.time.end, "time: end");
  require(model.time.fixed_step >= 0,
          "time: fixed_step must not be negative (0 chooses the step automatically)");
  require(model.time.step_factor > 0 && model.time.step_factor <= 1, "time: step_factor must lie in (0, 1]");
  require(model.output.history_interval >= 1, "output: history_interval must be at least 1 step");
  for (const double t : model.output.snapshot_times) require(t >= 0, "output: a snapshot time is negative");
  require(model.threads >= 0, "threads must not be negative (0: as many as the machine has)");
}

}  // namespace

std::vector<std::string> check_model(const Model& model) {
  std::vector<std::string> warnings = check_mesh(model.mesh);
  for (const ElementType type : model.mesh.types) {
    require(type == ElementType::hexahedron || type == ElementType::tetrahedron,
            "a simulation takes hexahedra and tetrahedra only; convert the other elements");
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
