/// The pictures of a run: crack patterns, force, energies.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cdfp/results.hpp"
#include "core/archive.hpp"
#include "output/crack_picture.hpp"
#include "output/section_picture.hpp"

namespace cdfp {

class Pictures {
 public:
  Pictures(std::filesystem::path folder, std::vector<std::string> crack_parts);

  /// Also beside the snapshots, for a run that goes on.
  void keep(const Frame& frame);
  /// Takes up what a run has kept in the folder up to `time`.
  void take_up(double time);
  void draw(const History& history, const Summary& summary) const;

 private:
  void archive(Archive& a);
  std::filesystem::path kept_file() const { return folder_ / "snapshots" / "pictures.cdfp"; }
  void begin(const Frame& frame);
  void begin_section(const Frame& frame, const std::optional<std::array<double, 3>>& impact);

  std::filesystem::path folder_;
  std::vector<std::string> parts_;
  std::vector<Index> numbers_;  ///< of `parts_` in the frames
  bool begun_ = false;
  double section_depth_ = 0;  ///< m, y of the section's plane
  std::vector<CrackPicture> cracks_;
  SectionPicture section_;
};

/// At most `count` of the panels, the last among them, the times spread as evenly as they allow.
std::vector<CrackPanel> choose_panels(const std::vector<CrackPanel>& panels, std::size_t count);

}  // namespace cdfp
