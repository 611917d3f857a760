/// Charts of benchmarks as files.
#pragma once

#include <filesystem>

#include "output/chart.hpp"

namespace bench {

/// A PNG; makes its folder.
void save_chart(const std::filesystem::path& file, const cdfp::Chart& chart);

}  // namespace bench
