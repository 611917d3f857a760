#include "output/crack_picture.hpp"

#include <algorithm>
#include <cmath>

#include "output/scale.hpp"

namespace cdfp {
namespace {

constexpr int width = 2000;
constexpr double side = 40, gap = 36, header = 120, panel_title = 62, footer = 120;
constexpr double broken = 0.999;

struct Grid {
  std::size_t columns, rows;
};

Grid arrange(std::size_t panels) {
  const std::size_t columns = panels <= 1 ? 1 : panels <= 4 ? 2 : 3;
  return {columns, (panels + columns - 1) / columns};
}

/// From m to pixels: the outline fills the box, y upwards.
struct Frame2d {
  Point corner;
  Box box;
  double scale;
  Point place(Point p) const {
    return {box.x + (p.x - corner.x) * scale, box.bottom() - (p.y - corner.y) * scale};
  }
};

struct Extent {
  Point low, high;
};

Extent extent_of(const std::vector<Point>& outline) {
  Extent extent{outline.front(), outline.front()};
  for (const Point& p : outline) {
    extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
    extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
  }
  return extent;
}

void draw_facet(Canvas& canvas, const Frame2d& frame, const Copy& copy, const SeenFacet& facet) {
  std::array<Point, 4> corners;
  for (int c = 0; c < facet.count; ++c) corners[c] = frame.place(copy.place(facet.corners[c]));
  Colour colour = damage_colour(facet.damage);
  if (facet.edge_on()) {
    canvas.line(corners[0], corners[1], colour, 1.1 + 1.5 * facet.damage);
    return;
  }
  // Faces in the plane of the plate stay light, so that the lines above them can be read.
  colour.alpha = 0.10 + 0.22 * facet.damage;
  canvas.fill(std::span<const Point>(corners.data(), static_cast<std::size_t>(facet.count)), colour);
}

/// Faces in the plane of the plate lie below the lines, and what is broken above what is not.
std::vector<const SeenFacet*> drawing_order(const std::vector<SeenFacet>& facets) {
  std::vector<const SeenFacet*> order;
  for (const SeenFacet& facet : facets) order.push_back(&facet);
  std::stable_sort(order.begin(), order.end(), [](const SeenFacet* a, const SeenFacet* b) {
    return a->edge_on() != b->edge_on() ? b->edge_on() : a->damage < b->damage;
  });
  return order;
}

void draw_panel(Canvas& canvas, const Frame2d& frame, const CrackPicture& picture, const CrackPanel& panel) {
  std::vector<Point> outline;
  for (const Point& p : picture.outline) outline.push_back(frame.place(p));
  canvas.fill(outline, glass_tint);
  canvas.clip(frame.box);
  for (const SeenFacet* facet : drawing_order(panel.facets))
    for (const Copy& copy : picture.copies) draw_facet(canvas, frame, copy, *facet);
  canvas.unclip();
  canvas.polyline(outline, ink, 2.5, false, true);
  if (picture.impact) {
    const Point at = frame.place(*picture.impact);
    canvas.ring(at, 9, rgb(0xffffff), 6);
    canvas.ring(at, 9, rgb(0x0072b2), 3);
  }
}

void draw_panel_title(Canvas& canvas, const Frame2d& frame, const CrackPicture& picture,
                      const CrackPanel& panel) {
  const Unit unit = readable_unit(panel.time, "s");
  const double y = frame.box.y - panel_title / 2;
  canvas.text({frame.box.x, y}, short_label(panel.time / unit.size) + " " + unit.name,
              {.size = 30, .bold = true});
  const auto gone = std::count_if(panel.facets.begin(), panel.facets.end(),
                                  [](const SeenFacet& facet) { return facet.damage >= broken; });
  const std::size_t times = picture.copies.size();
  canvas.text({frame.box.right(), y},
              std::to_string(panel.facets.size() * times) + " faces, " +
                  std::to_string(static_cast<std::size_t>(gone) * times) + " broken",
              {.size = 22, .colour = soft_ink, .align = Align::right});
}

void draw_scale_bar(Canvas& canvas, Point at, double pixels_per_metre, double panel_width) {
  const Ticks ticks = round_ticks(0, panel_width / 3, 1);
  const double length = ticks.values.back();
  const double end = at.x + length * pixels_per_metre;
  canvas.line(at, {end, at.y}, ink, 4);
  canvas.line({at.x, at.y - 9}, {at.x, at.y + 9}, ink, 3);
  canvas.line({end, at.y - 9}, {end, at.y + 9}, ink, 3);
  canvas.text({end + 18, at.y}, short_label(length * 1e3) + " mm", {.size = 22});
}

void draw_colour_bar(Canvas& canvas, const Box& bar) {
  for (int i = 0; i < bar.width; ++i)
    canvas.fill(Box{bar.x + i, bar.y, 1.5, bar.height}, damage_colour(i / bar.width));
  canvas.text({bar.x - 16, bar.y + bar.height / 2}, "damage", {.size = 22, .align = Align::right});
  for (int tenth = 0; tenth <= 10; tenth += 2)
    canvas.text({bar.x + bar.width * tenth / 10, bar.bottom() + 20}, label(tenth / 10.0, 1),
                {.size = 20, .colour = soft_ink, .align = Align::centre});
  canvas.text({bar.x, bar.y - 18}, "just inserted", {.size = 20, .colour = soft_ink});
  canvas.text({bar.right(), bar.y - 18}, "broken", {.size = 20, .colour = soft_ink, .align = Align::right});
}

}  // namespace

void draw_crack_picture(const std::filesystem::path& path, const CrackPicture& picture) {
  if (picture.outline.size() < 3 || picture.panels.empty()) return;
  const Grid grid = arrange(picture.panels.size());
  const Extent extent = extent_of(picture.outline);
  const double span_x = extent.high.x - extent.low.x, span_y = extent.high.y - extent.low.y;
  const double columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  const double panel_width = (width - 2 * side - (columns - 1) * gap) / columns;
  const double scale = panel_width / span_x;
  const double panel_height = span_y * scale;
  const int height = static_cast<int>(header + rows * (panel_title + panel_height) + footer + 20);

  write_png(path, width, height, [&](Canvas& canvas) {
    canvas.text({side, 50}, "Cracks in the " + picture.part, {.size = 38, .bold = true});
    canvas.text({side, 98},
                picture.copies.size() > 1 ? "seen from above, all layers, whole plate by reflection"
                                          : "seen from above, all layers",
                {.size = 23, .colour = soft_ink});
    for (std::size_t i = 0; i < picture.panels.size(); ++i) {
      const double column = static_cast<double>(i % grid.columns),
                   row = static_cast<double>(i / grid.columns);
      const Box box{side + column * (panel_width + gap),
                    header + row * (panel_title + panel_height) + panel_title, panel_width, panel_height};
      const Frame2d frame{extent.low, box, scale};
      draw_panel(canvas, frame, picture, picture.panels[i]);
      draw_panel_title(canvas, frame, picture, picture.panels[i]);
    }
    const double y = height - footer / 2 - 6;
    draw_scale_bar(canvas, {side, y}, scale, span_x);
    if (picture.impact) {
      canvas.ring({800, y}, 9, rgb(0x0072b2), 3);
      canvas.text({824, y}, "impact", {.size = 22});
    }
    draw_colour_bar(canvas, {width - side - 640, y - 13, 640, 26});
  });
}

}  // namespace cdfp
