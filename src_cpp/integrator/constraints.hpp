/// Symmetry planes and prescribed velocities: directions of nodes that do not follow their force.
#pragma once

#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"
#include "state/nodes.hpp"

namespace cdfp {

class Constraints {
 public:
  /// Marks `nodes.fixed` and sets the velocities at time 0.
  Constraints(const Model& model, Nodes& nodes);

  /// Copies of constrained nodes are constrained alike.
  void follow(const Insertion& insertion);

  bool any_moving() const { return !moving_.empty(); }
  /// Work of the constraints, J.
  struct Work {
    double step = 0;  ///< over the change of velocity at step n, half a step to either side
    double ahead =
        0;  ///< to be added for the balance at n itself, with `kinetic_energy` as it takes the velocities
  };
  /// Sets the prescribed velocities of `time`. What the constraint adds to the force on a node is its mass
  /// times the change of velocity, less the force.
  Work apply(double time, double step, Nodes& nodes);

 private:
  struct Moving {
    PrescribedVelocity velocity;
    std::vector<Index> nodes;
  };
  std::vector<Moving> moving_;                      ///< not zero for good
  std::vector<std::vector<Index>> moving_of_node_;  ///< entries of `moving_` by node; empty if there are none
};

}  // namespace cdfp
