/// Internal forces, mass, stress and stable step of all bulk elements of a model.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "core/archive.hpp"
#include "core/parallel.hpp"
#include "core/vec3.hpp"

namespace cdfp {

struct PartEnergy {
  double strain = 0;      ///< J, without hourglass
  double hourglass = 0;   ///< J
  double dissipated = 0;  ///< J, by the material
};

struct StepBound {
  double step = 0;  ///< s
  Index element = kNone;
};
struct StepBounds {
  StepBound alone, with_springs;
};

class ElementForce {
 public:
  /// Elements of rigid parts are left out. Copies what it needs; the model may go.
  explicit ElementForce(const Model& model);
  ~ElementForce();

  /// Adds each deformable element's lumped mass to its nodes.
  void add_mass(std::span<double> mass) const;
  /// kg: what one element gives to each of its corners; 0 for rigid elements.
  double corner_mass(Index element) const;

  /// Where each element's corners start in the mesh's connectivity, and the end.
  std::span<const Index> first_corners() const;

  /// Whether a part has a law of the user's, so that `advance_user_laws` has work.
  bool has_user_laws() const;

  /// Calls users' laws for the step of that length which ends at `time` with the nodes at `position`; their
  /// stress stands until the next call. The same bits for any number of threads. Returns the elements that
  /// were deleted, ascending. Throws `Error(diverged)` naming element, point, material and time if a law
  /// fails.
  std::span<const Index> advance_user_laws(std::span<const double> position, double time, double step,
                                           const Threads& threads);

  /// Elastic constants that the law of a part showed in its first call: the model's, if it gives some.
  struct Elasticity {
    double youngs_modulus = 0, poissons_ratio = 0;
  };
  Elasticity shown_elasticity(Index part) const;

  /// Of a part with a user's law: the mean of a state over the element's points. NaN for any other.
  double mean_state(Index element, int state) const;

  /// Adds minus the internal force to `force` and advances the material state by `step`.
  /// The same bits for any number of threads. `reference`: undeformed positions of the same nodes, or none;
  /// with them blocks of elements are left out until one of their nodes has moved, such as before the first
  /// wave.
  void add_force(std::span<const double> position, std::span<double> force, double step,
                 const Threads& threads, std::span<const double> reference = {});

  /// Ascending numbers of the cracking elements whose stress, at the last `add_force`, could reach the
  /// strength on some plane (Frobenius norm of the stress against strength * min(1, shear ratio)). A facet
  /// whose traction is the mean of two elements' can only open if one of them is listed.
  std::span<const Index> critical_elements() const;

  /// Mean Cauchy stress of each of them at `position`, Pa, with the material state as it is.
  std::span<const Mat3> critical_stresses(std::span<const double> position, const Threads& threads);
  /// The same as the last call found them.
  std::span<const Mat3> last_critical_stresses() const;

  /// Lists elements of a cracking part from this strength on (Pa) instead of its law's, where facets are
  /// weaker or stronger than that.
  void set_least_strength(Index part, double strength);

  /// Mean Cauchy stress of an element at `position`, Pa, with the material state as it is.
  Mat3 stress(Index element, std::span<const double> position) const;

  /// Minus the internal force of one element at its corners, (corners, 3), N, with the material state as it
  /// is: what `add_force` last added for it. For nodes that are split after that.
  void corner_force(Index element, std::span<const double> position, std::span<double> force) const;

  /// An element's corner now names `node` (a copy of the old one at the same place).
  void replace_node(Index element, Index corner, Index node);

  /// A step below which every element, alone or in any assembly, is stable (2 / omega of the free element, as
  /// deformed now).
  StepBound stable_step(std::span<const double> position, const Threads& threads) const {
    return stable_steps(position, threads, {}).alone;
  }
  /// Also with springs between nodes. `springs`: 1/s2, bound on omega^2 of those at each node, which act on
  /// the elements that have it; may be empty.
  StepBounds stable_steps(std::span<const double> position, const Threads& threads,
                          std::span<const double> springs) const;

  /// One entry a part of the model.
  std::vector<PartEnergy> energies(std::span<const double> position, const Threads& threads) const;

  /// First element with a non-finite or non-positive volume at `position`, or kNone.
  Index first_inverted(std::span<const double> position) const;

  /// All but the corners' nodes, which `replace_node` gives.
  void archive(Archive& a);

  /// Bytes held an element, constants and state.
  std::size_t memory() const;

 private:
  struct Blocks;
  std::unique_ptr<Blocks> blocks_;
};

}  // namespace cdfp
