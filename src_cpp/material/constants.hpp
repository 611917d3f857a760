/// What the laws of a part share, and how their points lie side by side.
#pragma once

namespace cdfp {

/// Points side by side in memory: component after component of eight points, then the next eight, so that a
/// loop over points reads memory in its order.
inline constexpr int kLanes = 8;

/// One component of eight points.
struct alignas(64) Lanes {
  double value[kLanes];
};

/// The same, rounded to single precision.
struct alignas(32) SingleLanes {
  float value[kLanes];
};

struct MaterialConstants {
  double lambda = 0, mu = 0;  ///< Pa, Lame constants (of the static branch if rate dependent)

  // Rate-dependent branch: a tensor of unit modulus times rate_modulus * rate^rate_exponent.
  double unit_lambda = 0, unit_mu = 0;
  double rate_modulus = 0, rate_exponent = 0;
};

/// What a step changes for all elements of a part.
struct StepConstants {
  double per_step = 0;    ///< 1/s; 0: no time passes
  double rate_blend = 0;  ///< share of the present rate in the smoothed one
};

}  // namespace cdfp
