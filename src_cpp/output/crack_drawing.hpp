/// What the pictures of cracks share: from m to pixels, faces by damage, titles and legends.
#pragma once

#include <string>
#include <vector>

#include "output/plane_view.hpp"

namespace cdfp {

/// Crack faces at one time.
struct CrackPanel {
  double time = 0;  ///< s
  std::vector<SeenFacet> facets;
};

struct Extent {
  Point low, high;
  double width() const { return high.x - low.x; }
  double height() const { return high.y - low.y; }
};

Extent extent_of(const std::vector<Point>& points);

/// From m to pixels, y upwards.
struct Window {
  Point low;  ///< m, in the lower left corner of the box
  Box box;
  double scale;  ///< pixels a metre
  Point place(Point p) const { return {box.x + (p.x - low.x) * scale, box.bottom() - (p.y - low.y) * scale}; }
  std::vector<Point> place(const std::vector<Point>& points) const;
};

/// Only what lies in the window's box. Faces seen as areas lie below the lines, what is broken above what is
/// not.
void draw_facets(Canvas& canvas, const Window& window, const std::vector<Copy>& copies,
                 const std::vector<SeenFacet>& facets);

/// Time and numbers, above the box.
void draw_panel_title(Canvas& canvas, const Box& box, const CrackPanel& panel, std::size_t copies);

inline constexpr Colour impact_colour = rgb(0x0072b2);

/// Scale bar and colour bar around the height y of a picture this wide.
void draw_legend(Canvas& canvas, double side, double y, double width, double pixels_per_metre);

}  // namespace cdfp
