/// A model checked as a whole.
#pragma once

#include <string>
#include <vector>

#include "cdfp/model.hpp"

namespace cdfp {

/// Throws `Error` naming the first entry that is wrong and the cure. Returns warnings.
std::vector<std::string> check_model(const Model& model);

}  // namespace cdfp
