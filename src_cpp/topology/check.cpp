// The relations that hold between insertions, in the order in which later ones build on earlier ones.
#include <string>

#include "topology/facet_match.hpp"
#include "topology/star.hpp"
#include "topology/store.hpp"

namespace cdfp {
namespace {

std::string name(const char* kind, Index local, Index element) {
  return std::string(kind) + " " + std::to_string(local) + " of element " + std::to_string(element);
}

std::string check_corners(const TopologyStore& store) {
  const auto node_count = static_cast<Index>(store.anchors.size());
  for (Index e = 0; e < store.element_count(); ++e) {
    const ElementView element = store.view(e);
    for (Index c = 0; c < element.shape->corner_count; ++c) {
      if (element.nodes[c] < 0 || element.nodes[c] >= node_count) {
        return name("corner", c, e) + " names node " + std::to_string(element.nodes[c]) + ", there are " +
               std::to_string(node_count);
      }
      for (Index d = 0; d < c && !element.shape->cohesive; ++d) {
        if (element.nodes[d] == element.nodes[c]) {
          return "corners " + std::to_string(d) + " and " + std::to_string(c) + " of element " +
                 std::to_string(e) + " name the same node " + std::to_string(element.nodes[c]);
        }
      }
    }
  }
  return {};
}

std::string check_mates(const TopologyStore& store) {
  for (Index e = 0; e < store.element_count(); ++e) {
    const ElementView element = store.view(e);
    for (Index f = 0; f < element.shape->facet_count; ++f) {
      const Packed mate = element.mates[f];
      if (mate == kNone && !element.shape->cohesive) continue;
      const Index other = element_of(mate);
      if (mate < 0 || other >= store.element_count() ||
          local_of(mate) >= store.view(other).shape->facet_count) {
        return name("facet", f, e) + " has a mate that does not exist";
      }
      const std::string pair = name("facet", f, e) + " and its mate, " + name("facet", local_of(mate), other);
      if (store.view(other).mates[local_of(mate)] != pack(e, f)) {
        return name("facet", f, e) + " has as its mate " + name("facet", local_of(mate), other) +
               ", which has another";
      }
      if (element.shape->cohesive && store.is_cohesive(other)) return pair + ", are both cohesive";
      if (compare_facets(store, pack(e, f), mate) != Match::mates) {
        return pair + ", do not have the same nodes in opposite orders";
      }
    }
    if (element.shape->cohesive && element_of(element.mates[0]) < element_of(element.mates[1])) {
      return "the upper face of cohesive element " + std::to_string(e) +
             " belongs to the bulk element with the smaller number";
    }
  }
  return {};
}

std::string check_nodes(const TopologyStore& store) {
  std::vector<Index> uses(store.anchors.size(), 0);
  for (Index e = 0; e < store.bulk_count; ++e) {
    const ElementView element = store.view(e);
    for (Index c = 0; c < element.shape->corner_count; ++c) ++uses[element.nodes[c]];
  }
  std::vector<VertexUse> star;
  Visited visited;
  for (Index node = 0; node < static_cast<Index>(uses.size()); ++node) {
    const std::string subject = "node " + std::to_string(node);
    star.clear();
    visited.clear();
    for (const Packed anchor : store.anchors_of(node)) {
      const Index e = element_of(anchor);
      if (e >= store.bulk_count || local_of(anchor) >= store.view(e).shape->corner_count ||
          store.view(e).nodes[local_of(anchor)] != node) {
        return subject + " is anchored at " + name("corner", local_of(anchor), e) +
               ", which does not name it";
      }
      if (visited.contains(e)) return subject + " has two anchors in one part";
      const std::size_t first = star.size();
      flood_part(store, anchor, star, visited);
      for (std::size_t i = first; i < star.size(); ++i) {
        if (star[i].element < e) {
          return subject + " is anchored at element " + std::to_string(e) + ", but element " +
                 std::to_string(star[i].element) + " of the same part is lower";
        }
      }
    }
    if (static_cast<Index>(star.size()) != uses[node]) {
      return subject + " is named by " + std::to_string(uses[node]) + " elements, but only " +
             std::to_string(star.size()) + " are connected without crossing a cohesive element";
    }
  }
  return {};
}

}  // namespace

std::string check(const TopologyStore& store) {
  for (const auto& relation : {check_corners, check_mates, check_nodes}) {
    std::string violation = relation(store);
    if (!violation.empty()) return violation;
  }
  return {};
}

}  // namespace cdfp
