/// summary.json: what never came about is null.
#pragma once

#include <string>

#include "cdfp/results.hpp"

namespace cdfp {

std::string summary_json(const Summary& summary);

}  // namespace cdfp
