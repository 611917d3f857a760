#include <array>
#include <cmath>
#include <numeric>

#include "cdfp/contact.hpp"
#include "cdfp/error.hpp"
#include "contact/box_levels.hpp"
#include "contact/boxes.hpp"
#include "contact/search_kernels.hpp"
#include "core/growth.hpp"
#include "core/parallel.hpp"

namespace cdfp {

namespace {

/// Moves those that pass to the front and returns how many they are.
template <class Test>
std::size_t keep(std::span<Index> ids, const Test& test) {
  std::size_t kept = 0;
  for (const Index id : ids) {
    ids[kept] = id;
    kept += test(id);
  }
  return kept;
}

}  // namespace

/// What is summed together: the same pieces for any number of threads.
constexpr std::int64_t kPiece = 4096;
/// Segments that one call pairs: what it found is still at hand when it is counted.
constexpr std::int64_t kBatch = 512;

/// What a regular search needs while it runs; kept for the next.
struct SearchRoom {
  std::vector<Float4> points;
  std::vector<Index> names_in_cells;
  std::vector<RoughBox> boxes, edge_boxes, spaces;
  std::vector<double> lengths;          // sums over pieces
  std::vector<PairRows::Found> shares;  // by thread
};

struct ContactSearch::Cells : SearchRoom {
  double cell_factor, buffer_factor;
  bool open;
  bool searched = false;
  double buffer = 0, length = 0, travel = 0;
  std::size_t entities_then = 0;
  Index nodes = 0, segments = 0, edges = 0;  // taken in so far

  const SearchKernels& kernels = choose_search_kernels();
  Corner origin{};
  Rough rough;
  CellTable<false> node_cells;
  BoxLevels segment_cells, edge_cells;
  PairRows node_segments, edge_edges;
  std::vector<Index> touched_nodes, touched_edges;
  std::vector<Index> hits, rows_of_segment;  // of looks at the cells
  std::vector<std::size_t> hits_end;
  // As the last call left them, for what a renamed entity was named before.
  std::vector<Index> row_of_node, corners_then, ends_then;

  static bool may_pair(const SurfaceView& s, Index a, Index b) {
    return a != b && (s.groups.empty() || s.groups[a] < 0 || s.groups[a] != s.groups[b]);
  }
  static bool names(const Index* corners, Index node) {
    return any_equal(Int4{corners[0], corners[1], corners[2], corners[3]}, node - Int4{});
  }
  static bool share_node(const Index* a, const Index* b) {
    return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
  }
  bool edges_may_touch(const SurfaceView& s, Index m, Index n) const {
    const Index *a = ends_of(s, m), *b = ends_of(s, n);
    return !share_node(a, b) && may_pair(s, a[0], b[0]) && edge_box(s, m).overlaps(edge_box(s, n));
  }
  Box segment_box(const SurfaceView& s, Index segment) const {
    Box box = box_of(s, corners_of(s, segment), 4);
    box.grow(buffer);
    return box;
  }
  Box edge_box(const SurfaceView& s, Index edge) const {
    Box box = box_of(s, ends_of(s, edge), 2);
    box.grow(0.5 * buffer);
    return box;
  }
  /// What `find(found)` adds to the first `begin` in `room`.
  template <class Find>
  static std::span<Index> collect(std::vector<Index>& room, std::size_t begin, const Find& find) {
    for (;;) {
      FoundIds found{room.data(), begin, room.size()};
      find(found);
      if (!found.full()) return std::span(room).subspan(begin, found.count - begin);
      room.resize(2 * room.size() + 1024);
    }
  }
  /// The edges that may overlap a box, each once.
  std::span<Index> edges_about(const RoughBox& box, std::vector<Index>& room) const {
    return collect(room, 0, [&](FoundIds& found) {
      edge_cells.visit(box,
                       [&](const auto& cells, Float4 low) { kernels.find_boxes(cells, low, box, found); });
    });
  }
  ExactPairs exact(const SurfaceView& s) const {
    return {s.nodes.data(), s.segments.data(), s.position.data(), buffer};
  }
  void pair_renamed_segments(const SurfaceView& s, std::span<const Index> renamed);
  void pair_new_nodes(const SurfaceView& s, Index end);
  void pair_new_segments(const SurfaceView& s, Index end);

