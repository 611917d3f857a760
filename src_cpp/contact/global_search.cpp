#include <cmath>
#include <limits>

#include "cdfp/contact.hpp"
#include "cdfp/error.hpp"
#include "contact/cell_table.hpp"

namespace cdfp {

namespace {

Corner place(const SurfaceView& surface, Index node) {
  const double* x = &surface.position[3 * static_cast<std::size_t>(node)];
  return {x[0], x[1], x[2]};
}

struct Box {
  Corner low, high;
  void include(const Corner& x) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  }
  void grow(double by) {
    for (int d = 0; d < 3; ++d) low[d] -= by, high[d] += by;
  }
  double longest() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }
};

const Index* corners_of(const SurfaceView& surface, Index segment) {
  return &surface.segments[4 * static_cast<std::size_t>(segment)];
}
const Index* ends_of(const SurfaceView& surface, Index edge) {
  return &surface.edges[2 * static_cast<std::size_t>(edge)];
}

Box box_of(const SurfaceView& surface, const Index* nodes, int count) {
  const Corner x = place(surface, nodes[0]);
  Box box{x, x};
  for (int i = 1; i < count && nodes[i] != kNone; ++i) box.include(place(surface, nodes[i]));
  return box;
}

/// sqrt of a segment's area: half the cross product of a quadrilateral's diagonals.
double segment_length(const SurfaceView& surface, const Index* nodes) {
  const bool triangle = nodes[3] == kNone;
  const Corner a = place(surface, nodes[0]), b = place(surface, nodes[1]), c = place(surface, nodes[2]);
  const Corner d = triangle ? a : place(surface, nodes[3]);
  const Corner p{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const Corner q{d[0] - b[0], d[1] - b[1], d[2] - b[2]};
  const double x = p[1] * q[2] - p[2] * q[1], y = p[2] * q[0] - p[0] * q[2], z = p[0] * q[1] - p[1] * q[0];
  return std::sqrt(0.5 * std::sqrt(x * x + y * y + z * z));
}

/// Boxes in tables by size: level j holds those no longer than `base * 2^j` along any axis, each in the cell
/// of its lowest corner, so a query needs to reach back by one cell only.
class BoxLevels {
 public:
  void reset(const Corner& low, const Corner& high, double base) {
    low_ = low, high_ = high, base_ = base;
    levels_.clear();
  }
  void build(std::span<const BoxEntry> boxes, bool open) {
    std::vector<std::vector<BoxEntry>> by_level;
    for (const BoxEntry& box : boxes) {
      const std::size_t level = level_of(Box{box.low, box.high}.longest());
      if (by_level.size() <= level) by_level.resize(level + 1);
      by_level[level].push_back(box);
    }
    for (std::size_t level = 0; level < by_level.size(); ++level) make_level(by_level[level], open);
  }
  void insert(const BoxEntry& box) {
    const std::size_t level = level_of(Box{box.low, box.high}.longest());
    while (levels_.size() <= level) make_level({}, true);
    levels_[level].insert(box);
  }
  /// `report(entry)` once for every box that overlaps [low, high].
  template <class Report>
  void visit(const Corner& low, const Corner& high, Report&& report) const {
    double length = base_;
    for (const CellTable<BoxEntry>& level : levels_) {
      if (level.size() > 0) {
        const double back = length * (1 + 1e-6);
        level.visit(
            {low[0] - back, low[1] - back, low[2] - back}, high,
            [&](const BoxEntry& e) { return overlap(e.low, e.high, low, high); }, report);
      }
      length *= 2;
    }
  }
  std::size_t memory() const {
    std::size_t bytes = 0;
    for (const auto& level : levels_) bytes += level.memory();
    return bytes;
  }

 private:
  std::size_t level_of(double extent) const {
    std::size_t level = 0;
    for (double length = base_; length < extent && level < 60; length *= 2) ++level;
    return level;
  }
  void make_level(std::span<const BoxEntry> boxes, bool open) {
    levels_.emplace_back();
    levels_.back().reset(low_, high_, std::ldexp(base_, static_cast<int>(levels_.size()) - 1), boxes.size());
    levels_.back().build(boxes, open);
  }

  Corner low_{}, high_{};
  double base_ = 1;
  std::vector<CellTable<BoxEntry>> levels_;
};

}  // namespace

