#include "cdfp/topology.hpp"

#include <algorithm>

#include "topology/insertion.hpp"
#include "topology/star.hpp"
#include "topology/store.hpp"

namespace cdfp {

struct Topology::Store : TopologyStore {
  using TopologyStore::TopologyStore;
  Inserter inserter;
};

Topology::Topology(Index node_count, std::span<const ElementType> types, std::span<const Index> connectivity)
    : store_(std::make_unique<Store>(node_count, types, connectivity)) {}
Topology::~Topology() = default;
Topology::Topology(Topology&&) noexcept = default;
Topology& Topology::operator=(Topology&&) noexcept = default;

namespace {

FacetUse unpack_facet(Packed word) {
  return word == kNone ? FacetUse{} : FacetUse{element_of(word), local_of(word)};
}

bool is_anchored(const TopologyStore& store, FacetUse use) {
  // Cohesive elements have higher numbers than all bulk elements.
  const Packed mate = store.view(use.element).mates[use.facet];
  return mate == kNone || element_of(mate) > use.element;
}

/// Looks both ways in turn: most edges meet a lower element, if there is one, within a step or two.
bool is_anchored(const TopologyStore& store, EdgeUse use) {
  EdgeWalk right{use.element, use.edge};
  EdgeWalk left = right;
  bool go_right = true;
  bool go_left = true;
  while (go_right || go_left) {
    if (go_right && (go_right = right.turn(store, true, false))) {
      if (right.element < use.element) return false;
      if (right.element == left.element) return true;
    }
    if (go_left && (go_left = left.turn(store, false, false))) {
      if (left.element < use.element) return false;
      if (left.element == right.element) return true;
    }
  }
  return true;
}

/// Visits the cycle around an edge as `elements_around` orders it; returns whether it is closed.
template <class Visit>
bool walk_ring(const TopologyStore& store, EdgeUse use, Visit&& visit) {
  EdgeWalk walk{use.element, use.edge};
  bool closed = false;
  while (!closed && walk.turn(store, false, true)) closed = walk.element == use.element;
  if (closed) walk = {use.element, use.edge};
  const Index first = walk.element;
  do {
    visit(walk);
  } while (walk.turn(store, true, true) && walk.element != first);
  return closed;
}

/// Calls `visit(facet, mate)` for the facets at a corner.
template <class Visit>
void at_corner(const ElementView& element, Index corner, Visit&& visit) {
  for (Index i = 0; i < element.shape->corner_degree[corner]; ++i) {
    const Index facet = element.shape->corner_facets[corner][i];
    visit(facet, element.mates[facet]);
  }
}

/// The bulk uses of a node, in the order in which they are found.
void bulk_star(const TopologyStore& store, Index node, std::vector<VertexUse>& star) {
  star.clear();
  Visited visited;
  for (const Packed anchor : store.anchors_of(node)) flood_part(store, anchor, star, visited);
}

std::vector<VertexUse>& thread_scratch() {
  static thread_local std::vector<VertexUse> scratch;
  return scratch;
}

bool by_element(VertexUse a, VertexUse b) {
  return a.element != b.element ? a.element < b.element : a.corner < b.corner;
}

}  // namespace

Index Topology::node_count() const {
  return static_cast<Index>(store_->anchors.size());
}

Index Topology::element_count() const {
  return store_->element_count();
}

Index Topology::bulk_count() const {
  return store_->bulk_count;
}

ElementType Topology::type(Index element) const {
  return store_->type(element);
}

std::span<const Index> Topology::nodes(Index element) const {
  const ElementView view = store_->view(element);
  return {view.nodes, static_cast<std::size_t>(view.shape->corner_count)};
}

Index Topology::facet_count(Index element) const {
  return store_->view(element).shape->facet_count;
}

Index Topology::edge_count(Index element) const {
  return store_->view(element).shape->edge_count;
}

FacetNodes Topology::facet_nodes(FacetUse use) const {
  const ElementView element = store_->view(use.element);
  FacetNodes facet;
  for (const auto corner : element.shape->facet(use.facet))
    facet.nodes[facet.count++] = element.nodes[corner];
  return facet;
}

std::array<Index, 2> Topology::edge_nodes(EdgeUse use) const {
  const ElementView element = store_->view(use.element);
  const auto& ends = element.shape->edges[use.edge];
  return {element.nodes[ends[0]], element.nodes[ends[1]]};
}

EdgeUse Topology::facet_edge(FacetUse use, Index side) const {
  return {use.element, store_->view(use.element).shape->facet_edges[use.facet][side]};
}

FacetUse Topology::mate(FacetUse use) const {
  return unpack_facet(store_->view(use.element).mates[use.facet]);
}

void Topology::elements_around(EdgeUse use, std::vector<EdgeUse>& out) const {
  out.clear();
  walk_ring(*store_, use, [&](const EdgeWalk& walk) { out.push_back({walk.element, walk.edge}); });
}

void Topology::facets_around(EdgeUse use, std::vector<FacetUse>& out) const {
  out.clear();
  const auto facet_of = [&](const EdgeWalk& walk, bool ahead) {
    const Index facet = store_->view(walk.element).shape->edge_facets[walk.edge][walk.along == ahead ? 0 : 1];
    out.push_back(anchor(FacetUse{walk.element, facet}));
  };
  EdgeWalk first{kNone, kNone};
  const bool closed = walk_ring(*store_, use, [&](const EdgeWalk& walk) {
    if (first.element == kNone) first = walk;
    facet_of(walk, true);
  });
  if (closed) return;
  facet_of(first, false);
  std::rotate(out.begin(), out.end() - 1, out.end());
}

void Topology::elements_around_vertex(VertexUse use, std::vector<VertexUse>& out) const {
  out.assign(1, use);
  Visited visited;
  visited.insert(use.element);
  for (std::size_t next = 0; next < out.size(); ++next) {
    const VertexUse from = out[next];
    const ElementView element = store_->view(from.element);
    const auto cross = [&](Index corner) {
      at_corner(element, corner, [&](Index, Packed mate) {
        if (mate == kNone || !visited.insert(element_of(mate))) return;
        const Index there = store_->view(element_of(mate)).corner(local_of(mate), element.nodes[corner]);
        out.push_back({element_of(mate), there});
      });
    };
    cross(from.corner);
    if (const Index half = element.shape->corner_count / 2; element.shape->cohesive) {
      cross(from.corner < half ? from.corner + half : from.corner - half);
    }
  }
}

void Topology::elements_around_node(Index node, std::vector<VertexUse>& out) const {
  bulk_star(*store_, node, out);
  const std::size_t bulk = out.size();
  for (std::size_t i = 0; i < bulk; ++i) {
    at_corner(store_->view(out[i].element), out[i].corner, [&](Index, Packed mate) {
      if (mate == kNone || !store_->is_cohesive(element_of(mate))) return;
      out.push_back({element_of(mate), store_->view(element_of(mate)).corner(local_of(mate), node)});
    });
  }
  std::sort(out.begin(), out.end(), by_element);
}

void Topology::facets_around_node(Index node, std::vector<FacetUse>& out) const {
  out.clear();
  std::vector<VertexUse>& star = thread_scratch();
  bulk_star(*store_, node, star);
  for (const VertexUse& use : star) {
    at_corner(store_->view(use.element), use.corner, [&](Index facet, Packed) {
      if (is_anchored(*store_, FacetUse{use.element, facet})) out.push_back({use.element, facet});
    });
  }
  std::sort(out.begin(), out.end());
}

void Topology::edges_around_node(Index node, std::vector<EdgeUse>& out) const {
  out.clear();
  std::vector<VertexUse>& star = thread_scratch();
  bulk_star(*store_, node, star);
  for (const VertexUse& use : star) {
    const ElementTemplate& shape = *store_->view(use.element).shape;
    for (Index i = 0; i < shape.corner_degree[use.corner]; ++i) {
      const EdgeUse edge{use.element, shape.corner_edges[use.corner][i]};
      if (is_anchored(*store_, edge)) out.push_back(edge);
    }
  }
  std::sort(out.begin(), out.end(), [](EdgeUse a, EdgeUse b) {
    return a.element != b.element ? a.element < b.element : a.edge < b.edge;
  });
}

FacetUse Topology::anchor(FacetUse use) const {
  return is_anchored(*store_, use) ? use : mate(use);
}

EdgeUse Topology::anchor(EdgeUse use) const {
  EdgeWalk walk{use.element, use.edge};
  if (store_->is_cohesive(use.element)) {
    const ElementTemplate& shape = *store_->view(use.element).shape;
    const bool upper = use.edge < shape.edge_count / 2;
    // Turn through the face that the edge lies on.
    walk.turn(*store_, shape.edge_facets[use.edge][0] == (upper ? 0 : 1), true);
  }
  EdgeUse lowest{walk.element, walk.edge};
  for (const bool right_handed : {true, false}) {
    EdgeWalk step = walk;
    while (step.turn(*store_, right_handed, false)) {
      if (step.element < lowest.element) lowest = {step.element, step.edge};
      if (step.element == walk.element) return lowest;
    }
  }
  return lowest;
}

VertexUse Topology::anchor(Index node) const {
  const auto anchors = store_->anchors_of(node);
  if (anchors.empty()) return {};
  return {element_of(anchors.front()), local_of(anchors.front())};
}

bool Topology::is_boundary(FacetUse use) const {
  return store_->view(use.element).mates[use.facet] == kNone;
}

bool Topology::is_boundary(EdgeUse use) const {
  EdgeWalk walk{use.element, use.edge};
  while (walk.turn(*store_, true, true)) {
    if (walk.element == use.element) return false;
  }
  return true;
}

bool Topology::is_boundary_node(Index node) const {
  std::vector<VertexUse>& star = thread_scratch();
  bulk_star(*store_, node, star);
  bool boundary = false;
  for (const VertexUse& use : star) {
    at_corner(store_->view(use.element), use.corner,
              [&](Index, Packed mate) { boundary = boundary || mate == kNone; });
  }
  return boundary;
}

FacetUse Topology::next_facet(FacetUse use) const {
  while (use.element < store_->bulk_count) {
    const Index count = facet_count(use.element);
    while (++use.facet < count) {
      if (is_anchored(*store_, use)) return use;
    }
    ++use.element;
    use.facet = kNone;
  }
  return {};
}

EdgeUse Topology::next_edge(EdgeUse use) const {
  while (use.element < store_->bulk_count) {
    const Index count = edge_count(use.element);
    while (++use.edge < count) {
      if (is_anchored(*store_, use)) return use;
    }
    ++use.element;
    use.edge = kNone;
  }
  return {};
}

void Topology::insert_cohesive(FacetUse use, Insertion& report) {
  store_->inserter.insert(*store_, use, report);
}

std::string Topology::check() const {
  return cdfp::check(*store_);
}

std::size_t Topology::memory() const {
  return sizeof(Store) + store_->memory();
}

}  // namespace cdfp