  /// `search(begin, end, found)` over the partners, a share for each thread.
  template <class Search>
  void search_shares(const Threads& threads, Index partners, std::size_t places, const Search& search) {
    shares.resize(threads.count());
    threads.for_each(threads.count(), [&](std::int64_t t) {
      const std::int64_t begin = partners * t / threads.count(), end = partners * (t + 1) / threads.count();
      shares[t].start(static_cast<Index>(begin), static_cast<Index>(end - begin), places);
      search(begin, end, shares[t]);
    });
  }

  void regular(const SurfaceView& s, const Threads& threads);
  RoughBox place_nodes(const SurfaceView& s, const Threads& threads);
  void place_segments(const SurfaceView& s, const Threads& threads);
  void pair_edges(const SurfaceView& s, const RoughBox& space, const Threads& threads);
  void remember_names(const SurfaceView& s);
  void adaptive(const SurfaceView& s, std::span<const Index> renamed_segments,
                std::span<const Index> renamed_edges);
  void add_edge_pair(Index m, Index n) {
    edge_edges.add(std::min(m, n), std::max(m, n));
    touched_edges.push_back(std::min(m, n));
  }
};

RoughBox ContactSearch::Cells::place_nodes(const SurfaceView& s, const Threads& threads) {
  origin = middle(s);
  rough = {Double2{origin[0], origin[1]}, Double2{origin[2], 0}};
  points.resize(s.nodes.size());
  spaces.resize((nodes + kPiece - 1) / kPiece);
  threads.for_ranges(nodes, kPiece, [&](std::int64_t begin, std::int64_t end) {
    spaces[begin / kPiece] =
        kernels.place_nodes(s.nodes.data(), s.position.data(), origin.data(), begin, end, points.data());
  });
  if (nodes == 0) return {Float4{}, Float4{}};
  RoughBox space = spaces[0];
  for (const RoughBox& piece : spaces) {
    space = {lesser(space.low, piece.low), greater(space.high, piece.high)};
  }
  return space;
}

/// Boxes, buffer and cell length.
void ContactSearch::Cells::place_segments(const SurfaceView& s, const Threads& threads) {
  boxes.resize(segments);
  lengths.assign((segments + kPiece - 1) / kPiece, 0);
  threads.for_ranges(segments, kPiece, [&](std::int64_t begin, std::int64_t end) {
    lengths[begin / kPiece] =
        kernels.place_segments(s.segments.data(), s.position.data(), origin.data(), begin, end, boxes.data());
  });
  double sum = 0;
  for (const double piece : lengths) sum += piece;
  const double mean = segments > s.removed ? sum / (segments - s.removed) : 0;
  if (!std::isfinite(mean)) {
    throw Error(Status::diverged,
                "contact search: a segment's corner has a position that is not finite; reduce the step");
  }
  length = mean > 0 ? cell_factor * mean : 1;
  buffer = buffer_factor * mean;
}

void ContactSearch::Cells::regular(const SurfaceView& s, const Threads& threads) {
  nodes = static_cast<Index>(s.nodes.size());
  segments = static_cast<Index>(s.segments.size() / 4);
  edges = static_cast<Index>(s.edges.size() / 2);
  searched = true;
  travel = 0;
  entities_then = s.nodes.size() + segments + edges;
  touched_nodes.clear();
  touched_edges.clear();

  const RoughBox space = place_nodes(s, threads);
  place_segments(s, threads);
  const auto cell = static_cast<float>(length);
  node_cells.reset(space, 2 * cell, points.size());
  node_cells.build(kernels, points, s.nodes, names_in_cells, open);

  const float grow = static_cast<float>(buffer * (1 + 1e-6));
  const NodePairs job{node_cells.layout(),
                      node_cells.first(),
                      node_cells.places(),
                      node_cells.stride(),
                      points.size(),
                      names_in_cells.data(),
                      s.segments.data(),
                      s.position.data(),
                      s.groups.empty() ? nullptr : s.groups.data(),
                      boxes.data(),
                      grow,
                      buffer};
  search_shares(threads, segments, nodes, [&](std::int64_t begin, std::int64_t end, PairRows::Found& here) {
    std::array<Index, kBatch> ends;
    for (std::int64_t m = begin; m < end;) {
      FoundPlaces found{here.room(), 0, here.room_size()};
      const std::int64_t done =
          kernels.pair_nodes(job, m, std::min(end, m + kBatch), found, ends.data(), here.counts());
      here.took(found.count, std::span(ends).first(done - m));
      if (done < std::min(end, m + kBatch)) here.make_room();
      m = done;
    }
  });
  node_segments.assign(node_cells.ids(), shares);
  if (open) {
    segment_cells.reset(space, 2 * length);
    segment_cells.build(boxes, grow, true);
    remember_names(s);
  }
  pair_edges(s, space, threads);
}

void ContactSearch::Cells::pair_edges(const SurfaceView& s, const RoughBox& space, const Threads& threads) {
  edge_boxes.resize(edges);
  threads.for_ranges(edges, kPiece, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      const auto edge = static_cast<Index>(e);
      edge_boxes[e] = rough(edge_box(s, edge));
    }
  });
  edge_cells.reset(space, 1.5 * length);
  edge_cells.build(edge_boxes, 0, open);
  search_shares(threads, edges, edges, [&](std::int64_t begin, std::int64_t end, PairRows::Found& here) {
    std::vector<Index> near_by;
    for (std::int64_t e = begin; e < end; ++e) {
      const auto edge = static_cast<Index>(e);
      for (const Index other : edges_about(edge_boxes[e], near_by)) {
        if (other < edge && edges_may_touch(s, other, edge)) here.add(other);
      }
      here.end_partner();
    }
  });
  std::vector<Index> in_order(edges);
  std::iota(in_order.begin(), in_order.end(), 0);
  edge_edges.assign(in_order, shares);
}

