/// What the elements of a part share, worked out from the model.
#pragma once

#include <memory>
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
  double hourglass = 1;         ///< share of the assumed-strain stiffness
  double hourglass_factor = 0;  ///< g_i^2 = hourglass_factor * H_ii
  double smoothing_time = 0;
  bool cracks = false;
  double shear_ratio = 1;                    ///< of the cohesive law, if it cracks
  std::shared_ptr<const UserMaterial> user;  ///< of a user's law
  std::string part, material;                ///< names
};

/// What the hourglass stiffness and its shares follow from.
void set_hourglass(PartPlan& plan, double youngs_modulus, double poissons_ratio);

/// The constants that the stable step of a user's law starts from.
void set_elasticity(PartPlan& plan, double youngs_modulus, double poissons_ratio);

/// Elements whose stress could reach `strength` (Pa) on some plane count as critical.
void set_least_strength(PartPlan& plan, double strength);

/// Nothing for a rigid part. Throws `Error(bad_argument)` for a name that the model does not define.
std::optional<PartPlan> plan_part(const Model& model, const Part& part);

}  // namespace cdfp
