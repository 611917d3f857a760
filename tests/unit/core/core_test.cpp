#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <new>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/archive.hpp"
#include "core/numbered.hpp"
#include "core/parallel.hpp"
#include "core/shares.hpp"
#include "core/stress.hpp"
#include "core/vec3.hpp"
#include "state/slabs.hpp"

namespace cdfp {
namespace {

TEST(Mat3, InverseAndDeterminant) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int k = 0; k < 100; ++k) {
    Mat3 a = 3.0 * Mat3::identity();
    for (int i = 0; i < 9; ++i) a(i / 3, i % 3) += u(random);
    const Mat3 one = a * inverse(a);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(one(i / 3, i % 3), i % 4 == 0 ? 1 : 0, 1e-13);
    EXPECT_NEAR(det(a) * det(inverse(a)), 1, 1e-12);
  }
}

TEST(Stress, InvariantsOfKnownStates) {
  Mat3 s;
  s(0, 0) = 60e6;
  EXPECT_NEAR(von_mises(s), 60e6, 1);
  EXPECT_NEAR(max_principal(s), 60e6, 1);
  Mat3 shear;
  shear(0, 1) = shear(1, 0) = 10e6;
  EXPECT_NEAR(von_mises(shear), std::sqrt(3.0) * 10e6, 1);
  EXPECT_NEAR(max_principal(shear), 10e6, 1);
  EXPECT_NEAR(max_principal(-5.0 * Mat3::identity()), -5, 1e-14);
}

TEST(Threads, EveryIndexOnce) {
  for (const int count : {1, 2, 3}) {
    const Threads threads(count);
    std::vector<int> seen(10007, 0);
    threads.for_ranges(10007, 64, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const int s : seen) ASSERT_EQ(s, 1);
  }
}

TEST(Threads, UnevenWorkIsDoneOnce) {
  for (const int count : {1, 2, 3, 8}) {
    const Threads threads(count);
    std::vector<int> seen(1001, 0);
    std::vector<double> sums(seen.size());
    threads.deal_ranges(std::ssize(seen), 3, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        ++seen[i];
        for (int k = 0; k < (i < 100 ? 20000 : 10); ++k) sums[i] += std::sqrt(k);
      }
    });
    for (const int s : seen) ASSERT_EQ(s, 1);
  }
}

TEST(Shares, AThreadGoesThroughItsOwnThenTakesFromTheEndsOfOthers) {
  Shares shares(2);
  shares.refill(5);
  std::vector<std::int64_t> order;
  for (int k = 0; k < 3; ++k) order.push_back(shares.next(1));
  EXPECT_EQ(order, (std::vector<std::int64_t>{2, 3, 4}));
  EXPECT_EQ(shares.next(1), 1);
  EXPECT_EQ(shares.next(0), 0);
  EXPECT_EQ(shares.next(0), Shares::kNothing);
  EXPECT_EQ(shares.next(1), Shares::kNothing);
  shares.refill(0);
  EXPECT_EQ(shares.next(0), Shares::kNothing);
}

/// 30 x 400 x 3 nodes, the layers one after the other.
std::vector<double> layers_of_nodes() {
  std::vector<double> x;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 400; ++j) {
      for (int i = 0; i < 30; ++i) x.insert(x.end(), {20.0 * (30 - i), 1.0 * j, 0.1 * k});
    }
  }
  return x;
}

TEST(Slabs, RunAcrossTheLongestAxisAlongWhichNumbersStayTogether) {
  EXPECT_EQ(slab_axis(extents_of_pieces(layers_of_nodes())), 1);
  EXPECT_EQ(slab_axis(extents_of_pieces({})), 0);
}

TEST(Slabs, EveryNodeOnceAndNewOnesToo) {
  const std::vector<double> x = layers_of_nodes();
  const NodePieces pieces(x);
  for (const int count : {1, 2, 3}) {
    for (const std::size_t nodes : {x.size() / 3, x.size() / 3 + 2000}) {
      std::vector<int> seen(nodes, 0);
      pieces.for_each(std::ssize(seen), Threads(count), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t n = begin; n < end; ++n) ++seen[n];
      });
      for (const int s : seen) ASSERT_EQ(s, 1);
    }
  }
}

struct Padded {
  bool first = false;
  double second = 0;
};

/// What an archive holds of a value whose memory held `before`.
std::string archived(int before) {
  alignas(Padded) unsigned char memory[2 * sizeof(Padded)];
  std::memset(memory, before, sizeof memory);
  auto* const padded = new (memory) Padded;
  padded->first = true;
  padded->second = 3;
  auto* const nothing = new (memory + sizeof(Padded)) std::optional<float>;
  Archive a;
  a("padded", *padded);
  a("nothing", *nothing);
  return a.bytes();
}

TEST(Archive, EqualValuesAreEqualBytes) {
#ifdef __clang__
  GTEST_SKIP() << "clang 14 cannot clear what lies between members";
#endif
  EXPECT_EQ(archived(0x5a), archived(0xc3));
}

TEST(Archive, GivesBackWhatItTook) {
  std::optional<float> some = 4, none;
  std::vector<Padded> padded{{true, 1}, {false, 2}};
  Archive filled;
  filled("some", some);
  filled("none", none);
  filled("padded", padded);
  Archive read(filled.bytes());
  std::optional<float> back_some, back_none = 1;
  std::vector<Padded> back;
  read("some", back_some);
  read("none", back_none);
  read("padded", back);
  EXPECT_EQ(back_some, some);
  EXPECT_EQ(back_none, none);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_TRUE(back[0].first && back[1].second == 2);
}

TEST(Numbered, MessagesCountFromWhereTheirReaderDoes) {
  const Error error(Status::bad_mesh, "element " + numbered(9) + " has 8 corners and is of part " +
                                          numbered(-1) + "; give one of " + numbered(0) + "-" + numbered(3));
  EXPECT_STREQ(error.what(), "element 9 has 8 corners and is of part -1; give one of 0-3");
  EXPECT_EQ(error.counted_from(0), error.what());
  const Error copy = error;
  EXPECT_EQ(copy.counted_from(1), "element 10 has 8 corners and is of part 0; give one of 1-4");
  EXPECT_EQ(Error(Status::io, "").counted_from(1), "");
}

}  // namespace
}  // namespace cdfp