void ContactSearch::Cells::remember_names(const SurfaceView& s) {
  row_of_node.assign(s.position.size() / 3, kNone);
  for (Index row = 0; row < nodes; ++row) row_of_node[s.nodes[row]] = row;
  corners_then.assign(s.segments.begin(), s.segments.end());
  ends_then.assign(s.edges.begin(), s.edges.end());
}

/// They lie where they did: of the old nodes only their former corners are new to them.
void ContactSearch::Cells::pair_renamed_segments(const SurfaceView& s, std::span<const Index> renamed) {
  constexpr std::size_t kAhead = 8;
  for (std::size_t i = 0; i < renamed.size(); ++i) {
    const Index ahead = renamed[std::min(i + kAhead, renamed.size() - 1)], m = renamed[i];
    if (ahead < segments) __builtin_prefetch(&corners_then[4 * static_cast<std::size_t>(ahead)], 1);
    if (m >= segments) continue;
    const Index* const corners = corners_of(s, m);
    Index* const then = &corners_then[4 * static_cast<std::size_t>(m)];
    for (unsigned differ = 15U & ~lane_bits(load4(corners) == load4(then), Int4{}); differ != 0;
         differ &= differ - 1) {
      const Index former = then[__builtin_ctz(differ)];
      const Index row = former < static_cast<Index>(row_of_node.size()) ? row_of_node[former] : kNone;
      if (row == kNone || names(corners, former) || !may_pair(s, former, corners[0])) continue;
      node_segments.add(row, m);
      touched_nodes.push_back(row);
    }
    std::copy_n(corners, 4, then);
  }
}

