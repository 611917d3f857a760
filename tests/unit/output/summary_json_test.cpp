#include "output/summary_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sample_run.hpp"

namespace cdfp {
namespace {

nlohmann::json parsed(const Summary& summary) {
  return nlohmann::json::parse(summary_json(summary));
}

TEST(SummaryJson, has_every_key_even_of_a_run_in_which_nothing_happened) {
  for (const Summary& summary : {Summary{}, sample::summary()}) {
    const nlohmann::json json = parsed(summary);
    for (const char* key : {"elements",
                            "nodes_initial",
                            "nodes_final",
                            "segments_initial",
                            "segments_final",
                            "steps",
                            "simulated_time_s",
                            "dt_s",
                            "wall_s",
                            "threads",
                            "peak_rss_mb",
                            "energy_balance_min",
                            "energy_balance_max",
                            "hourglass_over_strain_max",
                            "cohesive_inserted",
                            "cohesive_broken",
                            "cohesive_dissipated_over_GA",
                            "first_crack_upper_s",
                            "first_crack_upper_layer_face",
                            "first_crack_lower_s",
                            "peak_force_n",
                            "peak_force_time_s",
                            "impactor_rebound_mps",
                            "stage_seconds",
                            "warnings"})
      EXPECT_TRUE(json.contains(key)) << key;
  }
}

TEST(SummaryJson, names_the_first_cracks_of_both_panes) {
  const nlohmann::json json = parsed(sample::summary());
  EXPECT_EQ(json["first_crack_upper_s"], 20.4e-6);
  EXPECT_EQ(json["first_crack_upper_layer_face"], "lower face (layer 1 of 3)");
  EXPECT_EQ(json["first_crack_lower_s"], 30.2e-6);
  EXPECT_NEAR(json["first_crack_interval_s"], 9.8e-6, 1e-12);
  EXPECT_NEAR(json["first_crack_upper_after_contact_s"], 19.4e-6, 1e-12);
  ASSERT_EQ(json["first_cracks"].size(), 2u);
  EXPECT_EQ(json["first_cracks"][1]["part"], "upper_glass");
  EXPECT_EQ(json["first_cracks"][1]["position_m"][2], -2.5e-3);
  EXPECT_EQ(json["stage_seconds"], (nlohmann::json{{"internal_force", 12.5}, {"traction", 1.25}}));
  EXPECT_EQ(json["warnings"][0], "fixed step above the limit of element 7");
}

TEST(SummaryJson, what_never_came_about_is_null) {
  Summary summary = sample::summary();
  summary.first_cracks.pop_back();
  summary.first_cracks[0] = {};
  summary.first_cracks[0].part = "lower_glass";
  summary.energy_balance_max = std::numeric_limits<double>::infinity();
  const nlohmann::json json = parsed(summary);
  for (const char* key : {"first_crack_upper_s", "first_crack_upper_layer_face", "first_crack_lower_s",
                          "first_crack_interval_s", "impactor_rebound_mps", "energy_balance_max"})
    EXPECT_TRUE(json[key].is_null()) << key;
  EXPECT_TRUE(json["first_cracks"][0]["time_s"].is_null());
  EXPECT_TRUE(json["first_cracks"][0]["position_m"].is_null());
}

}  // namespace
}  // namespace cdfp
