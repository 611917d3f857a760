#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "cdfp/error.hpp"
#include "cdfp/mesh.hpp"
#include "core/numbered.hpp"
#include "core/vec3.hpp"
#include "mesh/element_shapes.hpp"
#include "topology/templates.hpp"

namespace cdfp {

namespace {

/// A corner whose Jacobian is below this share of its edges' product is taken as flat.
constexpr double kFlat = 1e-9;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(Status::bad_mesh, message);
}

std::string number(std::size_t n) {
  return std::to_string(n);
}

std::string point(const Mesh& mesh, Index node) {
  const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(node)];
  std::string text = "(";
  for (int i = 0; i < 3; ++i) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%s%.6g", i ? ", " : "", x[i]);
    text += digits;
  }
  return text + ")";
}

/// Where each element's corners start; sizes are checked on the way.
std::vector<std::size_t> check_sizes(const Mesh& mesh) {
  if (mesh.coordinates.size() % 3 != 0) {
    refuse("coordinates holds " + number(mesh.coordinates.size()) +
           " values, not a multiple of 3; give x, y, z for each node");
  }
  const std::size_t elements = mesh.types.size();
  if (elements == 0) refuse("the mesh has no elements; give at least one");
  std::vector<std::size_t> first(elements + 1, 0);
  for (std::size_t e = 0; e < elements; ++e) {
    if (!bulk_shape(mesh.types[e])) {
      refuse("element " + numbered(e) + " is of no bulk type (type " +
             std::to_string(static_cast<int>(mesh.types[e])) +
             "); cohesive elements are inserted by the simulation, leave them out of the mesh");
    }
    first[e + 1] = first[e] + element_template(mesh.types[e]).corner_count;
  }
  if (first.back() != mesh.connectivity.size()) {
    refuse("connectivity holds " + number(mesh.connectivity.size()) + " node numbers, but the types of the " +
           number(elements) + " elements ask for " + number(first.back()));
  }
  if (mesh.parts.size() != elements) {
    refuse("parts holds " + number(mesh.parts.size()) + " values for " + number(elements) +
           " elements; give the part of each element");
  }
  if (!mesh.layers.empty() && mesh.layers.size() != elements) {
    refuse("layers holds " + number(mesh.layers.size()) + " values for " + number(elements) +
           " elements; give one for each element, or none");
  }
  return first;
}

void check_numbers(const Mesh& mesh, const std::vector<std::size_t>& first) {
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) {
    if (!std::isfinite(mesh.coordinates[i])) {
      refuse("node " + numbered(i / 3) + ": coordinate " + "xyz"[i % 3] + " is not a finite number");
    }
  }
  const Index nodes = mesh.node_count();
  for (std::size_t e = 0; e < mesh.types.size(); ++e) {
    const Index part = mesh.parts[e];
    if (part < 0 || static_cast<std::size_t>(part) >= mesh.part_names.size()) {
      refuse("element " + numbered(e) + " is of part " + numbered(part) + ", but there are " +
             number(mesh.part_names.size()) + " part names (numbered from " + numbered(0) + ")");
    }
    for (std::size_t i = first[e]; i < first[e + 1]; ++i) {
      const Index node = mesh.connectivity[i];
      if (node < 0 || node >= nodes) {
        refuse("element " + numbered(e) + ", corner " + numbered(i - first[e]) + ": node " + numbered(node) +
               " is out of range (nodes are numbered " + numbered(0) + " to " + numbered(nodes - 1) + ")");
      }
      for (std::size_t j = first[e]; j < i; ++j) {
        if (mesh.connectivity[j] == node) {
          refuse("element " + numbered(e) + " names node " + numbered(node) + " at corners " +
                 numbered(j - first[e]) + " and " + numbered(i - first[e]) +
                 "; use a type with fewer corners or give it a node of its own");
        }
      }
    }
  }
}

[[noreturn]] void refuse_shape(const Mesh& mesh, std::size_t element, Index corner, Index node,
                               bool inverted) {
  refuse("element " + numbered(element) + " (" + bulk_shape(mesh.types[element])->name + ", part '" +
         mesh.part_names[static_cast<std::size_t>(mesh.parts[element])] + "') is " +
         (inverted ? "inverted" : "degenerate") + " at node " + numbered(node) + " (corner " +
         numbered(corner) + ") " + point(mesh, node) +
         (inverted ? ": the Jacobian is negative; check the order of its corners (as in the VTK linear "
                     "cells) and where its nodes lie"
                   : ": its edges there have no volume; merge the coinciding nodes or move them apart"));
}