struct ContactSearch::Cells {
  double cell_factor, buffer_factor;
  bool open;
  bool searched = false;
  double buffer = 0, length = 0, travel = 0;
  std::size_t entities_then = 0;
  Index nodes = 0, segments = 0, edges = 0;  // taken in so far

  CellTable<PointEntry> node_cells;
  BoxLevels segment_cells, edge_cells;
  PairRows node_segments, edge_edges;
  std::vector<Index> touched_nodes, touched_edges;

  std::vector<PointEntry> points;
  std::vector<BoxEntry> boxes;
  std::vector<std::array<Index, 2>> pairs;

  static bool may_pair(const SurfaceView& s, Index a, Index b) {
    return a != b && (s.groups.empty() || s.groups[a] < 0 || s.groups[a] != s.groups[b]);
  }
  static bool node_may_touch(const SurfaceView& s, Index row, const Index* corners) {
    const Index node = s.nodes[row];
    return node != corners[0] && node != corners[1] && node != corners[2] && node != corners[3] &&
           may_pair(s, node, corners[0]);
  }
  static bool edges_may_touch(const SurfaceView& s, Index m, Index n) {
    const Index *a = ends_of(s, m), *b = ends_of(s, n);
    return a[0] != b[0] && a[0] != b[1] && a[1] != b[0] && a[1] != b[1] && may_pair(s, a[0], b[0]);
  }
  BoxEntry segment_entry(const SurfaceView& s, Index segment) const {
    Box box = box_of(s, corners_of(s, segment), 4);
    box.grow(buffer);
    return {box.low, box.high, segment};
  }
  BoxEntry edge_entry(const SurfaceView& s, Index edge) const {
    Box box = box_of(s, ends_of(s, edge), 2);
    box.grow(0.5 * buffer);
    return {box.low, box.high, edge};
  }
  /// `report(row)` for the nodes in a segment's grown box that may touch it.
  template <class Report>
  void nodes_in(const SurfaceView& s, const BoxEntry& box, Report&& report) const {
    const Index* corners = corners_of(s, box.id);
    node_cells.visit(
        box.low, box.high, [&](const PointEntry& p) { return overlap(p.place, p.place, box.low, box.high); },
        [&](const PointEntry& p) {
          if (node_may_touch(s, p.id, corners)) report(p.id);
        });
  }

  void regular(const SurfaceView& s);
  void adaptive(const SurfaceView& s, std::span<const Index> renamed_segments,
                std::span<const Index> renamed_edges);
  void add_edge_pair(Index m, Index n) {
    edge_edges.add(std::min(m, n), std::max(m, n));
    touched_edges.push_back(std::min(m, n));
  }
};

void ContactSearch::Cells::regular(const SurfaceView& s) {
  nodes = static_cast<Index>(s.nodes.size());
  segments = static_cast<Index>(s.segments.size() / 4);
  edges = static_cast<Index>(s.edges.size() / 2);
  searched = true;
  travel = 0;
  entities_then = s.nodes.size() + segments + edges;
  touched_nodes.clear();
  touched_edges.clear();

  double sum = 0;
  boxes.resize(segments);
  for (Index m = 0; m < segments; ++m) {
    const Index* corners = corners_of(s, m);
    const Box box = box_of(s, corners, 4);
    boxes[m] = {box.low, box.high, m};
    sum += segment_length(s, corners);
  }
  const double mean = segments > 0 ? sum / segments : 0;
  if (!std::isfinite(mean)) {
    throw Error(Status::diverged,
                "contact search: a segment's corner has a position that is not finite; reduce the step");
  }
  length = mean > 0 ? cell_factor * mean : 1;
  buffer = buffer_factor * mean;

  constexpr double inf = std::numeric_limits<double>::infinity();
  Box space{{inf, inf, inf}, {-inf, -inf, -inf}};
  points.resize(s.nodes.size());
  for (Index i = 0; i < nodes; ++i) {
    points[i] = {place(s, s.nodes[i]), i};
    space.include(points[i].place);
  }
  if (nodes == 0) space = {{0, 0, 0}, {0, 0, 0}};
  node_cells.reset(space.low, space.high, length, points.size());
  node_cells.build(points, open);

  pairs.clear();
  for (BoxEntry& entry : boxes) {
    Box box{entry.low, entry.high};
    box.grow(buffer);
    entry.low = box.low, entry.high = box.high;
    nodes_in(s, entry, [&](Index row) { pairs.push_back({row, entry.id}); });
  }
  node_segments.assign(nodes, pairs);
  if (open) {
    segment_cells.reset(space.low, space.high, 2 * length);
    segment_cells.build(boxes, true);
  }

  boxes.resize(edges);
  for (Index e = 0; e < edges; ++e) boxes[e] = edge_entry(s, e);
  edge_cells.reset(space.low, space.high, 1.5 * length);
  edge_cells.build(boxes, open);
  pairs.clear();
  for (const BoxEntry& box : boxes) {
    edge_cells.visit(box.low, box.high, [&](const BoxEntry& other) {
      if (other.id < box.id && edges_may_touch(s, other.id, box.id)) pairs.push_back({other.id, box.id});
    });
  }
  edge_edges.assign(edges, pairs);
}

