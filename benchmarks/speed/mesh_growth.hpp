/// Time and memory an element as the mesh grows.
#pragma once

#include "speed/results.hpp"

namespace speed {

/// To be called before any thread is started, which no child would have.
void measure_growth(bool large, Results& results);

}  // namespace speed
