/// A number that counts the operations done with it: put in place of a kernel's pack, it tells the kernel's
/// arithmetic. Additions, multiplications, divisions, roots and comparisons count one each.
#pragma once

#include "core/pack.hpp"

namespace cdfp::host {

struct Counted {
  double value = 0;
  static inline long operations = 0;

  Counted() = default;
  Counted(double given) : value(given) {}
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  friend Counted operator+(Counted a, Counted b) { return ++operations, a.value + b.value; }
  friend Counted operator-(Counted a, Counted b) { return ++operations, a.value - b.value; }
  friend Counted operator*(Counted a, Counted b) { return ++operations, a.value * b.value; }
  friend Counted operator/(Counted a, Counted b) { return ++operations, a.value / b.value; }
  friend Counted operator-(Counted a) { return -a.value; }
  friend Counted max(Counted a, Counted b) { return ++operations, a.value > b.value ? a : b; }
  friend Counted min(Counted a, Counted b) { return ++operations, a.value < b.value ? a : b; }
  friend Counted square_root(Counted a) { return ++operations, __builtin_sqrt(a.value); }
  friend Counted power(Counted a, double n) { return ++operations, __builtin_pow(a.value, n); }
  friend void store(double* p, Counted a) { *p = a.value; }
};

}  // namespace cdfp::host
