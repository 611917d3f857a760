/// results.h5: the history and one state, in SI units.
///
///   /history/<column>        (rows)
///   /final                   attributes time_s, step
///     positions velocities   (nodes, 3)
///     connectivity           (corners of all elements)
///     first_corner parts     (elements + 1), (elements)
///     part_names             (parts)
///     von_mises max_principal (elements)
///     cracks/upper lower     (facets, 4) nodes of the two faces, -1 where a triangle has no corner
///     cracks/part layer damage insertion_time broken_time   (facets); broken_time is inf while unbroken
/// Every dataset has the attributes `units` and `description`.
#pragma once

#include <filesystem>

#include "cdfp/results.hpp"

namespace cdfp {

void write_results_h5(const std::filesystem::path& path, const Frame& frame, const History& history);

}  // namespace cdfp
