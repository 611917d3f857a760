/// The cracks of all parts at several times, in an upright section through the point of impact.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "output/crack_drawing.hpp"

namespace cdfp {

struct SectionPicture {
  struct Body {
    std::vector<Point> outline;  ///< m
    bool cracks;
  };
  std::vector<Body> bodies;
  Extent shown;  ///< m
  std::vector<Copy> copies;
  std::optional<Point> impact;  ///< m
  std::vector<CrackPanel> panels;
};

/// Draws nothing without bodies that crack or panels.
void draw_section_picture(const std::filesystem::path& path, const SectionPicture& picture);

}  // namespace cdfp
