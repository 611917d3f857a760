/// Boxes of segments and edges, exact and in single precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "cdfp/contact.hpp"
#include "contact/cell_layout.hpp"
#include "core/lanes.hpp"

namespace cdfp {

using Corner = std::array<double, 3>;

inline Corner place(const SurfaceView& surface, Index node) {
  const double* x = &surface.position[3 * static_cast<std::size_t>(node)];
  return {x[0], x[1], x[2]};
}

struct Box {
  Corner low, high;
  void include(const Corner& x) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  }
  void grow(double by) {
    for (int d = 0; d < 3; ++d) low[d] -= by, high[d] += by;
  }
  /// Without branches: which side fails is as good as random.
  bool holds(const Corner& x) const {
    int inside = 1;
    for (int d = 0; d < 3; ++d)
      inside &= static_cast<int>(x[d] >= low[d]) & static_cast<int>(x[d] <= high[d]);
    return inside != 0;
  }
  bool overlaps(const Box& other) const {
    int apart = 0;
    for (int d = 0; d < 3; ++d) {
      apart |= static_cast<int>(low[d] > other.high[d]) | static_cast<int>(other.low[d] > high[d]);
    }
    return apart == 0;
  }
};

inline const Index* corners_of(const SurfaceView& surface, Index segment) {
  return &surface.segments[4 * static_cast<std::size_t>(segment)];
}
inline const Index* ends_of(const SurfaceView& surface, Index edge) {
  return &surface.edges[2 * static_cast<std::size_t>(edge)];
}

inline Box box_of(const SurfaceView& surface, const Index* nodes, int count) {
  const Corner x = place(surface, nodes[0]);
  Box box{x, x};
  for (int i = 1; i < count && nodes[i] != kNone; ++i) box.include(place(surface, nodes[i]));
  return box;
}

/// Places in single precision, taken from a point that most of them lie near.
struct Rough {
  Double2 origin_xy{}, origin_z{};
  Float4 operator()(Double2 xy, Double2 z) const {
    typedef float Float2 __attribute__((vector_size(8)));
    const auto flat = __builtin_convertvector(xy - origin_xy, Float2);
    const auto high = __builtin_convertvector(z - origin_z, Float2);
    return __builtin_shufflevector(flat, high, 0, 1, 2, 3);
  }
  Float4 operator()(const Corner& x) const { return (*this)(Double2{x[0], x[1]}, Double2{x[2], 0}); }
  RoughBox operator()(const Box& box) const { return {(*this)(box.low), (*this)(box.high)}; }
};

/// The middle of a few nodes: far outliers do not move it.
inline Corner middle(const SurfaceView& surface) {
  constexpr std::size_t kSamples = 63;
  const std::size_t count = std::min(surface.nodes.size(), kSamples);
  Corner center{};
  if (count == 0) return center;
  std::array<double, kSamples> sample{};
  for (int d = 0; d < 3; ++d) {
    for (std::size_t i = 0; i < count; ++i) {
      sample[i] = place(surface, surface.nodes[i * surface.nodes.size() / count])[d];
    }
    std::nth_element(sample.begin(), sample.begin() + count / 2, sample.begin() + count);
    center[d] = sample[count / 2];
  }
  return center;
}

}  // namespace cdfp
