/// Contact as services that work on a caller's own arrays: global search, projection on a face, and the whole
/// sequence of search, penalty and friction. Nothing here needs a model; a topology is a convenience.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"
#include "cdfp/types.hpp"

namespace cdfp {

class Archive;

/// A list that grows without moving what it holds, and keeps its room when it is cleared.
template <class Item, std::size_t kBlockBits>
class GrowingList {
 public:
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }
  void resize(std::size_t size) {
    while (blocks_.size() << kBlockBits < size) blocks_.emplace_back(kBlock);
    size_ = size;
  }
  Item& operator[](std::size_t i) { return blocks_[i >> kBlockBits][i & (kBlock - 1)]; }
  [[gnu::always_inline]] const Item& operator[](std::size_t i) const {
    return blocks_.data()[i >> kBlockBits].data()[i & (kBlock - 1)];
  }
  std::size_t memory() const { return blocks_.size() * kBlock * sizeof(Item); }
  /// For the restart of a simulation.
  template <class Stream>
  void archive(Stream& a, const char* name) {
    std::uint64_t size = size_;
    a(name, size);
    resize(size);
    for (std::size_t first = 0; first < size; first += kBlock) a(name, blocks_[first >> kBlockBits]);
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << kBlockBits;
  std::vector<std::vector<Item>> blocks_;
  std::size_t size_ = 0;
};

/// Pairs as compressed rows, with chains for what an adaptive search adds later.
class PairRows {
 public:
  Index rows() const { return static_cast<Index>(ranges_.size()); }
  std::size_t size() const { return partners_.size() + added_.size(); }
  bool empty(Index row) const { return head_[row] == kNone && ranges_[row].begin == ranges_[row].end; }

  /// `visit(partner)` in a fixed order.
  template <class Visit>
  void for_each(Index row, Visit&& visit) const {
    for (Index i = ranges_[row].begin; i < ranges_[row].end; ++i) visit(partners_[i]);
    for (Index i = head_[row]; i != kNone; i = added_[i].next) visit(added_[i].partner);
  }
  bool contains(Index row, Index partner) const;
  /// All pairs as compressed rows, partners ascending: those of row `r` stand in [start[r], start[r + 1]).
  void compress(std::vector<Index>& start, std::vector<Index>& partners) const;
  std::size_t memory() const;
  void archive(Archive& a);  ///< for the restart of a simulation

  /// Places of rows in the order in which they are searched: bit i stands for place `at + i`.
  struct Places {
    std::uint32_t at = 0, bits = 0;
  };
  /// What one thread found for its share of the partners, one partner after another.
  class Found {
   public:
    /// Of `partners` from `first` on, among `places` places of rows.
    void start(Index first, Index partners, std::size_t places);
    /// What the next partners pair with goes to `room()`, up to `room_size()`, and is counted in `counts()`,
    /// of which a few past the last may be written.
    Places* room() { return found_.data() + count_; }
    std::size_t room_size() const {
      return found_.size() > count_ + kAhead ? found_.size() - count_ - kAhead : 0;
    }
    std::uint32_t* counts() { return counts_.data(); }
    void make_room();
    /// `count` were written there; those of the i-th partner of them end at `ends[i]`.
    void took(std::size_t count, std::span<const Index> ends);
    void add(Index place) {
      if (room_size() == 0) make_room();
      found_[count_++] = {static_cast<std::uint32_t>(place), 1};
      ++counts_[place];
    }
    void end_partner() { ends_.push_back(static_cast<Index>(count_)); }
    std::size_t memory() const {
      return found_.capacity() * sizeof(Places) + (ends_.capacity() + counts_.capacity()) * sizeof(Index);
    }

   private:
    friend class PairRows;
    /// Partners to where their rows go on.
    void scatter(std::span<Index> partners);
    static constexpr std::size_t kSpare = 32;
    /// Of the places, those whose partners are asked for before they are written.
    static constexpr std::size_t kAhead = 64;
    Index first_ = 0, partners_ = 0;
    std::vector<Places> found_;          // as long as its use so far; the first `count_` of them hold
    std::vector<Index> ends_;            // of the partners
    std::vector<std::uint32_t> counts_;  // of partners by place; then where the next one goes
    std::size_t count_ = 0;
  };
  /// Starts anew from what was found, share after share; the first partner is 0. `rows[i]` is the row at
  /// place i. Throws `Error(bad_argument)` if there are more pairs than 32 bits count.
  void assign(std::span<const Index> rows, std::span<Found> shares);
  void add_rows(Index count) {
    ranges_.resize(ranges_.size() + count);
    head_.resize(ranges_.size(), kNone);
  }
  void add(Index row, Index partner) {
    const std::size_t at = added_.size();
    added_.resize(at + 1);
    added_[at] = {partner, head_[row]};
    head_[row] = static_cast<Index>(at);
  }
  void add(Index row, std::span<const Index> partners);
  void add(std::span<const Index> rows, Index partner);

