/// Element templates: the local corners of each type's facets and edges, and what follows from them.
///
/// A type is its row of `ElementTemplate`: corners of the facets in outward order (right-hand normal points
/// out of the element) and corners of the edges; everything else is derived and proven at compile time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "cdfp/mesh.hpp"

namespace cdfp {

inline constexpr int kMaxCorners = 8;
inline constexpr int kMaxFacets = 6;
inline constexpr int kMaxEdges = 12;
inline constexpr int kMaxAtCorner = 4;  ///< facets, or edges, that meet at one corner
inline constexpr std::uint8_t kNoLocal = 255;

struct ElementTemplate {
  using Byte = std::uint8_t;

  Byte corner_count = 0;
  Byte facet_count = 0;
  Byte edge_count = 0;
  bool cohesive = false;
  std::array<Byte, kMaxFacets> facet_size{};
  std::array<std::array<Byte, 4>, kMaxFacets> facets{};  ///< corners of a facet, outward order
  std::array<std::array<Byte, 2>, kMaxEdges> edges{};    ///< corners of an edge

  // Derived.
  std::array<std::array<Byte, 4>, kMaxFacets>
      facet_edges{};  ///< edge from corner i to corner i + 1 of a facet
  /// The facets that meet at an edge: turning right-handed about the edge's direction one comes in through
  /// the second and goes out through the first (whose outward order holds the edge in its direction).
  std::array<std::array<Byte, 2>, kMaxEdges> edge_facets{};
  std::array<Byte, kMaxCorners> corner_degree{};  ///< facets (and edges) that meet at a corner
  std::array<std::array<Byte, kMaxAtCorner>, kMaxCorners> corner_facets{};
  std::array<std::array<Byte, kMaxAtCorner>, kMaxCorners> corner_edges{};

  constexpr std::span<const Byte> facet(int f) const {
    return {facets[f].data(), static_cast<std::size_t>(facet_size[f])};
  }
};

namespace detail {

using Corners = std::initializer_list<int>;

constexpr ElementTemplate make_template(int corner_count, std::initializer_list<Corners> facets,
                                        std::initializer_list<Corners> edges, bool cohesive = false) {
  using Byte = ElementTemplate::Byte;
  ElementTemplate t;
  t.corner_count = static_cast<Byte>(corner_count);
  t.facet_count = static_cast<Byte>(facets.size());
  t.edge_count = static_cast<Byte>(edges.size());
  t.cohesive = cohesive;

  std::size_t f = 0;
  for (const Corners& facet : facets) {
    std::size_t i = 0;
    for (int c : facet) t.facets[f][i++] = static_cast<Byte>(c);
    t.facet_size[f++] = static_cast<Byte>(i);
  }
  std::size_t e = 0;
  for (const Corners& edge : edges) {
    t.edges[e++] = {static_cast<Byte>(*edge.begin()), static_cast<Byte>(*(edge.begin() + 1))};
  }

  for (auto& sides : t.edge_facets) sides = {kNoLocal, kNoLocal};
  for (f = 0; f < facets.size(); ++f) {
    const std::size_t n = static_cast<std::size_t>(t.facet_size[f]);
    for (std::size_t i = 0; i < n; ++i) {
      const Byte a = t.facets[f][i];
      const Byte b = t.facets[f][(i + 1) % n];
      t.facet_edges[f][i] = kNoLocal;
      for (e = 0; e < edges.size(); ++e) {
        const bool along = t.edges[e][0] == a && t.edges[e][1] == b;
        const bool against = t.edges[e][0] == b && t.edges[e][1] == a;
        if (!along && !against) continue;
        t.facet_edges[f][i] = static_cast<Byte>(e);
        t.edge_facets[e][along ? 0 : 1] = static_cast<Byte>(f);
      }
      const std::size_t at = static_cast<std::size_t>(a);
      t.corner_facets[at][static_cast<std::size_t>(t.corner_degree[at]++)] = static_cast<Byte>(f);
    }
  }
  // Turning about an edge crosses a cohesive element from one face to the other.
  if (cohesive) {
    for (auto& sides : t.edge_facets) {
      for (std::size_t s = 0; s < 2; ++s) {
        if (sides[s] == kNoLocal && sides[1 - s] != kNoLocal) sides[s] = static_cast<Byte>(1 - sides[1 - s]);
      }
    }
  }
  std::array<std::size_t, kMaxCorners> filled{};
  for (e = 0; e < edges.size(); ++e) {
    for (Byte c : t.edges[e]) {
      const std::size_t at = static_cast<std::size_t>(c);
      t.corner_edges[at][filled[at]++] = static_cast<Byte>(e);
    }
  }
  return t;
}

}  // namespace detail

/// Indexed by `ElementType`.
inline constexpr std::array<ElementTemplate, 6> kTemplates{
    // hexahedron: 0-1-2-3 bottom, 4-5-6-7 above them
    detail::make_template(
        8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
        {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}),
    // tetrahedron: the right-hand normal of 0-1-2 points to 3
    detail::make_template(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                          {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}),
    // wedge: 0-1-2 bottom, 3-4-5 above them; the right-hand normal of 0-1-2 points to 3-4-5
    detail::make_template(6, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
                          {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}),
    // pyramid: 0-1-2-3 base, its right-hand normal points to the apex 4
    detail::make_template(5, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                          {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}),
    // cohesive quadrilateral: facet 0 is the upper face, facet 1 the lower; edge i lies above edge i + 4
    detail::make_template(8, {{0, 1, 2, 3}, {4, 7, 6, 5}},
                          {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}}, true),
    // cohesive triangle: edge i lies above edge i + 3
    detail::make_template(6, {{0, 1, 2}, {3, 5, 4}}, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}}, true)};

constexpr const ElementTemplate& element_template(ElementType type) {
  return kTemplates[static_cast<std::size_t>(type)];
}

namespace detail {

/// A bulk template is a closed surface: Euler's relation, each edge in two facets in opposite directions,
/// as many edges as facets at a corner.
constexpr bool is_sound(const ElementTemplate& t) {
  std::size_t sides = 0;
  for (std::size_t f = 0; f < static_cast<std::size_t>(t.facet_count); ++f) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(t.facet_size[f]); ++i, ++sides) {
      if (t.facet_edges[f][i] == kNoLocal) return false;
    }
  }
  for (std::size_t e = 0; e < static_cast<std::size_t>(t.edge_count); ++e) {
    if (t.edge_facets[e][0] == kNoLocal || t.edge_facets[e][1] == kNoLocal) return false;
  }
  if (t.cohesive) return sides == static_cast<std::size_t>(t.edge_count);
  return t.corner_count - t.edge_count + t.facet_count == 2 &&
         sides == 2u * static_cast<unsigned>(t.edge_count);
}

constexpr bool all_sound() {
  for (const ElementTemplate& t : kTemplates) {
    if (!is_sound(t)) return false;
  }
  return true;
}
static_assert(all_sound());

}  // namespace detail
}  // namespace cdfp
