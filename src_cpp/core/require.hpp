/// Refusals of a caller's values, by the name of the entry.
#pragma once

#include <cmath>
#include <string>

#include "cdfp/error.hpp"

namespace cdfp {

[[noreturn]] inline void refuse(const std::string& message) {
  throw Error(Status::bad_argument, message);
}

inline void require(bool holds, const std::string& message) {
  if (!holds) refuse(message);
}

inline void require_positive(double value, const std::string& what) {
  require(std::isfinite(value) && value > 0, what + " is " + std::to_string(value) + "; it must be positive");
}

inline void require_not_negative(double value, const std::string& what) {
  require(std::isfinite(value) && value >= 0,
          what + " is " + std::to_string(value) + "; it must not be negative");
}

}  // namespace cdfp
