// Global search against brute force, on soups of segments of many shapes and sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

#include "cdfp/contact.hpp"
#include "cdfp/error.hpp"

namespace {

using cdfp::Index;
using cdfp::kNone;
using Pair = std::array<Index, 2>;
using Pairs = std::set<Pair>;

struct Soup {
  std::vector<double> x;
  std::vector<Index> nodes, segments, edges, groups;

  cdfp::SurfaceView view() const { return {x, nodes, segments, edges, groups}; }
  Index node_count() const { return static_cast<Index>(groups.size()); }
  Index add_node(const std::array<double, 3>& p, Index group) {
    x.insert(x.end(), p.begin(), p.end());
    groups.push_back(group);
    nodes.push_back(node_count() - 1);
    return node_count() - 1;
  }
  /// A quadrilateral or triangle somewhere in a cube, some of its corners shared with what is there.
  void add_segment(std::mt19937& random, double side, double space, bool sharing = true) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const double size = side * std::exp(1.5 * unit(random));
    const std::array<double, 3> c{space * unit(random), space * unit(random), 0.3 * space * unit(random)};
    const Index group = random() % 10 == 0 ? static_cast<Index>(random() % 2) : kNone;
    const int corners = random() % 4 == 0 ? 3 : 4;
    std::array<Index, 4> s{kNone, kNone, kNone, kNone};
    for (int i = 0; i < corners; ++i) {
      const double angle = (i + 0.3 * unit(random)) * 1.5;
      s[i] = sharing && random() % 8 == 0 && node_count() > 0
                 ? static_cast<Index>(random() % node_count())
                 : add_node({c[0] + size * std::cos(angle), c[1] + size * std::sin(angle),
                             c[2] + 0.4 * size * unit(random)},
                            group);
    }
    segments.insert(segments.end(), s.begin(), s.end());
    edges.insert(edges.end(), {s[0], s[1], s[1], s[2]});
  }
  void shift(double by) {
    for (double& value : x) value += by;
  }
};

struct Bounds {
  std::array<double, 3> low, high;
};
Bounds bounds(const Soup& s, const Index* nodes, int count) {
  Bounds b{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
  for (int i = 0; i < count && nodes[i] != kNone; ++i) {
    for (int d = 0; d < 3; ++d) {
      b.low[d] = std::min(b.low[d], s.x[3 * nodes[i] + d]);
      b.high[d] = std::max(b.high[d], s.x[3 * nodes[i] + d]);
    }
  }
  return b;
}
/// Largest separation along an axis.
double separation(const Bounds& a, const Bounds& b) {
  double apart = -1e300;
  for (int d = 0; d < 3; ++d) apart = std::max({apart, a.low[d] - b.high[d], b.low[d] - a.high[d]});
  return apart;
}
bool same_group(const Soup& s, Index a, Index b) {
  return s.groups[a] >= 0 && s.groups[a] == s.groups[b];
}

Pairs brute_node_segments(const Soup& s, double distance) {
  Pairs pairs;
  for (Index row = 0; row < static_cast<Index>(s.nodes.size()); ++row) {
    const Bounds p = bounds(s, &s.nodes[row], 1);
    for (Index m = 0; m < static_cast<Index>(s.segments.size() / 4); ++m) {
      const Index* c = &s.segments[4 * m];
      if (std::find(c, c + 4, s.nodes[row]) != c + 4 || same_group(s, s.nodes[row], c[0])) continue;
      if (separation(p, bounds(s, c, 4)) <= distance) pairs.insert({row, m});
    }
  }
  return pairs;
}
Pairs brute_edges(const Soup& s, double distance) {
  Pairs pairs;
  for (Index n = 0; n < static_cast<Index>(s.edges.size() / 2); ++n) {
    for (Index m = 0; m < n; ++m) {
      const Index *a = &s.edges[2 * m], *b = &s.edges[2 * n];
      if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1] || same_group(s, a[0], b[0])) continue;
      if (separation(bounds(s, a, 2), bounds(s, b, 2)) <= distance) pairs.insert({m, n});
    }
  }
  return pairs;
}

