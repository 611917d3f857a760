/// Which facets open: the effective traction Te = sqrt(<Tn>^2 + (|Tt|/eta)^2) reaches the strength.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"
#include "cohesive/facet_strength.hpp"
#include "core/number_set.hpp"
#include "core/parallel.hpp"
#include "core/vec3.hpp"

namespace cdfp {

struct OpenFacet {
  FacetUse lower;  ///< use by the bulk element with the smaller number
  Vec3 traction;   ///< Pa, that the upper side exerts on the lower one
};

class Criterion {
 public:
  /// The model's mesh must stay.
  explicit Criterion(const Model& model);

  /// Facets that reach their strength, in ascending order of `lower`. `candidates`: ascending numbers of all
  /// elements whose stress could reach the strength of a facet near them on some plane, with their Cauchy
  /// stresses (or none: they are asked for); elements that cannot reach that of their own facets are skipped
  /// by the norm of their stress. `stress(element)`: of any other, from any thread. Only facets between two
  /// elements of one cracking part count. Independent of the order in which facets are looked at.
  void find(std::span<const Index> candidates, std::span<const Mat3> candidate_stresses,
            const Topology& topology, std::span<const double> position,
            const std::function<Mat3(Index)>& stress, std::vector<OpenFacet>& open,
            const Threads& threads = Threads(1));

  const FacetStrength& strength() const { return strength_; }

  /// Pa: no facet of the element opens by its stress alone if its norm is smaller; infinite if it does not
  /// crack.
  double least_norm(Index element) const;

 private:
  /// What one call of `find` looks at.
  struct Scene {
    const Topology& topology;
    std::span<const double> position;
    const std::function<Mat3(Index)>& stress;
  };
  Mat3 stress_of(Index element, const Scene& scene) const {
    const Index place = known_.place(element);
    return place == kNone ? scene.stress(element) : stresses_[place];
  }
  void list(std::span<const Index> elements, std::span<const Mat3> stresses, const Scene& scene,
            const Threads& threads);
  std::vector<Index> with_neighbours(const Topology& topology) const;
  void look_at_facets(Index element, const Scene& scene, std::vector<OpenFacet>& open) const;
  Mat3 nodal_stress(const FacetNodes& facet, Index part, const Scene& scene) const;

  FacetStrength strength_;
  StressRecovery recovery_;
  std::vector<Index> listed_;  ///< elements whose stress is known, ascending
  NumberSet known_;            ///< the same
  std::vector<Mat3> stresses_;
  std::vector<double> norms_;
  std::vector<std::uint8_t> is_able_;
  std::vector<Index> able_;  ///< those of them whose facets are looked at
  std::vector<std::vector<OpenFacet>> found_;
};

}  // namespace cdfp
