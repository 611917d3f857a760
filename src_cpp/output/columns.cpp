#include "output/columns.hpp"

#include <algorithm>
#include <string_view>

namespace cdfp {

std::vector<double> column(const History& history, const std::string& name) {
  const auto found = std::find(history.columns.begin(), history.columns.end(), name);
  std::vector<double> values;
  if (found == history.columns.end()) return values;
  const std::size_t stride = history.columns.size();
  const std::size_t first = static_cast<std::size_t>(found - history.columns.begin());
  for (std::size_t row = 0; row < history.rows(); ++row)
    values.push_back(history.values[row * stride + first]);
  return values;
}

const char* column_units(const std::string& name) {
  struct Ending {
    std::string_view text;
    const char* units;
  };
  static constexpr Ending endings[] = {{"_s", "s"},   {"_m", "m"},     {"_n", "N"},  {"_j", "J"},
                                       {"_pa", "Pa"}, {"_mps", "m/s"}, {"_kg", "kg"}};
  for (const Ending& ending : endings)
    if (std::string_view(name).ends_with(ending.text)) return ending.units;
  return "1";
}

}  // namespace cdfp
