#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/numbered.hpp"
#include "core/parallel.hpp"
#include "core/stress.hpp"
#include "core/vec3.hpp"

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
