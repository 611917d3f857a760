/// Which facets open: the effective traction Te = sqrt(<Tn>^2 + (|Tt|/eta)^2) reaches the strength.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"
#include "cohesive/facet_strength.hpp"
#include "core/vec3.hpp"

namespace cdfp {

struct OpenFacet {
  FacetUse lower;  ///< use by the bulk element with the smaller number
  Vec3 traction;   ///< Pa, that the upper side exerts on the lower one
};

class Criterion {
 public:
  explicit Criterion(const Model& model);

  /// Facets that reach their strength, in ascending order of `lower`. `candidates`: ascending numbers of all
  /// elements whose stress could reach the strength of a facet near them on some plane; elements that cannot
  /// reach that of their own facets are skipped by the norm of their stress. Only facets between two elements
  /// of one cracking part count. `stress(element)` gives the Cauchy stress. Independent of the order in which
  /// facets are looked at.
  void find(std::span<const Index> candidates, const Topology& topology, std::span<const double> position,
            const std::function<Mat3(Index)>& stress, std::vector<OpenFacet>& open) const;

  const FacetStrength& strength() const { return strength_; }

 private:
  struct Side {
    FacetUse lower;
    Index upper;
  };
  class Stresses;
  std::vector<Index> able_to_crack(std::span<const Index> candidates, const Stresses& stresses) const;
  std::vector<Index> with_neighbours(std::span<const Index> elements, const Topology& topology) const;
  std::vector<Side> facets_of(std::span<const Index> elements, const Topology& topology) const;
  Mat3 nodal_stress(const FacetNodes& facet, Index part, const Topology& topology,
                    const Stresses& stresses) const;

  FacetStrength strength_;
  StressRecovery recovery_;
};

}  // namespace cdfp
