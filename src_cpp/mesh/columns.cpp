#include "mesh/columns.hpp"

#include <cmath>

#include "cdfp/error.hpp"
#include "mesh/irregular_columns.hpp"
#include "mesh/o_grid_columns.hpp"

namespace cdfp {

namespace {

QuadMesh square_grid(Index columns) {
  QuadMesh grid = quad_grid(columns, columns);
  for (auto& p : grid.points) p = {p[0] / columns, p[1] / columns};
  return grid;
}

/// Widths in geometric progression; the one at the rim is twice that at the impact point.
QuadMesh graded_grid(Index columns) {
  const double ratio = std::pow(2.0, 1.0 / (columns - 1));
  std::vector<double> place(static_cast<std::size_t>(columns) + 1, 0);
  double width = 1;
  for (std::size_t i = 1; i < place.size(); ++i, width *= ratio) place[i] = place[i - 1] + width;
  for (std::size_t i = 1; i < place.size(); ++i) place[i] /= place.back();
  QuadMesh grid = quad_grid(columns, columns);
  for (auto& p : grid.points) {
    p = {place[static_cast<std::size_t>(p[0])], place[static_cast<std::size_t>(p[1])]};
  }
  return grid;
}

}  // namespace

QuadMesh plate_columns(PlateColumns layout, Index columns) {
  switch (layout) {
    case PlateColumns::regular:
      return square_grid(columns);
    case PlateColumns::graded:
      return graded_grid(columns);
    case PlateColumns::o_grid:
      return o_grid_columns(columns * columns);
    case PlateColumns::irregular:
      return irregular_columns(columns * columns);
  }
  throw Error(Status::bad_argument, "unknown layout of columns");
}

}  // namespace cdfp
