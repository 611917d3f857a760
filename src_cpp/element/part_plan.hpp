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
  double shear_ratio = 1;  ///< of the cohesive law, if it cracks
};

/// Elements whose stress could reach `strength` (Pa) on some plane count as critical.
void set_least_strength(PartPlan& plan, double strength);

/// Nothing for a rigid part. Throws `Error(bad_argument)` for a name that the model does not define.
std::optional<PartPlan> plan_part(const Model& model, const std::string& name);

}  // namespace cdfp
