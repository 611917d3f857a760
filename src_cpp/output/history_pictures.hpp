/// force.png and energy.png, each with an SVG beside it.
#pragma once

#include <filesystem>

#include "cdfp/results.hpp"

namespace cdfp {

/// Draws what the history's columns allow.
void draw_history(const std::filesystem::path& folder, const History& history, const Summary& summary);

}  // namespace cdfp
