/// All cohesive elements: state at the node pairs, traction, energies.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cdfp/cohesive.hpp"
#include "cdfp/model.hpp"
#include "cdfp/results.hpp"
#include "cdfp/topology.hpp"
#include "cohesive/criterion.hpp"
#include "core/archive.hpp"
#include "core/parallel.hpp"
#include "state/nodes.hpp"

namespace cdfp {

enum class CohesiveScheme {
  mean_traction,  ///< traction is its mean between half steps, solved for: dissipates what the law says
  plain           ///< traction at the step's opening: for comparison
};

class CohesiveZone {
 public:
  /// The model must stay.
  explicit CohesiveZone(const Model& model, CohesiveScheme scheme = CohesiveScheme::mean_traction);
  /// For a caller's own elements, which have consecutive numbers from `first_element` on.
  explicit CohesiveZone(Index first_element);
  ~CohesiveZone();
  CohesiveZone(CohesiveZone&&) noexcept;
  CohesiveZone& operator=(CohesiveZone&&) noexcept;

  /// A cohesive element was inserted in the topology (and the nodes cloned). `facet.traction` is what it must
  /// carry at first. Corners of older cohesive elements that `insertion.renumbered` names are followed.
  void insert(const Topology& topology, const Insertion& insertion, const OpenFacet& facet,
              const NodeArrays& nodes, double time);

  /// The same for a facet that is bonded from the start by a law of its own and carries nothing yet.
  void insert_bond(const Topology& topology, const Insertion& insertion, const std::string& law,
                   const NodeArrays& nodes);

  // The same step by step, for elements of a caller's.
  void add_law(const CohesiveLaw& law);
  /// New nodes, and corners of cohesive elements that name them.
  void follow(const Insertion& insertion);
  /// The next element. `corners`: of the upper face, then of the lower face in its element's outward order.
  void insert(Index law, std::span<const Index> corners, Vec3 traction, const NodeArrays& nodes, double time);
  /// A node of a live pair whose position or velocity is not finite, or that has no mass; or kNone.
  Index first_bad_node(const NodeArrays& nodes) const;
  /// By the order of insertion.
  Index corner_count(Index facet) const;
  CohesivePointState point(Index facet, Index corner) const;

  /// Adds the cohesive (and closed-face contact and friction) forces at the node pairs to `nodes.force`,
  /// which holds all other forces of the step already, and advances the state. Velocities must change by
  /// `step * force / mass` afterwards. The same bits for any number of threads.
  void add_force(const NodeArrays& nodes, double step, double time, const Threads& threads);

  /// Cohesive elements (topology numbers) that lost their last point in the last `add_force`, ascending.
  /// Corners where the nodes are still one do not count.
  std::span<const Index> broken_now() const;

  Index count() const;         ///< bonds included
  Index broken_count() const;  ///< bonds included

  /// J, at the time of the last `add_force`. `dissipated` is what the cohesive forces took from the nodes
  /// less what is stored; `ga` what the law says for the same openings: they agree as far as the time
  /// stepping is right. `friction` is heat between closed faces and what their contact loses where a closed
  /// face breaks or turns.
  struct Energy {
    double stored = 0;
    double dissipated = 0;
    double friction = 0;
    double ga = 0;          ///< sum over points of area * damage * mode-weighted fracture energy
    double slope_cost = 0;  ///< |work| by which users' laws missed their traction, too steep for the step
  };
  Energy energy() const;

  /// 4 / step^2 below which the stiffnesses that users' laws name are followed as they are, 1/s2: for the
  /// stable step. The built-in laws are solved for and bound no step.
  double stiffness_over_mass(const NodeArrays& nodes) const;

  /// For output, in the order of insertion. Bonds show once they are damaged.
  std::vector<CrackFacet> facets(const Topology& topology) const;

  void archive(Archive& a);

  /// What the solution of the node pairs cost, for benchmarks.
  struct Cost {
    std::int64_t clusters = 0;     ///< solved
    std::int64_t evaluations = 0;  ///< of all points of a cluster
    std::int64_t approached = 0;   ///< clusters that took softer springs first
    std::int64_t softened = 0;     ///< clusters that kept them
    std::int64_t unsettled = 0;    ///< clusters whose stiffness was fixed over the step
  };
  Cost cost() const;

 private:
  struct Points;
  std::unique_ptr<Points> points_;
};

}  // namespace cdfp
