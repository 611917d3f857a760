/// Springs pass from pairs that ended to pairs that are where those were: from face to face, edge to edge,
/// and between a node in a face and two edges. Without it a contact that slides over a border would lose its
/// load.
#include <algorithm>
#include <cmath>

#include "contact/stages.hpp"

namespace cdfp {

namespace {

template <class Visit>
void for_each_node_pair(const TouchingPair& pair, Visit&& visit) {
  for (Index i = 0; i < pair.first_count; ++i) {
    for (Index j = pair.first_count; j < pair.count; ++j) {
      const Index a = pair.nodes[i], b = pair.nodes[j];
      visit(std::array<Index, 2>{std::min(a, b), std::max(a, b)}, b < a);
    }
  }
}

void take_over(TouchingPair& pair, Grip& grip, const Grip& old, double side) {
  if (pair.origin == TouchingPair::Origin::fresh) {
    grip = old;
    grip.stick *= side;
    grip.drag *= side;
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

/// The pairs that have a node on each side where some pair ended.
void SurfaceContact::Stages::find_links() {
  links.clear();
  const auto link = [&](TouchingPair& pair, Grip& grip) {
    for_each_node_pair(pair, [&](std::array<Index, 2> nodes, bool turned) {
      if (ended_here[surface.row(nodes[0])] == stamp && ended_here[surface.row(nodes[1])] == stamp) {
        links.push_back({nodes, &pair, &grip, turned});
      }
    });
  };
  for (const Index row : ended_rows) {
    Hold& hold = holds[row];
    if (hold.segment != kNone) link(pieces[hold.piece].touches[hold.place], hold.grip);
  }
  for (GrippedPair& edges : edge_touches) link(edges.pair, edges.grip);
  std::stable_sort(links.begin(), links.end(),
                   [](const Link& a, const Link& b) { return a.nodes < b.nodes; });
}

void SurfaceContact::Stages::hand_over() {
  ended.clear();
  for (const Piece& piece : pieces) ended.insert(ended.end(), piece.ended.begin(), piece.ended.end());
  follow_edges();
  if (ended.empty()) return;

  ended_rows.clear();
  for (const GrippedPair& old : ended) {
    for (Index i = 0; i < old.pair.count; ++i) {
      const Index row = surface.row(old.pair.nodes[i]);
      if (ended_here[row] != stamp) ended_rows.push_back(row);
      ended_here[row] = stamp;
    }
  }
  find_links();
  std::size_t lost = 0;
  for (const GrippedPair& old : ended) {
    const Link* heir = nullptr;
    double side = 1;
    const auto is_fresh = [](const Link& l) { return l.pair->origin == TouchingPair::Origin::fresh; };
    for_each_node_pair(old.pair, [&](std::array<Index, 2> nodes, bool turned) {
      auto link = std::lower_bound(links.begin(), links.end(), nodes,
                                   [](const Link& a, const std::array<Index, 2>& b) { return a.nodes < b; });
      for (; link != links.end() && link->nodes == nodes; ++link) {
        const double same_side = link->turned == turned ? 1 : -1;
        if (same_side * dot(old.pair.normal, link->pair->normal) < 0.5) continue;
        if (heir == nullptr || (is_fresh(*link) && !is_fresh(*heir))) {
          heir = &*link;
          side = same_side;
        }
      }
    });
    const bool whole = heir != nullptr && is_fresh(*heir);
    if (heir != nullptr && old.grip.pressed < 0) take_over(*heir->pair, *heir->grip, old.grip, side);
    if (!whole) ended[lost++] = old;
  }
  ended.resize(lost);
}

}  // namespace cdfp
