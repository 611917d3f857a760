#include <algorithm>
#include <array>
#include <vector>

#include "c_gate.hpp"
#include "core/numbered.hpp"
#include "topology/templates.hpp"

using namespace cdfp;
using namespace cdfp::gate;

static_assert(int32_t(ElementType::hexahedron) == CDFP_HEXAHEDRON &&
              int32_t(ElementType::tetrahedron) == CDFP_TETRAHEDRON &&
              int32_t(ElementType::wedge) == CDFP_WEDGE && int32_t(ElementType::pyramid) == CDFP_PYRAMID &&
              int32_t(ElementType::cohesive_quadrilateral) == CDFP_COHESIVE_QUADRILATERAL &&
              int32_t(ElementType::cohesive_triangle) == CDFP_COHESIVE_TRIANGLE);
static_assert(sizeof(Insertion::NewNode) == 2 * sizeof(int32_t) &&
                  sizeof(Insertion::Renumbered) == 4 * sizeof(int32_t),
              "what an insertion changed crosses the door as rows of numbers");

namespace {

void need_element(const Topology& topology, int32_t element) {
  need_number(element, topology.element_count(), "element");
}

void need_facet(const Topology& topology, int32_t element, int32_t facet) {
  need_element(topology, element);
  need_number(facet, topology.facet_count(element), "facet");
}

void need_edge(const Topology& topology, int32_t element, int32_t edge) {
  need_element(topology, element);
  need_number(edge, topology.edge_count(element), "edge");
}

/// As many pairs as there is room for; `count` is that of all.
template <class Use>
void put_pairs(const std::vector<Use>& found, Index Use::*part, int64_t capacity, int32_t* uses,
               int64_t* count) {
  *count = static_cast<int64_t>(found.size());
  const std::size_t kept = std::min(found.size(), static_cast<std::size_t>(std::max<int64_t>(capacity, 0)));
  for (std::size_t i = 0; i < kept; ++i) {
    uses[2 * i] = found[i].element;
    uses[2 * i + 1] = found[i].*part;
  }
}

}  // namespace

cdfp::gate::Changes::Changes(std::int64_t new_node_count, const std::int32_t* new_node_rows,
                             std::int64_t renumbered_count, const std::int32_t* renumbered_rows)
    : new_nodes(size_of(new_node_count, "new_node_count")),
      renumbered(size_of(renumbered_count, "renumbered_count")) {
  need_array(new_node_rows, new_node_count, "new_nodes");
  need_array(renumbered_rows, renumbered_count, "renumbered");
  for (std::size_t i = 0; i < new_nodes.size(); ++i) {
    const std::int32_t* row = new_node_rows + 2 * i;
    new_nodes[i] = {row[0], row[1]};
  }
  for (std::size_t i = 0; i < renumbered.size(); ++i) {
    const std::int32_t* row = renumbered_rows + 4 * i;
    renumbered[i] = {row[0], row[1], row[2], row[3]};
  }
}

std::vector<cdfp::ElementType> cdfp::gate::element_types_of(std::size_t elements, const std::int32_t* types,
                                                            std::size_t corners) {
  std::vector<ElementType> found(elements, ElementType::hexahedron);
  std::size_t wanted = 8 * elements;
  if (types) {
    wanted = 0;
    for (std::size_t i = 0; i < elements; ++i) {
      if (types[i] < CDFP_HEXAHEDRON || types[i] > CDFP_PYRAMID) {
        refuse("element " + numbered(i) + " has type " + std::to_string(types[i]) +
               "; take CDFP_HEXAHEDRON, CDFP_TETRAHEDRON, CDFP_WEDGE or CDFP_PYRAMID");
      }
      found[i] = static_cast<ElementType>(types[i]);
      wanted += element_template(found[i]).corner_count;
    }
  }
  if (corners != wanted) {
    refuse("'connectivity' holds " + std::to_string(corners) + " corners, but the " +
           std::to_string(elements) + " elements have " + std::to_string(wanted));
  }
  return found;
}

int32_t cdfp_topology_create(int64_t nodes, int64_t elements, const int32_t* types, int64_t corners,
                             const int32_t* connectivity, cdfp_topology** topology) {
  return guarded(__func__, [&] {
    need(topology, "topology");
    const std::size_t n = size_of(nodes, "nodes");
    const std::size_t e = size_of(elements, "elements");
    const std::size_t c = size_of(corners, "corners");
    need_array(connectivity, corners, "connectivity");
    const std::vector<ElementType> element_types = element_types_of(e, types, c);
    give(std::make_shared<Held<cdfp_topology>::Object>(Held<cdfp_topology>::Object{
             Topology(static_cast<Index>(n), element_types, {connectivity, c}), {}}),
         topology);
  });
}

int32_t cdfp_topology_free(cdfp_topology** topology) {
  return free_handle(__func__, topology);
}

int32_t cdfp_topology_node_count(const cdfp_topology* topology, int64_t* nodes) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(nodes, "nodes");
    *nodes = t->topology.node_count();
  });
}

