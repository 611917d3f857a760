#include "scene/bonds.hpp"

#include <algorithm>
#include <string>

#include "cdfp/error.hpp"
#include "core/numbered.hpp"
#include "model/lookup.hpp"

namespace cdfp {

namespace {

std::vector<FacetUse> between_parts(const Model& model, const Bond& bond, const Topology& topology) {
  const Index first = part_number(model.mesh, bond.parts[0]);
  const Index second = part_number(model.mesh, bond.parts[1]);
  std::vector<FacetUse> found;
  for (Index e = 0; e < topology.bulk_count(); ++e) {
    const Index part = model.mesh.parts[e];
    if (part != first && part != second) continue;
    const Index other = part == first ? second : first;
    for (Index f = 0; f < topology.facet_count(e); ++f) {
      const Index mate = topology.mate({e, f}).element;
      if (mate > e && mate < topology.bulk_count() && model.mesh.parts[mate] == other)
        found.push_back({e, f});
    }
  }
  if (found.empty()) {
    throw Error(Status::bad_argument, "bond: parts '" + bond.parts[0] + "' and '" + bond.parts[1] +
                                          "' share no facet; let their meshes share nodes there");
  }
  return found;
}

}  // namespace

std::vector<FacetUse> bonded_facets(const Model& model, const Bond& bond, const Topology& topology) {
  if (bond.facet_set.empty()) return between_parts(model, bond, topology);
  std::vector<FacetUse> found;
  for (const FacetUse& use : facet_set(model.mesh, bond.facet_set).facets) {
    const FacetUse mate = topology.mate(use);
    if (mate.element == kNone || mate.element >= topology.bulk_count()) {
      throw Error(Status::bad_argument, "bond: facet " + numbered(use.facet) + " of element " +
                                            numbered(use.element) + " in facet set '" + bond.facet_set +
                                            "' has no element on its other side or is bonded already");
    }
    found.push_back(mate.element < use.element ? mate : use);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace cdfp
