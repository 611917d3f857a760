/// Columns of a history by name.
#pragma once

#include <string>
#include <vector>

#include "cdfp/results.hpp"

namespace cdfp {

/// Empty if the history has no such column.
std::vector<double> column(const History& history, const std::string& name);

/// From the end of a column's name: "force_n" is in N. "1" for pure numbers.
const char* column_units(const std::string& name);

}  // namespace cdfp
