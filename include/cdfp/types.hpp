/// Index and array conventions that every public header shares.
///
/// Indices are 0-based and 32 bits wide. Node arrays are `(n, 3)` row-major `double`, contiguous (a Fortran
/// caller's `real(c_double) :: x(3, n)`). Units are SI: m, kg, s, N, Pa, J.
#pragma once

#include <compare>
#include <cstdint>

namespace cdfp {

using Index = std::int32_t;

/// "No entity": the mate of a boundary facet, a node outside every rigid body.
inline constexpr Index kNone = -1;

/// One side of a facet: the oriented use that `element` makes of its local facet `facet`.
struct FacetUse {
  Index element = kNone;
  Index facet = kNone;
  friend bool operator==(const FacetUse&, const FacetUse&) = default;
  friend auto operator<=>(const FacetUse&, const FacetUse&) = default;
};

}  // namespace cdfp