/// Fails if a pair is stored twice.
Pairs found(const cdfp::PairRows& rows) {
  Pairs pairs;
  for (Index row = 0; row < rows.rows(); ++row) {
    rows.for_each(row, [&](Index partner) {
      EXPECT_TRUE(pairs.insert({row, partner}).second) << "pair " << row << ", " << partner << " twice";
    });
  }
  EXPECT_EQ(pairs.size(), rows.size());
  return pairs;
}

/// Off the boundary of the buffer by rounding: pairs in doubt are left out of the comparison.
void expect_same(const Pairs& got, const Pairs& at_least, const Pairs& at_most) {
  EXPECT_TRUE(std::includes(got.begin(), got.end(), at_least.begin(), at_least.end()));
  EXPECT_TRUE(std::includes(at_most.begin(), at_most.end(), got.begin(), got.end()));
}
void expect_exact(const Soup& soup, const cdfp::ContactSearch& search) {
  const double b = search.buffer(), doubt = 1e-12 + 1e-9 * b;
  expect_same(found(search.node_segments()), brute_node_segments(soup, b - doubt),
              brute_node_segments(soup, b + doubt));
  expect_same(found(search.edge_edges()), brute_edges(soup, b - doubt), brute_edges(soup, b + doubt));
}

/// Those whose present boxes are at most so far apart.
Pairs node_segments_within(const Soup& s, const Pairs& pairs, double distance) {
  Pairs near_by;
  for (const Pair& p : pairs) {
    const Bounds node = bounds(s, &s.nodes[p[0]], 1), segment = bounds(s, &s.segments[4 * p[1]], 4);
    if (separation(node, segment) <= distance) near_by.insert(p);
  }
  return near_by;
}
Pairs edges_within(const Soup& s, const Pairs& pairs, double distance) {
  Pairs near_by;
  for (const Pair& p : pairs) {
    const Bounds a = bounds(s, &s.edges[2 * p[0]], 2), b = bounds(s, &s.edges[2 * p[1]], 2);
    if (separation(a, b) <= distance) near_by.insert(p);
  }
  return near_by;
}

class Seeded : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random_{GetParam()};
  void SetUp() override { RecordProperty("seed", static_cast<int>(GetParam())); }
};
class Regular : public Seeded {};
class Adaptive : public Seeded {};

TEST_P(Regular, FindsWhatBruteForceFinds) {
  const double sides[] = {0.02, 0.1, 0.5};
  Soup soup;
  const double side = sides[random_() % 3];
  const int count = 1 + static_cast<int>(random_() % 400);
  for (int i = 0; i < count; ++i) soup.add_segment(random_, side, 1.0);
  for (const double by : {0.0, 1e3}) {
    soup.shift(by);
    for (const double cell_factor : {0.3, 1.0, 4.0}) {
      cdfp::ContactSearch search(cell_factor, 0.4);
      search.regular(soup.view());
      expect_exact(soup, search);
    }
  }
}

TEST_P(Regular, SurvivesOutliersAndHugeSegments) {
  Soup soup;
  for (int i = 0; i < 200; ++i) soup.add_segment(random_, 0.02, 1.0);
  for (int i = 0; i < 3; ++i) {
    Soup far;
    far.add_segment(random_, 0.02, 1.0);
    const Index first = soup.node_count();
    for (std::size_t n = 0; n < far.nodes.size(); ++n) {
      soup.add_node({far.x[3 * n] + 1e7 * (i + 1), far.x[3 * n + 1] - 1e9, far.x[3 * n + 2]}, kNone);
    }
    for (const Index node : far.segments) soup.segments.push_back(node == kNone ? kNone : first + node);
  }
  soup.add_segment(random_, 5.0, 0.1);
  cdfp::ContactSearch search(1.0, 0.4);
  search.regular(soup.view());
  expect_exact(soup, search);
}

TEST_P(Regular, TakesEverythingInOneCell) {
  Soup soup;
  for (int i = 0; i < 60; ++i) soup.add_segment(random_, 1.0, 1e-3);
  cdfp::ContactSearch search(5.0, 0.4);
  search.regular(soup.view());
  expect_exact(soup, search);
}

