/// A cohesive facet as a small rigid frame. The forces on its two sides meet an opening apart: unless they
/// pull along the opening they have a moment, which a pair of sides cannot hold (Vossen, Schreurs, van der
/// Sluis, Geers 2013). The frame takes it up by forces on its corners that have that moment and no resultant,
/// so that a facet that turns as a whole does no work.
#pragma once

#include <array>
#include <span>

#include "cohesive/clusters.hpp"
#include "core/vec3.hpp"
#include "state/nodes.hpp"

namespace cdfp {

class FacetFrame {
 public:
  /// The frame of the middles of up to four node pairs, as they lie now.
  FacetFrame(std::span<const NodePair> pairs, const NodeArrays& nodes);

  /// Adds forces with this moment, N m.
  void add_couple(Vec3 couple, const NodeArrays& nodes) const;

  /// The rotation that displacements of the nodes stand for, as a couple's work tells it: work = couple .
  /// spin.
  template <class Displacement>
  Vec3 spin(Displacement&& of_node) const {
    Vec3 sum;
    for (std::size_t c = 0; c < pairs_.size(); ++c)
      sum += cross(arm_[c], 0.5 * (of_node(pairs_[c].upper) + of_node(pairs_[c].lower)));
    return inverse_inertia_ * sum;
  }

 private:
  std::span<const NodePair> pairs_;
  std::array<Vec3, 4> arm_;  ///< m, from the centre
  Mat3 inverse_inertia_;     ///< 1/m2, with a mass of one at each corner
};

}  // namespace cdfp