int32_t cdfp_topology_element_count(const cdfp_topology* topology, int64_t* elements, int64_t* bulk) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(elements, "elements");
    need(bulk, "bulk");
    *elements = t->topology.element_count();
    *bulk = t->topology.bulk_count();
  });
}

int32_t cdfp_topology_element_type(const cdfp_topology* topology, int32_t element, int32_t* type) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(type, "type");
    need_element(t->topology, element);
    *type = static_cast<int32_t>(t->topology.type(element));
  });
}

int32_t cdfp_topology_element_nodes(const cdfp_topology* topology, int32_t element, const int32_t** nodes,
                                    int64_t* count) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(nodes, "nodes");
    need(count, "count");
    need_element(t->topology, element);
    const std::span<const Index> corners = t->topology.nodes(element);
    *nodes = corners.data();
    *count = static_cast<int64_t>(corners.size());
  });
}

int32_t cdfp_topology_facet_count(const cdfp_topology* topology, int32_t element, int64_t* facets) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(facets, "facets");
    need_element(t->topology, element);
    *facets = t->topology.facet_count(element);
  });
}

int32_t cdfp_topology_edge_count(const cdfp_topology* topology, int32_t element, int64_t* edges) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(edges, "edges");
    need_element(t->topology, element);
    *edges = t->topology.edge_count(element);
  });
}

int32_t cdfp_topology_mate(const cdfp_topology* topology, int32_t element, int32_t facet,
                           int32_t* mate_element, int32_t* mate_facet) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(mate_element, "mate_element");
    need(mate_facet, "mate_facet");
    need_facet(t->topology, element, facet);
    const FacetUse mate = t->topology.mate({element, facet});
    *mate_element = mate.element;
    *mate_facet = mate.facet;
  });
}

int32_t cdfp_topology_facet_nodes(const cdfp_topology* topology, int32_t element, int32_t facet,
                                  int32_t* nodes, int64_t* count) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(nodes, "nodes");
    need(count, "count");
    need_facet(t->topology, element, facet);
    const FacetNodes corners = t->topology.facet_nodes({element, facet});
    std::copy_n(corners.nodes.begin(), corners.count, nodes);
    *count = corners.count;
  });
}

int32_t cdfp_topology_edge_nodes(const cdfp_topology* topology, int32_t element, int32_t edge,
                                 int32_t* nodes) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(nodes, "nodes");
    need_edge(t->topology, element, edge);
    const std::array<Index, 2> ends = t->topology.edge_nodes({element, edge});
    std::copy_n(ends.begin(), 2, nodes);
  });
}

int32_t cdfp_topology_elements_around_edge(const cdfp_topology* topology, int32_t element, int32_t edge,
                                           int64_t capacity, int32_t* uses, int64_t* count) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(count, "count");
    need_array(uses, capacity, "uses");
    need_edge(t->topology, element, edge);
    std::vector<EdgeUse> found;
    t->topology.elements_around({element, edge}, found);
    put_pairs(found, &EdgeUse::edge, capacity, uses, count);
  });
}

int32_t cdfp_topology_elements_around_node(const cdfp_topology* topology, int32_t node, int64_t capacity,
                                           int32_t* uses, int64_t* count) {
  return guarded(__func__, [&] {
    const Look t(topology);
    need(count, "count");
    need_array(uses, capacity, "uses");
    need_number(node, t->topology.node_count(), "node");
    std::vector<VertexUse> found;
    t->topology.elements_around_node(node, found);
    put_pairs(found, &VertexUse::corner, capacity, uses, count);
  });
}

int32_t cdfp_topology_insert_cohesive(cdfp_topology* topology, int32_t element, int32_t facet,
                                      int32_t* cohesive_element, const int32_t** new_nodes,
                                      int64_t* new_node_count, const int32_t** renumbered,
                                      int64_t* renumbered_count) {
  return guarded(__func__, [&] {
    const Change t(topology);
    need(cohesive_element, "cohesive_element");
    need(new_nodes, "new_nodes");
    need(new_node_count, "new_node_count");
    need(renumbered, "renumbered");
    need(renumbered_count, "renumbered_count");
    need_facet(t->topology, element, facet);
    t->topology.insert_cohesive({element, facet}, t->last);
    const Insertion& last = t->last;
    *cohesive_element = last.cohesive_element;
    *new_nodes = last.new_nodes.empty() ? nullptr : &last.new_nodes.front().node;
    *new_node_count = static_cast<int64_t>(last.new_nodes.size());
    *renumbered = last.renumbered.empty() ? nullptr : &last.renumbered.front().element;
    *renumbered_count = static_cast<int64_t>(last.renumbered.size());
  });
}

int32_t cdfp_topology_check(const cdfp_topology* topology, char* text, int64_t capacity, int64_t* length) {
  return guarded(__func__, [&] { copy_text(Look(topology)->topology.check(), text, capacity, length); });
}
