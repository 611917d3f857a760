// The inner loops of the regular search, compiled once for each instruction set: the including file sets
// CDFP_ISA and CDFP_SEARCH_KERNELS. What they call is inlined.
#include <cmath>

#include "contact/cell_queries.hpp"
#include "contact/exact_place.hpp"
#include "contact/reach.hpp"
#include "contact/search_kernels.hpp"
#include "contact/wide.hpp"

namespace cdfp {

namespace CDFP_ISA {

/// What one segment looks for.
struct Finder {
  const NodePairs& job;
  const Index* corners;
  FoundPlaces& found;
  Wide::Query<false> query;
  Wide::Corners own;

  CDFP_ALWAYS_INLINE Finder(const NodePairs& pairs, const Index* of_segment, const Reach& reach,
                            FoundPlaces& places)
      : job(pairs), corners(of_segment), found(places), query(reach.low, reach.high), own(of_segment) {}

  CDFP_ALWAYS_INLINE bool same_group(Index node) const {
    return job.groups[node] >= 0 && job.groups[node] == job.groups[corners[0]];
  }
  CDFP_ALWAYS_INLINE bool holds(Index node) const {
    const double* x = job.position + 3 * static_cast<std::size_t>(node);
    for (int d = 0; d < 3; ++d) {
      double low = job.position[3 * static_cast<std::size_t>(corners[0]) + d], high = low;
      for (int i = 1; i < 4 && corners[i] != kNone; ++i) {
        const double c = job.position[3 * static_cast<std::size_t>(corners[i]) + d];
        low = c < low ? c : low, high = c > high ? c : high;
      }
      if (x[d] < low - job.buffer || x[d] > high + job.buffer) return false;
    }
    return true;
  }
  /// One bit for each of the points from `at` that pair.
  template <class Filter>
  CDFP_ALWAYS_INLINE void scan(std::uint32_t at, std::uint32_t end, const Filter& filter) {
    for (; at < end; at += Wide::kLanes) {
      const std::uint32_t left = end - at;
      Wide::Bits bits;
      if (Wide::kLanes > 16 && left <= 16) {
        bits = query.overlap_sixteen(job.places + at, job.stride) & (0xFFFFU >> (16 - left));
        bits &= ~own.among_sixteen(job.nodes + at);
      } else {
        bits = query.overlap(job.places + at, job.stride);
        if (left < Wide::kLanes) bits &= (Wide::Bits{1} << left) - 1;
        if (bits == 0) continue;
        bits &= ~own.among(job.nodes + at);
      }
      if (bits == 0) continue;
      filter(at, bits);
      doubt(at, bits);
      if (found.count >= found.room) {
        found.count = found.room + 1;
        return;
      }
      found.places[found.count] = {at, bits};
      found.count += bits != 0;
    }
  }
  CDFP_ALWAYS_INLINE void doubt(std::uint32_t at, Wide::Bits& bits) {
    Wide::Bits doubtful = bits;
    if (job.layout.tells()) doubtful &= ~query.well_inside(job.places + at, job.stride);
    for (; doubtful != 0; doubtful &= doubtful - 1) {
      if (!holds(job.nodes[at + __builtin_ctz(doubtful)])) bits &= ~(doubtful & -doubtful);
    }
    if (job.groups) {
      for (Wide::Bits rest = bits; rest != 0; rest &= rest - 1) {
        if (same_group(job.nodes[at + __builtin_ctz(rest)])) bits &= ~(rest & -rest);
      }
    }
  }
};

/// Where rows are folded, or a segment is so large that it looks at all nodes.
[[gnu::noinline]] void pair_nodes_far(const NodePairs& job, std::int64_t m, const Reach& reach,
                                      FoundPlaces& found) {
  Finder finder(job, job.corners + 4 * m, reach, found);
  const auto any = [](std::uint32_t, Wide::Bits&) {};
  job.layout.visit_cells(
      reach.from, reach.to, job.points,
      [&](std::uint32_t from, std::uint32_t to) { finder.scan(job.first[from], job.first[to], any); },
      [&](std::uint32_t from, std::uint32_t to, std::int32_t y, std::int32_t z) {
        finder.scan(job.first[from], job.first[to], [&](std::uint32_t at, Wide::Bits& bits) {
          const std::uint16_t *ys = job.places + job.stride + at, *zs = ys + job.stride;
          for (Wide::Bits rest = bits; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            if (!CellLayout::is_row(ys[i], y) || !CellLayout::is_row(zs[i], z)) bits &= ~(rest & -rest);
          }
        });
      },
      [&] { finder.scan(0, static_cast<std::uint32_t>(job.points), any); });
}

std::int64_t pair_nodes(const NodePairs& pairs, std::int64_t begin, std::int64_t end,
                        FoundPlaces& found_places, Index* ends, std::uint32_t* counts) {
  // Copies, which nothing that is written can alias.
  const NodePairs job = pairs;
  FoundPlaces found = found_places;
  const Reaches reaches(job.layout, job.grow);
  for (std::int64_t m = begin; m < end; ++m) {
    const std::size_t before = found.count;
    RoughBox box = job.boxes[m];
    const Reach reach = reaches(box);
    Finder finder(job, job.corners + 4 * m, reach, found);
    const bool done =
        job.layout.visit_flat(reach.from, reach.to, job.points, [&](std::uint32_t from, std::uint32_t to) {
          finder.scan(job.first[from], job.first[to], [](std::uint32_t, Wide::Bits&) {});
        });
    if (!done) {
      FoundPlaces far = found;
      pair_nodes_far(pairs, m, reach, far);
      found = far;
    }
    if (found.count > found.room) {
      found.count = before;
      end = m;
      break;
    }
    ends[m - begin] = static_cast<Index>(found.count);
  }
  for (std::size_t i = 0; i < found.count; ++i) {
    Wide::count(found.places[i].bits, counts + found.places[i].at);
  }
  found_places.count = found.count;
  return end;
}

double place_segments(const Index* corners, const double* position, const double* middle, std::int64_t begin,
                      std::int64_t end, RoughBox* boxes) {
  constexpr std::int64_t kBatch = 64;  // roots side by side
  const Place origin(middle);
  double sum = 0, length[kBatch];
  for (std::int64_t first = begin; first < end; first += kBatch) {
    const std::int64_t count = end - first < kBatch ? end - first : kBatch;
    for (std::int64_t i = 0; i < count; ++i) {
      const Index* of = corners + 4 * (first + i);
      const auto corner = [&](Index node) { return Place(position + 3 * static_cast<std::size_t>(node)); };
      const Place x0 = corner(of[0]), x1 = corner(of[1]), x2 = corner(of[2]);
      const Place x3 = corner(of[3] == kNone ? of[0] : of[3]);
      PlaceBox box{x0, x0};
      box.include(x1), box.include(x2), box.include(x3);
      boxes[first + i] = {box.low.about(origin), box.high.about(origin)};
      length[i] = 0.25 * cross_squared(x0, x2, x1, x3);  // half the cross product of the diagonals
    }
    for (std::int64_t i = 0; i < count; ++i) length[i] = std::sqrt(std::sqrt(length[i]));
    for (std::int64_t i = 0; i < count; ++i) sum += length[i];
  }
  return sum;
}

RoughBox place_nodes(const Index* nodes, const double* position, const double* middle, std::int64_t begin,
                     std::int64_t end, Float4* places) {
  const Place origin(middle);
  const Float4 first = Place(position + 3 * static_cast<std::size_t>(nodes[begin])).about(origin);
  RoughBox space{first, first};
  for (std::int64_t i = begin; i < end; ++i) {
    const Float4 place = Place(position + 3 * static_cast<std::size_t>(nodes[i])).about(origin);
    places[i] = place;
    space.low = lesser(space.low, place);
    space.high = greater(space.high, place);
  }
  return space;
}

void sort_points(const PointSort& sort) {
  // A copy, which nothing that is written can alias.
  const CellLayout layout = sort.layout;
  for (std::size_t i = 0; i < sort.count; ++i) {
    const std::uint32_t slot = layout.slot(layout.lattice()(sort.points[i]));
    sort.slot[i] = slot;
    ++sort.first[slot + 2];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t s = 0; s < layout.size(); ++s) sort.first[s + 2] = sum += sort.first[s + 2];
  for (std::size_t i = 0; i < sort.count; ++i) {
    const std::size_t at = sort.first[sort.slot[i] + 1]++;
    sort.ids[at] = static_cast<Index>(i);
    sort.names[at] = sort.nodes[i];
    const auto place = reinterpret_cast<Short8>(layout.lattice()(sort.points[i]));
    std::uint16_t* const to = sort.places + at;
    to[0] = place[0], to[sort.stride] = place[2], to[2 * sort.stride] = place[4];
  }
}

void find_boxes(const CellsView<true>& cells, const Float4& low, const RoughBox& box, FoundIds& found) {
  find(cells, low, box, NoDoubt{}, found);
}

struct SegmentDoubt {
  const ExactPairs& exact;
  Wide::Query<true> query;
  Place x;
  bool tells;

