/// TopS: a compact adjacency-based mesh structure (Celes, Paulino, Espinha 2005; Paulino et al. 2008).
///
/// Elements and nodes are stored; facets, edges and vertices are implicit and named by oriented uses of an
/// element through its template. Bulk elements come first and keep their numbers; each cohesive insertion
/// appends one cohesive element. Every query costs time proportional to its answer.
///
/// Corners and local facets (outward order: the right-hand normal points out of the element):
///   hexahedron    0-1-2-3 bottom, 4-5-6-7 above   0 = 0321, 1 = 4567, 2 = 0154, 3 = 1265, 4 = 2376, 5 = 3047
///   tetrahedron   normal of 0-1-2 points to 3     0 = 021, 1 = 013, 2 = 123, 3 = 203
///   wedge         0-1-2 bottom, 3-4-5 above       0 = 021, 1 = 345, 2 = 0143, 3 = 1254, 4 = 2035
///   pyramid       0-1-2-3 base, 4 apex            0 = 0321, 1 = 014, 2 = 124, 3 = 234, 4 = 304
///   cohesive      upper face, then lower face     0 = 0123 (012) upper, 1 = 4765 (354) lower
/// Right-hand normals of bottom and base (0-1-2 of wedge and pyramid too) point into the element.
/// Local edges: around the bottom (base, upper face), around the top (lower face), then bottom to top.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cdfp/mesh.hpp"
#include "cdfp/types.hpp"

namespace cdfp {

struct EdgeUse {
  Index element = kNone;
  Index edge = kNone;
  friend bool operator==(const EdgeUse&, const EdgeUse&) = default;
};

struct VertexUse {
  Index element = kNone;
  Index corner = kNone;
  friend bool operator==(const VertexUse&, const VertexUse&) = default;
};

/// The corners of a facet, in outward order for the element that uses it.
struct FacetNodes {
  std::array<Index, 4> nodes{kNone, kNone, kNone, kNone};
  Index count = 0;
  std::span<const Index> view() const& { return {nodes.data(), static_cast<std::size_t>(count)}; }
  std::span<const Index> view() const&& = delete;
};

/// What one cohesive insertion changed; a driver updates its own arrays from it.
struct Insertion {
  struct NewNode {
    Index node;
    Index mother;  ///< the node that it was copied from
  };
  struct Renumbered {
    Index element;  ///< bulk or cohesive
    Index corner;
    Index old_node;
    Index new_node;
  };
  Index cohesive_element = kNone;
  FacetUse lower;  ///< facet of the bulk element with the smaller number; the cohesive normal leaves it
  FacetUse upper;
  std::vector<NewNode> new_nodes;      ///< in the order of their numbers
  std::vector<Renumbered> renumbered;  ///< corners, of elements that stood before, that now name a new node
  /// Edge i of `lower` (from corner i of its outward order to the next) came apart: the two elements are no
  /// longer connected around it without crossing a cohesive element.
  std::array<bool, 4> split_edges{};
};

/// A facet, edge or vertex has as many uses as elements; it is anchored at the use by its lowest-numbered
/// bulk element, which names it once. The two faces of a cohesive element are two facets. The elements of one
/// edge are those connected around it without crossing a cohesive element; a vertex is a node.
///
/// Uses stay valid for good, since elements keep their numbers; spans hold until the next insertion. Queries
/// expect uses and nodes that exist, allocate nothing but what the caller's vector needs (nodes with more
/// than 32 elements excepted) and may run in several threads at once.
class Topology {
 public:
  /// `connectivity` holds the corners of all elements, one after the other, as in `Mesh`.
  /// Throws `Error(bad_mesh)` for node numbers out of range, an element that names a node twice, types that
  /// are not bulk types, facets shared by more than two elements or by two in the same sense.
  Topology(Index node_count, std::span<const ElementType> types, std::span<const Index> connectivity);
  ~Topology();
  Topology(Topology&&) noexcept;
  Topology& operator=(Topology&&) noexcept;

