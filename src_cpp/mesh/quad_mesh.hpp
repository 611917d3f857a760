/// Quadrilaterals in the plane and their extrusion into hexahedra.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cdfp/mesh.hpp"

namespace cdfp {

struct QuadMesh {
  std::vector<std::array<double, 2>> points;
  std::vector<std::array<Index, 4>> quads;  ///< counter-clockwise
};

/// `m` x `n` quads; point (i, j) is number i + (m + 1) j and is left at (i, j).
QuadMesh quad_grid(Index m, Index n);

/// Quarter of the unit disc: a core of m x n quads inside radius `core`, `rings` rings of m + n quads around.
QuadMesh quarter_disc(Index m, Index n, Index rings, double core);

/// Adds one layer of hexahedra between each two neighbours of the ascending `levels`, layer k in part
/// `parts[k]`, with nodes of its own, level by level. Returns the first element: quad q of layer k is that
/// + k * quads + q; its facet 0 is the bottom, 1 the top, 2 + s the side over the quad's edge from corner s.
Index extrude(const QuadMesh& plane, std::span<const double> levels, std::span<const Index> parts,
              Mesh& mesh);

}  // namespace cdfp
