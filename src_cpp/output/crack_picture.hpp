/// The crack pattern of one part at several times, seen from above.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/crack_drawing.hpp"

namespace cdfp {

struct CrackPicture {
  std::string part;            ///< as the title names it
  std::vector<Point> outline;  ///< of the whole part, m
  std::vector<Copy> copies;
  std::optional<Point> impact;  ///< m
  std::vector<CrackPanel> panels;
};

/// Draws nothing without an outline or panels.
void draw_crack_picture(const std::filesystem::path& path, const CrackPicture& picture);

}  // namespace cdfp
