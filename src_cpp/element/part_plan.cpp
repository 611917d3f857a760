#include "element/part_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "model/lookup.hpp"

namespace cdfp {

namespace {

/// Modulus of rate-dependent parts in the hourglass stiffness: that at this rate, 1/s.
constexpr double kRateOfHourglass = 100;

double lambda_of(double modulus, double nu) {
  return modulus * nu / ((1 + nu) * (1 - 2 * nu));
}
double mu_of(double modulus, double nu) {
  return modulus / (2 * (1 + nu));
}

/// Norm of the second Piola-Kirchhoff stress below which the Cauchy stress stays under `stress`. Where S has
/// that norm, |E| <= |S| / (2 mu), and |sigma| <= (1 + 2|E|) / (1 - 2|E|)^1.5 |S|.
double critical_norm(double stress, double mu) {
  const double strain = stress / (2 * mu);
  if (strain >= 0.25) return 0;
  return 0.999 * stress * std::pow(1 - 2 * strain, 1.5) / (1 + 2 * strain);
}

}  // namespace

void set_least_strength(PartPlan& plan, double strength) {
  const double stress = strength * std::min(1.0, plan.shear_ratio);
  const double norm =
      plan.rate_dependent || plan.user ? 0 : critical_norm(stress, plan.constants.material.mu);
  plan.constants.critical_norm_squared = norm * norm;
}

void set_hourglass(PartPlan& plan, double youngs_modulus, double poissons_ratio) {
  const double nu = poissons_ratio;
  plan.hourglass_factor = plan.hourglass * 2 * mu_of(youngs_modulus, nu) / (1 - nu) / 64;
  plan.constants.bending_coupling = nu;
  plan.constants.shear_share = (1 - nu) / 2;
  plan.constants.warping_share = (1 - nu * nu) / 3;
}

void set_elasticity(PartPlan& plan, double youngs_modulus, double poissons_ratio) {
  plan.constants.material.lambda = lambda_of(youngs_modulus, poissons_ratio);
  plan.constants.material.mu = mu_of(youngs_modulus, poissons_ratio);
}

std::optional<PartPlan> plan_part(const Model& model, const Part& part) {
  const Material& material = cdfp::material(model, part.material);
  PartPlan plan;
  PartConstants& constants = plan.constants;
  double nu = 0, hourglass_modulus = 0;
  if (const auto* elastic = std::get_if<ElasticMaterial>(&material.law)) {
    nu = elastic->poissons_ratio;
    hourglass_modulus = elastic->youngs_modulus;
    constants.density = elastic->density;
    set_elasticity(plan, elastic->youngs_modulus, nu);
  } else if (const auto* rate = std::get_if<RateDependentMaterial>(&material.law)) {
    nu = rate->poissons_ratio;
    hourglass_modulus =
        rate->static_modulus + rate->rate_modulus * std::pow(kRateOfHourglass, rate->rate_exponent);
    constants.density = rate->density;
    constants.material = {lambda_of(rate->static_modulus, nu),
                          mu_of(rate->static_modulus, nu),
                          lambda_of(1, nu),
                          mu_of(1, nu),
                          rate->rate_modulus,
                          rate->rate_exponent};
    plan.smoothing_time = rate->smoothing_time;
    plan.rate_dependent = true;
  } else if (const auto* user = std::get_if<UserMaterial>(&material.law)) {
    nu = user->poissons_ratio;
    hourglass_modulus = user->youngs_modulus;
    constants.density = user->density;
    set_elasticity(plan, user->youngs_modulus, nu);
    plan.user = std::make_shared<UserMaterial>(*user);
  } else {
    return std::nullopt;
  }
  plan.part = part.name;
  plan.material = material.name;
  plan.full = part.formulation == Formulation::full;
  plan.hourglass = part.hourglass;
  set_hourglass(plan, hourglass_modulus, nu);
  plan.cracks = !part.cohesive_law.empty();
  constants.critical_norm_squared = std::numeric_limits<double>::infinity();
  if (plan.cracks) {
    const CohesiveLaw& law = cohesive_law(model, part.cohesive_law);
    plan.shear_ratio = law.shear_ratio;
    set_least_strength(plan, law.strength);
  }
  return plan;
}

}  // namespace cdfp
