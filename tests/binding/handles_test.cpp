// Handles across threads, and what the Fortran test counts.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
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

/// A square of 1 m that comes apart, in a service of its own: the forces of all steps.
std::vector<double> pull_apart(int steps) {
  std::vector<double> x{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, all;
  x.insert(x.end(), x.begin(), x.begin() + 12);
  std::vector<double> v(24, 0.0), mass{1e6, 1e6, 1e6, 1e6, 0.01, 0.01, 0.01, 0.01};
  const std::int32_t corners[] = {4, 5, 6, 7, 0, 1, 2, 3};
  const double pull[] = {1e5, 0, 3e5};
  cdfp_cohesive* cohesive = nullptr;
  cdfp_cohesive_law law;
  std::int32_t number = -1;
  EXPECT_EQ(cdfp_cohesive_law_default(&law), CDFP_OK);
  law.strength = 3e5, law.fracture_energy = 10;
  EXPECT_EQ(cdfp_cohesive_create(0, &cohesive), CDFP_OK);
  EXPECT_EQ(cdfp_cohesive_add_law(cohesive, &law, &number), CDFP_OK);
  EXPECT_EQ(cdfp_cohesive_insert(cohesive, 0, number, 8, corners, pull, 8, x.data(), 0), CDFP_OK);
  const double step = 1e-7;
  for (int i = 0; i < steps; ++i) {
    std::vector<double> f(24, 0.0);
    for (int n = 4; n < 8; ++n) f[3 * n] = 2e4, f[3 * n + 2] = 1e5;
    for (int k = 0; k < 24; ++k) x[k] += step * v[k];
    EXPECT_EQ(
        cdfp_cohesive_add_force(cohesive, 8, x.data(), v.data(), mass.data(), f.data(), step, i * step, 1),
        CDFP_OK);
    for (int k = 0; k < 24; ++k) v[k] += step * f[k] / mass[k / 3];
    all.insert(all.end(), f.begin(), f.end());
  }
  std::int64_t elements = 0, broken = 0;
  EXPECT_EQ(cdfp_cohesive_count(cohesive, &elements, &broken), CDFP_OK);
  EXPECT_EQ(broken, 1);
  EXPECT_EQ(cdfp_cohesive_free(&cohesive), CDFP_OK);
  return all;
}

TEST(Handles, ServicesInManyThreadsDoWhatOneDoes) {
  const std::vector<double> alone = pull_apart(600);
  std::vector<std::vector<double>> each(4);
  std::vector<std::thread> threads;
  for (std::vector<double>& result : each) threads.emplace_back([&result] { result = pull_apart(600); });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& result : each) EXPECT_EQ(result, alone);
}

/// While a user's law is asked, another thread finds the service in use.
TEST(Handles, TwoThreadsOnOneServiceAreRefusedWithTheCure) {
  struct Seen {
    cdfp_cohesive* cohesive = nullptr;
    std::int32_t status = -1;
    std::string text;
  } seen;
  const auto law_of_threads = [](const cdfp_cohesive_points* points, void* user_data) {
    auto* s = static_cast<Seen*>(user_data);
    std::thread([s] {
      std::int64_t elements = 0, broken = 0;
      char text[300];
      std::int64_t length = 0;
      s->status = cdfp_cohesive_count(s->cohesive, &elements, &broken);
      cdfp_last_error(text, sizeof text, &length);
      s->text = text;
    }).join();
    for (std::int64_t i = 0; i < points->count; ++i) points->damage[i] = points->stored[i] = 0;
  };
  std::vector<double> x{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, v(24, 0.0), f(24, 0.0), mass(8, 1.0);
  x.insert(x.end(), x.begin(), x.begin() + 12);
  const std::int32_t corners[] = {4, 5, 6, 7, 0, 1, 2, 3};
  cdfp_cohesive_law law;
  std::int32_t number = -1;
  ASSERT_EQ(cdfp_cohesive_law_default(&law), CDFP_OK);
  law.strength = 1e6, law.fracture_energy = 10, law.kind = CDFP_USER;
  ASSERT_EQ(cdfp_cohesive_create(0, &seen.cohesive), CDFP_OK);
  ASSERT_EQ(cdfp_cohesive_add_user_law(seen.cohesive, &law, law_of_threads, 0, &seen, &number), CDFP_OK);
  ASSERT_EQ(cdfp_cohesive_insert(seen.cohesive, 0, number, 8, corners, nullptr, 8, x.data(), 0), CDFP_OK);
  ASSERT_EQ(cdfp_cohesive_add_force(seen.cohesive, 8, x.data(), v.data(), mass.data(), f.data(), 1e-6, 0, 1),
            CDFP_OK);
  EXPECT_EQ(seen.status, CDFP_BAD_STATE);
  EXPECT_NE(seen.text.find("use it from one thread at a time"), std::string::npos) << seen.text;
  ASSERT_EQ(cdfp_cohesive_free(&seen.cohesive), CDFP_OK);
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