/// With the old segments.
void ContactSearch::Cells::pair_new_nodes(const SurfaceView& s, Index end) {
  hits_end.clear();
  std::size_t count = 0;
  for (Index row = nodes; row < end; ++row) {
    const Index node = s.nodes[row];
    const Float4 at = rough(place(s, node));
    const std::span<Index> near_by = collect(hits, count, [&](FoundIds& found) {
      segment_cells.visit({at, at}, [&](const auto& cells, Float4 low) {
        kernels.find_segments(cells, low, at, exact(s), node, found);
      });
    });
    for (const Index m : near_by) __builtin_prefetch(corners_of(s, m));
    count += near_by.size();
    hits_end.push_back(count);
    node_cells.insert(at, row);
    row_of_node[node] = row;
  }
  count = 0;
  for (Index row = nodes; row < end; ++row) {
    const Index node = s.nodes[row];
    const std::span<Index> near_by = std::span(hits).subspan(count, hits_end[row - nodes] - count);
    count = hits_end[row - nodes];
    std::size_t foreign = keep(near_by, [&](Index m) { return !names(corners_of(s, m), node); });
    if (!s.groups.empty()) {
      foreign = keep(near_by.first(foreign), [&](Index m) { return may_pair(s, node, corners_of(s, m)[0]); });
    }
    node_segments.add(row, near_by.first(foreign));
    if (foreign > 0) touched_nodes.push_back(row);
  }
  nodes = end;
}

void ContactSearch::Cells::pair_new_segments(const SurfaceView& s, Index end) {
  Box box_before{};
  std::span<Index> inside;
  for (Index m = segments; m < end; ++m) {
    const Index* const corners = corners_of(s, m);
    const Box box = segment_box(s, m);
    const RoughBox rough_box = rough(box);
    // Both faces of a facet that came free hold the same nodes.
    if (m == segments || box.low != box_before.low || box.high != box_before.high) {
      inside = collect(hits, 0, [&](FoundIds& found) {
        kernels.find_rows(node_cells.view(), rough_box, exact(s), box.low.data(), box.high.data(), found);
      });
      box_before = box;
    }
    rows_of_segment.assign(inside.begin(), inside.end());
    std::size_t foreign = keep(rows_of_segment, [&](Index row) { return !names(corners, s.nodes[row]); });
    if (!s.groups.empty()) {
      foreign = keep(std::span(rows_of_segment).first(foreign),
                     [&](Index row) { return may_pair(s, s.nodes[row], corners[0]); });
    }
    node_segments.add(std::span(rows_of_segment).first(foreign), m);
    touched_nodes.insert(touched_nodes.end(), rows_of_segment.begin(), rows_of_segment.begin() + foreign);
    segment_cells.insert(rough_box, m);
    make_room(corners_then, corners_then.size() + 4);
    corners_then.insert(corners_then.end(), corners, corners + 4);
  }
  segments = end;
}

void ContactSearch::Cells::adaptive(const SurfaceView& s, std::span<const Index> renamed_segments,
                                    std::span<const Index> renamed_edges) {
  touched_nodes.clear();
  touched_edges.clear();
  const Index new_nodes = static_cast<Index>(s.nodes.size());
  const Index new_segments = static_cast<Index>(s.segments.size() / 4);
  const Index new_edges = static_cast<Index>(s.edges.size() / 2);
  pair_renamed_segments(s, renamed_segments);

  node_segments.add_rows(new_nodes - nodes);
  if (row_of_node.size() < s.position.size() / 3) row_of_node.resize(s.position.size() / 3, kNone);
  pair_new_nodes(s, new_nodes);
  pair_new_segments(s, new_segments);

  // A renamed edge pairs anew with those that shared a node with it and do so no more.
  for (const Index e : renamed_edges) {
    if (e >= edges) continue;
    Index* then = &ends_then[2 * static_cast<std::size_t>(e)];
    for (const Index other : edges_about(rough(edge_box(s, e)), hits)) {
      if (other == e || !share_node(then, &ends_then[2 * static_cast<std::size_t>(other)])) continue;
      if (edges_may_touch(s, other, e)) add_edge_pair(other, e);
    }
    std::copy_n(ends_of(s, e), 2, then);
  }
  edge_edges.add_rows(new_edges - edges);
  for (Index e = edges; e < new_edges; ++e) {
    const RoughBox box = rough(edge_box(s, e));
    for (const Index other : edges_about(box, hits)) {
      if (edges_may_touch(s, other, e)) add_edge_pair(other, e);
    }
    edge_cells.insert(box, e);
    ends_then.insert(ends_then.end(), ends_of(s, e), ends_of(s, e) + 2);
  }
  edges = new_edges;
}

