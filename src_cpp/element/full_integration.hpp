/// Hexahedron with 2 x 2 x 2 points whose volumetric strain is that of the mean gradient (B-bar, Hughes 1980,
/// in Green-Lagrange strain):
///
///   W = sum_p w_p psi(Ebar_p),   Ebar_p = E_p + (tr E_mean - tr E_p) / 3 I.
///
/// Forces are minus the exact derivative: dW = sum_p w_p dev S_p : dE_p + (sum_p w_p tr S_p / 3) dtr E_mean.
#pragma once

#include "element/block.hpp"
#include "element/modes.hpp"
#include "element/one_point.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

/// The line of points along `axis` through `point`, by the signs of its two companions.
CDFP_INLINE constexpr int line_of(int point, int axis) {
  return axis == 0 ? point >> 1 : axis == 1 ? (point & 1) | (point >> 1 & 2) : point & 3;
}

/// Points of any hexahedron. Constants: mean gradient (7 x 3), then for each point d(xi_m)/dX_j / 8 (3 x 3)
/// and its volume.
struct HexahedronPoints {
  using Mean = Hexahedron;
  static constexpr int kPoint = 21, kPerPoint = 10;
  static constexpr int kConstants = kPoint + 8 * kPerPoint;

  /// F (columns) of a point, from 8 dx/dxi on the lines along each axis.
  template <class T>
  CDFP_INLINE static void gradient(const double* constants, const T (&tangent)[3][4][3], int point,
                                   T (&f)[3][3]) {
    for (int j = 0; j < 3; ++j) {
      for (int d = 0; d < 3; ++d) f[j][d] = T(0.0);
      for (int axis = 0; axis < 3; ++axis) {
        const T g = inverse<T>(constants, point, axis, j);
        for (int d = 0; d < 3; ++d) f[j][d] += g * tangent[axis][line_of(point, axis)][d];
      }
    }
  }

  /// Adds to `pull` (the transpose of `tangent`) what dW/dF (columns p) of a point gives.
  template <class T>
  CDFP_INLINE static void add_pull(const double* constants, const T (&p)[3][3], int point,
                                   T (&pull)[3][4][3]) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int j = 0; j < 3; ++j) {
        const T g = inverse<T>(constants, point, axis, j);
        for (int d = 0; d < 3; ++d) pull[axis][line_of(point, axis)][d] += g * p[j][d];
      }
    }
  }

  template <class T>
  CDFP_INLINE static T volume(const double* constants, int point) {
    return load<T>(constants + (kPoint + kPerPoint * point + 9) * kLanes);
  }

 private:
  template <class T>
  CDFP_INLINE static T inverse(const double* constants, int point, int axis, int j) {
    return load<T>(constants + (kPoint + kPerPoint * point + 3 * axis + j) * kLanes);
  }
};

/// Points of an element extruded along zeta (see Prism). Constants: mean gradient (7), d(zeta)/dZ / 8, then
/// for each pair of points over one another d(xi, eta)/d(X, Y) / 8 (2 x 2) and the volume of one.
struct PrismPoints {
  using Mean = Prism;
  static constexpr int kAcross = 7, kPoint = 8, kPerPoint = 5;
  static constexpr int kConstants = kPoint + 4 * kPerPoint;

  template <class T>
  CDFP_INLINE static void gradient(const double* constants, const T (&tangent)[3][4][3], int point,
                                   T (&f)[3][3]) {
    const T across = load<T>(constants + kAcross * kLanes);
    for (int j = 0; j < 2; ++j) {
      const T g = inverse<T>(constants, point, 0, j), h = inverse<T>(constants, point, 1, j);
      for (int d = 0; d < 3; ++d) {
        f[j][d] = g * tangent[0][line_of(point, 0)][d] + h * tangent[1][line_of(point, 1)][d];
      }
    }
    for (int d = 0; d < 3; ++d) f[2][d] = across * tangent[2][line_of(point, 2)][d];
  }

