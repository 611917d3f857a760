// The adaptive search test of Chen, Zang, Xu 2015, section 6.1: a plate of 60 x 50 x 1 bricks, cohesive
// elements inserted at random facets; after every few new segments the node-face pairs are updated, either by
// a regular search each time or by the adaptive one. Processor seconds of one thread.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "cdfp/contact.hpp"
#include "cdfp/topology.hpp"
#include "support/stop_watch.hpp"

namespace {

using namespace cdfp;

struct Plate {
  std::vector<double> position;
  std::vector<Index> connectivity;
  std::vector<ElementType> types;
};

Plate make_plate() {
  constexpr Index nx = 60, ny = 50;
  Plate plate;
  for (Index k = 0; k < 2; ++k) {
    for (Index j = 0; j <= ny; ++j) {
      for (Index i = 0; i <= nx; ++i) {
        plate.position.insert(plate.position.end(), {i * 120e-3 / nx, j * 90e-3 / ny, k * 2e-3});
      }
    }
  }
  for (Index j = 0; j < ny; ++j) {
    for (Index i = 0; i < nx; ++i) {
      const Index a = i + (nx + 1) * j, b = a + (nx + 1) * (ny + 1);
      plate.types.push_back(ElementType::hexahedron);
      plate.connectivity.insert(plate.connectivity.end(),
                                {a, a + 1, a + nx + 2, a + nx + 1, b, b + 1, b + nx + 2, b + nx + 1});
    }
  }
  return plate;
}

/// Contact nodes and segments as a driver of its own would keep them.
class Scene {
 public:
  Scene()
      : plate_(make_plate()),
        topology_(static_cast<Index>(plate_.position.size() / 3), plate_.types, plate_.connectivity),
        segment_of_(6 * plate_.types.size(), kNone) {
    for (Index e = 0; e < topology_.bulk_count(); ++e) {
      for (Index f = 0; f < 6; ++f) {
        if (topology_.mate({e, f}).element == kNone) add({e, f});
        if (topology_.mate({e, f}).element > e) inner_.push_back({e, f});
      }
    }
    for (std::size_t n = 0; n < plate_.position.size() / 3; ++n) nodes_.push_back(static_cast<Index>(n));
    std::mt19937 random(1);
    std::shuffle(inner_.begin(), inner_.end(), random);
  }

  SurfaceView view() const { return {plate_.position, nodes_, segments_, {}, {}}; }
  Index segment_count() const { return static_cast<Index>(segments_.size() / 4); }
  const std::vector<Index>& renamed() const { return renamed_; }

  /// The next facet splits and both its faces come free.
  void insert() {
    topology_.insert_cohesive(inner_[next_++], report_);
    for (const Insertion::NewNode& node : report_.new_nodes) {
      for (int d = 0; d < 3; ++d) plate_.position.push_back(plate_.position[3 * node.mother + d]);
      nodes_.push_back(node.node);
    }
    for (const Insertion::Renumbered& r : report_.renumbered) {
      if (r.element >= topology_.bulk_count()) continue;
      for (Index f = 0; f < 6; ++f) {
        const Index segment = segment_of_[6 * r.element + f];
        if (segment == kNone) continue;
        for (Index c = 4 * segment; c < 4 * segment + 4; ++c) {
          if (segments_[c] != r.old_node) continue;
          segments_[c] = r.new_node;
          renamed_.push_back(segment);
        }
      }
    }
    add(report_.lower);
    add(report_.upper);
  }
  void clear_renamed() { renamed_.clear(); }

 private:
  void add(FacetUse use) {
    segment_of_[6 * use.element + use.facet] = segment_count();
    const FacetNodes facet = topology_.facet_nodes(use);
    segments_.insert(segments_.end(), facet.nodes.begin(), facet.nodes.end());
  }

