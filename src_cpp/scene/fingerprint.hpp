/// What of a model a saved state fits to.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cdfp/model.hpp"

namespace cdfp {

/// Digests by the name of the section. Title, threads, time and output are left out: they may change when a
/// run goes on. So are callbacks, which cannot be told apart.
std::vector<std::pair<std::string, std::uint64_t>> fingerprint(const Model& model);

}  // namespace cdfp
