/// Corners and facets of the bulk element shapes, as far as checking and generating a mesh needs them.
#pragma once

#include <array>
#include <span>

#include "cdfp/mesh.hpp"

namespace cdfp {

/// Corner numbers of a facet, outward; `corners[3]` is kNone for a triangle.
using FacetCorners = std::array<Index, 4>;
/// A corner and three neighbours (a tetrahedron shares a corner of a pyramid's apex): the Jacobian there is
/// positive if (b - a) x (c - a) . (d - a) is.
using CornerFrame = std::array<Index, 4>;

struct ElementShape {
  const char* name;
  Index corners;
  std::span<const FacetCorners> facets;
  std::span<const CornerFrame> frames;
};

/// Null for a type that is no bulk type.
const ElementShape* bulk_shape(ElementType type);

}  // namespace cdfp
