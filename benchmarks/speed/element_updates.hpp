/// Updates of elements a second, beside the limits of the machine.
#pragma once

#include <vector>

#include "speed/results.hpp"
#include "support/roofline.hpp"

namespace speed {

std::vector<bench::Roofline> measure_machine(Results& results);

/// Returns million updates a second of the first scene on 46,656 elements, by thread count.
std::vector<double> measure_elements(const std::vector<bench::Roofline>& machine, bool large,
                                     Results& results);

}  // namespace speed
