#include "output/canvas.hpp"

#include <cairo-svg.h>

#include <algorithm>
#include <memory>

#include "output/files.hpp"
#include "output/png_file.hpp"

namespace cdfp {
namespace {

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Context = std::unique_ptr<cairo_t, Destroy>;

cairo_status_t append(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status, const std::filesystem::path& path) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(Status::io,
                "cannot draw '" + path.string() + "': " + cairo_status_to_string(status) + "; free memory");
}

/// What lies below the line `top` of the drawing.
void draw_on(cairo_surface_t* surface, const std::filesystem::path& path, const Drawing& drawing,
             int top = 0) {
  check(cairo_surface_status(surface), path);
  const Context context(cairo_create(surface));
  cairo_translate(context.get(), 0, -top);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  Canvas canvas(context.get());
  drawing(canvas);
  check(cairo_status(context.get()), path);
}

}  // namespace

void Canvas::use(Colour colour) {
  cairo_set_source_rgba(context_, colour.red, colour.green, colour.blue, colour.alpha);
}

void Canvas::trace(std::span<const Point> points) {
  cairo_new_path(context_);
  for (const Point& point : points) cairo_line_to(context_, point.x, point.y);
}

void Canvas::fill(const Box& box, Colour colour) {
  use(colour);
  cairo_rectangle(context_, box.x, box.y, box.width, box.height);
  cairo_fill(context_);
}

void Canvas::fill(std::span<const Point> polygon, Colour colour) {
  use(colour);
  trace(polygon);
  cairo_fill(context_);
}

void Canvas::stroke(const Box& box, Colour colour, double width) {
  use(colour);
  cairo_set_line_width(context_, width);
  cairo_rectangle(context_, box.x, box.y, box.width, box.height);
  cairo_stroke(context_);
}

void Canvas::line(Point from, Point to, Colour colour, double width, bool dashed) {
  const Point points[2] = {from, to};
  polyline(points, colour, width, dashed);
}

void Canvas::polyline(std::span<const Point> points, Colour colour, double width, bool dashed, bool closed) {
  use(colour);
  cairo_set_line_width(context_, width);
  cairo_set_line_cap(context_, dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  const double dash[2] = {3.5 * width, 3 * width};
  cairo_set_dash(context_, dash, dashed ? 2 : 0, 0);
  trace(points);
  if (closed) cairo_close_path(context_);
  cairo_stroke(context_);
  cairo_set_dash(context_, nullptr, 0, 0);
}

void Canvas::disc(Point centre, double radius, Colour colour) {
  use(colour);
  cairo_new_path(context_);
  cairo_arc(context_, centre.x, centre.y, radius, 0, 6.283185307179586);
  cairo_fill(context_);
}

void Canvas::ring(Point centre, double radius, Colour colour, double width) {
  use(colour);
  cairo_set_line_width(context_, width);
  cairo_new_path(context_);
  cairo_arc(context_, centre.x, centre.y, radius, 0, 6.283185307179586);
  cairo_stroke(context_);
}

void Canvas::select(const TextStyle& style) {
  cairo_select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, style.size);
}

double Canvas::text_width(const std::string& words, const TextStyle& style) {
  select(style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_, words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(Point at, const std::string& words, const TextStyle& style) {
  const double width = text_width(words, style);
  const double shift = style.align == Align::left ? 0 : style.align == Align::right ? width : width / 2;
  use(style.colour);
  cairo_save(context_);
  cairo_translate(context_, at.x, at.y);
  if (style.upwards) cairo_rotate(context_, -1.5707963267948966);
  // Small letters of DejaVu Sans are 0.55 of the size high, capitals 0.73: 0.35 centres both well.
  cairo_move_to(context_, -shift, 0.35 * style.size);
  cairo_show_text(context_, words.c_str());
  cairo_restore(context_);
}

void Canvas::clip(const Box& box) {
  cairo_save(context_);
  cairo_rectangle(context_, box.x, box.y, box.width, box.height);
  cairo_clip(context_);
}

void Canvas::unclip() {
  cairo_restore(context_);
}

void write_png(const std::filesystem::path& path, int width, int height, const Drawing& drawing) {
  constexpr int strip = 256;  // rows: a whole picture in memory may be more than the run that it shows
  PngFile file(width, height);
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, std::min(strip, height)));
  for (int top = 0; top < height; top += strip) {
    draw_on(surface.get(), path, drawing, top);
    cairo_surface_flush(surface.get());
    const unsigned char* pixels = cairo_image_surface_get_data(surface.get());
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
    for (int row = 0; row < std::min(strip, height - top); ++row) file.add_row(pixels + row * stride);
  }
  write_whole_file(path, file.finish());
}

void write_svg(const std::filesystem::path& path, int width, int height, const Drawing& drawing) {
  std::string bytes;
  {
    const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, width, height));
    draw_on(surface.get(), path, drawing);
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()), path);
  }
  write_whole_file(path, bytes);
}

}  // namespace cdfp
