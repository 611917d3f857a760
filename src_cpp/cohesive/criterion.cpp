#include "cohesive/criterion.hpp"

#include <algorithm>
#include <string>

#include "cdfp/error.hpp"
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

}  // namespace

Criterion::Criterion(const Model& model) : part_of_element_(model.mesh.parts) {
  law_of_part_.resize(model.mesh.part_names.size());
  for (const Part& part : model.parts) {
    if (part.cohesive_law.empty()) continue;
    const auto name = std::find(model.mesh.part_names.begin(), model.mesh.part_names.end(), part.name);
    const auto law = std::find_if(model.cohesive_laws.begin(), model.cohesive_laws.end(),
                                  [&](const CohesiveLaw& l) { return l.name == part.cohesive_law; });
    if (name == model.mesh.part_names.end() || law == model.cohesive_laws.end()) {
      throw Error(Status::bad_argument, "part '" + part.name + "' or its cohesive law '" + part.cohesive_law +
                                            "' does not exist in the model");
    }
    law_of_part_[name - model.mesh.part_names.begin()] = *law;
  }
}

void Criterion::find(std::span<const Index> candidates, const Topology& topology,
                     std::span<const double> position, const std::function<Mat3(Index)>& stress,
                     std::vector<OpenFacet>& open) const {
  open.clear();
  struct Side {
    FacetUse lower;
    Index upper;
  };
  std::vector<Side> sides;
  std::vector<Index> elements;
  for (const Index e : candidates) {
    const Index part = part_of_element_[e];
    if (!(law_of_part_[part].strength > 0)) continue;
    for (Index f = 0; f < topology.facet_count(e); ++f) {
      const FacetUse mate = topology.mate({e, f});
      if (mate.element == kNone || mate.element >= topology.bulk_count()) continue;
      if (part_of_element_[mate.element] != part) continue;
      if (mate.element > e) {
        sides.push_back({{e, f}, mate.element});
      } else if (!std::binary_search(candidates.begin(), candidates.end(), mate.element)) {
        sides.push_back({mate, e});
      } else {
        continue;  // found from the other side
      }
      elements.push_back(e);
      elements.push_back(mate.element);
    }
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  std::vector<Mat3> stresses;
  stresses.reserve(elements.size());
  for (const Index e : elements) stresses.push_back(stress(e));
  const auto stress_of = [&](Index e) -> const Mat3& {
    return stresses[std::lower_bound(elements.begin(), elements.end(), e) - elements.begin()];
  };

  for (const Side& side : sides) {
    const CohesiveLaw& law = law_of_part_[part_of_element_[side.upper]];
    const Vec3 normal = normalized(doubled_area(topology.facet_nodes(side.lower), position));
    const Vec3 traction = 0.5 * (stress_of(side.lower.element) + stress_of(side.upper)) * normal;
    if (opening_traction(traction, normal, law) >= law.strength) {
      open.push_back({side.lower, traction});
    }
  }
  std::sort(open.begin(), open.end(),
            [](const OpenFacet& a, const OpenFacet& b) { return a.lower < b.lower; });
}

}  // namespace cdfp
