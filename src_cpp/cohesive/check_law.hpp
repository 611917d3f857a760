#pragma once

#include "cdfp/model.hpp"

namespace cdfp {

/// Throws `Error(bad_argument)` naming the law and the entry that is wrong.
void check_law(const CohesiveLaw& law);

}  // namespace cdfp
