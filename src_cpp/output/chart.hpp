/// Line charts: axes with round ticks, grid, series, marked times, bands and a legend.
#pragma once

#include <string>
#include <vector>

#include "output/canvas.hpp"

namespace cdfp {

struct Series {
  std::string name;
  std::vector<double> y;  ///< one for each `Chart::x`; what is not finite leaves a gap
  Colour colour;
  double width = 3;
  bool dashed = false;
};

/// A vertical line at one x, its text beside its top end.
struct Mark {
  double x = 0;
  std::string text;
  Colour colour;
};

struct Spot {
  Point at;
  std::string text;
  Colour colour;
};

struct Band {
  double low = 0, high = 0;
  std::string text;
  Colour colour;
};

struct Chart {
  std::string title, x_title, y_title;
  std::vector<double> x;
  std::vector<Series> series;
  std::vector<Mark> marks;  ///< in ascending order of x
  std::vector<Spot> spots;
  std::vector<Band> bands;
  double y_low = 0, y_high = 0;  ///< shown at least
  bool legend = false;           ///< leaves room beside the chart; drawn if there are two series or more
};

/// Distance from a chart's left edge to its axis, so that charts one below the other line up.
inline constexpr double chart_margin = 150;

void draw_chart(Canvas& canvas, const Box& box, const Chart& chart);

/// The finite points of a line that can be told apart at this resolution: first, lowest, highest and last of
/// each pixel column. Empty entries part runs at gaps.
std::vector<std::vector<Point>> visible_runs(const std::vector<Point>& points);

}  // namespace cdfp
