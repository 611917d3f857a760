/// Snapshots for ParaView: `results.pvd` names snapshots/NNNN.vtu (bulk elements), `cracks.pvd` names
/// snapshots/cracks_NNNN.vtu (middle faces of the cohesive elements).
#pragma once

#include <filesystem>
#include <vector>

#include "cdfp/results.hpp"

namespace cdfp {

class Snapshots {
 public:
  explicit Snapshots(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void write(const Frame& frame);

 private:
  std::filesystem::path folder_;
  std::vector<double> times_;
};

}  // namespace cdfp
