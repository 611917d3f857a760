/// Everything that a run leaves in its folder.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cdfp/results.hpp"

namespace cdfp {

class Recorder {
 public:
  /// Makes the folder. `crack_parts`: parts whose cracks get a picture each, `cracks_<name>.png`.
  Recorder(const std::string& folder, std::vector<std::string> crack_parts);
  ~Recorder();

  /// Writes a VTU snapshot, brings the .pvd up to date (readable at any moment) and keeps what the crack
  /// pictures need.
  void snapshot(const Frame& frame);
  /// Rewrites history.csv from the rows so far.
  void history(const History& history);
  /// history.csv, results.h5, summary.json and the pictures.
  void finish(const Frame& last, const History& history, const Summary& summary);

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

}  // namespace cdfp
