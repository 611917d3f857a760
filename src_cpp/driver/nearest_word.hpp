/// The word that was probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cdfp {

/// The nearest of `words`, empty if none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

}  // namespace cdfp
