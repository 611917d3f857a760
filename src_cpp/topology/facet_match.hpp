/// Whether two facets are the two sides of one: the same nodes, in opposite orders.
#pragma once

#include <span>

#include "topology/store.hpp"

namespace cdfp {

/// Where the lowest node stands on the facet.
inline std::size_t lowest(const ElementView& element, std::span<const ElementTemplate::Byte> facet) {
  std::size_t low = 0;
  for (std::size_t i = 1; i < facet.size(); ++i) {
    if (element.nodes[facet[i]] < element.nodes[facet[low]]) low = i;
  }
  return low;
}

enum class Match { none, mates, same_sense };

inline Match compare_facets(const TopologyStore& store, Packed a, Packed b) {
  const ElementView ea = store.view(element_of(a));
  const ElementView eb = store.view(element_of(b));
  const auto fa = ea.shape->facet(local_of(a));
  const auto fb = eb.shape->facet(local_of(b));
  const std::size_t n = fa.size();
  if (n != fb.size()) return Match::none;
  const std::size_t la = lowest(ea, fa);
  const std::size_t lb = lowest(eb, fb);
  bool reverse = true;
  bool same = true;
  for (std::size_t i = 0; i < n; ++i) {
    const Index node = ea.nodes[fa[(la + i) % n]];
    reverse = reverse && node == eb.nodes[fb[(lb + n - i) % n]];
    same = same && node == eb.nodes[fb[(lb + i) % n]];
  }
  if (reverse) return Match::mates;
  return same ? Match::same_sense : Match::none;
}

}  // namespace cdfp
