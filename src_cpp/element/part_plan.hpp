/// What the elements of a part share, worked out from the model.
#pragma once

#include <optional>
#include <string>

#include "cdfp/model.hpp"
#include "element/block.hpp"

namespace cdfp {

/// Of a deformable part.
struct PartPlan {
  PartConstants constants;
  bool full = false;
  bool rate_dependent = false;
  double hourglass_factor = 0;  ///< g_i^2 = hourglass_factor * H_ii
  double smoothing_time = 0;
  bool cracks = false;
};

/// Nothing for a rigid part. Throws `Error(bad_argument)` for a name that the model does not define.
std::optional<PartPlan> plan_part(const Model& model, const std::string& name);

}  // namespace cdfp
