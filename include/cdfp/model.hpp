/// What to simulate, as plain data. Names tie the parts of a model together; `Simulation` resolves and checks
/// them. Units are SI.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cdfp/material.h"
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

/// A block of material points, as a user's law sees it.
using MaterialPoints = cdfp_material_points;

/// A law of the user's. It is called for blocks of points: once at time 0 with a tiny strain increment
/// (`MaterialPoints::start`), whose stress shows the elastic constants and is dropped while its state is
/// kept, and then once a step.
struct UserMaterial {
  double density = 0;  ///< kg/m3
  /// For the stiffness of hourglass modes and contact. 0: as the first call shows, where the stable step also
  /// has them from; a law that answers nothing there needs them.
  double youngs_modulus = 0;  ///< Pa
  double poissons_ratio = 0;
  int states = 0;  ///< numbers kept at each point, 0 at the start
  std::vector<double> properties;
  std::vector<std::string> state_names;  ///< in output; those left out are state_1, state_2 ...
  /// Number of the state (from 0) that deletes: a point where the law makes it 0 carries no stress from then
  /// on, and an element all of whose points have gone is deleted. It is 1 at the start. -1: none.
  int deletion_state = -1;
  /// Several threads may call the law at once. Otherwise one calls it, block after block; the results are the
  /// same bits either way.
  bool thread_safe = false;
  std::function<void(const MaterialPoints&)> callback;           ///< what it throws ends the step
  std::function<std::vector<std::string>()> warnings = nullptr;  ///< for the summary; may be null
};

struct Material {
  std::string name;
  std::variant<ElasticMaterial, RateDependentMaterial, RigidMaterial, UserMaterial> law;
};

enum class Formulation {
  one_point,  ///< mean gradient, one point, assumed-strain stiffness hourglass control
  full        ///< 2 x 2 x 2 points, mean volumetric strain (does not lock at nu 0.49)
};

/// The points of one user's law, all at once: `count` of them at a step. Vectors are (count, 3).
struct CohesivePoints {
  std::int64_t count = 0;
  double time = 0;                             ///< s
  double step = 0;                             ///< s
  const double* opening = nullptr;             ///< m, upper side minus lower side
  const double* normal = nullptr;              ///< from lower to upper
  const double* insertion_traction = nullptr;  ///< Pa, what the law must give at no opening; 0 in a bond
  double* state = nullptr;     ///< (count, `CohesiveLaw::states`), 0 at insertion; the law's own
  double* traction = nullptr;  ///< out: Pa, that the upper side exerts on the lower one
  double* stored = nullptr;    ///< out: J/m2 that closing gives back
  double* damage = nullptr;    ///< out: 0 to 1; broken for good at 1
};

enum class CohesiveKind {
  /// Extrinsic, irreversible, path-dependent (Snozzi and Molinari 2013; Chen, Zang, Xu 2015, eqs. 4-14).
  linear,
  /// Extrinsic, from a potential while it loads (Camacho and Ortiz 1996): `mode_ratio` is 1.
  camacho_ortiz,
  /// Intrinsic, for bonds: elastic with `stiffness` up to the strength, then linear down to no traction; the
  /// triangle below it is the fracture energy.
  bilinear,
  /// What `callback` says, at the opening of the step. The step must resolve it.
  user
};

