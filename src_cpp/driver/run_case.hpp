/// The command `cdfp run`.
#pragma once

#include <string>

#include "cdfp/model.hpp"

namespace cdfp {

/// Steps through the model and leaves all output in `folder`. False if it was interrupted. Whatever stops
/// it, the output so far is complete and readable. `restart`: a file that an earlier run of the model has
/// saved and from where it goes on, together with what that run has left in the folder; or empty.
bool run_case(Model model, const std::string& folder, const std::string& restart);

}  // namespace cdfp
