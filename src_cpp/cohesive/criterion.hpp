/// Which facets open: the effective traction Te = sqrt(<Tn>^2 + (|Tt|/eta)^2) reaches the strength.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"
#include "core/vec3.hpp"

namespace cdfp {

struct OpenFacet {
  FacetUse lower;  ///< use by the bulk element with the smaller number
  Vec3 traction;   ///< Pa, that the upper side exerts on the lower one
};

class Criterion {
 public:
  explicit Criterion(const Model& model);

  /// Facets of `candidates` (ascending element numbers) that reach the strength, in ascending order of
  /// `lower`. Only facets between two elements of one cracking part count. `stress(element)` gives the Cauchy
  /// stress. Independent of the order in which facets are looked at.
  void find(std::span<const Index> candidates, const Topology& topology, std::span<const double> position,
            const std::function<Mat3(Index)>& stress, std::vector<OpenFacet>& open) const;

 private:
  std::vector<Index> part_of_element_;
  std::vector<CohesiveLaw> law_of_part_;  ///< strength 0: the part does not crack
};

}  // namespace cdfp