/// Cohesive law: traction between two faces by their opening.
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
  CohesiveKind kind = CohesiveKind::linear;
  /// Pa/m: slope of a bilinear law before its strength; the steepest slope of a user's law, for the stable
  /// step.
  double stiffness = 0;
  /// m of Weibull's distribution, 0: no scatter. A facet of area A has the strength
  /// strength * (weibull_area / A * ln(1 / (1 - u)))^(1 / m), with u drawn by `seed` and the facet.
  double weibull_modulus = 0;
  double weibull_area = 0;  ///< m2 that `strength` belongs to; 0: each facet's own (no size effect)
  std::int64_t seed = 0;
  /// c: while it opens further, at the rate v of the effective opening, the traction is that of the law times
  /// 1 + c ln(1 + v / reference_rate), and so are the peak and the energy that it dissipates; at rest it is
  /// the law. Facets open at `strength`. A factor on the traction by the opening rate: Glennie 1971 (J. Mech.
  /// Phys. Solids 19, 255) and Kubair, Geubelle, Huang 2003 (Eng. Fract. Mech. 70, 685); its logarithm:
  /// Johnson and Cook 1985. Not for user laws. 0: no rate dependence.
  double rate_sensitivity = 0;
  double reference_rate = 0;  ///< m/s
  int states = 0;             ///< numbers that a user's law keeps at each point
  /// A user's law; never called from two threads at once by one simulation.
  std::function<void(const CohesivePoints&)> callback = nullptr;
};

/// Cohesive elements from the start, on a facet set or between all elements of two parts that share nodes,
/// such as glass and PVB.
struct Bond {
  std::string facet_set;               ///< or
  std::array<std::string, 2> parts{};  ///< both or none
  std::string cohesive_law;            ///< bilinear or user
};

/// How the traction on a facet follows from the stresses of elements.
enum class StressRecovery {
  element_mean,  ///< mean of the facet's two elements
  nodal          ///< mean over the elements of a part around each corner, then over the corners
};

struct Part {
  std::string name;  ///< one of `Mesh::part_names`
  std::string material;
  Formulation formulation = Formulation::one_point;  ///< of hexahedra
  double hourglass = 1.0;    ///< share of the assumed-strain stiffness (one_point, wedges)
  std::string cohesive_law;  ///< extrinsic (linear, camacho_ortiz or user); empty: does not crack
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

/// velocity + gradient * position, such as of a body that spins or expands.
struct InitialVelocity {
  std::string part;                  ///< a deformable part
  std::array<double, 3> velocity{};  ///< m/s, at the origin
  std::array<double, 9> gradient{};  ///< 1/s, row by row
};

/// What a load is given at a step. Vectors are (nodes, 3); nodes that cracks made are among them.
struct NodalLoad {
  std::int64_t nodes = 0;
  double time = 0;                   ///< s
  const double* position = nullptr;  ///< m
  const double* velocity = nullptr;  ///< m/s, at the half step that led to `position`
  double* force = nullptr;           ///< N: of elements and gravity so far; the load is what is added
};

struct ContactSettings {
  std::vector<std::string> surfaces;  ///< facet sets; empty: no contact in the scene
  double cell_factor = 1.0;           ///< w1: cell length over mean segment length
  double buffer_factor = 0.4;         ///< w2: buffer over mean segment length
  double penalty_factor = 1.0;        ///< zeta in k = zeta K A^2 / V
  double friction = 0;                ///< Coulomb coefficient
  double depth_limit = 0.5;           ///< deepest penetration that counts, over the segment's element height
  double penetration_warning = 0.1;   ///< share of that height from which a warning names the pair
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
  std::int64_t restart_interval = 0;   ///< steps between files to continue from; 0: none
};

struct Model {
  std::string title;
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<Part> parts;
  std::vector<CohesiveLaw> cohesive_laws;
  std::vector<Bond> bonds;
  StressRecovery stress_recovery = StressRecovery::element_mean;
  /// Share of its law's strength that an element has, such as less where a surface is scratched; empty: 1. A
  /// facet has the mean of its two elements.
  std::vector<double> strength_shares;
  std::vector<RigidBody> rigid_bodies;
  std::vector<SymmetryPlane> symmetry_planes;
  std::vector<PrescribedVelocity> prescribed_velocities;
  std::vector<InitialVelocity> initial_velocities;
  std::array<double, 3> gravity{};
  /// Forces of the caller's own; called once a step, never from two threads at once by one simulation. Their
  /// work is external work.
  std::function<void(const NodalLoad&)> load = nullptr;
  ContactSettings contact;
  TimeSettings time;
  OutputSettings output;
  int threads = 0;  ///< 0: as many as the machine has
};

}  // namespace cdfp
