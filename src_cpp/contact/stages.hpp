/// What the stages of contact share: surface, candidates, and the pairs that touch.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cdfp/contact.hpp"
#include "contact/projection.hpp"
#include "contact/surface.hpp"
#include "core/parallel.hpp"

namespace cdfp {

/// Springs of a pair that touches. They last as long as the contact does, across searches.
struct Grip {
  double stiffness = 0;  ///< N/m, fixed when the pair first touches, lowered only for stability
  double offset = 0;     ///< m, <= 0: penetration from before the pair was seen; it rises with the gap
  double pressed = 0;    ///< m, <= 0: gap less offset, what compresses the normal spring
  Vec3 stick;            ///< m, stretch of the tangential spring
  /// N, friction on the first side.
  Vec3 drag() const { return -stiffness * stick; }
  double stick_energy() const { return 0.5 * stiffness * dot(stick, stick); }
};

/// The force acts on the first `first_count` nodes by their weights, its opposite on the others by theirs.
struct TouchingPair {
  std::array<Index, 5> nodes{};
  std::uint8_t first_count = 1, count = 0;
  enum class Origin : std::uint8_t {
    same,
    moved,
    fresh
  } origin = Origin::fresh;  ///< moved: springs are another pair's
  bool ignored = false;      ///< edges only
  std::array<double, 5> weights{};
  Index first = kNone, second = kNone;  ///< contact node (row) and segment, or two edges
  std::array<Index, 2> parts{kNone, kNone};
  double gap = 0, height = 0;  ///< m; the segment's, or the lower edge's
  Vec3 normal;
  Vec3 force;
  double stored = 0, heat = 0;
  std::array<float, 5> mass{};  ///< kg
};

struct GrippedPair {
  TouchingPair pair;
  Grip grip;
};

/// Over threads where it pays for waking them.
template <class Body>
void share_out(int threads, std::int64_t n, Body&& body) {
  constexpr std::int64_t kWorthwhile = 256;
  Threads(n < kWorthwhile ? 1 : threads).for_each(n, body);
}

struct SurfaceContact::Stages {
  static constexpr std::int64_t kPiece = 64;  ///< active nodes, or edges that touch: one thread works on them

  explicit Stages(const ContactSettings& s)
      : settings(s), surface(s.penalty_factor), search(s.cell_factor, s.buffer_factor, s.adaptive) {}

  const ContactSettings settings;
  Surface surface;
  ContactSearch search;
  Index searched_nodes = 0, searched_segments = 0, searched_edges = 0;
  std::vector<double> piece_speed;

  SurfaceView view(const Arrays& arrays) const {
    return {arrays.position,
            surface.nodes(),
            surface.segments(),
            settings.edge_edge ? std::span<const Index>(surface.edges()) : std::span<const Index>(),
            arrays.group,
            surface.removed_count()};
  }

