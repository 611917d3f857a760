/// A drawing surface in pixels, origin at the top left, y downwards. What is drawn once comes out as PNG or
/// SVG.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "output/colours.hpp"

namespace cdfp {

struct Point {
  double x = 0, y = 0;
};

struct Box {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

enum class Align { left, centre, right };

struct TextStyle {
  double size = 22;
  Colour colour = ink;
  Align align = Align::left;
  bool bold = false;
  bool upwards = false;  ///< turned to read from bottom to top
};

class Canvas {
 public:
  explicit Canvas(cairo_t* context) : context_(context) {}

  void fill(const Box& box, Colour colour);
  void fill(std::span<const Point> polygon, Colour colour);
  void stroke(const Box& box, Colour colour, double width);
  void line(Point from, Point to, Colour colour, double width, bool dashed = false);
  void polyline(std::span<const Point> points, Colour colour, double width, bool dashed = false,
                bool closed = false);
  void disc(Point centre, double radius, Colour colour);
  void ring(Point centre, double radius, Colour colour, double width);
  /// `at`: left, middle or right of the text, half way up its small letters.
  void text(Point at, const std::string& words, const TextStyle& style);
  double text_width(const std::string& words, const TextStyle& style);

  /// What is drawn until `unclip` shows inside the box only.
  void clip(const Box& box);
  void unclip();

 private:
  void trace(std::span<const Point> points);
  void use(Colour colour);
  void select(const TextStyle& style);

  cairo_t* context_;
};

using Drawing = std::function<void(Canvas&)>;

void write_png(const std::filesystem::path& path, int width, int height, const Drawing& drawing);
void write_svg(const std::filesystem::path& path, int width, int height, const Drawing& drawing);

}  // namespace cdfp
