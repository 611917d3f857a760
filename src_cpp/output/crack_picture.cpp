#include "output/crack_picture.hpp"

#include <algorithm>

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

void draw_impact(Canvas& canvas, Point at) {
  canvas.ring(at, 7, rgb(0xffffff), 5);
  canvas.ring(at, 7, impact_colour, 2.5);
}

void draw_panel(Canvas& canvas, const Window& window, const CrackPicture& picture, const CrackPanel& panel) {
  const std::vector<Point> outline = window.place(picture.outline);
  canvas.fill(outline, glass_tint);
  draw_facets(canvas, window, picture.copies, panel.facets);
  canvas.polyline(outline, ink, 2.5, false, true);
  if (picture.impact) draw_impact(canvas, window.place(*picture.impact));
  draw_panel_title(canvas, window.box, panel, picture.copies.size());
}

}  // namespace

void draw_crack_picture(const std::filesystem::path& path, const CrackPicture& picture) {
  if (picture.outline.size() < 3 || picture.panels.empty()) return;
  const Grid grid = arrange(picture.panels.size());
  const Extent extent = extent_of(picture.outline);
  const double columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  const double panel_width = (width - 2 * side - (columns - 1) * gap_across) / columns;
  const double scale = panel_width / extent.width();
  const double panel_height = extent.height() * scale, row_height = panel_title + panel_height + gap_up;
  const int height = static_cast<int>(header + rows * row_height + footer);

  write_png(path, width, height, [&](Canvas& canvas) {
    canvas.text({side, 50}, "Cracks in the " + picture.part, {.size = 38, .bold = true});
    canvas.text({side, 98},
                picture.copies.size() > 1 ? "seen from above, all layers, whole plate by reflection"
                                          : "seen from above, all layers",
                {.size = 23, .colour = soft_ink});
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
