#include "topology/insertion.hpp"

#include <algorithm>
#include <string>

#include "cdfp/error.hpp"
#include "core/growth.hpp"
#include "core/numbered.hpp"
#include "topology/star.hpp"

namespace cdfp {
namespace {

[[noreturn]] void refuse(FacetUse use, const std::string& why) {
  throw Error(Status::bad_argument, "no cohesive element can be inserted at facet " + numbered(use.facet) +
                                        " of element " + numbered(use.element) + ": " + why);
}

FacetUse checked_mate(const TopologyStore& store, FacetUse use) {
  const Index count = store.element_count();
  if (use.element < 0 || use.element >= count) {
    refuse(use, "there are " + std::to_string(count) + " elements, numbered from " + numbered(0));
  }
  if (store.is_cohesive(use.element))
    refuse(use, "the element is cohesive itself; name a facet of a bulk element");
  const ElementView element = store.view(use.element);
  if (use.facet < 0 || use.facet >= element.shape->facet_count) {
    refuse(use, "the element has " + std::to_string(element.shape->facet_count) + " facets, numbered from " +
                    numbered(0));
  }
  const Packed mate = element.mates[use.facet];
  if (mate == kNone) refuse(use, "it lies on the boundary; only inner facets can open");
  if (store.is_cohesive(element_of(mate))) {
    refuse(use, "the facet is cohesive already, by element " + numbered(element_of(mate)));
  }
  if (count >= kMaxElements) refuse(use, "the topology holds as many elements as it can number");
  return {element_of(mate), local_of(mate)};
}

}  // namespace

void Inserter::Side::start(VertexUse use) {
  uses.assign(1, use);
  next = 0;
  visited.clear();
  visited.insert(use.element);
}

Index Inserter::Side::lowest() const {
  return std::min_element(uses.begin(), uses.end(),
                          [](VertexUse a, VertexUse b) { return a.element < b.element; })
      ->element;
}

void Inserter::insert(TopologyStore& store, FacetUse use, Insertion& report) {
  const FacetUse other = checked_mate(store, use);
  const Cut cut{store.element_count(), std::min(use, other), std::max(use, other)};
  report.cohesive_element = cut.cohesive;
  report.lower = cut.lower;
  report.upper = cut.upper;
  report.new_nodes.clear();
  report.renumbered.clear();

  Packed& lower_mate = store.mutable_mates(cut.lower.element)[cut.lower.facet];
  Packed& upper_mate = store.mutable_mates(cut.upper.element)[cut.upper.facet];
  lower_mate = pack(cut.cohesive, 1);
  upper_mate = pack(cut.cohesive, 0);
  try {
    decide(store, cut, report);
  } catch (...) {
    lower_mate = pack(cut.upper.element, cut.upper.facet);
    upper_mate = pack(cut.lower.element, cut.lower.facet);
    throw;
  }
  apply(store, cut, report);
}

/// Whether the two bulk elements are still connected about an edge of the facet, without crossing a
/// cohesive element.
bool Inserter::edge_holds(const TopologyStore& store, const Cut& cut, Index lower_edge) {
  const ElementTemplate& shape = *store.view(cut.lower.element).shape;
  // Turn away from the facet.
  const bool right_handed = shape.edge_facets[lower_edge][1] == cut.lower.facet;
  EdgeWalk walk{cut.lower.element, lower_edge};
  while (walk.turn(store, right_handed, false)) {
    if (walk.element != cut.upper.element) continue;
    const auto& sides = store.view(walk.element).shape->edge_facets[walk.edge];
    if (sides[walk.along == right_handed ? 0 : 1] == cut.upper.facet) return true;
  }
  return false;
}

/// Visits one more use of the side; true if it touches the other side.
bool Inserter::grow(const TopologyStore& store, Side& side, const Side& other) {
  const VertexUse use = side.uses[side.next++];
  const ElementView element = store.view(use.element);
  const Index node = element.nodes[use.corner];
  for (Index i = 0; i < element.shape->corner_degree[use.corner]; ++i) {
    const Packed mate = element.mates[element.shape->corner_facets[use.corner][i]];
    if (mate == kNone || store.is_cohesive(element_of(mate))) continue;
    if (other.visited.contains(element_of(mate))) return true;
    if (!side.visited.insert(element_of(mate))) continue;
    side.uses.push_back({element_of(mate), store.view(element_of(mate)).corner(local_of(mate), node)});
  }
  return false;
}

// Both sides grow in turn until they touch or one is complete. The part that holds one of the node's anchors
// keeps the node: the lowest element of the part as it was before, whoever asks and in whatever order.
Inserter::Fate Inserter::vertex_fate(const TopologyStore& store, Index node, VertexUse lower,
                                     VertexUse upper) {
  lower_.start(lower);
  upper_.start(upper);
  while (!lower_.exhausted() && !upper_.exhausted()) {
    if (grow(store, lower_, upper_) || grow(store, upper_, lower_)) return Fate::joined;
  }
  const bool lower_complete = lower_.exhausted();
  const Index lowest = (lower_complete ? lower_ : upper_).lowest();
  const auto anchors = store.anchors_of(node);
  const bool keeps =
      std::any_of(anchors.begin(), anchors.end(), [&](Packed a) { return element_of(a) == lowest; });
  const Fate fate = lower_complete == keeps ? Fate::upper_moves : Fate::lower_moves;
  Side& moving = fate == Fate::upper_moves ? upper_ : lower_;
  Side& staying = fate == Fate::upper_moves ? lower_ : upper_;
  while (!moving.exhausted()) grow(store, moving, staying);
  return fate;
}

void Inserter::decide(TopologyStore& store, const Cut& cut, Insertion& report) {
  const ElementView lower = store.view(cut.lower.element);
  const ElementView upper = store.view(cut.upper.element);
  const auto corners = lower.shape->facet(cut.lower.facet);
  const std::size_t n = corners.size();
  std::array<bool, 4> holds{};
  for (std::size_t i = 0; i < n; ++i) {
    holds[i] = edge_holds(store, cut, lower.shape->facet_edges[cut.lower.facet][i]);
    report.split_edges[i] = !holds[i];
  }
  for (std::size_t i = n; i < 4; ++i) report.split_edges[i] = false;

  // Where the lower facet's first corner stands on the upper facet.
  start_ = 0;
  while (upper.nodes[upper.shape->facets[cut.upper.facet][start_]] != lower.nodes[corners[0]]) ++start_;

  moves_.clear();
  ranges_.fill(0);
  for (std::size_t i = 0; i < n; ++i) {
    ranges_[i] = moves_.size();
    // What holds about an edge holds at its ends.
    if (holds[i] || holds[(i + n - 1) % n]) continue;
    const Index node = lower.nodes[corners[i]];
    const Fate fate = vertex_fate(store, node, {cut.lower.element, corners[i]},
                                  {cut.upper.element, upper.corner(cut.upper.facet, node)});
    if (fate == Fate::joined) continue;
    const Side& moving = fate == Fate::lower_moves ? lower_ : upper_;
    moves_.insert(moves_.end(), moving.uses.begin(), moving.uses.end());
  }
  ranges_[n] = moves_.size();

  // All memory that `apply` needs, so that it cannot fail half way.
  make_room(report.new_nodes, report.new_nodes.size() + n);
  make_room(report.renumbered, report.renumbered.size() + moves_.size() * (1 + kMaxAtCorner));
  make_room(store.anchors, store.anchors.size() + n);
  make_room(store.cohesive, store.cohesive.size() + TopologyStore::kCohesiveWords);
}

void Inserter::apply(TopologyStore& store, const Cut& cut, Insertion& report) {
  const std::size_t n = store.view(cut.lower.element).shape->facet(cut.lower.facet).size();
  for (std::size_t i = 0; i < n; ++i) {
    if (ranges_[i] == ranges_[i + 1]) continue;
    const std::span<const VertexUse> moves(&moves_[ranges_[i]], ranges_[i + 1] - ranges_[i]);
    const Index mother = store.view(moves[0].element).nodes[moves[0].corner];
    const auto node = static_cast<Index>(store.anchors.size());
    report.new_nodes.push_back({node, mother});
    const VertexUse lowest = *std::min_element(
        moves.begin(), moves.end(), [](VertexUse a, VertexUse b) { return a.element < b.element; });
    store.anchors.push_back(pack(lowest.element, lowest.corner));

    for (const VertexUse& use : moves) {
      const ElementView element = store.view(use.element);
      store.mutable_nodes(use.element)[use.corner] = node;
      report.renumbered.push_back({use.element, use.corner, mother, node});
      for (Index k = 0; k < element.shape->corner_degree[use.corner]; ++k) {
        const Packed mate = element.mates[element.shape->corner_facets[use.corner][k]];
        if (mate == kNone || !store.is_cohesive(element_of(mate)) || element_of(mate) == cut.cohesive)
          continue;
        const Index corner = store.view(element_of(mate)).corner(local_of(mate), mother);
        store.mutable_nodes(element_of(mate))[corner] = node;
        report.renumbered.push_back({element_of(mate), corner, mother, node});
      }
    }
  }

  // Node i of the upper face faces node i of the lower one: the facets' outward orders run against each
  // other.
  const ElementView lower = store.view(cut.lower.element);
  const ElementView upper = store.view(cut.upper.element);
  std::array<Index, TopologyStore::kCohesiveWords> record;
  record.fill(kNone);
  for (std::size_t i = 0; i < n; ++i) {
    record[i] = upper.nodes[upper.shape->facets[cut.upper.facet][(start_ + n - i) % n]];
    record[n + i] = lower.nodes[lower.shape->facets[cut.lower.facet][i]];
  }
  record[8] = pack(cut.upper.element, cut.upper.facet);
  record[9] = pack(cut.lower.element, cut.lower.facet);
  store.cohesive.insert(store.cohesive.end(), record.begin(), record.end());
}

}  // namespace cdfp
