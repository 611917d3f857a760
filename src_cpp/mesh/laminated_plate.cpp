#include "cdfp/laminated_plate.hpp"

#include <cmath>
#include <vector>

#include "cdfp/error.hpp"
#include "mesh/columns.hpp"
#include "mesh/impactor.hpp"
#include "mesh/quad_mesh.hpp"

namespace cdfp {

namespace {

enum PartNumber : Index { kLowerGlass, kPvb, kUpperGlass, kSupport, kImpactor };

void require(bool holds, const std::string& message) {
  if (!holds) throw Error(Status::bad_argument, "laminated plate: " + message);
}

void check(const LaminatedPlate& p) {
  const auto positive = [](double value, const char* name) {
    require(std::isfinite(value) && value > 0,
            std::string(name) + " is " + std::to_string(value) + "; it must be positive");
  };
  positive(p.half_width, "half_width");
  positive(p.lower_glass, "lower_glass");
  positive(p.pvb, "pvb");
  positive(p.upper_glass, "upper_glass");
  positive(p.support, "support");
  positive(p.impactor_radius, "impactor_radius");
  positive(p.impactor_shaft, "impactor_shaft");
  positive(p.impactor_refinement, "impactor_refinement");
  require(p.impactor_refinement <= 20,
          "impactor_refinement is above 20; 1 gives 2,198 elements, 20 16 million");
  require(std::isfinite(p.impactor_gap) && p.impactor_gap >= 0, "impactor_gap must not be negative");
  require(p.columns >= 2 && p.columns <= 2000, "columns must lie between 2 and 2000");
  for (const Index layers : {p.lower_layers, p.pvb_layers, p.upper_layers, p.support_layers}) {
    require(layers >= 1 && layers <= 1000, "each number of layers must lie between 1 and 1000");
  }
}

/// Heights of the layers of one sheet, appended to `levels`, which ends with the height of its bottom.
void add_sheet(double thickness, Index layers, Index part, std::vector<double>& levels,
               std::vector<Index>& parts) {
  const double bottom = levels.back();
  for (Index k = 1; k <= layers; ++k) {
    levels.push_back(bottom + thickness * k / layers);
    parts.push_back(part);
  }
}

/// Both faces and the outer rim of the layers [first_layer, first_layer + layers) of an extruded plane.
std::vector<FacetUse> sheet_facets(const QuadMesh& plane, double half_width, Index first_element,
                                   Index first_layer, Index layers) {
  const Index quads = static_cast<Index>(plane.quads.size());
  const auto element = [&](Index layer, Index q) {
    return first_element + (first_layer + layer) * quads + q;
  };
  std::vector<FacetUse> facets;
  facets.reserve(2 * plane.quads.size());
  for (Index q = 0; q < quads; ++q) facets.push_back({element(0, q), 0});
  for (Index q = 0; q < quads; ++q) facets.push_back({element(layers - 1, q), 1});
  for (Index q = 0; q < quads; ++q) {
    const auto& quad = plane.quads[static_cast<std::size_t>(q)];
    for (std::size_t side = 0; side < 4; ++side) {
      const auto& a = plane.points[static_cast<std::size_t>(quad[side])];
      const auto& b = plane.points[static_cast<std::size_t>(quad[(side + 1) % 4])];
      const bool on_rim =
          (a[0] == half_width && b[0] == half_width) || (a[1] == half_width && b[1] == half_width);
      if (!on_rim) continue;
      for (Index layer = 0; layer < layers; ++layer) {
        facets.push_back({element(layer, q), 2 + static_cast<Index>(side)});
      }
    }
  }
  facets.shrink_to_fit();
  return facets;
}

NodeSet nodes_on_plane(const Mesh& mesh, std::string name, std::size_t axis) {
  NodeSet set{std::move(name), {}};
  for (Index n = 0; n < mesh.node_count(); ++n) {
    if (mesh.coordinates[3 * static_cast<std::size_t>(n) + axis] == 0) set.nodes.push_back(n);
  }
  return set;
}

}  // namespace

Mesh laminated_plate_mesh(const LaminatedPlate& plate) {
  check(plate);
  QuadMesh plane = plate_columns(plate.layout, plate.columns);
  for (auto& p : plane.points) p = {plate.half_width * p[0], plate.half_width * p[1]};
  const Index quads = static_cast<Index>(plane.quads.size());

  Mesh mesh;
  mesh.part_names = {"lower_glass", "pvb", "upper_glass", "support", "impactor"};

  std::vector<double> levels{0};
  std::vector<Index> parts;
  add_sheet(plate.lower_glass, plate.lower_layers, kLowerGlass, levels, parts);
  add_sheet(plate.pvb, plate.pvb_layers, kPvb, levels, parts);
  add_sheet(plate.upper_glass, plate.upper_layers, kUpperGlass, levels, parts);
  const double top = levels.back();
  const Index glass = extrude(plane, levels, parts, mesh);
  const auto sheet = [&](Index first_layer, Index layers) {
    return sheet_facets(plane, plate.half_width, glass, first_layer, layers);
  };
  mesh.facet_sets.push_back({"lower_glass_faces", sheet(0, plate.lower_layers)});
  mesh.facet_sets.push_back(
      {"upper_glass_faces", sheet(plate.lower_layers + plate.pvb_layers, plate.upper_layers)});

  const Index support_bottom = mesh.node_count();
  levels.clear();
  parts.clear();
  for (Index k = plate.support_layers; k >= 0; --k) {
    levels.push_back(k == 0 ? 0.0 : -plate.support * k / plate.support_layers);
  }
  parts.assign(static_cast<std::size_t>(plate.support_layers), kSupport);
  const Index support = extrude(plane, levels, parts, mesh);
  FacetSet support_top{"support_top", {}};
  for (Index q = 0; q < quads; ++q) {
    support_top.facets.push_back({support + (plate.support_layers - 1) * quads + q, 1});
  }
  mesh.facet_sets.push_back(std::move(support_top));
  NodeSet bottom{"support_bottom", {}};
  for (std::size_t i = 0; i < plane.points.size(); ++i) {
    bottom.nodes.push_back(support_bottom + static_cast<Index>(i));
  }
  mesh.node_sets.push_back(std::move(bottom));

  const ImpactorShape shape{plate.impactor_radius, plate.impactor_shaft, top + plate.impactor_gap,
                            plate.impactor_refinement};
  mesh.facet_sets.push_back({"impactor_head", add_impactor(shape, kImpactor, mesh)});

  mesh.node_sets.push_back(nodes_on_plane(mesh, "symmetry_x", 0));
  mesh.node_sets.push_back(nodes_on_plane(mesh, "symmetry_y", 1));
  mesh.coordinates.shrink_to_fit();
  mesh.connectivity.shrink_to_fit();
  mesh.types.shrink_to_fit();
  mesh.parts.shrink_to_fit();
  mesh.layers.shrink_to_fit();
  return mesh;
}

}  // namespace cdfp
