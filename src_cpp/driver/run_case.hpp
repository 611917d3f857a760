/// The command `cdfp run`.
#pragma once

#include <string>

#include "cdfp/model.hpp"

namespace cdfp {

/// Steps through the model and leaves all output in `folder`. False if it was interrupted. Whatever stops
/// it, the output so far is complete and readable.
bool run_case(Model model, const std::string& folder);

}  // namespace cdfp