  CDFP_ALWAYS_INLINE Wide::Bits sure(const std::uint16_t* places, std::size_t stride) const {
    return tells ? query.well_inside(places, stride) : 0;
  }
  CDFP_ALWAYS_INLINE Wide::Bits sure_sixteen(const std::uint16_t* places) const {
    return tells ? query.well_inside_sixteen(places) : 0;
  }
  CDFP_ALWAYS_INLINE bool passes(Index segment) const {
    const Index* of = exact.corners + 4 * static_cast<std::size_t>(segment);
    const Place first(exact.position + 3 * static_cast<std::size_t>(of[0]));
    PlaceBox box{first, first};
    for (int c = 1; c < 4; ++c) {
      box.include(Place(exact.position + 3 * static_cast<std::size_t>(of[c] == kNone ? of[0] : of[c])));
    }
    return box.holds(x, exact.buffer);
  }
};
void find_segments(const CellsView<true>& cells, const Float4& low, const Float4& place,
                   const ExactPairs& exact, Index node, FoundIds& found) {
  const Int4 at = cells.layout.lattice()(place);
  const SegmentDoubt doubt{
      exact, {at, at}, Place(exact.position + 3 * static_cast<std::size_t>(node)), cells.layout.tells()};
  find(cells, low, {place, place}, doubt, found);
}

struct RowDoubt {
  const ExactPairs& exact;
  Wide::Query<false> query;
  PlaceBox box;
  bool tells;

