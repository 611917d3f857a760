/// The summary of a run as a table to read.
#pragma once

#include <string>

#include "cdfp/results.hpp"

namespace cdfp {

std::string summary_table(const Summary& summary);

}  // namespace cdfp
