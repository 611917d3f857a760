#include "cohesive/check_law.hpp"

#include <string>

#include "core/require.hpp"

namespace cdfp {

void check_law(const CohesiveLaw& law) {
  const std::string where = "cohesive law '" + law.name + "'";
  require_positive(law.strength, where + ": strength");
  require_positive(law.fracture_energy, where + ": fracture_energy");
  require_positive(law.mode_ratio, where + ": mode_ratio");
  require_positive(law.shear_ratio, where + ": shear_ratio");
  require_not_negative(law.friction, where + ": friction");
  require_positive(law.friction_exponent, where + ": friction_exponent");
  require_not_negative(law.internal_friction, where + ": internal_friction");
  require_not_negative(law.weibull_modulus, where + ": weibull_modulus");
  require_not_negative(law.weibull_area, where + ": weibull_area");
  require(law.weibull_area == 0 || law.weibull_modulus > 0,
          where + ": weibull_area means nothing without scatter; give weibull_modulus or leave it out");
  require_not_negative(law.rate_sensitivity, where + ": rate_sensitivity");
  require_not_negative(law.reference_rate, where + ": reference_rate");
  require(
      (law.rate_sensitivity > 0) == (law.reference_rate > 0),
      where + ": rate_sensitivity and reference_rate mean nothing without one another; give both or none");
  const bool user = law.kind == CohesiveKind::user;
  require(
      !user || law.rate_sensitivity == 0,
      where + ": rate_sensitivity is not of user laws; they are told the step and may keep the last opening");
  const bool bilinear = law.kind == CohesiveKind::bilinear;
  require(
      law.kind != CohesiveKind::camacho_ortiz || law.mode_ratio == 1,
      where + ": camacho_ortiz has a potential for mode_ratio 1 only; leave mode_ratio out or take linear");
  if (user) require(law.callback != nullptr, where + ": a user law needs a callback");
  require(user || (!law.callback && law.states == 0),
          where + ": callback and states are of user laws only; set its kind to user");
  require(law.states >= 0, where + ": states must not be negative");
  if (bilinear) {
    require_positive(law.stiffness, where + ": stiffness");
    const double least = law.strength * law.strength / (2 * law.fracture_energy);
    require(law.stiffness > least,
            where + ": stiffness is " + std::to_string(law.stiffness) + " Pa/m; above " +
                std::to_string(least) +
                " (strength^2 / 2 fracture_energy) the bond softens after its strength");
  } else {
    require_not_negative(law.stiffness, where + ": stiffness");
    require(
        user || law.stiffness == 0,
        where + ": stiffness is of bilinear and user laws only; an extrinsic law is rigid until it opens");
  }
}

}  // namespace cdfp
