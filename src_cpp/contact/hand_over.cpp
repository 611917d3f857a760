/// Springs pass from pairs that ended to pairs that are where those were: from face to face, edge to edge,
/// and between a node in a face and two edges. Without it a contact that slides over a border would lose its
/// load.
#include <algorithm>
#include <cmath>

#include "contact/stages.hpp"

namespace cdfp {

namespace {

/// `visit(a, b)` for a node of each side.
template <class Visit>
void for_each_node_pair(const TouchingPair& pair, Visit&& visit) {
  for (Index i = 0; i < pair.first_count; ++i) {
    for (Index j = pair.first_count; j < pair.count; ++j) visit(pair.nodes[i], pair.nodes[j]);
  }
}

void take_over(TouchingPair& pair, Grip& grip, const Grip& old, double side) {
  if (pair.origin == TouchingPair::Origin::fresh) {
    grip = old;
    grip.stick *= side;
  } else {
    // The normal spring takes up the other's energy as far as the gap allows (it has an offset to give up).
    grip.pressed =
        -std::sqrt(grip.pressed * grip.pressed + old.stiffness / grip.stiffness * old.pressed * old.pressed);
  }
  pair.origin = TouchingPair::Origin::moved;
}

}  // namespace

/// Edges that were touching go on, or end.
void SurfaceContact::Stages::follow_edges() {
  const auto key = [](const GrippedPair& t) { return std::array<Index, 2>{t.pair.first, t.pair.second}; };
  std::size_t next = 0;
  for (const GrippedPair& old : old_edge_touches) {
    if (old.pair.ignored) continue;
    while (next < edge_touches.size() && key(edge_touches[next]) < key(old)) ++next;
    if (next < edge_touches.size() && key(edge_touches[next]) == key(old)) {
      edge_touches[next].grip = old.grip;
      edge_touches[next].pair.origin = TouchingPair::Origin::same;
    } else {
      ended.push_back(old);
    }
  }
}

/// Of edges that touch, with a node on each side where some pair ended.
void SurfaceContact::Stages::link_edges() {
  for (const GrippedPair& old : ended) {
    for (Index i = 0; i < old.pair.count; ++i) ended_here[surface.row(old.pair.nodes[i])] = stamp;
  }
  links.clear();
  for (GrippedPair& edges : edge_touches) {
    for_each_node_pair(edges.pair, [&](Index a, Index b) {
      if (ended_here[surface.row(a)] != stamp || ended_here[surface.row(b)] != stamp) return;
      links.push_back({{std::min(a, b), std::max(a, b)}, &edges, b < a});
    });
  }
  std::stable_sort(links.begin(), links.end(),
                   [](const Link& a, const Link& b) { return a.nodes < b.nodes; });
}

/// `see(pair, grip, side)` for the pairs that touch with `a` and `b` on either side; side: 1 if `a` is on the
/// first, or -1.
template <class See>
void SurfaceContact::Stages::for_each_between(Index a, Index b, See&& see) {
  const auto see_touch = [&](Index node, Index on_face, double side) {
    Hold& hold = holds[surface.row(node)];
    if (hold.segment == kNone) return;
    TouchingPair& pair = pieces[hold.piece].touches[hold.place];
    const auto corners = std::span(pair.nodes).first(pair.count).subspan(1);
    if (std::find(corners.begin(), corners.end(), on_face) != corners.end()) see(pair, hold.grip, side);
  };
  see_touch(a, b, 1);
  see_touch(b, a, -1);
  const std::array<Index, 2> nodes{std::min(a, b), std::max(a, b)};
  auto link = std::lower_bound(links.begin(), links.end(), nodes,
                               [](const Link& l, const std::array<Index, 2>& n) { return l.nodes < n; });
  for (; link != links.end() && link->nodes == nodes; ++link) {
    see(link->edges->pair, link->edges->grip, link->turned == (b < a) ? 1 : -1);
  }
}

void SurfaceContact::Stages::hand_over() {
  ended.clear();
  for (const Piece& piece : pieces) ended.insert(ended.end(), piece.ended.begin(), piece.ended.end());
  follow_edges();
  if (ended.empty()) return;

  link_edges();
  std::size_t lost = 0;
  for (const GrippedPair& old : ended) {
    TouchingPair* heir = nullptr;
    Grip* heirs_grip = nullptr;
    double heirs_side = 1;
    const auto is_fresh = [](const TouchingPair& p) { return p.origin == TouchingPair::Origin::fresh; };
    for_each_node_pair(old.pair, [&](Index a, Index b) {
      for_each_between(a, b, [&](TouchingPair& pair, Grip& grip, double side) {
        if (side * dot(old.pair.normal, pair.normal) < 0.5) return;
        if (heir != nullptr && (!is_fresh(pair) || is_fresh(*heir))) return;
        heir = &pair;
        heirs_grip = &grip;
        heirs_side = side;
      });
    });
    const bool whole = heir != nullptr && is_fresh(*heir);
    if (heir != nullptr && old.grip.pressed < 0) take_over(*heir, *heirs_grip, old.grip, heirs_side);
    if (!whole) ended[lost++] = old;
  }
  ended.resize(lost);
}

}  // namespace cdfp