  template <class T>
  CDFP_INLINE static void add_pull(const double* constants, const T (&p)[3][3], int point,
                                   T (&pull)[3][4][3]) {
    const T across = load<T>(constants + kAcross * kLanes);
    for (int axis = 0; axis < 2; ++axis) {
      const T g = inverse<T>(constants, point, axis, 0), h = inverse<T>(constants, point, axis, 1);
      for (int d = 0; d < 3; ++d) pull[axis][line_of(point, axis)][d] += g * p[0][d] + h * p[1][d];
    }
    for (int d = 0; d < 3; ++d) pull[2][line_of(point, 2)][d] += across * p[2][d];
  }

  template <class T>
  CDFP_INLINE static T volume(const double* constants, int point) {
    return load<T>(constants + (kPoint + kPerPoint * (point & 3) + 4) * kLanes);
  }

 private:
  template <class T>
  CDFP_INLINE static T inverse(const double* constants, int point, int axis, int j) {
    return load<T>(constants + (kPoint + kPerPoint * (point & 3) + 2 * axis + j) * kLanes);
  }
};

template <class Points>
struct FullIntegration {
  static constexpr int kCorners = 8;
  static constexpr int kPoints = 8;
  static constexpr bool kHourglassFollowsLaw = true;  ///< non-uniform strains are the law's too
  static constexpr int kConstants = Points::kConstants;

  template <class T, class StressOf>
  CDFP_INLINE static T force(const PartConstants&, const double* constants, const T (&x)[8][3], T (&f)[8][3],
                             StressOf&& stress_of) {
    T m[kModes][3], mean[3][3], tangent[3][4][3], pull[3][4][3];
    to_modes(x, m);
    Points::Mean::gradient(constants, m, mean);
    tangents(m, tangent);
    for (auto& axis : pull) {
      for (auto& line : axis) line[0] = line[1] = line[2] = T(0.0);
    }
    const T mean_trace = trace_of(mean);
    T pressure(0.0), norm(0.0);
#pragma GCC unroll 8
    for (int point = 0; point < kPoints; ++point) {
      T grad[3][3], p[3][3];
      Symmetric<T> strain;
      point_strain(constants, tangent, mean_trace, point, grad, strain);
      const Symmetric<T> s = stress_of(strain, point);
      norm = max(norm, double_dot(s, s));
      const T w = volume<T>(constants, point);
      const T third = s.trace() * T(1.0 / 3);
      pressure += w * third;
      const Symmetric<T> ws = w * Symmetric<T>{s.xx - third, s.yy - third, s.zz - third, s.xy, s.yz, s.xz};
      first_piola_kirchhoff(grad, ws, p);
      Points::add_pull(constants, p, point, pull);
    }
    for (auto& column : mean) {
      for (T& component : column) component *= pressure;
    }
    collect(pull, m);
    Points::Mean::add_mean(constants, mean, m);
    to_corners(m, f);
    return norm;
  }

  template <class T, class DensityOf>
  CDFP_INLINE static void energy(const PartConstants&, const double* constants, const T (&x)[8][3],
                                 T& strain_energy, T& hourglass_energy, DensityOf&& density_of) {
    strain_energy = T(0.0);
    hourglass_energy = T(0.0);
    each_point(constants, x, [&](const T(&)[3][3], const Symmetric<T>& strain, int point) {
      strain_energy += volume<T>(constants, point) * density_of(strain, point);
    });
  }

  template <class T, class StressOf>
  CDFP_INLINE static void extremes(const double* constants, const T (&x)[8][3], T& strain_square,
                                   T& stress_square, T& hourglass_square, StressOf&& stress_of) {
    strain_square = stress_square = hourglass_square = T(0.0);
    each_point(constants, x, [&](const T(&)[3][3], const Symmetric<T>& strain, int point) {
      const Symmetric<T> s = stress_of(strain, point);
      strain_square = max(strain_square, double_dot(strain, strain));
      stress_square = max(stress_square, double_dot(s, s));
    });
  }

