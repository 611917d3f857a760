/// Snapshots for ParaView: `results.pvd` names snapshots/NNNN.vtu (bulk elements), `cracks.pvd` names
/// snapshots/cracks_NNNN.vtu (middle faces of the cohesive elements).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cdfp/results.hpp"

namespace cdfp {

class Snapshots {
 public:
  explicit Snapshots(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void write(const Frame& frame);
  /// Counts on from the snapshots that lie in the folder up to `time`; later ones go.
  void take_up(double time);
  /// s, of the last one; nothing if there is none.
  std::optional<double> last_time() const {
    return times_.empty() ? std::nullopt : std::optional(times_.back());
  }

 private:
  void write_collections() const;

  std::filesystem::path folder_;
  std::vector<double> times_;
};

}  // namespace cdfp
