/// Which facets a bond holds.
#pragma once

#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"

namespace cdfp {

/// Uses by the elements with the smaller numbers, ascending, each once. Throws `Error(bad_argument)` if there
/// is none or a facet of the set does not lie between two elements.
std::vector<FacetUse> bonded_facets(const Model& model, const Bond& bond, const Topology& topology);

}  // namespace cdfp
