/// Numbers as text.
#pragma once

#include <charconv>
#include <string>

namespace cdfp {

/// The shortest text that reads back as the same number.
inline std::string to_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace cdfp
