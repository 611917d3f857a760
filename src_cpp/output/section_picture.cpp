#include "output/section_picture.hpp"

namespace cdfp {
namespace {

constexpr int width = 2000;
constexpr double side = 40, gap_up = 22, header = 120, panel_title = 62, footer = 130;
constexpr Colour interlayer_tint = rgb(0xefe6d3);

/// An arrowhead that stands on the top face.
void draw_impact(Canvas& canvas, Point tip) {
  const Point head[3] = {{tip.x, tip.y - 3}, {tip.x - 11, tip.y - 23}, {tip.x + 11, tip.y - 23}};
  canvas.fill(head, impact_colour);
  canvas.text({tip.x + 22, tip.y - 14}, "impact", {.size = 20, .colour = impact_colour});
}

void draw_panel(Canvas& canvas, const Window& window, const SectionPicture& picture,
                const CrackPanel& panel) {
  canvas.clip(window.box);
  for (const SectionPicture::Body& body : picture.bodies)
    canvas.fill(window.place(body.outline), body.cracks ? glass_tint : interlayer_tint);
  canvas.unclip();
  draw_facets(canvas, window, picture.copies, panel.facets);
  canvas.clip(window.box);
  for (const SectionPicture::Body& body : picture.bodies)
    canvas.polyline(window.place(body.outline), soft_ink, 1.5, false, true);
  canvas.unclip();
  canvas.stroke(window.box, ink, 2.5);
  if (picture.impact) draw_impact(canvas, {window.place(*picture.impact).x, window.box.y});
  draw_panel_title(canvas, window.box, panel, picture.copies.size());
}

}  // namespace

void draw_section_picture(const std::filesystem::path& path, const SectionPicture& picture) {
  if (!(picture.shown.height() > 0) || picture.panels.empty()) return;
  const double scale = (width - 2 * side) / picture.shown.width();
  const double panel_height = picture.shown.height() * scale,
               row_height = panel_title + panel_height + gap_up;
  const int height =
      static_cast<int>(header + static_cast<double>(picture.panels.size()) * row_height + footer);

  write_png(path, width, height, [&](Canvas& canvas) {
    canvas.text({side, 50}, "Cracks in section", {.size = 38, .bold = true});
    canvas.text({side, 98}, "upright plane through the point of impact, undeformed",
                {.size = 23, .colour = soft_ink});
    double y = header;
    for (const CrackPanel& panel : picture.panels) {
      const Box box{side, y + panel_title, width - 2 * side, panel_height};
      draw_panel(canvas, {picture.shown.low, box, scale}, picture, panel);
      y += row_height;
    }
    draw_legend(canvas, side, height - footer / 2 - 6, width, scale);
  });
}

}  // namespace cdfp