TEST(Search, ThreadsDoNotChangeTheOrder) {
  std::mt19937 random(11);
  Soup soup;
  for (int i = 0; i < 10000; ++i) soup.add_segment(random, 0.02, 1.0);  // more than one piece
  cdfp::ContactSearch one(1.0, 0.4), two(1.0, 0.4);
  one.regular(soup.view(), 1);
  two.regular(soup.view(), 2);
  const auto in_order = [](const cdfp::PairRows& rows) {
    std::vector<Index> all;
    for (Index row = 0; row < rows.rows(); ++row) {
      all.push_back(kNone);
      rows.for_each(row, [&](Index partner) { all.push_back(partner); });
    }
    return all;
  };
  EXPECT_GT(one.node_segments().size(), 10000u);
  EXPECT_EQ(in_order(one.node_segments()), in_order(two.node_segments()));
  EXPECT_EQ(in_order(one.edge_edges()), in_order(two.edge_edges()));
}

TEST(Search, SamePairsForEveryInstructionSet) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    Soup soup;
    for (int i = 0; i < 3000; ++i) soup.add_segment(random, 0.1, seed == 3 ? 40.0 : 1.0);
    const auto pairs_with = [&](const char* isa) {
      setenv("CDFP_ISA", isa, 1);
      cdfp::ContactSearch search(1.0, 0.4);
      unsetenv("CDFP_ISA");
      search.regular(soup.view());
      std::vector<Index> pairs;
      for (Index row = 0; row < search.node_segments().rows(); ++row) {
        search.node_segments().for_each(row, [&](Index m) { pairs.insert(pairs.end(), {row, m}); });
      }
      return pairs;
    };
    const std::vector<Index> base = pairs_with("baseline");
    EXPECT_GT(base.size(), 200u);
    for (const char* isa : {"avx2", "avx512"}) {
      try {
        EXPECT_EQ(pairs_with(isa), base) << isa;
      } catch (const cdfp::Error& error) {
        unsetenv("CDFP_ISA");
        EXPECT_EQ(error.status(), cdfp::Status::bad_argument);  // this processor lacks it
      }
    }
  }
}

TEST(Search, TakesEmptyScenes) {
  Soup soup;
  cdfp::ContactSearch search(1.0, 0.4);
  search.regular(soup.view());
  EXPECT_EQ(search.node_segments().size(), 0u);
  std::mt19937 random(1);
  for (int i = 0; i < 5; ++i) soup.add_segment(random, 0.1, 0.2);
  search.adaptive(soup.view());
  EXPECT_TRUE(search.due(0.0, 1.0)) << "far more entities than at the regular search";
}

TEST(Search, MemoryIsLinearWhateverTheSpace) {
  const auto bytes_a_segment = [](int count, double space) {
    std::mt19937 random(3);
    Soup soup;
    for (int i = 0; i < count; ++i) soup.add_segment(random, 0.05, space, false);
    cdfp::ContactSearch search(1.0, 0.4);
    search.regular(soup.view());
    const double pairs = static_cast<double>(search.node_segments().size() + search.edge_edges().size());
    return (static_cast<double>(search.memory()) - 8 * pairs) / count;  // found and stored, an index each
  };
  const double few = bytes_a_segment(2000, 1.0);
  for (const double space : {1e3, 1e6, 1e9}) EXPECT_LT(bytes_a_segment(2000, space), 1.5 * few);
  EXPECT_LT(bytes_a_segment(20000, 3.0), 1.5 * few);
}

TEST(Search, RegularIsDueOnceTheBufferIsTravelled) {
  std::mt19937 random(5);
  Soup soup;
  for (int i = 0; i < 20; ++i) soup.add_segment(random, 0.1, 0.5);
  cdfp::ContactSearch search(1.0, 0.4);
  EXPECT_TRUE(search.due(0.0, 1.0)) << "nothing searched yet";
  search.regular(soup.view());
  const double speed = 3.0, step = search.buffer() / (2 * speed) / 10;
  int steps = 0;
  while (!search.due(speed, step * 1.0001)) ++steps;
  EXPECT_EQ(steps, 9);
}

