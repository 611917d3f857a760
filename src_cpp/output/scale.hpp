/// Scales of axes: round ticks, units with prefixes, numbers and names as labels.
#pragma once

#include <string>
#include <vector>

namespace cdfp {

struct Unit {
  double size = 1;   ///< in the SI unit
  std::string name;  ///< with its prefix, such as "mJ"
};

/// The prefix from nano to giga with which `largest` has one to three digits before the point.
Unit readable_unit(double largest, const std::string& si_name);

struct Ticks {
  std::vector<double> values;
  int decimals = 0;  ///< that the labels need to differ
};

/// Multiples of 1, 2 or 5 times a power of ten inside [low, high], about `count` of them.
Ticks round_ticks(double low, double high, int count);

/// The largest of 1, 2 or 5 times a power of ten that is not above a positive value.
double rounded_down(double value);

/// Fixed decimals, a true minus sign.
std::string label(double value, int decimals);

/// Three significant digits, trailing zeros dropped.
std::string short_label(double value);

/// A name with blanks for its underscores.
std::string spoken(std::string name);

}  // namespace cdfp
