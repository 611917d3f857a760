// From connectivity to records: copy the corners, pair the facets, anchor the nodes. Linear in the mesh.
#include <algorithm>
#include <string>

#include "cdfp/error.hpp"
#include "core/numbered.hpp"
#include "topology/facet_match.hpp"
#include "topology/star.hpp"
#include "topology/store.hpp"

namespace cdfp {
namespace {

std::string describe(Packed use) {
  return "facet " + numbered(local_of(use)) + " of element " + numbered(element_of(use));
}

/// A facet on its way to its mate: it waits in the bucket of its lowest node.
struct Waiting {
  Packed use;
  std::uint32_t key;  ///< from the lowest node's two neighbours on the facet
};

std::uint32_t neighbours_key(const ElementView& element, std::span<const ElementTemplate::Byte> facet,
                             std::size_t low) {
  const std::size_t n = facet.size();
  const auto p = static_cast<std::uint32_t>(element.nodes[facet[low + 1 == n ? 0 : low + 1]]);
  const auto q = static_cast<std::uint32_t>(element.nodes[facet[low == 0 ? n - 1 : low - 1]]);
  return std::min(p, q) * 0x9E3779B1u + std::max(p, q);
}

[[noreturn]] void refuse_third(Packed a, Packed b, Packed c) {
  throw Error(Status::bad_mesh, describe(a) + ", " + describe(b) + " and " + describe(c) +
                                    " have the same nodes; at most two elements may share a facet");
}

[[noreturn]] void refuse_sense(Packed a, Packed b) {
  throw Error(Status::bad_mesh, describe(a) + " and " + describe(b) +
                                    " have the same nodes in the same sense: one of the elements is inverted "
                                    "or doubled; reorder its corners or remove it");
}

/// Joins the facets of one bucket two by two.
void pair_bucket(TopologyStore& store, std::span<Waiting> bucket) {
  constexpr std::size_t kFew = 32;
  const bool sorted = bucket.size() > kFew;
  if (sorted) {
    std::sort(bucket.begin(), bucket.end(), [](const Waiting& a, const Waiting& b) {
      return a.key != b.key ? a.key < b.key : a.use < b.use;
    });
  }
  for (std::size_t i = 0; i < bucket.size(); ++i) {
    const auto [use, key] = bucket[i];
    Packed& mate = store.mutable_mates(element_of(use))[local_of(use)];
    if (mate != kNone) continue;
    Match found = Match::none;
    for (std::size_t j = i + 1; j < bucket.size() && (!sorted || bucket[j].key == key); ++j) {
      if (bucket[j].key != key) continue;
      const Match match = compare_facets(store, use, bucket[j].use);
      if (match == Match::none) continue;
      if (found != Match::none) refuse_third(use, mate, bucket[j].use);
      found = match;
      mate = bucket[j].use;
      store.mutable_mates(element_of(mate))[local_of(mate)] = use;
    }
    if (found == Match::same_sense) refuse_sense(use, mate);
  }
}

}  // namespace

TopologyStore::TopologyStore(Index node_count, std::span<const ElementType> types,
                             std::span<const Index> connectivity) {
  if (node_count < 0) throw Error(Status::bad_argument, "the number of nodes is negative");
  if (types.size() > std::size_t{kMaxElements}) {
    throw Error(Status::bad_mesh, "the mesh has " + std::to_string(types.size()) +
                                      " elements; the topology takes at most " +
                                      std::to_string(kMaxElements));
  }
  bulk_count = static_cast<Index>(types.size());
  anchors.assign(node_count, kNone);
  copy_elements(types, connectivity);
  match_facets();
  anchor_nodes();
}

void TopologyStore::copy_elements(std::span<const ElementType> types, std::span<const Index> connectivity) {
  std::array<std::size_t, kBulkTypes> counts{};
  std::size_t corners = 0;
  for (std::size_t e = 0; e < types.size(); ++e) {
    const auto type = static_cast<std::size_t>(types[e]);
    if (type >= kBulkTypes) {
      throw Error(Status::bad_mesh, "element " + numbered(e) +
                                        " is not of a bulk type; cohesive elements are inserted later, by "
                                        "insert_cohesive");
    }
    ++counts[type];
    corners += static_cast<std::size_t>(kTemplates[type].corner_count);
  }
  if (corners != connectivity.size()) {
    throw Error(Status::bad_mesh, "the connectivity holds " + std::to_string(connectivity.size()) +
                                      " corners where the types of the elements need " +
                                      std::to_string(corners));
  }
  for (std::size_t t = 0; t < kBulkTypes; ++t) {
    if (counts[t] == types.size()) only_type = static_cast<ElementType>(t);
    pools[t].assign(counts[t] * kStride[t], kNone);
  }
  const bool mixed = counts[static_cast<std::size_t>(only_type)] != types.size();
  if (mixed) places.resize(types.size());

  const auto node_count = static_cast<Index>(anchors.size());
  std::array<std::size_t, kBulkTypes> filled{};
  const Index* next = connectivity.data();
  for (std::size_t e = 0; e < types.size(); ++e) {
    const auto type = static_cast<std::size_t>(types[e]);
    const std::size_t slot = filled[type]++;
    if (mixed) places[e] = static_cast<std::uint32_t>(type << kTypeShift | slot);
    const auto count = static_cast<std::size_t>(kTemplates[type].corner_count);
    Index* record = pools[type].data() + slot * kStride[type];
    for (std::size_t c = 0; c < count; ++c) {
      const Index node = next[c];
      if (node < 0 || node >= node_count) {
        throw Error(Status::bad_mesh, "corner " + numbered(c) + " of element " + numbered(e) +
                                          " names node " + numbered(node) + "; the mesh has " +
                                          std::to_string(node_count) + " nodes, numbered from " +
                                          numbered(0));
      }
      for (std::size_t d = 0; d < c; ++d) {
        if (next[d] != node) continue;
        throw Error(Status::bad_mesh, "element " + numbered(e) + " names node " + numbered(node) +
                                          " twice; use an element type with fewer corners");
      }
      record[c] = node;
    }
    next += count;
  }
}

void TopologyStore::match_facets() {
  std::vector<std::size_t> begin(anchors.size() + 1, 0);
  for (Index e = 0; e < bulk_count; ++e) {
    const ElementView element = view(e);
    for (Index f = 0; f < element.shape->facet_count; ++f) {
      const auto facet = element.shape->facet(f);
      ++begin[element.nodes[facet[lowest(element, facet)]] + 1];
    }
  }
  for (std::size_t n = 1; n < begin.size(); ++n) begin[n] += begin[n - 1];

  std::vector<Waiting> waiting(begin.back());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  for (Index e = 0; e < bulk_count; ++e) {
    const ElementView element = view(e);
    for (Index f = 0; f < element.shape->facet_count; ++f) {
      const auto facet = element.shape->facet(f);
      const std::size_t low = lowest(element, facet);
      waiting[end[element.nodes[facet[low]]]++] = {pack(e, f), neighbours_key(element, facet, low)};
    }
  }
  for (std::size_t n = 0; n + 1 < begin.size(); ++n) {
    pair_bucket(*this, std::span(waiting).subspan(begin[n], begin[n + 1] - begin[n]));
  }
}

// A use without a lower element across any facet at its corner is the lowest of its part, or a local minimum
// of it. So the first such use of a node is its anchor, and only nodes with further ones can have further
// parts.
void TopologyStore::anchor_nodes() {
  struct Minimum {
    Index node;
    Packed use;
  };
  std::vector<Minimum> further;
  for (Index e = 0; e < bulk_count; ++e) {
    const ElementView element = view(e);
    unsigned has_lower = 0;
    for (Index f = 0; f < element.shape->facet_count; ++f) {
      const Packed mate = element.mates[f];
      if (mate != kNone && element_of(mate) < e) has_lower |= 1u << f;
    }
    for (Index c = 0; c < element.shape->corner_count; ++c) {
      unsigned around = 0;
      for (Index i = 0; i < element.shape->corner_degree[c]; ++i) {
        around |= 1u << element.shape->corner_facets[c][i];
      }
      if ((has_lower & around) != 0) continue;
      Packed& anchor = anchors[element.nodes[c]];
      if (anchor == kNone) {
        anchor = pack(e, c);
      } else {
        further.push_back({element.nodes[c], pack(e, c)});
      }
    }
  }
  std::sort(further.begin(), further.end(), [](const Minimum& a, const Minimum& b) {
    return a.node != b.node ? a.node < b.node : a.use < b.use;
  });

  std::vector<VertexUse> star;
  Visited visited;
  for (std::size_t first = 0; first < further.size();) {
    const Index node = further[first].node;
    const Packed anchor = anchors[node];
    const std::size_t group = hinges.size();
    star.clear();
    visited.clear();
    flood_part(*this, anchor, star, visited);
    for (; first < further.size() && further[first].node == node; ++first) {
      const Packed use = further[first].use;
      if (visited.contains(element_of(use))) continue;
      if (hinges.size() == group) hinges.insert(hinges.end(), {1, anchor});
      ++hinges[group];
      hinges.push_back(use);
      flood_part(*this, use, star, visited);
    }
    if (hinges.size() != group) anchors[node] = kFirstHinge - static_cast<Packed>(group);
  }
  hinges.shrink_to_fit();
}

}  // namespace cdfp
