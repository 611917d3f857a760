/// Which elements stand together in a block, and which blocks may run at the same time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

struct Centroid {
  std::array<double, 3> x;
  Index element;
};

/// Reorders by recursive bisection of the longest side so that each run of `size` elements is compact; all
/// runs but the last are full. Within a run elements ascend.
void order_in_runs(std::span<Centroid> elements, std::size_t size);

/// `nodes[first[i] .. first[i + 1])` are the nodes of item i (repeats are fine). Returns the items of each
/// colour in ascending order: items of one colour share no node, and colours are of about one size.
std::vector<std::vector<std::int32_t>> colour(std::span<const std::size_t> first,
                                              std::span<const Index> nodes, Index node_count);

}  // namespace cdfp
