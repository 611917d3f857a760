/// Colours of the pictures.
#pragma once

#include <cstddef>

namespace cdfp {

struct Colour {
  double red = 0, green = 0, blue = 0, alpha = 1;
};

constexpr Colour rgb(unsigned hex, double alpha = 1) {
  return {(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0, alpha};
}

inline constexpr Colour ink = rgb(0x1f2933);
inline constexpr Colour soft_ink = rgb(0x5b6773);
inline constexpr Colour grid_grey = rgb(0xe3e7eb);
inline constexpr Colour glass_tint = rgb(0xf3f7f9);

/// Colours that stay apart for colour-blind eyes (Okabe and Ito), repeated after the seventh.
Colour line_colour(std::size_t number);

/// From light orange (0, just inserted) over red to near black (1, broken); lightness falls evenly, so equal
/// differences of damage look equally large.
Colour damage_colour(double damage);

}  // namespace cdfp
