/// history.csv: one header line, then a line a row; grows by appending.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cdfp/results.hpp"

namespace cdfp {

class HistoryCsv {
 public:
  explicit HistoryCsv(std::filesystem::path path) : path_(std::move(path)) {}

  /// Writes the rows that are new since the last call; all of them when columns changed or rows went.
  void write(const History& history);

 private:
  std::filesystem::path path_;
  std::vector<std::string> columns_;
  std::size_t rows_ = 0;
};

}  // namespace cdfp
