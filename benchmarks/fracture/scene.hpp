/// Plates that crack, and the parts of models that the fracture benchmarks share.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "cdfp/model.hpp"
#include "mesh/triangulation.hpp"

namespace bench {

/// A plate of nx x ny x 1 bricks in the x-y plane.
struct Plate {
  cdfp::Index nx = 1, ny = 1;
  double width = 1, height = 1, thickness = 1;
  double y0 = 0;  ///< of the lower edge
  /// Nodes at y = 0 with x below this are doubled: a notch.
  double notch = -1;
  /// Places of nodes, for meshes that are no grid.
  std::function<std::array<double, 2>(double, double)> place = [](double x, double y) {
    return std::array<double, 2>{x, y};
  };
  std::function<cdfp::Index(double, double)> part = [](double, double) {
    return 0;
  };  ///< by the element's middle
};

/// Node sets "all", "left", "right", "bottom", "top", in that order.
cdfp::Mesh mesh_of(const Plate& p, const std::vector<std::string>& parts);

/// Triangles between points that lie no regular way, about `h` apart, each a wedge or three tetrahedra.
struct IrregularPlate {
  double h = 1, width = 1, height = 1, thickness = 1;
  double y0 = 0;
  double notch = -1;  ///< nodes at y = 0 with x below this are doubled
  unsigned seed = 1;
  bool wedges = false;
};
cdfp::Mesh mesh_of(const IrregularPlate& p, const std::vector<std::string>& parts);
/// Its points, the four corners first.
std::vector<cdfp::PlanePoint> points_of(const IrregularPlate& p);

/// Adds the prism over a triangle: a wedge, or three tetrahedra whose sides match those of the neighbours.
/// Nodes: three below, by ascending number of their points, then the three over them.
void add_prism(cdfp::Mesh& mesh, const std::array<cdfp::Index, 6>& nodes, bool clockwise, bool wedge);

/// Parts of a plate that cracks along y = 0 only: a row of bricks on either side, its columns by turns of two
/// parts, between which no facet opens.
extern const std::vector<std::string> kPath;
std::function<cdfp::Index(double, double)> path_of(double h);

cdfp::PrescribedVelocity hold(const std::string& set, std::array<bool, 3> directions);
cdfp::CohesiveLaw law_of(double strength, double energy, double kappa = 1, double eta = 1);
/// All parts are of the material; those whose names start with `cracking` crack by the law.
cdfp::Model model_of(cdfp::Mesh mesh, const cdfp::ElasticMaterial& material, const cdfp::CohesiveLaw& law,
                     const std::string& cracking);

}  // namespace bench
