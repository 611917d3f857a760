/// LULESH 2.0 in the same run.
#pragma once

#include <vector>

#include "speed/results.hpp"

namespace speed {

/// `program`: a LULESH built elsewhere; `ours`: million updates a second by thread count.
void measure_beside_lulesh(const char* program, const std::vector<double>& ours, Results& results);

}  // namespace speed
