// Contact search from 1e4 to 3e6 segments: time and bytes of the regular search, time of the adaptive one for
// a fixed number of new segments, and the node-segment pairs of the same boxes by CGAL's box_intersection_d
// (libcgal-dev) and Boost.Geometry's R-tree (libboost-dev) where they are installed.
//   benchmarks/run.sh contact_scaling [LARGEST]
// The scene is rubble: bricks on a plate-like lattice, each on its own, close enough to be candidates of one
// another. Processor seconds of one thread, the least of a few repetitions. New bricks that are scattered
// over the scene cost more the larger it is, as their neighbours are in no cache; their work is the same.
// The regular search's time a segment rises by what the caches save at 1e4 segments, and then is constant.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "cdfp/contact.hpp"
#include "support/stop_watch.hpp"

#if __has_include(<CGAL/box_intersection_d.h>)
#define CDFP_WITH_CGAL
#define CGAL_DISABLE_GMP 1
#include <CGAL/box_intersection_d.h>
#endif
#if __has_include(<boost/geometry/index/rtree.hpp>)
#define CDFP_WITH_BOOST
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#endif

namespace {

using namespace cdfp;

constexpr double kSide = 1e-3, kGap = 0.1e-3;
constexpr std::size_t kNewBricks = 20;

class Rubble {
 public:
  /// About so many segments, in two layers.
  explicit Rubble(double segments) {
    const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(segments / 12))));
    for (int k = 0; k < 2; ++k) {
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
          add({i * (kSide + kGap), j * (kSide + kGap), k * (kSide + kGap)});
        }
      }
    }
    bricks_ = 2 * side * side;
  }
  /// A brick a little beside one that was there first, as after a split.
  void add_beside(std::size_t brick) {
    const std::size_t node = 8 * (brick % bricks_);
    add({position_[3 * node] + 0.5 * kGap, position_[3 * node + 1] + 0.5 * kGap, position_[3 * node + 2]});
  }

  SurfaceView view() const { return {position_, nodes_, segments_, {}, {}}; }
  Index segment_count() const { return static_cast<Index>(segments_.size() / 4); }
  Index node_count() const { return static_cast<Index>(nodes_.size()); }
  const double* place(Index node) const { return &position_[3 * static_cast<std::size_t>(node)]; }
  const Index* corners(Index segment) const { return &segments_[4 * static_cast<std::size_t>(segment)]; }
  bool names(Index segment, Index node) const {
    return std::find(corners(segment), corners(segment) + 4, node) != corners(segment) + 4;
  }
  /// Lowest and highest corner, grown.
  std::array<std::array<double, 3>, 2> box(Index segment, double by) const {
    std::array<std::array<double, 3>, 2> box{{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}}};
    for (int c = 0; c < 4; ++c) {
      const double* x = place(corners(segment)[c]);
      for (std::size_t d = 0; d < 3; ++d) {
        box[0][d] = std::min(box[0][d], x[d] - by);
        box[1][d] = std::max(box[1][d], x[d] + by);
      }
    }
    return box;
  }

 private:
  void add(const std::array<double, 3>& low) {
    const Index first = node_count();
    for (int c = 0; c < 8; ++c) {
      const int at[3] = {(c ^ (c >> 1)) & 1, (c >> 1) & 1, c >> 2};
      for (std::size_t d = 0; d < 3; ++d) position_.push_back(low[d] + at[d] * kSide);
      nodes_.push_back(first + c);
    }
    for (const auto& facet :
         {std::array{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
      for (const int c : facet) segments_.push_back(first + c);
    }
  }
  std::vector<double> position_;
  std::vector<Index> nodes_, segments_;
  std::size_t bricks_ = 0;
};

struct Row {
  double segments = 0, pairs = 0, bytes = 0;
  double time = 1e30;                            ///< ns a segment
  double side_by_side = 1e30, scattered = 1e30;  ///< us an adaptive update

  void measure(double size) {
    Rubble scene(size);
    segments = scene.segment_count();
    ContactSearch search(1.0, 0.4);
    const double least = bench::least_seconds(size > 5e5 ? 2 : 5, [&] { search.regular(scene.view()); });
    time = std::min(time, 1e9 * least / segments);
    pairs = static_cast<double>(search.node_segments().size()) / segments;
    bytes = static_cast<double>(search.memory()) / segments;
    std::mt19937 random(1);
    for (std::size_t i = 0; i < 15; ++i) {
      for (std::size_t b = 0; b < kNewBricks; ++b) scene.add_beside(kNewBricks * i + b);
      side_by_side =
          std::min(side_by_side, 1e6 * bench::least_seconds(1, [&] { search.adaptive(scene.view()); }));
    }
    for (std::size_t i = 0; i < 15; ++i) {
      for (std::size_t b = 0; b < kNewBricks; ++b) scene.add_beside(random());
      scattered = std::min(scattered, 1e6 * bench::least_seconds(1, [&] { search.adaptive(scene.view()); }));
    }
  }
};

#ifdef CDFP_WITH_CGAL
/// Pairs and seconds; the boxes are there already.
std::pair<std::size_t, double> by_cgal(const Rubble& scene, double buffer) {
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Index*>;
  // Boxes are told apart by these addresses.
  std::vector<Index> ids(static_cast<std::size_t>(scene.segment_count() + scene.node_count()));
  std::iota(ids.begin(), ids.end(), 0);
  std::vector<Box> segments, nodes;
  for (Index m = 0; m < scene.segment_count(); ++m) {
    const auto box = scene.box(m, buffer);
    segments.emplace_back(CGAL::Bbox_3(box[0][0], box[0][1], box[0][2], box[1][0], box[1][1], box[1][2]),
                          &ids[m]);
  }
  for (Index n = 0; n < scene.node_count(); ++n) {
    const double* x = scene.place(n);
    nodes.emplace_back(CGAL::Bbox_3(x[0], x[1], x[2], x[0], x[1], x[2]), &ids[scene.segment_count() + n]);
  }
  std::vector<std::array<Index, 2>> pairs;
  const double time = bench::least_seconds(2, [&] {
    pairs.clear();
    CGAL::box_intersection_d(segments.begin(), segments.end(), nodes.begin(), nodes.end(),
                             [&](const Box& segment, const Box& node) {
                               const Index m = *segment.handle(), n = *node.handle() - scene.segment_count();
                               if (!scene.names(m, n)) pairs.push_back({m, n});
                             });
  });
  return {pairs.size(), time};
}
#endif

#ifdef CDFP_WITH_BOOST
std::pair<std::size_t, double> by_boost(const Rubble& scene, double buffer) {
  namespace bg = boost::geometry;
  using Point = bg::model::point<double, 3, bg::cs::cartesian>;
  using Entry = std::pair<Point, Index>;
  std::vector<Entry> nodes;
  std::vector<bg::model::box<Point>> boxes;
  for (Index n = 0; n < scene.node_count(); ++n) {
    const double* x = scene.place(n);
    nodes.emplace_back(Point(x[0], x[1], x[2]), n);
  }
  for (Index m = 0; m < scene.segment_count(); ++m) {
    const auto box = scene.box(m, buffer);
    boxes.emplace_back(Point(box[0][0], box[0][1], box[0][2]), Point(box[1][0], box[1][1], box[1][2]));
  }
  std::vector<std::array<Index, 2>> pairs;
  const double time = bench::least_seconds(2, [&] {
    pairs.clear();
    const bg::index::rtree<Entry, bg::index::rstar<16>> tree(nodes.begin(), nodes.end());
    for (Index m = 0; m < scene.segment_count(); ++m) {
      for (auto hit = tree.qbegin(bg::index::intersects(boxes[m])); hit != tree.qend(); ++hit) {
        if (!scene.names(m, hit->second)) pairs.push_back({m, hit->second});
      }
    }
  });
  return {pairs.size(), time};
}
#endif

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 3e6;
  std::string shortfall;
  std::printf("%67s\n%10s %14s %14s %16s %15s %14s\n", "adaptive, 120 new, us:", "segments", "pairs/segment",
              "ns/segment", "bytes/segment", "side by side", "scattered");
  // Rounds over all sizes, so that what else the machine does falls on none of them alone.
  std::vector<Row> rows;
  for (int round = 0; round < 6; ++round) {
    std::size_t i = 0;
    for (const double size : {1e4, 3e4, 1e5, 3e5, 1e6, 3e6}) {
      if (size > largest) break;
      if (i == rows.size()) rows.emplace_back();
      rows[i++].measure(size);
    }
  }
  for (const Row& row : rows) {
    std::printf("%10.0f %14.1f %14.1f %16.0f %15.1f %14.1f\n", row.segments, row.pairs, row.time, row.bytes,
                row.side_by_side, row.scattered);
    const std::string at = "@" + std::to_string(static_cast<int>(row.segments));
    // Up to 1e5 segments the search moves out of the caches (250 bytes a segment); from there on it is the
    // same memory for all.
    if (row.time > 1.5 * rows[0].time) shortfall += " time" + at;
    if (rows.size() > 2 && row.time > 1.3 * rows[2].time) shortfall += " time beyond caches" + at;
    if (row.bytes > 1.1 * rows[0].bytes) shortfall += " bytes" + at;
    if (row.side_by_side > 1.3 * rows[0].side_by_side) shortfall += " adaptive" + at;
  }
  if (rows.size() > 2) {
    std::printf("time a segment: out of the caches %.2f times that within, beyond them growing by %.2f\n",
                rows[2].time / rows[0].time, rows.back().time / rows[2].time);
  }

  const Rubble scene(std::min(largest, 1e5));
  ContactSearch search(1.0, 0.4, false);
  const double ours = bench::least_seconds(9, [&] { search.regular(scene.view()); });
  const double per_segment = 1e9 / scene.segment_count();
  std::printf("\n%d segments, the same boxes:\n  cdfp regular search         %8.1f ns/segment\n",
              scene.segment_count(), ours * per_segment);
  const auto compare = [&](const char* name, std::pair<std::size_t, double> theirs) {
    std::printf("  %-27s %8.1f ns/segment, %.1f times ours\n", name, theirs.second * per_segment,
                theirs.second / ours);
    if (theirs.first != search.node_segments().size()) shortfall += std::string(" other pairs: ") + name;
    if (theirs.second <= ours) shortfall += std::string(" slower than ") + name;
  };
#ifdef CDFP_WITH_CGAL
  compare("CGAL box_intersection_d", by_cgal(scene, search.buffer()));
#else
  std::printf("  CGAL is not installed (libcgal-dev)\n");
  shortfall += " CGAL missing";
#endif
#ifdef CDFP_WITH_BOOST
  compare("Boost.Geometry R-tree", by_boost(scene, search.buffer()));
#else
  std::printf("  Boost.Geometry is not installed (libboost-dev)\n");
  shortfall += " Boost missing";
#endif
  std::printf("contact_scaling: %s%s\n", shortfall.empty() ? "pass" : "short:", shortfall.c_str());
  return 0;
}
