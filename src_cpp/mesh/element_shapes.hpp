/// What checking a mesh knows of the bulk element shapes besides their templates (topology/templates.hpp).
#pragma once

#include <array>
#include <span>

#include "cdfp/mesh.hpp"

namespace cdfp {

/// A corner and three neighbours (a tetrahedron shares a corner of a pyramid's apex): the Jacobian there is
/// positive if (b - a) x (c - a) . (d - a) is.
using CornerFrame = std::array<Index, 4>;

struct ElementShape {
  const char* name;
  std::span<const CornerFrame> frames;
};

/// Null for a type that is no bulk type.
const ElementShape* bulk_shape(ElementType type);

}  // namespace cdfp