 private:
  struct Range {
    Index begin = 0, end = 0;
  };
  std::vector<Range> ranges_;  // of `partners_`, by row
  std::vector<Index> partners_;
  struct Added {
    Index partner, next;
  };
  std::vector<Index> head_;
  GrowingList<Added, 11> added_;
};

/// What a global search looks at. Entities keep their numbers; new ones are appended.
struct SurfaceView {
  std::span<const double> position;  ///< (n, 3) of all nodes of the mesh, m
  std::span<const Index> nodes;      ///< contact nodes
  std::span<const Index> segments;   ///< (m, 4) corners; a triangle has kNone last
  std::span<const Index> edges;      ///< (e, 2); may be empty
  std::span<const Index>
      groups;         ///< one a node of the mesh; entities of one group >= 0 never pair; may be empty
  Index removed = 0;  ///< segments that were removed: all corners one node, left out of the mean length
};

/// Candidate pairs node-segment and edge-edge (LC-Grid and its adaptive update; Chen, Zang, Xu 2015, section
/// 4.1). A pair is a node in a segment's box grown by the buffer, or two edges whose boxes are at most the
/// buffer apart along every axis; entities that share a node do not pair. The adaptive search takes boxes and
/// nodes of the last regular search where they were then: it may add pairs that have since moved apart. After
/// any insertions and movements until a regular search is due, those of its pairs whose boxes, where they are
/// at that moment, are at most what the travel has left of the buffer apart are exactly those of the pairs of
/// a regular search made at that moment.
///
/// The cells of a row lie side by side in a table that is never longer than twice the entities: where the
/// space has more, rows are folded onto one another. Time and memory are linear in the entities.
class ContactSearch {
 public:
  /// `cell_factor` w1 and `buffer_factor` w2: cell and buffer over the mean segment length.
  /// `adaptive`: whether `adaptive` will be called (keeps the cells of segments and edges).
  ContactSearch(double cell_factor, double buffer_factor, bool adaptive = true);
  ~ContactSearch();
  ContactSearch(ContactSearch&&) noexcept;
  ContactSearch& operator=(ContactSearch&&) noexcept;

  /// The same pairs in the same order for any number of threads.
  void regular(const SurfaceView& surface, int threads = 1);
  /// Gives back the room that a regular search takes while it runs and keeps for the next one (about 100
  /// bytes a segment). For searches that come seldom.
  void give_back_room();
  /// Adds the pairs of the entities appended since the last call, and those of old segments and edges that
  /// now name other nodes at the same place. Cost: the new entities and what lies near them.
  void adaptive(const SurfaceView& surface, std::span<const Index> renamed_segments = {},
                std::span<const Index> renamed_edges = {});

  /// Rule (20): adds 2 v_max dt to the travel since the last regular search; true once it reaches the buffer
  /// (or no search was made yet, or more entities came since than there were).
  bool due(double largest_speed, double step);
  double travel() const;  ///< m, bound on the relative movement since the last regular search
  double buffer() const;  ///< m
  double cell_length() const;

  const PairRows& node_segments() const;  ///< row: position in `nodes`
  const PairRows& edge_edges() const;     ///< row: the smaller edge of each pair
  /// Rows that the last `adaptive` added to (with repetitions).
  std::span<const Index> touched_node_rows() const;
  std::span<const Index> touched_edge_rows() const;
  std::size_t memory() const;
  void archive(Archive& a);  ///< for the restart of a simulation

 private:
  struct Cells;
  std::unique_ptr<Cells> cells_;
};

/// The point of a face closest to a given one, by an exact inverse map.
struct FaceProjection {
  std::array<double, 4> shape{};   ///< of the corners; sum 1
  std::array<double, 3> normal{};  ///< unit, outward, at the point
  double gap = 0;                  ///< m; negative behind the face
  double outside = 0;  ///< m, how far past the face's border (then the shape functions extrapolate)
};
/// `corners`: (3, 3) or (4, 3) in outward order.
FaceProjection project_on_face(std::span<const double, 3> point, std::span<const double> corners);

/// Search, penalty and friction between the segments of a surface (sections 4.1 to 4.4).
class SurfaceContact {
 public:
  struct Segment {
    std::array<Index, 4> nodes{kNone, kNone, kNone, kNone};  ///< outward order; a triangle has kNone last
    Index element = kNone;                                   ///< that owns the face
    Index part = kNone;                                      ///< names the body in messages
    double bulk_modulus = 0;                                 ///< Pa
    double area = 0;                                         ///< m2
    double volume = 0;                                       ///< m3 of the element
  };
  /// Arrays over all nodes of the mesh.
  struct Arrays {
    std::span<const double> position;  ///< (n, 3)
    std::span<const double> velocity;  ///< (n, 3) that led to `position`
    std::span<const double> mass;      ///< (n)
    std::span<const Index> group;      ///< rigid body of each node or kNone; may be empty
    std::span<double> force;           ///< (n, 3); only `add_force` needs it
  };

