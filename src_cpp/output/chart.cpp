#include "output/chart.hpp"

#include <algorithm>
#include <cmath>

#include "output/scale.hpp"

namespace cdfp {
namespace {

constexpr double title_height = 50, x_axis_height = 86, legend_width = 430, right_margin = 50;
constexpr double mark_row = 34;

struct Range {
  double low, high;
  double span() const { return high - low; }
};

Range x_range(const Chart& chart) {
  Range range{0, 0};
  for (const double x : chart.x)
    if (std::isfinite(x)) range = {std::min(range.low, x), std::max(range.high, x)};
  return range.span() > 0 ? range : Range{range.low, range.low + 1};
}

/// Data and what must be shown, with air above and below, and room for the marks' texts at the top.
Range y_range(const Chart& chart, double height) {
  Range range{chart.y_low, chart.y_high};
  for (const Series& series : chart.series)
    for (const double y : series.y)
      if (std::isfinite(y)) range = {std::min(range.low, y), std::max(range.high, y)};
  if (!(range.span() > 0)) range.high = range.low + 1;
  const double above = 0.07 + mark_row * static_cast<double>(chart.marks.size()) / height;
  // Rounding errors below zero need no room.
  const double below = range.low > 0 || range.low < -0.01 * range.high ? 0.07 : 0;
  const double span = range.span() / (1 - std::min(0.8, above + below));
  return {range.low - below * span, range.low - below * span + span};
}

struct Axes {
  Box box;
  Range x, y;
  Point place(Point at) const {
    return {box.x + (at.x - x.low) / x.span() * box.width,
            box.bottom() - (at.y - y.low) / y.span() * box.height};
  }
};

void draw_axes(Canvas& canvas, const Axes& axes, const Chart& chart) {
  const Box& box = axes.box;
  const Ticks across = round_ticks(axes.x.low, axes.x.high, static_cast<int>(box.width / 150));
  for (const double x : across.values) {
    const double at = axes.place({x, axes.y.low}).x;
    canvas.line({at, box.y}, {at, box.bottom()}, grid_grey, 1.5);
    canvas.text({at, box.bottom() + 24}, label(x, across.decimals), {.size = 22, .align = Align::centre});
  }
  const Ticks up = round_ticks(axes.y.low, axes.y.high, std::max(3, static_cast<int>(box.height / 85)));
  for (const double y : up.values) {
    const double at = axes.place({axes.x.low, y}).y;
    canvas.line({box.x, at}, {box.right(), at}, y == 0 ? soft_ink : grid_grey, 1.5);
    canvas.text({box.x - 14, at}, label(y, up.decimals), {.size = 22, .align = Align::right});
  }
  canvas.line({box.x, box.bottom()}, {box.right(), box.bottom()}, soft_ink, 2);
  canvas.line({box.x, box.y}, {box.x, box.bottom()}, soft_ink, 2);
  canvas.text({box.x + box.width / 2, box.bottom() + 64}, chart.x_title,
              {.size = 23, .colour = soft_ink, .align = Align::centre});
  canvas.text({box.x - chart_margin + 30, box.y + box.height / 2}, chart.y_title,
              {.size = 23, .colour = soft_ink, .align = Align::centre, .upwards = true});
}

void draw_series(Canvas& canvas, const Axes& axes, const Chart& chart, const Series& series) {
  std::vector<Point> points;
  const std::size_t count = std::min(chart.x.size(), series.y.size());
  for (std::size_t i = 0; i < count; ++i) points.push_back(axes.place({chart.x[i], series.y[i]}));
  for (const std::vector<Point>& run : visible_runs(points))
    canvas.polyline(run, series.colour, series.width, series.dashed);
}

/// The first mark is the tallest, so that no text crosses a later line.
void draw_marks(Canvas& canvas, const Axes& axes, const Chart& chart) {
  double row = axes.box.y + mark_row / 2;
  for (const Mark& mark : chart.marks) {
    const double x = axes.place({mark.x, 0}).x;
    TextStyle style{.size = 22, .colour = mark.colour};
    const double width = canvas.text_width(mark.text, style);
    const bool leftwards = x + 12 + width > axes.box.right();
    if (leftwards) style.align = Align::right;
    canvas.line({x, row}, {x, axes.box.bottom()}, mark.colour, 2.2, true);
    canvas.text({leftwards ? x - 12 : x + 12, row + 2}, mark.text, style);
    row += mark_row;
  }
}

void draw_legend(Canvas& canvas, const Chart& chart, Point at) {
  for (const Series& series : chart.series) {
    canvas.line({at.x, at.y}, {at.x + 46, at.y}, series.colour, series.width + 1, series.dashed);
    canvas.text({at.x + 60, at.y}, series.name, {.size = 22});
    at.y += 40;
  }
}

}  // namespace

std::vector<std::vector<Point>> visible_runs(const std::vector<Point>& points) {
  std::vector<std::vector<Point>> runs;
  bool open = false;
  for (std::size_t i = 0; i < points.size();) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
      open = false;
      ++i;
      continue;
    }
    if (!open) runs.emplace_back();
    open = true;
    const double column = std::floor(points[i].x);
    std::size_t end = i, lowest = i, highest = i;
    while (end < points.size() && std::floor(points[end].x) == column && std::isfinite(points[end].y)) {
      if (points[end].y < points[lowest].y) lowest = end;
      if (points[end].y > points[highest].y) highest = end;
      ++end;
    }
    std::size_t kept[4] = {i, std::min(lowest, highest), std::max(lowest, highest), end - 1};
    for (std::size_t k = 0; k < 4; ++k)
      if (k == 0 || kept[k] != kept[k - 1]) runs.back().push_back(points[kept[k]]);
    i = end;
  }
  return runs;
}

void draw_chart(Canvas& canvas, const Box& box, const Chart& chart) {
  const double beside = chart.legend ? legend_width : right_margin;
  const double above = chart.title.empty() ? 16 : title_height;
  const Box inner{box.x + chart_margin, box.y + above, box.width - chart_margin - beside,
                  box.height - above - x_axis_height};
  const Axes axes{inner, x_range(chart), y_range(chart, inner.height)};
  if (!chart.title.empty()) canvas.text({inner.x, box.y + 18}, chart.title, {.size = 28, .bold = true});
  for (const Band& band : chart.bands) {
    const double top = axes.place({0, band.high}).y, bottom = axes.place({0, band.low}).y;
    canvas.fill(Box{inner.x, top, inner.width, bottom - top}, band.colour);
  }
  draw_axes(canvas, axes, chart);
  for (const Band& band : chart.bands) {
    const double top = axes.place({0, band.high}).y;
    canvas.text({inner.right() - 12, top + 18}, band.text,
                {.size = 20, .colour = soft_ink, .align = Align::right});
  }
  canvas.clip(inner);
  for (const Series& series : chart.series) draw_series(canvas, axes, chart, series);
  canvas.unclip();
  draw_marks(canvas, axes, chart);
  for (const Spot& spot : chart.spots) {
    const Point at = axes.place(spot.at);
    canvas.disc(at, 8, rgb(0xffffff));
    canvas.ring(at, 7, spot.colour, 3.5);
    canvas.text({at.x + 18, at.y - 2}, spot.text, {.size = 22, .colour = spot.colour});
  }
  if (chart.legend && chart.series.size() > 1) draw_legend(canvas, chart, {inner.right() + 40, inner.y + 24});
}

}  // namespace cdfp