  template <class T, class StressOf>
  CDFP_INLINE static T kirchhoff_stress(const double* constants, const T (&x)[8][3], T (&sum)[3][3],
                                        StressOf&& stress_of) {
    T volume_now(0.0);
    for (auto& column : sum) column[0] = column[1] = column[2] = T(0.0);
    each_point(constants, x, [&](const T(&grad)[3][3], const Symmetric<T>& strain, int point) {
      T here[3][3];
      push_forward(grad, volume<T>(constants, point) * stress_of(strain, point), here);
      volume_now += volume<T>(constants, point) * determinant(grad);
      for (int i = 0; i < 3; ++i) {
        for (int d = 0; d < 3; ++d) sum[i][d] += here[i][d];
      }
    });
    return volume_now;
  }

  /// `use(F, Ebar, point)`, F by columns
  template <class T, class Use>
  CDFP_INLINE static void each_point(const double* constants, const T (&x)[8][3], Use&& use) {
    T m[kModes][3], mean[3][3], tangent[3][4][3];
    to_modes(x, m);
    Points::Mean::gradient(constants, m, mean);
    tangents(m, tangent);
    const T mean_trace = trace_of(mean);
    for (int point = 0; point < kPoints; ++point) {
      T grad[3][3];
      Symmetric<T> strain;
      point_strain(constants, tangent, mean_trace, point, grad, strain);
      use(grad, strain, point);
    }
  }

  template <class T>
  CDFP_INLINE static T volume(const double* constants, int point) {
    return Points::template volume<T>(constants, point);
  }

 private:
  static constexpr double kPlace = 0.57735026918962576451;  ///< of the points, 1 / sqrt 3

  /// Modes of the tangent along an axis: constant, linear in its first and in its second companion, product.
  static constexpr int kOf[3][4] = {{0, 5, 4, 6}, {1, 5, 3, 6}, {2, 4, 3, 6}};

  /// 8 dx/dxi_axis on each line.
  template <class T>
  CDFP_INLINE static void tangents(const T (&m)[kModes][3], T (&t)[3][4][3]) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int d = 0; d < 3; ++d) {
        const T a = m[kOf[axis][0]][d], b = T(kPlace) * m[kOf[axis][1]][d];
        const T c = T(kPlace) * m[kOf[axis][2]][d], e = T(kPlace * kPlace) * m[kOf[axis][3]][d];
        const T low = a - c, high = a + c, low_slope = b - e, high_slope = b + e;
        t[axis][0][d] = low - low_slope;
        t[axis][1][d] = low + low_slope;
        t[axis][2][d] = high - high_slope;
        t[axis][3][d] = high + high_slope;
      }
    }
  }

  /// Transposed `tangents`; all modes are set.
  template <class T>
  CDFP_INLINE static void collect(const T (&t)[3][4][3], T (&m)[kModes][3]) {
    for (auto& mode : m) mode[0] = mode[1] = mode[2] = T(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      for (int d = 0; d < 3; ++d) {
        const T low = t[axis][0][d] + t[axis][1][d], high = t[axis][2][d] + t[axis][3][d];
        const T low_slope = t[axis][1][d] - t[axis][0][d], high_slope = t[axis][3][d] - t[axis][2][d];
        m[kOf[axis][0]][d] += low + high;
        m[kOf[axis][1]][d] += T(kPlace) * (low_slope + high_slope);
        m[kOf[axis][2]][d] += T(kPlace) * (high - low);
        m[kOf[axis][3]][d] += T(kPlace * kPlace) * (high_slope - low_slope);
      }
    }
  }

  template <class T>
  CDFP_INLINE static T trace_of(const T (&grad)[3][3]) {
    Symmetric<T> strain;
    green_strain(grad, strain);
    return strain.trace();
  }

  /// F and Ebar of a point.
  template <class T>
  CDFP_INLINE static void point_strain(const double* constants, const T (&tangent)[3][4][3], T mean_trace,
                                       int point, T (&grad)[3][3], Symmetric<T>& strain) {
    Points::gradient(constants, tangent, point, grad);
    green_strain(grad, strain);
    const T correction = (mean_trace - strain.trace()) * T(1.0 / 3);
    strain.xx += correction, strain.yy += correction, strain.zz += correction;
  }
};

}  // namespace cdfp::CDFP_ISA
