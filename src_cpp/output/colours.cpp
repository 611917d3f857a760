#include "output/colours.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cdfp {
namespace {

double gamma_encoded(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// sRGB of a colour in Oklab (Ottosson 2020).
Colour from_oklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {gamma_encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          gamma_encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          gamma_encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Colour line_colour(std::size_t number) {
  static constexpr unsigned colours[] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                         0xb8860b, 0x56b4e9, 0x444444};
  return rgb(colours[number % std::size(colours)]);
}

Colour damage_colour(double damage) {
  const double t = std::isfinite(damage) ? std::clamp(damage, 0.0, 1.0) : 0.0;
  const double lightness = 0.86 - 0.70 * t;
  const double chroma = 0.11 - 0.04 * t + 0.28 * t * (1 - t);
  const double hue = (72 - 110 * t) * 3.141592653589793 / 180;
  return from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

}  // namespace cdfp
