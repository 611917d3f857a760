/// What `speed` has measured.
#pragma once

#include <string>
#include <vector>

#include "cdfp/types.hpp"

namespace speed {

/// Rows to keep, and what of the wanted was missed.
class Results {
 public:
  void add(const std::string& what, cdfp::Index elements, int threads, double value, const char* unit);
  void want(bool holds, const std::string& what);
  void keep(const char* file) const;
  /// Prints the verdict.
  void close() const;

 private:
  std::vector<std::string> rows_;
  std::string missed_;
};

/// One and two, where the machine has them.
std::vector<int> thread_counts();

}  // namespace speed
