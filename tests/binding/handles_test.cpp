// Handles across threads, and what the Fortran test counts.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "../../fortran_api/c_gate.hpp"

using namespace cdfp;

namespace {

TEST(Handles, UseByTwoIsRefusedWhenOneChanges) {
  cdfp_model* model = nullptr;
  ASSERT_EQ(cdfp_model_create(&model), CDFP_OK);
  {
    const gate::Look look(model);
    const gate::Look another(model);
    EXPECT_EQ(cdfp_model_set_threads(model, 2), CDFP_BAD_STATE);
  }
  {
    const gate::Change change(model);
    cdfp_contact_settings settings;
    EXPECT_EQ(cdfp_model_get_contact(model, &settings), CDFP_BAD_STATE);
    EXPECT_EQ(cdfp_model_set_threads(model, 2), CDFP_BAD_STATE);
  }
  EXPECT_EQ(cdfp_model_set_threads(model, 2), CDFP_OK);
  EXPECT_EQ(cdfp_model_free(&model), CDFP_OK);
}

TEST(Handles, FreedWhileInUseStaysUntilTheCallEnds) {
  cdfp_model* model = nullptr;
  ASSERT_EQ(cdfp_model_create(&model), CDFP_OK);
  const gate::Change change(model);
  ASSERT_EQ(cdfp_model_free(&model), CDFP_OK);
  change->title = "still there";
  EXPECT_EQ(change->title, "still there");
}

TEST(Handles, ErrorsBelongToTheirThread) {
  EXPECT_EQ(cdfp_model_set_threads(nullptr, 1), CDFP_BAD_ARGUMENT);
  std::thread([] {
    char text[8] = "x";
    std::int64_t length = -1;
    EXPECT_EQ(cdfp_last_error(text, sizeof text, &length), CDFP_OK);
    EXPECT_EQ(length, 0);
    EXPECT_STREQ(text, "");
  }).join();
  std::int64_t length = 0;
  EXPECT_EQ(cdfp_last_error(nullptr, 0, &length), CDFP_OK);
  EXPECT_GT(length, 0);
}

TEST(Handles, ManyThreadsEachWithItsOwn) {
  const std::int64_t before = gate::live_handles();
  std::atomic<int> failures = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&failures] {
      for (int i = 0; i < 2000; ++i) {
        cdfp_model* model = nullptr;
        void* copy = nullptr;
        failures += cdfp_model_create(&model) != CDFP_OK;
        failures += cdfp_share(model, &copy) != CDFP_OK;
        failures += cdfp_model_set_threads(model, i) != CDFP_OK;
        failures += cdfp_model_free(&model) != CDFP_OK;
        failures += cdfp_model_set_title(static_cast<cdfp_model*>(copy), "title") != CDFP_OK;
        failures += cdfp_free(&copy) != CDFP_OK;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(gate::live_handles(), before);
}

TEST(Handles, EveryExceptionBecomesAStatus) {
  EXPECT_EQ(gate::guarded("f", [] { throw Error(Status::bad_mesh, "mesh"); }), CDFP_BAD_MESH);
  EXPECT_EQ(gate::guarded("f", [] { throw std::bad_alloc(); }), CDFP_INTERNAL);
  EXPECT_EQ(gate::guarded("f", [] { throw std::logic_error("logic"); }), CDFP_INTERNAL);
  EXPECT_EQ(gate::guarded("f", [] { throw 1; }), CDFP_INTERNAL);
  EXPECT_EQ(gate::guarded("f", [] { throw Error(Status::io, std::string(100000, 'x')); }), CDFP_IO);
  std::int64_t length = 0;
  EXPECT_EQ(cdfp_last_error(nullptr, 0, &length), CDFP_OK);
  EXPECT_EQ(length, 4095);
}

}  // namespace