ContactSearch::ContactSearch(double cell_factor, double buffer_factor, bool adaptive)
    : cells_(std::make_unique<Cells>()) {
  if (!(cell_factor > 0) || !(buffer_factor > 0)) {
    throw Error(Status::bad_argument,
                "contact search: cell and buffer factor must be positive (1.0 and 0.4 are usual)");
  }
  cells_->cell_factor = cell_factor;
  cells_->buffer_factor = buffer_factor;
  cells_->open = adaptive;
}
ContactSearch::~ContactSearch() = default;
ContactSearch::ContactSearch(ContactSearch&&) noexcept = default;
ContactSearch& ContactSearch::operator=(ContactSearch&&) noexcept = default;

void ContactSearch::regular(const SurfaceView& surface, int threads) {
  cells_->regular(surface, Threads(threads));
}
void ContactSearch::adaptive(const SurfaceView& surface, std::span<const Index> renamed_segments,
                             std::span<const Index> renamed_edges) {
  if (!cells_->searched || !cells_->open) {
    throw Error(Status::bad_state,
                "contact search: an adaptive search needs a regular one before it, and a search made for it");
  }
  cells_->adaptive(surface, renamed_segments, renamed_edges);
}

void ContactSearch::give_back_room() {
  Cells& c = *cells_;
  static_cast<SearchRoom&>(c) = SearchRoom{};
  c.node_cells.give_back_room();
  c.segment_cells.give_back_room();
  c.edge_cells.give_back_room();
}

bool ContactSearch::due(double largest_speed, double step) {
  Cells& c = *cells_;
  c.travel += 2 * largest_speed * step;
  const std::size_t now = static_cast<std::size_t>(c.nodes) + c.segments + c.edges;
  return !c.searched || c.travel >= c.buffer || now > 2 * c.entities_then + 1000;
}
double ContactSearch::travel() const {
  return cells_->travel;
}
double ContactSearch::buffer() const {
  return cells_->buffer;
}
double ContactSearch::cell_length() const {
  return cells_->length;
}
const PairRows& ContactSearch::node_segments() const {
  return cells_->node_segments;
}
const PairRows& ContactSearch::edge_edges() const {
  return cells_->edge_edges;
}
std::span<const Index> ContactSearch::touched_node_rows() const {
  return cells_->touched_nodes;
}
std::span<const Index> ContactSearch::touched_edge_rows() const {
  return cells_->touched_edges;
}
void ContactSearch::archive(Archive& a) {
  Cells& c = *cells_;
  a("search.searched", c.searched);
  a("search.buffer", c.buffer);
  a("search.length", c.length);
  a("search.travel", c.travel);
  a("search.entities_then", c.entities_then);
  a("search.nodes", c.nodes);
  a("search.segments", c.segments);
  a("search.edges", c.edges);
  a("search.origin", c.origin);
  a("search.rough", c.rough);
  c.node_cells.archive(a);
  c.segment_cells.archive(a);
  c.edge_cells.archive(a);
  c.node_segments.archive(a);
  c.edge_edges.archive(a);
  a("search.touched_nodes", c.touched_nodes);
  a("search.touched_edges", c.touched_edges);
  a("search.row_of_node", c.row_of_node);
  a("search.corners_then", c.corners_then);
  a("search.ends_then", c.ends_then);
}

std::size_t ContactSearch::memory() const {
  const Cells& c = *cells_;
  std::size_t pairs = 0;
  for (const PairRows::Found& share : c.shares) pairs += share.memory();
  return c.node_cells.memory() + c.segment_cells.memory() + c.edge_cells.memory() + c.node_segments.memory() +
         c.edge_edges.memory() + c.points.capacity() * sizeof(Float4) +
         (c.boxes.capacity() + c.edge_boxes.capacity()) * sizeof(RoughBox) + pairs +
         (c.row_of_node.capacity() + c.corners_then.capacity() + c.ends_then.capacity()) * sizeof(Index);
}

}  // namespace cdfp
