/// Walks on the stored adjacency: turning about an edge, and flooding the elements at a node.
#pragma once

#include <vector>

#include "topology/store.hpp"
#include "topology/visited.hpp"

namespace cdfp {

/// Appends the uses of a node that are connected with `use` through uncut facets at it; `visited` holds the
/// elements of `star` before and after.
inline void flood_part(const TopologyStore& store, Packed use, std::vector<VertexUse>& star,
                       Visited& visited) {
  std::size_t next = star.size();
  star.push_back({element_of(use), local_of(use)});
  visited.insert(element_of(use));
  for (; next < star.size(); ++next) {
    const Index corner = star[next].corner;
    const ElementView element = store.view(star[next].element);
    const Index node = element.nodes[corner];
    for (Index i = 0; i < element.shape->corner_degree[corner]; ++i) {
      const Index f = element.shape->corner_facets[corner][i];
      const Packed mate = element.mates[f];
      if (mate == kNone || store.is_cohesive(element_of(mate)) || !visited.insert(element_of(mate))) continue;
      star.push_back({element_of(mate), store.view(element_of(mate)).corner(local_of(mate), node)});
    }
  }
}

/// A use of an edge by an element, and the direction in which a walk turns about it.
struct EdgeWalk {
  Index element;
  Index edge;
  bool along = true;  ///< the walk's axis has the template's direction

  bool turn(const TopologyStore& store, bool right_handed, bool through_cohesive);
};

/// The edge of a cohesive element's other face.
inline Index partner_edge(const ElementTemplate& shape, Index edge) {
  const Index half = shape.edge_count / 2;
  return edge < half ? edge + half : edge - half;
}

/// Goes to the next element around the edge; at a boundary facet (or before a cohesive element, unless
/// `through_cohesive`) returns false and stays.
inline bool EdgeWalk::turn(const TopologyStore& store, bool right_handed, bool through_cohesive) {
  const ElementView here = store.view(element);
  const ElementTemplate& shape = *here.shape;
  const Index out = shape.edge_facets[edge][along == right_handed ? 0 : 1];
  const Packed mate = here.mates[out];
  if (mate == kNone || (!through_cohesive && store.is_cohesive(element_of(mate)))) return false;

  Index leaving = edge;
  if (shape.cohesive && (edge < shape.edge_count / 2) != (out == 0)) leaving = partner_edge(shape, edge);
  const auto& ends = shape.edges[leaving];
  // The facet's outward order holds the edge from one end to the other, its mate's the other way round.
  const bool forward = shape.edge_facets[leaving][0] == out;
  const Index first_on_mate = here.nodes[forward ? ends[1] : ends[0]];

  const ElementView there = store.view(element_of(mate));
  const Index in = local_of(mate);
  std::size_t side = 0;
  while (there.nodes[there.shape->facets[in][side]] != first_on_mate) ++side;
  element = element_of(mate);
  edge = there.shape->facet_edges[in][side];
  along = there.shape->edge_facets[edge][right_handed ? 1 : 0] == local_of(mate);
  return true;
}

}  // namespace cdfp
