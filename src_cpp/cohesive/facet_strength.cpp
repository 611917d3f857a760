#include "cohesive/facet_strength.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/vec3.hpp"
#include "model/lookup.hpp"

namespace cdfp {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostFacets = 6;

/// Steele, Lea, Flood 2014 (splitmix64): each input bit turns about half of the output bits.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// In (0, 1).
double draw(std::int64_t seed, FacetUse lower) {
  const std::uint64_t facet =
      kMostFacets * static_cast<std::uint64_t>(lower.element) + static_cast<std::uint64_t>(lower.facet);
  return (static_cast<double>(mix(mix(static_cast<std::uint64_t>(seed)) ^ facet) >> 11) + 0.5) * 0x1p-53;
}

double area_of(const FacetNodes& facet, const std::vector<double>& coordinates) {
  const auto x = [&](int c) {
    return Vec3::load(&coordinates[3 * static_cast<std::size_t>(facet.nodes[c])]);
  };
  return 0.5 * norm(facet.count == 4 ? cross(x(2) - x(0), x(3) - x(1)) : cross(x(1) - x(0), x(2) - x(0)));
}

}  // namespace

FacetStrength::FacetStrength(const Model& model)
    : laws_(model.cohesive_laws), part_of_element_(model.mesh.parts), shares_(model.strength_shares) {
  law_of_part_.assign(model.mesh.part_names.size(), -1);
  for (const Part& part : model.parts) {
    if (part.cohesive_law.empty()) continue;
    const auto law = &cohesive_law(model, part.cohesive_law) - model.cohesive_laws.data();
    law_of_part_[part_number(model.mesh, part.name)] = static_cast<std::int32_t>(law);
  }
  find_least(model);
  if (model.stress_recovery == StressRecovery::nodal) spread_over_nodes(model);
}

double FacetStrength::scatter(const CohesiveLaw& law, FacetUse lower) const {
  const double size =
      law.weibull_area > 0 ? law.weibull_area / area_[kMostFacets * lower.element + lower.facet] : 1.0;
  return std::pow(-size * std::log1p(-draw(law.seed, lower)), 1 / law.weibull_modulus);
}

double FacetStrength::of(FacetUse lower, Index upper) const {
  const CohesiveLaw& law = *law_of(lower.element);
  double strength = law.strength;
  if (!shares_.empty()) strength *= 0.5 * (shares_[lower.element] + shares_[upper]);
  if (law.weibull_modulus > 0) strength *= scatter(law, lower);
  return strength;
}

void FacetStrength::find_least(const Model& model) {
  const auto count = part_of_element_.size();
  const bool varies = !shares_.empty() || std::any_of(laws_.begin(), laws_.end(), [](const CohesiveLaw& law) {
    return law.weibull_modulus > 0;
  });
  if (!varies) return;
  least_.assign(count, kInfinite);
  const Topology topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
  area_.assign(kMostFacets * count, 0.0);
  for (Index e = 0; e < static_cast<Index>(count); ++e) {
    if (!law_of(e)) continue;
    for (Index f = 0; f < topology.facet_count(e); ++f) {
      const Index mate = topology.mate({e, f}).element;
      if (mate < e || part_of_element_[mate] != part_of_element_[e]) continue;
      area_[kMostFacets * e + f] = area_of(topology.facet_nodes({e, f}), model.mesh.coordinates);
      const double strength = of({e, f}, mate);
      least_[e] = std::min(least_[e], strength);
      least_[mate] = std::min(least_[mate], strength);
    }
  }
}

/// A facet's traction is made from the stresses of all elements around its corners: each of them must know of
/// the facet.
void FacetStrength::spread_over_nodes(const Model& model) {
  std::vector<double> least(part_of_element_.size());
  for (std::size_t e = 0; e < least.size(); ++e) least[e] = least_of_element(static_cast<Index>(e));
  least_ = std::move(least);
  const std::vector<Index>& nodes = model.mesh.connectivity;
  std::vector<double> at_node(model.mesh.node_count(), kInfinite);
  const std::vector<Index> first = first_corners(model.mesh);
  const auto for_corners = [&](auto&& visit) {
    for (std::size_t e = 0; e < part_of_element_.size(); ++e) {
      for (Index i = first[e]; i < first[e + 1]; ++i) visit(e, nodes[i]);
    }
  };
  for_corners([&](std::size_t e, Index n) { at_node[n] = std::min(at_node[n], least_[e]); });
  for_corners([&](std::size_t e, Index n) {
    if (law_of(static_cast<Index>(e))) least_[e] = std::min(least_[e], at_node[n]);
  });
}

double FacetStrength::least_of_element(Index element) const {
  if (!least_.empty()) return least_[element];
  const CohesiveLaw* law = law_of(element);
  return law ? law->strength : kInfinite;
}

double FacetStrength::least_of_part(Index part) const {
  if (least_.empty()) {
    const std::int32_t law = law_of_part_[part];
    return law < 0 ? kInfinite : laws_[law].strength;
  }
  double least = kInfinite;
  for (std::size_t e = 0; e < least_.size(); ++e) {
    if (part_of_element_[e] == part) least = std::min(least, least_[e]);
  }
  return least;
}

}  // namespace cdfp