  Index node_count() const;
  Index element_count() const;  ///< bulk and cohesive
  Index bulk_count() const;

  ElementType type(Index element) const;
  std::span<const Index> nodes(Index element) const;
  Index facet_count(Index element) const;
  Index edge_count(Index element) const;
  FacetNodes facet_nodes(FacetUse use) const;
  std::array<Index, 2> edge_nodes(EdgeUse use) const;
  /// The edge from corner `side` of a facet's outward order to the next.
  EdgeUse facet_edge(FacetUse use, Index side) const;

  /// The facet on the other side (`f[E]`): of a cohesive element if one stands between, `{kNone, kNone}` at
  /// the boundary. A cohesive element's facet 0 is its upper face, facet 1 its lower face.
  FacetUse mate(FacetUse use) const;

  /// Elements around an edge in cyclic order (`e[E]`), starting with the given use and turning right-handed
  /// about its direction; an open cycle starts at its first element instead. Cohesive elements are part of
  /// the cycle, by the edge of the face that comes first.
  void elements_around(EdgeUse use, std::vector<EdgeUse>& out) const;
  /// Facets around an edge (anchored), in the order in which `elements_around` leaves the elements by them;
  /// those of an open cycle start with the boundary facet of its first element.
  void facets_around(EdgeUse use, std::vector<FacetUse>& out) const;
  /// Elements around a vertex as the uncut mesh had it, starting with the given use: all that facets connect
  /// with it, through cohesive elements too.
  void elements_around_vertex(VertexUse use, std::vector<VertexUse>& out) const;

  /// Elements around a node (`N{E}`), in ascending order of element numbers; a cohesive element appears once
  /// for each of its corners that names the node.
  void elements_around_node(Index node, std::vector<VertexUse>& out) const;
  /// Facets (anchored) around a node, in ascending order.
  void facets_around_node(Index node, std::vector<FacetUse>& out) const;
  /// Edges (anchored) around a node, in ascending order.
  void edges_around_node(Index node, std::vector<EdgeUse>& out) const;

  FacetUse anchor(FacetUse use) const;
  EdgeUse anchor(EdgeUse use) const;
  /// `{kNone, kNone}` for a node without elements.
  VertexUse anchor(Index node) const;

  /// The boundary of the mesh as it was given; crack faces do not count.
  bool is_boundary(FacetUse use) const;
  bool is_boundary(EdgeUse use) const;
  bool is_boundary_node(Index node) const;

  /// All facets, edges and vertices, each once by its anchored use, in ascending order of elements (vertices:
  /// of nodes).
  template <class Visit>
  void for_each_facet(Visit&& visit) const {
    for (FacetUse use = next_facet({0, kNone}); use.element != kNone; use = next_facet(use)) visit(use);
  }
  template <class Visit>
  void for_each_edge(Visit&& visit) const {
    for (EdgeUse use = next_edge({0, kNone}); use.element != kNone; use = next_edge(use)) visit(use);
  }
  template <class Visit>
  void for_each_vertex(Visit&& visit) const {
    for (Index node = 0; node < node_count(); ++node) {
      const VertexUse use = anchor(node);
      if (use.element != kNone) visit(use);
    }
  }
  /// The next anchored use, `{kNone, kNone}` after the last.
  FacetUse next_facet(FacetUse use) const;
  EdgeUse next_edge(EdgeUse use) const;

  /// Inserts a cohesive element at an inner facet between two bulk elements; nodes whose elements come apart
  /// are doubled, and the part with the lowest element number keeps the old one. `report` is overwritten (its
  /// storage is reused). Throws `Error(bad_argument)` at a boundary facet, a facet that is cohesive already
  /// and numbers out of range; nothing is changed then.
  void insert_cohesive(FacetUse use, Insertion& report);

  /// The first relation that does not hold, or an empty string.
  std::string check() const;

  /// Bytes held by the structure.
  std::size_t memory() const;

 private:
  struct Store;
  std::unique_ptr<Store> store_;
};

}  // namespace cdfp