  /// What holds a contact node: it touches one face at a time.
  struct Hold {
    Index segment = kNone;
    Index piece = 0, place = 0;  // of its touch among those of the pieces
    float xi = 0, eta = 0;       // about where it was on the face
    Grip grip;
  };
  /// A segment's mean plane, and how far its points lie from centre (when it became a candidate: since then
  /// by the travel more at most) and plane.
  struct alignas(64) Plane {
    Vec3 centre, normal;
    double radius = 0, warp = 0;
  };
  struct Deepest {
    double share = 0, depth = 0;
    Index node = kNone, element = kNone;
    std::array<Index, 2> parts{kNone, kNone};
    bool edges = false;
  };
  /// Over some of the pairs.
  struct Sums {
    std::vector<BodyPair> bodies;
    Deepest worst;
    std::array<Index, 2> nodes;  // the least and the largest that a force acts on
    Sums& start(const Deepest& worst_so_far) {
      bodies.clear();
      worst = worst_so_far;
      nodes = {std::numeric_limits<Index>::max(), -1};
      return *this;
    }
  };
  /// What some of the active nodes touch.
  struct Piece {
    std::vector<TouchingPair> touches;
    std::vector<GrippedPair> ended;  // in this step's local search
    Sums sums;
  };
  /// Edges that touch, by a node of each.
  struct Link {
    std::array<Index, 2> nodes;  // ascending
    GrippedPair* edges;
    bool turned;  // the second side's node comes first
  };
  std::vector<Hold> holds;               // by contact node
  std::vector<double> wake;              // by contact node: travel before which it can't touch
  std::vector<std::uint8_t> has_pairs;   // by contact node
  std::vector<Index> active_nodes;       // with candidates
  std::vector<std::uint8_t> is_partner;  // by segment
  std::vector<Index> active_segments;    // candidates of some node
  std::vector<Plane> planes;             // by segment
  std::vector<Piece> pieces;             // of the active nodes
  std::vector<double> edge_wake;         // by edge
  std::vector<std::uint8_t> edge_has_pairs;
  std::vector<Index> active_edges;
  std::vector<std::array<Index, 4>> edge_hits;  // by active edge: partners, kNone after the last
  std::int32_t stamp = 0;
  std::vector<std::array<Index, 2>> hit_edges;
  std::vector<GrippedPair> ended;        // in this step's local search
  std::vector<std::int32_t> ended_here;  // by contact node: the last step in which a pair with it ended
  std::vector<Link> links;
  std::vector<GrippedPair> edge_touches, old_edge_touches;
  std::vector<Sums> edge_sums;              // by piece of the edges that touch
  std::vector<TouchingPair> removed_pairs;  // since the last forces

  Deepest worst;
  std::vector<BodyPair> body_pairs;
  std::vector<std::string> part_names;

  void need_nodes(std::span<const double> vectors, const char* name) const;
  void grow_to_surface();
  void activate_node(const double* x, Index row);
  void activate_edge(Index edge);

  Vec3 segment_normal(const double* x, Index segment) const;
  void place_plane(const double* x, Index segment);
  double segment_radius(const double* x, Index segment) const;
  FacePoint project(const double* x, Vec3 p, Index segment, double xi = 0, double eta = 0) const;
  Vec3 node_normal(const double* x, Index row) const;
  bool shares_element(Index row, Index segment) const;
  TouchingPair node_pair(Index row, Index segment, const FacePoint& point) const;
  void touch(Index row, Index segment, const FacePoint& point, Piece& piece);
  void let_go(Index row, const FacePoint& under_held, Piece& piece);
  void look_at_node(const double* x, Index row, Piece& piece);
  bool edges_touch(const double* x, Index m, Index n, double& room, TouchingPair* touch) const;
  void look_at_edge(const double* x, Index active);
  void follow_edges();
  void link_edges();
  template <class See>
  void for_each_between(Index a, Index b, See&& see);
  void hand_over();
  void let_go_of_removed();
  void bar_removed();

  double stiffness(const TouchingPair& pair) const;
  void enforce(TouchingPair& pair, Grip& grip, const Arrays& arrays, double step) const;
  void add_to_sums(const TouchingPair& pair, Sums& sums) const;
  void add_to_nodes(const Arrays& arrays, int threads) const;
  void add_to_bodies(const Sums& sums);

  /// `visit(sums, for_each_pair)`, with `for_each_pair(see)` that calls `see(pair, grip)`.
  template <class Visit>
  void for_each_piece(Visit&& visit) const {
    for (const Piece& piece : pieces) {
      visit(piece.sums, [&](auto&& see) {
        for (const TouchingPair& pair : piece.touches) see(pair, holds[pair.first].grip);
      });
    }
    for (std::size_t i = 0; i < edge_sums.size(); ++i) {
      visit(edge_sums[i], [&](auto&& see) {
        const std::size_t end = std::min(edge_touches.size(), (i + 1) * static_cast<std::size_t>(kPiece));
        for (std::size_t k = i * kPiece; k < end; ++k) see(edge_touches[k].pair, edge_touches[k].grip);
      });
    }
  }
  /// `see(pair, grip)`
  template <class See>
  void for_each_pair(See&& see) const {
    for (const Piece& piece : pieces) {
      for (const TouchingPair& pair : piece.touches) see(pair, holds[pair.first].grip);
    }
    for (const GrippedPair& edges : edge_touches) see(edges.pair, edges.grip);
  }
};

}  // namespace cdfp