TEST(Search, RowsCompressInOrder) {
  std::mt19937 random(7);
  Soup soup;
  for (int i = 0; i < 100; ++i) soup.add_segment(random, 0.2, 1.0);
  cdfp::ContactSearch search(1.0, 0.4);
  search.regular(soup.view());
  soup.add_segment(random, 0.2, 0.1);
  search.adaptive(soup.view());
  std::vector<Index> start, partners;
  search.node_segments().compress(start, partners);
  ASSERT_EQ(start.size(), soup.nodes.size() + 1);
  ASSERT_EQ(partners.size(), search.node_segments().size());
  for (std::size_t row = 0; row + 1 < start.size(); ++row) {
    EXPECT_TRUE(std::is_sorted(partners.begin() + start[row], partners.begin() + start[row + 1]));
  }
}

/// Insertions and splits without movement: the adaptive set is the regular one. With movement: within what is
/// left of the buffer it is that of a fresh regular search, and of brute force.
TEST_P(Adaptive, KeepsUpWithInsertionsAndMovement) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Soup soup;
  for (int i = 0; i < 120; ++i) soup.add_segment(random_, 0.1, 1.0);
  cdfp::ContactSearch search(1.0, 0.4);
  search.regular(soup.view());
  const bool moving = GetParam() % 2 == 1;
  std::size_t compared = 0;
  for (int round = 0; round < 12; ++round) {
    if (moving) {
      const double step = 0.022 * search.buffer();
      ASSERT_FALSE(search.due(std::sqrt(3.0) * step, 1.0));
      for (double& value : soup.x) value += step * unit(random_);
    }
    std::vector<Index> renamed_segments, renamed_edges;
    const int news = static_cast<int>(random_() % 6);
    for (int i = 0; i < news; ++i) soup.add_segment(random_, 0.1, 1.0);
    for (int i = 0; i < 3; ++i) {  // one segment's corner comes off
      const Index m = static_cast<Index>(random_() % (soup.segments.size() / 4));
      const int corner = static_cast<int>(random_() % 3);
      const Index old_node = soup.segments[4 * m + corner];
      const Index copy = soup.add_node(
          {soup.x[3 * old_node], soup.x[3 * old_node + 1], soup.x[3 * old_node + 2]}, soup.groups[old_node]);
      soup.segments[4 * m + corner] = copy;
      renamed_segments.push_back(m);
      for (Index e = 2 * m; e < 2 * m + 2; ++e) {
        for (int end = 0; end < 2; ++end) {
          if (soup.edges[2 * e + end] != old_node) continue;
          soup.edges[2 * e + end] = copy;
          renamed_edges.push_back(e);
        }
      }
    }
    search.adaptive(soup.view(), renamed_segments, renamed_edges);
    const Pairs nodes = found(search.node_segments()), edges = found(search.edge_edges());
    if (!moving) {
      expect_exact(soup, search);
    } else {
      cdfp::ContactSearch fresh(1.0, 0.4);
      fresh.regular(soup.view());
      const double left = std::min(search.buffer() - search.travel(), fresh.buffer() * (1 - 1e-9));
      const Pairs near_nodes = node_segments_within(soup, nodes, left);
      EXPECT_EQ(near_nodes, brute_node_segments(soup, left));
      EXPECT_EQ(near_nodes, node_segments_within(soup, found(fresh.node_segments()), left));
      const Pairs near_edges = edges_within(soup, edges, left);
      EXPECT_EQ(near_edges, brute_edges(soup, left));
      EXPECT_EQ(near_edges, edges_within(soup, found(fresh.edge_edges()), left));
      compared += near_nodes.size() + near_edges.size();
    }
  }
  EXPECT_TRUE(!moving || compared > 500) << compared;
}

INSTANTIATE_TEST_SUITE_P(Seeds, Regular, testing::Range(1u, 13u));
INSTANTIATE_TEST_SUITE_P(Seeds, Adaptive, testing::Range(1u, 21u));

}  // namespace