  explicit SurfaceContact(const ContactSettings& settings);
  ~SurfaceContact();
  SurfaceContact(SurfaceContact&&) noexcept;
  SurfaceContact& operator=(SurfaceContact&&) noexcept;

  /// Its number. Contact edges come where two segments of one element meet.
  Index add_segment(const Segment& segment);
  /// What facets of a topology's bulk elements need as segments, from the undeformed mesh.
  struct FacetSource {
    const Topology& topology;
    std::span<const double> reference;     ///< (n, 3), m: of the nodes as they are numbered now
    std::span<const Index> parts;          ///< part of each bulk element
    std::span<const double> bulk_modulus;  ///< Pa, by part
  };
  /// Facets as segments in their order: the surface at the start, and the free faces of elements beside a
  /// cohesive element that broke. Throws `Error(bad_argument)` naming the facet that is wrong.
  void add_facets(const FacetSource& source, std::span<const FacetUse> facets);
  /// All renames and splits of an insertion in the topology.
  void follow(std::span<const Insertion::NewNode> new_nodes,
              std::span<const Insertion::Renumbered> renumbered);
  /// The element is no more: its segments and edges leave, and what touches them is let go; what their
  /// springs held is heat. Nodes that no segment has left take part in no contact. The faces of its
  /// neighbours that are free now come by `add_facets`. Numbers of segments stay.
  void remove_element(Index element);
  /// `element` names `new_node` where it named `old_node`, at the same place.
  void rename(Index element, Index old_node, Index new_node);
  /// After all renames of a split: the copy takes its share of what holds the mother.
  void split(Index mother, Index copy);

  // Throw `Error(bad_argument)` for arrays that are too short, `Error(bad_state)` for a search that is
  // missing.

  enum class Search { none, regular, adaptive };
  /// Which search the step needs before `local_search`.
  Search due(const Arrays& arrays, double step, int threads = 1);
  void regular_search(const Arrays& arrays, int threads = 1);
  void adaptive_search(const Arrays& arrays);
  void local_search(const Arrays& arrays, int threads = 1);
  void add_force(const Arrays& arrays, double step, int threads = 1);

  Index segment_count() const;  ///< removed ones included
  Index removed_count() const;  ///< segments
  Index edge_count() const;
  Index node_count() const;
  /// Whether the facet is a segment and has not been removed.
  bool has_facet(const Topology& topology, FacetUse facet) const;
  std::span<const Index> nodes() const;     ///< contact nodes: rows of the search's pairs
  std::span<const Index> segments() const;  ///< (m, 4), kNone last in a triangle
  const ContactSearch& search() const;

  /// A pair that touches: the force acts on the first `first_count` nodes by their weights, its opposite on
  /// the others by theirs.
  struct Touch {
    std::array<Index, 5> nodes{};
    std::array<double, 5>
        weights{};          ///< positive on the first side, negative on the other; each side sums to 1
    Index first_count = 1;  ///< 1: node on face; 2: edge on edge
    Index count = 0;
    std::array<double, 3> normal{};  ///< out of the other side
    double gap = 0;                  ///< m, negative
    std::array<double, 3> force{};   ///< N
    Index parts[2] = {kNone, kNone};
  };
  std::vector<Touch> touches() const;
  std::size_t touching_count() const;

  /// Two parts that have touched, or one that touched itself; what their pairs sum to.
  struct BodyPair {
    std::array<Index, 2> parts{kNone, kNone};  ///< ascending
    std::array<double, 3> force{};             ///< N, on the first by the second at the last `add_force`
    double stored = 0;                         ///< J, in springs at the last `add_force`
    double friction_heat = 0;                  ///< J, so far, and what springs of removed segments held
    double peak_force = 0;                     ///< N, so far
    double deepest = 0;                        ///< m, so far
  };
  /// In the order in which they first touched.
  std::span<const BodyPair> body_pairs() const;

  double stored_energy() const;        ///< J, in penalty and stick springs at the last `add_force`
  double friction_heat() const;        ///< J, so far
  double deepest_penetration() const;  ///< m
  void name_parts(std::vector<std::string> names);  ///< for messages
  std::vector<std::string> warnings() const;
  /// 1/s2: bound on omega^2 of the contact springs alone (largest row sum of M^-1 K) at the last `add_force`.
  double stiffness_over_mass() const;
  /// Adds the row sums of M^-1 K, 1/s2, to the numbers of their nodes: an element's omega^2 and the largest
  /// sum at its nodes bound omega^2 of both together. Throws `Error(bad_argument)` if nodes are missing.
  void add_stiffness_over_mass(std::span<double> by_node) const;
  std::size_t memory() const;
  void archive(Archive& a);  ///< for the restart of a simulation

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace cdfp
