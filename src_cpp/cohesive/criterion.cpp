#include "cohesive/criterion.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "cohesive/law.hpp"

namespace cdfp {

namespace {

/// Twice the area of a facet along its outward normal.
Vec3 doubled_area(const FacetNodes& facet, std::span<const double> position) {
  const auto x = [&](int c) { return Vec3::load(&position[3 * static_cast<std::size_t>(facet.nodes[c])]); };
  return facet.count == 4 ? cross(x(2) - x(0), x(3) - x(1)) : cross(x(1) - x(0), x(2) - x(0));
}

/// What may open the facet: pressure holds part of the shear back (Mohr-Coulomb).
double opening_traction(Vec3 traction, Vec3 normal, const CohesiveLaw& law) {
  const double pressure = -dot(traction, normal);
  if (pressure <= 0) return effective_traction(traction, normal, law.shear_ratio);
  const double shear = norm(traction + pressure * normal);
  return std::max(0.0, shear - law.internal_friction * pressure) / law.shear_ratio;
}

double norm_of(const Mat3& a) {
  return std::sqrt(dot(a.r[0], a.r[0]) + dot(a.r[1], a.r[1]) + dot(a.r[2], a.r[2]));
}

}  // namespace

/// Each element's stress is asked for once.
class Criterion::Stresses {
 public:
  explicit Stresses(const std::function<Mat3(Index)>& stress) : stress_(stress) {}
  const Mat3& of(Index element) const {
    const auto [place, is_new] = known_.try_emplace(element);
    if (is_new) place->second = stress_(element);
    return place->second;
  }

 private:
  const std::function<Mat3(Index)>& stress_;
  mutable std::unordered_map<Index, Mat3> known_;
};

Criterion::Criterion(const Model& model) : strength_(model), recovery_(model.stress_recovery) {}

std::vector<Index> Criterion::able_to_crack(std::span<const Index> candidates,
                                            const Stresses& stresses) const {
  std::vector<Index> able;
  for (const Index e : candidates) {
    const CohesiveLaw* law = strength_.law_of(e);
    if (!law) continue;
    // A little less, as a norm and a traction round differently.
    const double least = (1 - 1e-12) * strength_.least_of_element(e) * std::min(1.0, law->shear_ratio);
    if (norm_of(stresses.of(e)) >= least) able.push_back(e);
  }
  return able;
}

std::vector<Index> Criterion::with_neighbours(std::span<const Index> elements,
                                              const Topology& topology) const {
  std::vector<Index> all;
  std::vector<VertexUse> around;
  for (const Index e : elements) {
    for (const Index node : topology.nodes(e)) {
      topology.elements_around_node(node, around);
      for (const VertexUse& use : around) {
        if (use.element < topology.bulk_count()) all.push_back(use.element);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<Criterion::Side> Criterion::facets_of(std::span<const Index> elements,
                                                  const Topology& topology) const {
  std::vector<Side> sides;
  for (const Index e : elements) {
    if (!strength_.law_of(e)) continue;
    for (Index f = 0; f < topology.facet_count(e); ++f) {
      const FacetUse mate = topology.mate({e, f});
      if (mate.element == kNone || mate.element >= topology.bulk_count()) continue;
      if (strength_.part_of(mate.element) != strength_.part_of(e)) continue;
      if (mate.element > e) {
        sides.push_back({{e, f}, mate.element});
      } else if (!std::binary_search(elements.begin(), elements.end(), mate.element)) {
        sides.push_back({mate, e});
      }
    }
  }
  return sides;
}

/// Sums go over elements in the order of their numbers, whichever facet asks.
Mat3 Criterion::nodal_stress(const FacetNodes& facet, Index part, const Topology& topology,
                             const Stresses& stresses) const {
  Mat3 sum;
  std::vector<VertexUse> around;
  for (const Index node : facet.view()) {
    topology.elements_around_node(node, around);
    std::erase_if(around, [&](const VertexUse& use) {
      return use.element >= topology.bulk_count() || strength_.part_of(use.element) != part;
    });
    Mat3 at_node;
    for (const VertexUse& use : around) at_node = at_node + stresses.of(use.element);
    sum = sum + 1.0 / (static_cast<double>(around.size()) * facet.count) * at_node;
  }
  return sum;
}

void Criterion::find(std::span<const Index> candidates, const Topology& topology,
                     std::span<const double> position, const std::function<Mat3(Index)>& stress,
                     std::vector<OpenFacet>& open) const {
  open.clear();
  const Stresses stresses(stress);
  std::vector<Index> elements = able_to_crack(candidates, stresses);
  const bool nodal = recovery_ == StressRecovery::nodal;
  if (nodal) elements = with_neighbours(elements, topology);
  for (const Side& side : facets_of(elements, topology)) {
    const CohesiveLaw& law = *strength_.law_of(side.upper);
    const FacetNodes facet = topology.facet_nodes(side.lower);
    const Vec3 normal = normalized(doubled_area(facet, position));
    const Mat3 recovered = nodal ? nodal_stress(facet, strength_.part_of(side.upper), topology, stresses)
                                 : 0.5 * (stresses.of(side.lower.element) + stresses.of(side.upper));
    const Vec3 traction = recovered * normal;
    if (opening_traction(traction, normal, law) >= strength_.of(side.lower, side.upper)) {
      open.push_back({side.lower, traction});
    }
  }
  std::sort(open.begin(), open.end(),
            [](const OpenFacet& a, const OpenFacet& b) { return a.lower < b.lower; });
}

}  // namespace cdfp