  Plate plate_;
  Topology topology_;
  std::vector<Index> segment_of_, nodes_, segments_, renamed_;
  std::vector<FacetUse> inner_;
  std::size_t next_ = 0;
  Insertion report_;
};

/// What a case costs: every loop its least time of the rounds so far, since other work on the machine only
/// adds.
struct Cost {
  std::vector<double> loops;
  std::size_t pairs = 0;
  double seconds() const { return std::accumulate(loops.begin(), loops.end(), 0.0); }
};

/// One round. Only the searches are timed, as the insertions are the same.
void run(int loops, int insertions, bool adaptive, double cell_factor, Cost& cost) {
  Scene scene;
  ContactSearch search(cell_factor, 0.4, adaptive);
  search.regular(scene.view());
  cost.loops.resize(loops, INFINITY);
  for (int loop = 0; loop < loops; ++loop) {
    for (int i = 0; i < insertions; ++i) scene.insert();
    const double begin = bench::processor_seconds();
    if (adaptive) {
      search.adaptive(scene.view(), scene.renamed());
    } else {
      search.regular(scene.view());
    }
    cost.loops[loop] = std::min(cost.loops[loop], bench::processor_seconds() - begin);
    scene.clear_renamed();
  }
  cost.pairs = search.node_segments().size();
}

struct Entry {
  int loops, insertions;
  double paper_regular, paper_adaptive;
};
constexpr Entry kTable[] = {{300, 1, 1.12, 0.29},  {300, 5, 1.94, 0.28},   {300, 10, 2.78, 0.31},
                            {500, 1, 2.48, 0.43},  {500, 5, 3.91, 0.41},   {500, 10, 6.91, 0.45},
                            {1000, 1, 7.23, 0.86}, {1000, 5, 13.87, 0.94}, {5000, 1, 84.24, 3.89}};

}  // namespace

int main() {
  constexpr int kRounds = 6;
  std::array<Cost, std::size(kTable)> regular_costs, adaptive_costs;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < std::size(kTable); ++i) {
      run(kTable[i].loops, kTable[i].insertions, false, 1.0, regular_costs[i]);
      run(kTable[i].loops, kTable[i].insertions, true, 1.0, adaptive_costs[i]);
    }
  }
  std::string shortfall;
  std::printf(
      "new/loop  loops   regular: paper s    ours s  times faster   adaptive: paper s    ours s  times "
      "faster   regular/adaptive: paper  ours\n");
  for (std::size_t i = 0; i < std::size(kTable); ++i) {
    const Entry& e = kTable[i];
    const double regular = regular_costs[i].seconds(), adaptive = adaptive_costs[i].seconds();
    const double faster = e.paper_regular / regular, faster_adaptive = e.paper_adaptive / adaptive;
    const double ratio = regular / adaptive;
    std::printf("%8d  %5d  %17.2f  %8.4f  %12.1f  %18.2f  %8.5f  %12.1f  %23.1f  %4.0f\n", 2 * e.insertions,
                e.loops, e.paper_regular, regular, faster, e.paper_adaptive, adaptive, faster_adaptive,
                e.paper_regular / e.paper_adaptive, ratio);
    std::fflush(stdout);
    const std::string entry =
        std::to_string(2 * e.insertions) + " new, " + std::to_string(e.loops) + " loops";
    if (regular_costs[i].pairs != adaptive_costs[i].pairs)
      shortfall += " pair counts differ (" + entry + ");";
    if (faster < 20) shortfall += " regular under 20 times (" + entry + ");";
    if (faster_adaptive < 100) shortfall += " adaptive under 100 times (" + entry + ");";
    if (e.loops == 5000 && ratio < 100) shortfall += " regular/adaptive under 100;";
  }
  std::printf("\n  w1   regular s  adaptive s   (2 new, 1000 loops)\n");
  for (const double cell_factor : {0.8, 0.9, 1.0, 1.1, 1.2}) {
    Cost regular, adaptive;
    for (int round = 0; round < 2; ++round) {
      run(1000, 1, false, cell_factor, regular);
      run(1000, 1, true, cell_factor, adaptive);
    }
    std::printf("%4.1f  %10.4f  %10.5f\n", cell_factor, regular.seconds(), adaptive.seconds());
  }
  std::printf("contact_table1: %s%s\n", shortfall.empty() ? "pass" : "short:", shortfall.c_str());
  return 0;
}
