/// A finite-element mesh as it enters cdfp: plain arrays, checked once by `check_mesh`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

/// Shapes of elements. Corner order follows the VTK linear cells (hexahedron 0-1-2-3 bottom, 4-5-6-7 top).
enum class ElementType : std::int8_t {
  hexahedron,
  tetrahedron,
  wedge,
  pyramid,
  cohesive_quadrilateral,  ///< 8 nodes: upper face 0-1-2-3, lower face 4-5-6-7, node i above node i + 4
  cohesive_triangle        ///< 6 nodes: upper face 0-1-2, lower face 3-4-5
};

struct NodeSet {
  std::string name;
  std::vector<Index> nodes;
};

struct FacetSet {
  std::string name;
  std::vector<FacetUse> facets;  ///< bulk element and its local facet (numbered as in `cdfp/topology.hpp`)
};

struct Mesh {
  std::vector<double> coordinates;  ///< (n, 3), m
  std::vector<ElementType> types;   ///< one an element, bulk types only
  std::vector<Index> connectivity;  ///< the corners of all elements, one after the other
  std::vector<Index> parts;         ///< part of each element, an index into `part_names`
  std::vector<Index> layers;        ///< layer through the thickness from the bottom of its part; may be empty
  std::vector<std::string> part_names;
  std::vector<NodeSet> node_sets;
  std::vector<FacetSet> facet_sets;

  Index node_count() const { return static_cast<Index>(coordinates.size() / 3); }
  Index element_count() const { return static_cast<Index>(types.size()); }
};

/// Throws `Error(bad_mesh)` naming element and node for sizes that disagree, node numbers out of range,
/// repeated corners, inverted or degenerate elements, facets shared by more than two elements, coordinates
/// that are not finite, and sets that name what does not exist. Returns warnings (unused nodes, coincident
/// nodes).
std::vector<std::string> check_mesh(const Mesh& mesh);

}  // namespace cdfp
