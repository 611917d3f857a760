/// What each stage of the step takes in the impact, and what a second thread is worth.
#pragma once

#include "speed/results.hpp"

namespace speed {

void measure_stages(Results& results);

}  // namespace speed
