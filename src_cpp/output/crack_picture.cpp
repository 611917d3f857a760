#include "output/crack_picture.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace cdfp {
namespace {

constexpr int width = 2000;
constexpr double side = 40, gap_across = 36, gap_up = 22, header = 120, panel_title = 62, footer = 130;

struct Grid {
  std::size_t columns, rows;
};

Grid arrange(std::size_t panels) {
  const std::size_t columns = panels == 4 ? 2 : std::min<std::size_t>(panels, 3);
  return {columns, (panels + columns - 1) / columns};
}

/// The whole part, or where its cracks reach less than half as far, a square around them.
Extent shown_extent(const CrackPicture& picture) {
  const Extent whole = extent_of(picture.outline);
  std::vector<Point> cracked;
  for (const CrackPanel& panel : picture.panels) {
    for (const SeenFacet& facet : panel.facets) {
      for (int c = 0; c < facet.count; ++c) {
        for (const Copy& copy : picture.copies) cracked.push_back(copy.place(facet.corners[c]));
      }
    }
  }
  if (cracked.empty()) return whole;
  const Extent cracks = extent_of(cracked);
  constexpr double margin = 1.3, least_share = 0.1;
  const double size =
      std::max({margin * cracks.width(), margin * cracks.height(), least_share * whole.width()});
  if (size > 0.5 * std::min(whole.width(), whole.height())) return whole;
  const Point middle{0.5 * (cracks.low.x + cracks.high.x), 0.5 * (cracks.low.y + cracks.high.y)};
  return {{middle.x - 0.5 * size, middle.y - 0.5 * size}, {middle.x + 0.5 * size, middle.y + 0.5 * size}};
}

std::string subtitle(const CrackPicture& picture, const Extent& shown) {
  std::string text = "seen from above, all layers";
  if (picture.copies.size() > 1) text += ", whole plate by reflection";
  const Extent whole = extent_of(picture.outline);
  if (shown.width() < whole.width()) {
    char part[80];
    std::snprintf(part, sizeof part, "; the cracked %.3g mm of %.3g mm", 1e3 * shown.width(),
                  1e3 * whole.width());
    text += part;
  }
  return text;
}

void draw_impact(Canvas& canvas, Point at) {
  canvas.ring(at, 7, rgb(0xffffff), 5);
  canvas.ring(at, 7, impact_colour, 2.5);
}

void draw_panel(Canvas& canvas, const Window& window, const CrackPicture& picture, const CrackPanel& panel) {
  const std::vector<Point> outline = window.place(picture.outline);
  const Box& box = window.box;
  const std::vector<Point> frame{
      {box.x, box.y}, {box.x + box.width, box.y}, {box.x + box.width, box.bottom()}, {box.x, box.bottom()}};
  canvas.clip(box);
  canvas.fill(outline, glass_tint);
  canvas.unclip();
  draw_facets(canvas, window, picture.copies, panel.facets);
  canvas.clip(box);
  canvas.polyline(outline, ink, 2.5, false, true);
  if (picture.impact) draw_impact(canvas, window.place(*picture.impact));
  canvas.unclip();
  canvas.polyline(frame, soft_ink, 1.5, false, true);
  draw_panel_title(canvas, window.box, panel, picture.copies.size());
}

}  // namespace

void draw_crack_picture(const std::filesystem::path& path, const CrackPicture& picture) {
  if (picture.outline.size() < 3 || picture.panels.empty()) return;
  const Grid grid = arrange(picture.panels.size());
  const Extent extent = shown_extent(picture);
  const double columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  const double panel_width = (width - 2 * side - (columns - 1) * gap_across) / columns;
  const double scale = panel_width / extent.width();
  const double panel_height = extent.height() * scale, row_height = panel_title + panel_height + gap_up;
  const int height = static_cast<int>(header + rows * row_height + footer);

  write_png(path, width, height, [&](Canvas& canvas) {
    canvas.text({side, 50}, "Cracks in the " + picture.part, {.size = 38, .bold = true});
    canvas.text({side, 98}, subtitle(picture, extent), {.size = 23, .colour = soft_ink});
    for (std::size_t i = 0; i < picture.panels.size(); ++i) {
      const std::size_t row_number = i / grid.columns;
      const double column = static_cast<double>(i % grid.columns), row = static_cast<double>(row_number);
      const Box box{side + column * (panel_width + gap_across), header + row * row_height + panel_title,
                    panel_width, panel_height};
      draw_panel(canvas, {extent.low, box, scale}, picture, picture.panels[i]);
    }
    const double y = height - footer / 2 - 6;
    draw_legend(canvas, side, y, width, scale);
    if (picture.impact) {
      draw_impact(canvas, {0.42 * width, y});
      canvas.text({0.42 * width + 26, y}, "impact", {.size = 22});
    }
  });
}

}  // namespace cdfp
