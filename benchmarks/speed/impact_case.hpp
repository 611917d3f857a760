/// The case of examples/laminated_glass.
#pragma once

#include "cdfp/model.hpp"

namespace speed {

/// 67 columns: as it is; other numbers: in regular columns, at the automatic step.
cdfp::Model impact_case(cdfp::Index columns);

}  // namespace speed