  CDFP_ALWAYS_INLINE Wide::Bits sure(const std::uint16_t* places, std::size_t stride) const {
    return tells ? query.well_inside(places, stride) : 0;
  }
  CDFP_ALWAYS_INLINE Wide::Bits sure_sixteen(const std::uint16_t* places) const {
    return tells ? query.well_inside_sixteen(places) : 0;
  }
  CDFP_ALWAYS_INLINE bool passes(Index row) const {
    return box.holds(Place(exact.position + 3 * static_cast<std::size_t>(exact.nodes[row])), 0);
  }
};
void find_rows(const CellsView<false>& cells, const RoughBox& box, const ExactPairs& exact, const double* low,
               const double* high, FoundIds& found) {
  const Lattice& lattice = cells.layout.lattice();
  const RowDoubt doubt{
      exact, {lattice(box.low), lattice(box.high)}, {Place(low), Place(high)}, cells.layout.tells()};
  find(cells, box.low, box, doubt, found);
}

}  // namespace CDFP_ISA

const SearchKernels CDFP_SEARCH_KERNELS{
    CDFP_ISA::place_nodes, CDFP_ISA::place_segments, CDFP_ISA::sort_points, CDFP_ISA::pair_nodes,
    CDFP_ISA::find_boxes,  CDFP_ISA::find_segments,  CDFP_ISA::find_rows};

}  // namespace cdfp
