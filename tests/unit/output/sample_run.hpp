/// A made-up run (hexahedra, and one tetrahedron on the impactor): quarter of a laminated plate in rings and
/// rays around the impact point, with radial and circular cracks that grow.
#pragma once

#include <vector>

#include "cdfp/results.hpp"

namespace cdfp::sample {

struct Run {
  int rays = 12, rings = 10, layers = 2;  ///< layers of each pane
  double half_width = 75e-3;
  double layer_height = 1e-3;
};

/// Owns what a frame only views.
struct State {
  std::vector<double> reference, positions, velocities;
  std::vector<Index> connectivity, first_corner{0}, parts;
  Frame frame;
};

/// `time` from 0 to 600e-6 s; the same arguments give the same state.
State state(const Run& run, double time);

History history(int rows, double end_time);
Summary summary();

}  // namespace cdfp::sample
