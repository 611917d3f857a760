/// What to simulate, as plain data. Names tie the parts of a model together; `Simulation` resolves and checks
/// them. Units are SI.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cdfp/mesh.hpp"
#include "cdfp/types.hpp"

namespace cdfp {

/// Linear elastic with finite rotation: second Piola-Kirchhoff stress linear in Green-Lagrange strain.
struct ElasticMaterial {
  double density = 0;         ///< kg/m3
  double youngs_modulus = 0;  ///< Pa
  double poissons_ratio = 0;
};

/// PVB with a modulus that depends on the strain rate: E = static + rate_modulus * (rate / 1 s^-1)^exponent.
/// The rate is the equivalent deviatoric strain rate sqrt(2/3 e:e), smoothed by a first-order filter. A
/// stress kept in the rate-dependent branch makes the law dissipate, never gain: at a constant rate it is
/// E(rate) * strain.
struct RateDependentMaterial {
  double density = 0;
  double poissons_ratio = 0;
  double static_modulus = 0;  ///< Pa
  double rate_modulus = 0;    ///< Pa
  double rate_exponent = 0;
  double smoothing_time = 0;  ///< s, time constant of the filter
};

/// Elements that only carry a shape; the elastic constants give the contact stiffness.
struct RigidMaterial {
  double density = 0;
  double youngs_modulus = 0;
  double poissons_ratio = 0;
};

struct Material {
  std::string name;
  std::variant<ElasticMaterial, RateDependentMaterial, RigidMaterial> law;
};

enum class Formulation {
  one_point,  ///< mean gradient, one point, assumed-strain stiffness hourglass control
  full        ///< 2 x 2 x 2 points, mean volumetric strain (does not lock at nu 0.49)
};

/// Extrinsic cohesive law (Snozzi and Molinari 2013; Chen, Zang, Xu 2015, eqs. 4-14).
struct CohesiveLaw {
  std::string name;
  double strength = 0;           ///< Pa, sigma_max
  double fracture_energy = 0;    ///< J/m2, G_I
  double mode_ratio = 1;         ///< kappa = G_II / G_I
  double shear_ratio = 1;        ///< eta: peak shear over strength
  double friction = 0;           ///< Coulomb coefficient between closed faces
  double friction_exponent = 1;  ///< q of f = 1 - (1 - opening/reach)^q (eq. 31)
  /// Mohr-Coulomb: on a facet under pressure p only |Tt| - internal_friction * p can open it. For a shear
  /// strength S and a compressive strength C it is (t - 1/t) / 2 with t = C / (2 S).
  double internal_friction = 0;
};

struct Part {
  std::string name;  ///< one of `Mesh::part_names`
  std::string material;
  Formulation formulation = Formulation::one_point;
  double hourglass = 1.0;    ///< share of the assumed-strain stiffness (one_point)
  std::string cohesive_law;  ///< empty: does not crack
};

/// All elements of a part move as one body.
struct RigidBody {
  std::string part;
  double mass = 0;  ///< kg, of what is modelled (a quarter of the whole in a quarter model)
  std::optional<std::array<double, 9>>
      inertia;  ///< kg m2 about the centre of mass; from the mesh if not given
  std::array<double, 3> velocity{};
  std::array<double, 3> angular_velocity{};
  std::array<bool, 3> translation_fixed{};
  std::array<bool, 3> rotation_fixed{};
};

/// Mirror plane normal to an axis: its nodes keep to it. Also says how the whole is built from what is
/// modelled.
struct SymmetryPlane {
  int axis = 0;
  double coordinate = 0;
};

/// Velocity of a node set, direction by direction, over time (linear between the points, constant outside).
struct PrescribedVelocity {
  std::string node_set;
  std::array<bool, 3> directions{};
  std::vector<double> times;   ///< s; empty: `values[0]` for good
  std::vector<double> values;  ///< m/s
};

struct InitialVelocity {
  std::string part;  ///< a deformable part
  std::array<double, 3> velocity{};
};

struct ContactSettings {
  std::vector<std::string> surfaces;  ///< facet sets; empty: no contact in the scene
  double cell_factor = 1.0;           ///< w1: cell length over mean segment length
  double buffer_factor = 0.4;         ///< w2: buffer over mean segment length
  double penalty_factor = 1.0;        ///< zeta in k = zeta K A^2 / V
  double friction = 0;                ///< Coulomb coefficient
  double depth_limit = 0.5;           ///< deepest penetration that counts, over the segment's element height
  bool edge_edge = true;
  bool adaptive = true;  ///< false: a regular search whenever contact entities are new
};

struct TimeSettings {
  double end = 0;            ///< s
  double fixed_step = 0;     ///< s; 0: automatic
  double step_factor = 0.9;  ///< share of the stable step (automatic)
};

struct OutputSettings {
  std::vector<double> snapshot_times;  ///< s
  std::int64_t history_interval = 20;  ///< steps between rows of the history
};

struct Model {
  std::string title;
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<Part> parts;
  std::vector<CohesiveLaw> cohesive_laws;
  std::vector<RigidBody> rigid_bodies;
  std::vector<SymmetryPlane> symmetry_planes;
  std::vector<PrescribedVelocity> prescribed_velocities;
  std::vector<InitialVelocity> initial_velocities;
  std::array<double, 3> gravity{};
  ContactSettings contact;
  TimeSettings time;
  OutputSettings output;
  int threads = 0;  ///< 0: as many as the machine has
};

}  // namespace cdfp