void check_shapes(const Mesh& mesh, const std::vector<std::size_t>& first) {
  for (std::size_t e = 0; e < mesh.types.size(); ++e) {
    const Index* corners = &mesh.connectivity[first[e]];
    const auto at = [&](Index corner) {
      return Vec3::load(&mesh.coordinates[3 * static_cast<std::size_t>(corners[corner])]);
    };
    for (const CornerFrame& f : bulk_shape(mesh.types[e])->frames) {
      const Vec3 a = at(f[1]) - at(f[0]);
      const Vec3 b = at(f[2]) - at(f[0]);
      const Vec3 c = at(f[3]) - at(f[0]);
      const double volume = dot(cross(a, b), c);
      const double size = norm(a) * norm(b) * norm(c);
      if (!(volume > kFlat * size)) refuse_shape(mesh, e, f[0], corners[f[0]], volume < -kFlat * size);
    }
  }
}

struct StoredFacet {
  std::array<Index, 4> sorted;   ///< kNone first for a triangle
  std::array<Index, 4> outward;  ///< rotated to start at the smallest node
  FacetUse use;
};

StoredFacet stored_facet(const Index* corners, std::span<const std::uint8_t> facet, FacetUse use) {
  StoredFacet stored{{kNone, kNone, kNone, kNone}, {kNone, kNone, kNone, kNone}, use};
  for (std::size_t i = 0; i < facet.size(); ++i) stored.outward[i] = corners[facet[i]];
  stored.sorted = stored.outward;
  std::sort(stored.sorted.begin(), stored.sorted.end());
  const auto end = stored.outward.begin() + static_cast<std::ptrdiff_t>(facet.size());
  std::rotate(stored.outward.begin(), std::min_element(stored.outward.begin(), end), end);
  return stored;
}

std::string facet_text(const StoredFacet& facet) {
  std::string text;
  for (const Index node : facet.sorted) {
    if (node != kNone) text += (text.empty() ? "" : ", ") + numbered(node);
  }
  return "the facet of nodes " + text;
}

