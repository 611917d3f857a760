/// A square plate cut out of a mesh that lies turned against it.
#pragma once

#include "cdfp/model.hpp"

namespace bench {

enum class Cells { bricks, wedges, tetrahedra };

/// One element through the thickness, in the square |x|, |y| < side / 2. Elements whose middle lies outside
/// are left out, so that the edges are as jagged as the mesh makes them.
struct TurnedPlate {
  Cells cells = Cells::bricks;
  bool irregular = false;  ///< triangles between points thrown at random instead of those of a square grid
  double h = 1, side = 1, angle = 0;
  double shift = 0;  ///< of nodes, at random, up to this share of `h` along each axis
  unsigned seed = 1;
};

/// Node sets "all" and "rim", in that order; rim: all nodes within `h` of an edge.
cdfp::Mesh mesh_of(const TurnedPlate& p);

}  // namespace bench
