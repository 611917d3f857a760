#include "driver/summary_table.hpp"

#include <gtest/gtest.h>

namespace cdfp {
namespace {

TEST(SummaryTable, ShowsEventsStagesAndWarnings) {
  Summary s;
  s.title = "a plate";
  s.elements = 47088;
  s.steps = 10000;
  s.threads = 1;
  s.first_cracks.resize(2);
  s.first_cracks[0] = {"upper_glass", 20e-6, 0, "lower face (layer 1 of 3)", {1e-3, 2e-3, 3e-3}};
  s.first_cracks[1].part = "lower_glass";
  s.peak_force_n = 2500;
  s.stages = {{"internal_force", 3.0, 10000}, {"criterion", 1.0, 10000}};
  s.warnings = {"the fixed step exceeds the stable step"};
  const std::string text = summary_table(s);
  for (const char* piece :
       {"a plate", "47088", "20.00 us, lower face (layer 1 of 3), x 1.00 y 2.00 mm",
        "first crack, lower_glass           none", "first contact                      never", "2500.0 N",
        "internal_force              3.00   75.0 %      10000",
        "warning: the fixed step exceeds the stable step", "1 thread,"}) {
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\nis missing in\n" << text;
  }
  EXPECT_EQ(text.find("velocity of the impactor"), std::string::npos) << "never came about";
}

}  // namespace
}  // namespace cdfp
