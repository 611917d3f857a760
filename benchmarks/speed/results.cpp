#include "speed/results.hpp"

#include <omp.h>

#include <cstdio>
#include <ctime>
#include <fstream>

#include "element/kernels.hpp"
#include "support/roofline.hpp"

namespace speed {

using namespace cdfp;

void Results::add(const std::string& what, Index elements, int threads, double value, const char* unit) {
  rows_.push_back(what + "," + std::to_string(elements) + "," + std::to_string(threads) + "," +
                  std::to_string(value) + "," + unit);
}

void Results::want(bool holds, const std::string& what) {
  if (!holds) missed_ += (missed_.empty() ? "" : "; ") + what;
}

void Results::keep(const char* file) const {
  const bool is_new = !std::ifstream(file).good();
  std::ofstream out(file, std::ios::app);
  if (is_new) out << "date,processor,instructions,what,elements,threads,value,unit\n";
  char date[16];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%d", std::localtime(&now));
  for (const std::string& row : rows_) {
    out << date << ',' << bench::processor_name() << ',' << choose_kernels().name << ',' << row << '\n';
  }
}

void Results::close() const {
  std::printf("%s\n", missed_.empty() ? "speed: pass" : ("speed: short: " + missed_).c_str());
}

std::vector<int> thread_counts() {
  return omp_get_num_procs() > 1 ? std::vector<int>{1, 2} : std::vector<int>{1};
}

}  // namespace speed