void ContactSearch::Cells::adaptive(const SurfaceView& s, std::span<const Index> renamed_segments,
                                    std::span<const Index> renamed_edges) {
  touched_nodes.clear();
  touched_edges.clear();
  const Index new_nodes = static_cast<Index>(s.nodes.size());
  const Index new_segments = static_cast<Index>(s.segments.size() / 4);
  const Index new_edges = static_cast<Index>(s.edges.size() / 2);
  const auto add = [&](Index row, Index segment) {
    node_segments.add(row, segment);
    touched_nodes.push_back(row);
  };

  node_segments.add_rows(new_nodes - nodes);
  for (Index row = nodes; row < new_nodes; ++row) {
    const Corner x = place(s, s.nodes[row]);
    segment_cells.visit(x, x, [&](const BoxEntry& box) {
      if (node_may_touch(s, row, corners_of(s, box.id))) add(row, box.id);
    });
    node_cells.insert({x, row});
  }
  nodes = new_nodes;
  for (Index m = segments; m < new_segments; ++m) {
    const BoxEntry box = segment_entry(s, m);
    nodes_in(s, box, [&](Index row) { add(row, m); });
    segment_cells.insert(box);
  }
  segments = new_segments;
  for (const Index m : renamed_segments) {
    nodes_in(s, segment_entry(s, m), [&](Index row) {
      if (!node_segments.contains(row, m)) add(row, m);
    });
  }

  edge_edges.add_rows(new_edges - edges);
  for (Index e = edges; e < new_edges; ++e) {
    const BoxEntry box = edge_entry(s, e);
    edge_cells.visit(box.low, box.high, [&](const BoxEntry& other) {
      if (edges_may_touch(s, other.id, e)) add_edge_pair(other.id, e);
    });
    edge_cells.insert(box);
  }
  edges = new_edges;
  for (const Index e : renamed_edges) {
    const BoxEntry box = edge_entry(s, e);
    edge_cells.visit(box.low, box.high, [&](const BoxEntry& other) {
      const Index m = std::min(other.id, e), n = std::max(other.id, e);
      if (edges_may_touch(s, m, n) && !edge_edges.contains(m, n)) add_edge_pair(m, n);
    });
  }
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

void ContactSearch::regular(const SurfaceView& surface) {
  cells_->regular(surface);
}
void ContactSearch::adaptive(const SurfaceView& surface, std::span<const Index> renamed_segments,
                             std::span<const Index> renamed_edges) {
  if (!cells_->searched || !cells_->open) {
    throw Error(Status::bad_state,
                "contact search: an adaptive search needs a regular one before it, and a search made for it");
  }
  cells_->adaptive(surface, renamed_segments, renamed_edges);
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
std::size_t ContactSearch::memory() const {
  const Cells& c = *cells_;
  return c.node_cells.memory() + c.segment_cells.memory() + c.edge_cells.memory() + c.node_segments.memory() +
         c.edge_edges.memory() + c.points.capacity() * sizeof(PointEntry) +
         c.boxes.capacity() * sizeof(BoxEntry) + c.pairs.capacity() * sizeof(c.pairs[0]);
}

}  // namespace cdfp
