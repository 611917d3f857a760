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

void take_over(TouchingPair& pair, const TouchingPair& old, double side) {
  if (pair.origin == TouchingPair::Origin::fresh) {
    pair.grip = old.grip;
    pair.grip.stick *= side;
    pair.grip.drag *= side;
  } else {
    // The normal spring takes up the other's energy as far as the gap allows (it has an offset to give up).
    pair.grip.pressed =
        -std::sqrt(pair.grip.pressed * pair.grip.pressed +
                   old.grip.stiffness / pair.grip.stiffness * old.grip.pressed * old.grip.pressed);
  }
  pair.origin = TouchingPair::Origin::moved;
}

}  // namespace

void SurfaceContact::Stages::hand_over() {
  ended.clear();
  for (TouchingPair& old : old_node_touches) {
    Hold& hold = holds[old.first];
    if (hold.stamp != stamp) hold = Hold{};
    if (!hold.kept) ended.push_back(&old);
  }
  const auto key = [](const TouchingPair& t) { return std::array<Index, 2>{t.first, t.second}; };
  std::size_t next = 0;
  for (TouchingPair& old : old_edge_touches) {
    if (old.ignored) continue;
    while (next < edge_touches.size() && key(edge_touches[next]) < key(old)) ++next;
    if (next < edge_touches.size() && key(edge_touches[next]) == key(old)) {
      edge_touches[next].grip = old.grip;
      edge_touches[next].origin = TouchingPair::Origin::same;
    } else {
      ended.push_back(&old);
    }
  }
  if (ended.empty()) return;

  for (const TouchingPair* old : ended) {
    for (Index i = 0; i < old->count; ++i) ended_here[surface.row(old->nodes[i])] = stamp;
  }
  links.clear();
  for (std::vector<TouchingPair>* pairs : {&node_touches, &edge_touches}) {
    for (TouchingPair& pair : *pairs) {
      for_each_node_pair(pair, [&](std::array<Index, 2> nodes, bool turned) {
        if (ended_here[surface.row(nodes[0])] == stamp && ended_here[surface.row(nodes[1])] == stamp) {
          links.push_back({nodes, &pair, turned});
        }
      });
    }
  }
  std::stable_sort(links.begin(), links.end(),
                   [](const Link& a, const Link& b) { return a.nodes < b.nodes; });
  std::size_t lost = 0;
  for (TouchingPair* old : ended) {
    TouchingPair* heir = nullptr;
    double side = 1;
    const auto is_fresh = [](const TouchingPair* p) { return p->origin == TouchingPair::Origin::fresh; };
    for_each_node_pair(*old, [&](std::array<Index, 2> nodes, bool turned) {
      auto link = std::lower_bound(links.begin(), links.end(), nodes,
                                   [](const Link& a, const std::array<Index, 2>& b) { return a.nodes < b; });
      for (; link != links.end() && link->nodes == nodes; ++link) {
        const double same_side = link->turned == turned ? 1 : -1;
        if (same_side * dot(old->normal, link->pair->normal) < 0.5) continue;
        if (heir == nullptr || (is_fresh(link->pair) && !is_fresh(heir))) {
          heir = link->pair;
          side = same_side;
        }
      }
    });
    const bool whole = heir != nullptr && is_fresh(heir);
    if (heir != nullptr && old->grip.pressed < 0) take_over(*heir, *old, side);
    if (!whole) ended[lost++] = old;
  }
  ended.resize(lost);
}

}  // namespace cdfp
