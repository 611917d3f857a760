#include "output/crack_drawing.hpp"

#include <algorithm>

#include "output/scale.hpp"

namespace cdfp {
namespace {

void draw_facet(Canvas& canvas, const Window& window, const Copy& copy, const SeenFacet& facet) {
  std::array<Point, 4> corners;
  const auto count = static_cast<std::size_t>(facet.count);
  for (std::size_t c = 0; c < count; ++c) corners[c] = window.place(copy.place(facet.corners[c]));
  Colour colour = damage_colour(facet.damage);
  if (facet.edge_on()) {
    canvas.line(corners[0], corners[1], colour, 1.1 + 1.5 * facet.damage);
    return;
  }
  // Areas stay light, so that the lines above them can be read.
  colour.alpha = 0.10 + 0.22 * facet.damage;
  canvas.fill(std::span<const Point>(corners.data(), count), colour);
}

void draw_scale_bar(Canvas& canvas, Point at, double pixels_per_metre) {
  constexpr double longest = 500;
  const double length = rounded_down(longest / pixels_per_metre);
  const double end = at.x + length * pixels_per_metre;
  canvas.line(at, {end, at.y}, ink, 4);
  canvas.line({at.x, at.y - 9}, {at.x, at.y + 9}, ink, 3);
  canvas.line({end, at.y - 9}, {end, at.y + 9}, ink, 3);
  canvas.text({end + 18, at.y}, short_label(length * 1e3) + " mm", {.size = 22});
}

void draw_colour_bar(Canvas& canvas, const Box& bar) {
  for (int i = 0; i < bar.width; ++i)
    canvas.fill(Box{bar.x + i, bar.y, std::min(1.5, bar.width - i), bar.height},
                damage_colour(i / bar.width));
  canvas.text({bar.x - 18, bar.y + bar.height / 2}, "damage", {.size = 22, .align = Align::right});
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double x = bar.x + bar.width * tenth / 10;
    canvas.line({x, bar.bottom()}, {x, bar.bottom() + 6}, soft_ink, 2);
    canvas.text({x, bar.bottom() + 22}, label(tenth / 10.0, 1),
                {.size = 20, .colour = soft_ink, .align = Align::centre});
  }
  canvas.text({bar.x, bar.y - 18}, "just inserted", {.size = 20, .colour = soft_ink});
  canvas.text({bar.right(), bar.y - 18}, "broken", {.size = 20, .colour = soft_ink, .align = Align::right});
}

}  // namespace

Extent extent_of(const std::vector<Point>& points) {
  Extent extent{points.front(), points.front()};
  for (const Point& p : points) {
    extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
    extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
  }
  return extent;
}

std::vector<Point> Window::place(const std::vector<Point>& points) const {
  std::vector<Point> placed;
  placed.reserve(points.size());
  for (const Point& p : points) placed.push_back(place(p));
  return placed;
}

void draw_facets(Canvas& canvas, const Window& window, const std::vector<Copy>& copies,
                 const std::vector<SeenFacet>& facets) {
  std::vector<const SeenFacet*> order;
  order.reserve(facets.size());
  for (const SeenFacet& facet : facets) order.push_back(&facet);
  std::stable_sort(order.begin(), order.end(), [](const SeenFacet* a, const SeenFacet* b) {
    return a->edge_on() != b->edge_on() ? b->edge_on() : a->damage < b->damage;
  });
  canvas.clip(window.box);
  for (const SeenFacet* facet : order)
    for (const Copy& copy : copies) draw_facet(canvas, window, copy, *facet);
  canvas.unclip();
}

void draw_panel_title(Canvas& canvas, const Box& box, const CrackPanel& panel, std::size_t copies) {
  constexpr float broken = 0.999f;
  const Unit unit = readable_unit(panel.time, "s");
  const double y = box.y - 30;
  canvas.text({box.x, y}, short_label(panel.time / unit.size) + " " + unit.name, {.size = 30, .bold = true});
  const auto gone = std::count_if(panel.facets.begin(), panel.facets.end(),
                                  [](const SeenFacet& facet) { return facet.damage >= broken; });
  canvas.text({box.right(), y},
              std::to_string(panel.facets.size() * copies) + " faces, " +
                  std::to_string(static_cast<std::size_t>(gone) * copies) + " broken",
              {.size = 22, .colour = soft_ink, .align = Align::right});
}

void draw_legend(Canvas& canvas, double side, double y, double width, double pixels_per_metre) {
  draw_scale_bar(canvas, {side, y}, pixels_per_metre);
  constexpr double bar = 640;
  draw_colour_bar(canvas, {width - side - 20 - bar, y - 13, bar, 26});
}

}  // namespace cdfp
