/// All cohesive elements: state at the node pairs, traction, energies.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/results.hpp"
#include "cdfp/topology.hpp"
#include "cohesive/criterion.hpp"
#include "core/parallel.hpp"
#include "state/nodes.hpp"

namespace cdfp {

class CohesiveZone {
 public:
  explicit CohesiveZone(const Model& model);
  ~CohesiveZone();

  /// A cohesive element was inserted in the topology (and the nodes cloned). `facet.traction` is what it must
  /// carry at first. Corners of older cohesive elements that `insertion.renumbered` names are followed.
  void insert(const Topology& topology, const Insertion& insertion, const OpenFacet& facet,
              const Nodes& nodes, double time);

  /// Adds the cohesive (and closed-face contact and friction) forces at the node pairs to `nodes.force`,
  /// which holds all other forces of the step already, and advances the state. The same bits for any number
  /// of threads.
  void add_force(Nodes& nodes, double step, double time, const Threads& threads);

  /// Cohesive elements (topology numbers) that lost their last point in the last `add_force`, ascending.
  std::span<const Index> broken_now() const;

  Index count() const;
  Index broken_count() const;

  struct Energy {
    double stored = 0;
    double dissipated = 0;
    double friction = 0;
    double ga = 0;  ///< J: sum over points of area * damage * mode-weighted fracture energy
  };
  Energy energy() const;

  /// For output, in the order of insertion.
  std::vector<CrackFacet> facets(const Topology& topology) const;

 private:
  struct Points;
  std::unique_ptr<Points> points_;
};

}  // namespace cdfp
