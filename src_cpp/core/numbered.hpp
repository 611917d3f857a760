/// Numbers of elements, nodes, facets ... in the messages of errors.
#pragma once

#include <cstdint>
#include <string>

#include "cdfp/error.hpp"

namespace cdfp {

/// `Error` knows it again, for callers who count from 1.
inline std::string numbered(std::int64_t number) {
  return Error::kNumber + std::to_string(number);
}

}  // namespace cdfp