/// Facets in buckets by their smallest node: time and memory linear in the elements.
void check_facets(const Mesh& mesh, const std::vector<std::size_t>& first) {
  std::vector<std::size_t> start(static_cast<std::size_t>(mesh.node_count()) + 1, 0);
  const auto for_each_facet = [&](auto&& visit) {
    for (std::size_t e = 0; e < mesh.types.size(); ++e) {
      const ElementTemplate& shape = element_template(mesh.types[e]);
      for (Index f = 0; f < shape.facet_count; ++f) {
        visit(stored_facet(&mesh.connectivity[first[e]], shape.facet(f), {static_cast<Index>(e), f}));
      }
    }
  };
  for_each_facet([&](const StoredFacet& f) { ++start[static_cast<std::size_t>(f.outward[0]) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<StoredFacet> facets(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for_each_facet([&](const StoredFacet& f) { facets[next[static_cast<std::size_t>(f.outward[0])]++] = f; });

  for (std::size_t node = 0; node + 1 < start.size(); ++node) {
    for (std::size_t i = start[node]; i < start[node + 1]; ++i) {
      std::size_t others = 0;
      const StoredFacet* mate = nullptr;
      for (std::size_t j = start[node]; j < start[node + 1]; ++j) {
        if (j == i || facets[j].sorted != facets[i].sorted) continue;
        if (++others == 2) {
          refuse(facet_text(facets[i]) + " is shared by elements " + numbered(facets[i].use.element) + ", " +
                 numbered(mate->use.element) + " and " + numbered(facets[j].use.element) +
                 "; at most two may share one, remove or separate the others");
        }
        mate = &facets[j];
      }
      if (mate && mate->outward == facets[i].outward) {
        refuse("elements " + numbered(facets[i].use.element) + " and " + numbered(mate->use.element) +
               " lie on the same side of " + facet_text(facets[i]).substr(4) +
               "; they overlap, remove one of them");
      }
    }
  }
}

void check_sets(const Mesh& mesh) {
  std::set<std::string> names;
  for (const std::string& name : mesh.part_names) {
    if (name.empty()) refuse("a part has no name; give it one");
    if (!names.insert(name).second) refuse("two parts are named '" + name + "'; rename one");
  }
  names.clear();
  for (const NodeSet& set : mesh.node_sets) {
    if (!names.insert(set.name).second) refuse("two node sets are named '" + set.name + "'; rename one");
    for (const Index node : set.nodes) {
      if (node < 0 || node >= mesh.node_count()) {
        refuse("node set '" + set.name + "': node " + numbered(node) +
               " does not exist (nodes are numbered " + numbered(0) + " to " +
               numbered(mesh.node_count() - 1) + ")");
      }
    }
  }
  names.clear();
  for (const FacetSet& set : mesh.facet_sets) {
    if (!names.insert(set.name).second) refuse("two facet sets are named '" + set.name + "'; rename one");
    for (const FacetUse& use : set.facets) {
      if (use.element < 0 || use.element >= mesh.element_count()) {
        refuse("facet set '" + set.name + "': element " + numbered(use.element) +
               " does not exist (elements are numbered " + numbered(0) + " to " +
               numbered(mesh.element_count() - 1) + ")");
      }
      const ElementType type = mesh.types[static_cast<std::size_t>(use.element)];
      const Index facets = element_template(type).facet_count;
      if (use.facet < 0 || use.facet >= facets) {
        refuse("facet set '" + set.name + "': element " + numbered(use.element) + " is a " +
               bulk_shape(type)->name + " and has no facet " + numbered(use.facet) + " (they are numbered " +
               numbered(0) + " to " + numbered(facets - 1) + ")");
      }
    }
  }
}

/// Part of each node (of the element named last), kNone for a node that no element uses.
std::vector<Index> part_of_nodes(const Mesh& mesh, const std::vector<std::size_t>& first) {
  std::vector<Index> part(static_cast<std::size_t>(mesh.node_count()), kNone);
  for (std::size_t e = 0; e < mesh.types.size(); ++e) {
    for (std::size_t i = first[e]; i < first[e + 1]; ++i) {
      part[static_cast<std::size_t>(mesh.connectivity[i])] = mesh.parts[e];
    }
  }
  return part;
}

void warn_unused(const std::vector<Index>& part, std::vector<std::string>& warnings) {
  const auto unused = std::count(part.begin(), part.end(), kNone);
  if (unused == 0) return;
  const auto first = std::find(part.begin(), part.end(), kNone) - part.begin();
  warnings.push_back(std::to_string(unused) + (unused == 1 ? " node is" : " nodes are") +
                     " used by no element (first: node " + std::to_string(first) + "); " +
                     (unused == 1 ? "it has" : "they have") + " no mass and will not move");
}

/// Parts that touch by contact may well have nodes at the same place; within a part it is a forgotten merge.
void warn_coincident(const Mesh& mesh, const std::vector<Index>& part, std::vector<std::string>& warnings) {
  std::vector<Index> order;
  for (Index n = 0; n < mesh.node_count(); ++n) {
    if (part[static_cast<std::size_t>(n)] != kNone) order.push_back(n);
  }
  const auto key = [&](Index n) {
    const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    return std::tuple(part[static_cast<std::size_t>(n)], x[0], x[1], x[2]);
  };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
  Index pairs = 0;
  std::array<Index, 2> example{kNone, kNone};
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (key(order[i - 1]) != key(order[i])) continue;
    if (pairs++ == 0) example = {order[i - 1], order[i]};
  }
  if (pairs == 0) return;
  warnings.push_back(std::to_string(pairs) + (pairs == 1 ? " pair" : " pairs") +
                     " of nodes of one part at the same place (first: nodes " + std::to_string(example[0]) +
                     " and " + std::to_string(example[1]) + " at " + point(mesh, example[0]) +
                     "); merge them unless a crack is meant there");
}

}  // namespace

std::vector<std::string> check_mesh(const Mesh& mesh) {
  const std::vector<std::size_t> first = check_sizes(mesh);
  check_numbers(mesh, first);
  check_sets(mesh);
  check_shapes(mesh, first);
  check_facets(mesh, first);
  std::vector<std::string> warnings;
  const std::vector<Index> part = part_of_nodes(mesh, first);
  warn_unused(part, warnings);
  warn_coincident(mesh, part, warnings);
  return warnings;
}

}  // namespace cdfp
