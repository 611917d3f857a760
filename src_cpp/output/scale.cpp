#include "output/scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cdfp {

Unit readable_unit(double largest, const std::string& si_name) {
  static constexpr const char* prefixes[] = {"n", "µ", "m", "", "k", "M", "G"};
  const double size = std::abs(largest);
  if (!(size > 0) || !std::isfinite(size)) return {1, si_name};
  const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(size) / 3 + 1e-12)), -3, 3);
  return {std::pow(10.0, 3 * thousands), prefixes[thousands + 3] + si_name};
}

Ticks round_ticks(double low, double high, int count) {
  Ticks ticks;
  if (!(high > low) || count < 1) return ticks;
  const double rough = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  const double step = power * (share <= 1.5 ? 1 : share <= 3.5 ? 2 : share <= 7.5 ? 5 : 10);
  const double slack = 1e-9 * step;
  const long first = std::lround(std::ceil((low - slack) / step));
  const long last = std::lround(std::floor((high + slack) / step));
  for (long i = first; i <= last; ++i) ticks.values.push_back(static_cast<double>(i) * step);
  ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return ticks;
}

double rounded_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double share = value / power * (1 + 1e-12);
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

std::string label(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value));
  const bool zero = std::string(text).find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? "\u2212" : "") + std::string(text);
}

std::string short_label(double value) {
  if (value == 0 || !std::isfinite(value)) return label(0, 0);
  const int before_point = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12)) + 1;
  std::string text = label(value, std::clamp(3 - before_point, 0, 12));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace cdfp
