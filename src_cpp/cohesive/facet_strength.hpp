/// The strength of each facet of a cracking part: its law's, as it varies over the body.
#pragma once

#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"

namespace cdfp {

class FacetStrength {
 public:
  /// The model's mesh must stay.
  explicit FacetStrength(const Model& model);

  /// The law of the elements' part, or none.
  const CohesiveLaw* law_of(Index element) const {
    const std::int32_t law = law_of_part_[part_of_element_[element]];
    return law < 0 ? nullptr : &laws_[law];
  }
  Index part_of(Index element) const { return part_of_element_[element]; }

  /// Pa, of the facet between two elements of one cracking part. `lower`: its use by the element with the
  /// smaller number. Depends on nothing but the facet and the model.
  double of(FacetUse lower, Index upper) const;

  /// Pa, at most the strength of each of the element's facets.
  double least_of_element(Index element) const;
  /// Pa, at most the strength of each of the part's facets; infinite if it does not crack.
  double least_of_part(Index part) const;

 private:
  double scatter(const CohesiveLaw& law, FacetUse lower) const;
  void find_least(const Model& model);
  void spread_over_nodes(const Model& model);

  std::vector<CohesiveLaw> laws_;
  std::vector<std::int32_t> law_of_part_;  ///< -1: the part does not crack
  std::span<const Index> part_of_element_;
  std::vector<double> shares_;
  std::vector<double> area_;   ///< m2, six an element; empty if no law needs it
  std::vector<double> least_;  ///< by element; empty if strength follows the part's law alone
};

}  // namespace cdfp
