/// Hexahedron with 2 x 2 x 2 points whose volumetric strain is that of the mean gradient (B-bar, Hughes 1980,
/// in Green-Lagrange strain):
///
///   W = sum_p w_p psi(Ebar_p),   Ebar_p = E_p + (tr E_mean - tr E_p) / 3 I.
///
/// Forces are minus the exact derivative: dW = sum_p w_p dev S_p : dE_p + (sum_p w_p tr S_p / 3) dtr E_mean.
#pragma once

#include <utility>

#include "element/block.hpp"
#include "element/modes.hpp"
#include "element/one_point.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

/// The points' places along each axis, 1 / sqrt 3.
inline constexpr double kPlace = 0.57735026918962576451;

/// The line of points along `axis` through `point`, by the signs of its two companions.
CDFP_INLINE constexpr int line_of(int point, int axis) {
  return axis == 0 ? point >> 1 : axis == 1 ? (point & 1) | (point >> 1 & 2) : point & 3;
}

/// Points of any hexahedron. Constants: mean gradient (7 x 3), then for each point d(xi_m)/dX_j / 8 (3 x 3)
/// and its volume.
struct HexahedronPoints {
  static constexpr int kPoint = 21, kPerPoint = 10;
  static constexpr int kConstants = kPoint + 8 * kPerPoint;

  template <class T>
  class Of {
   public:
    CDFP_INLINE explicit Of(const double* constants) : constants_(constants) {}

    CDFP_INLINE void mean_gradient(const T (&m)[kModes][3], T (&f)[3][3]) const {
      Hexahedron::gradient(constants_, m, f);
    }
    /// Adds to dW/dm what dW/dF (columns p) of the mean gradient gives.
    CDFP_INLINE void add_mean(const T (&p)[3][3], T (&r)[kModes][3]) const {
      Hexahedron::add_mean(constants_, p, r);
    }

    /// Two points over one another.
    struct Column {};
    CDFP_INLINE Column column(int) const { return {}; }

    /// F (columns) of a point, from 8 dx/dxi on the lines along each axis.
    CDFP_INLINE void gradient(Column, const T (&tangent)[3][4][3], int point, T (&f)[3][3]) const {
      for (int j = 0; j < 3; ++j) {
        for (int d = 0; d < 3; ++d) f[j][d] = T(0.0);
        for (int axis = 0; axis < 3; ++axis) {
          const T g = inverse(point, axis, j);
          for (int d = 0; d < 3; ++d) f[j][d] += g * tangent[axis][line_of(point, axis)][d];
        }
      }
    }
    /// Adds to `pull` (the transpose of `tangent`) what dW/dF (columns p) of a point gives.
    CDFP_INLINE void add_pull(Column, const T (&p)[3][3], int point, T (&pull)[3][4][3]) const {
      for (int axis = 0; axis < 3; ++axis) {
        for (int j = 0; j < 3; ++j) {
          const T g = inverse(point, axis, j);
          for (int d = 0; d < 3; ++d) pull[axis][line_of(point, axis)][d] += g * p[j][d];
        }
      }
    }
    CDFP_INLINE T volume(Column, int point) const {
      return load<T>(constants_ + (kPoint + kPerPoint * point + 9) * kLanes);
    }

   private:
    CDFP_INLINE T inverse(int point, int axis, int j) const {
      return load<T>(constants_ + (kPoint + kPerPoint * point + 3 * axis + j) * kLanes);
    }

    const double* constants_;
  };
};

/// Points of an element extruded along zeta (see Prism). Its plan is X = A xi + B eta + C xi eta in units of
/// modes.hpp. With D(xi, eta) = A x B + xi A x C + eta C x B, its Jacobian, all that the points need follows
/// from few constants (a large mesh waits for memory, not for arithmetic):
///
///   d(xi)/dX / 8 = (b_xi + xi k) / delta,   d(eta)/dX / 8 = (b_eta - eta k) / delta,
///   delta = D / (A x B),   k = (C_y, -C_x) / (A x B).
struct PrismPoints {
  // b of xi (x, y), eta (x, y), zeta (z); k (x, y) / sqrt 3; volume
  static constexpr int kBend = 5, kVolume = 7;
  static constexpr int kConstants = 8;

  template <class T>
  class Of {
   public:
    CDFP_INLINE explicit Of(const double* constants) {
      const auto at = [&](int component) { return load<T>(constants + component * kLanes); };
      for (int i = 0; i < 4; ++i) b_[i / 2][i % 2] = at(i);
      across_ = at(4);
      for (int j = 0; j < 2; ++j) k_[j] = at(kBend + j);
      eighth_ = at(kVolume) * T(1.0 / 8);
      const T area = T(512.0) * eighth_ * across_;  // A x B
      slope_[0] = area * (b_[1][1] * k_[0] - b_[1][0] * k_[1]);
      slope_[1] = area * (b_[0][1] * k_[0] - b_[0][0] * k_[1]);
    }

    /// Two points over one another.
    struct Column {
      T inverse[2][2], volume;
    };
    CDFP_INLINE Column column(int c) const {
      const T delta = T(1.0) + (c & 1 ? slope_[0] : -slope_[0]) + (c & 2 ? slope_[1] : -slope_[1]);
      const T per_delta = T(1.0) / delta;
      Column at;
      for (int j = 0; j < 2; ++j) {
        at.inverse[0][j] = (c & 1 ? b_[0][j] + k_[j] : b_[0][j] - k_[j]) * per_delta;
        at.inverse[1][j] = (c & 2 ? b_[1][j] - k_[j] : b_[1][j] + k_[j]) * per_delta;
      }
      at.volume = eighth_ * delta;
      return at;
    }

    CDFP_INLINE void mean_gradient(const T (&m)[kModes][3], T (&f)[3][3]) const {
      const T eta_zeta = skew(1), xi_zeta = skew(0);
      for (int d = 0; d < 3; ++d) {
        f[0][d] = b_[0][0] * m[0][d] + b_[1][0] * m[1][d];
        f[1][d] = b_[0][1] * m[0][d] + b_[1][1] * m[1][d];
        f[2][d] = across_ * m[2][d] + eta_zeta * m[3][d] + xi_zeta * m[4][d];
      }
    }
    CDFP_INLINE void add_mean(const T (&p)[3][3], T (&r)[kModes][3]) const {
      const T eta_zeta = skew(1), xi_zeta = skew(0);
      for (int d = 0; d < 3; ++d) {
        r[0][d] += b_[0][0] * p[0][d] + b_[0][1] * p[1][d];
        r[1][d] += b_[1][0] * p[0][d] + b_[1][1] * p[1][d];
        r[2][d] += across_ * p[2][d];
        r[3][d] += eta_zeta * p[2][d];
        r[4][d] += xi_zeta * p[2][d];
      }
    }

    CDFP_INLINE void gradient(const Column& at, const T (&tangent)[3][4][3], int point, T (&f)[3][3]) const {
      for (int j = 0; j < 2; ++j) {
        for (int d = 0; d < 3; ++d) {
          f[j][d] = at.inverse[0][j] * tangent[0][line_of(point, 0)][d] +
                    at.inverse[1][j] * tangent[1][line_of(point, 1)][d];
        }
      }
      for (int d = 0; d < 3; ++d) f[2][d] = across_ * tangent[2][line_of(point, 2)][d];
    }
    CDFP_INLINE void add_pull(const Column& at, const T (&p)[3][3], int point, T (&pull)[3][4][3]) const {
      for (int axis = 0; axis < 2; ++axis) {
        for (int d = 0; d < 3; ++d) {
          pull[axis][line_of(point, axis)][d] +=
              at.inverse[axis][0] * p[0][d] + at.inverse[axis][1] * p[1][d];
        }
      }
      for (int d = 0; d < 3; ++d) pull[2][line_of(point, 2)][d] += across_ * p[2][d];
    }
    CDFP_INLINE T volume(const Column& at, int) const { return at.volume; }

   private:
    /// b of the modes that an end face's slope in D brings in: delta's slope / 3, slopes being at 1 / sqrt 3.
    CDFP_INLINE T skew(int axis) const { return T(kPlace) * slope_[axis] * across_; }

    T b_[2][2], across_, k_[2], eighth_, slope_[2];
  };
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
    const At<T> points(constants);
    T m[kModes][3], mean[3][3], tangent[3][4][3], pull[3][4][3];
    to_modes(x, m);
    points.mean_gradient(m, mean);
    tangents(m, tangent);
    for (auto& axis : pull) {
      for (auto& line : axis) line[0] = line[1] = line[2] = T(0.0);
    }
    const T mean_trace = trace_of(mean);
    T pressure(0.0), norm(0.0);
#pragma GCC unroll 8
    for (int i = 0; i < kPoints; ++i) {
      const int point = i / 2 + i % 2 * 4;  // two over one another share constants
      const auto at = points.column(point & 3);
      T grad[3][3], p[3][3];
      Symmetric<T> strain;
      point_strain(points, at, tangent, mean_trace, point, grad, strain);
      const Symmetric<T> s = stress_of(strain, point);
      norm = max(norm, double_dot(s, s));
      const T w = points.volume(at, point);
      const T third = s.trace() * T(1.0 / 3);
      pressure += w * third;
      const Symmetric<T> ws = w * Symmetric<T>{s.xx - third, s.yy - third, s.zz - third, s.xy, s.yz, s.xz};
      first_piola_kirchhoff(grad, ws, p);
      points.add_pull(at, p, point, pull);
    }
    for (auto& column : mean) {
      for (T& component : column) component *= pressure;
    }
    collect(pull, m);
    points.add_mean(mean, m);
    to_corners(m, f);
    return norm;
  }

  template <class T, class DensityOf>
  CDFP_INLINE static void energy(const PartConstants&, const double* constants, const T (&x)[8][3],
                                 T& strain_energy, T& hourglass_energy, DensityOf&& density_of) {
    strain_energy = T(0.0);
    hourglass_energy = T(0.0);
    const At<T> points(constants);
    each_point(points, x, [&](const T(&)[3][3], const Symmetric<T>& strain, int point) {
      strain_energy += volume_of(points, point) * density_of(strain, point);
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
    const At<T> points(constants);
    T volume_now(0.0);
    for (auto& column : sum) column[0] = column[1] = column[2] = T(0.0);
    each_point(points, x, [&](const T(&grad)[3][3], const Symmetric<T>& strain, int point) {
      T here[3][3];
      push_forward(grad, volume_of(points, point) * stress_of(strain, point), here);
      volume_now += volume_of(points, point) * determinant(grad);
      for (int i = 0; i < 3; ++i) {
        for (int d = 0; d < 3; ++d) sum[i][d] += here[i][d];
      }
    });
    return volume_now;
  }

  /// `use(F, Ebar, point)`, F by columns
  template <class T, class Use>
  CDFP_INLINE static void each_point(const double* constants, const T (&x)[8][3], Use&& use) {
    each_point(At<T>(constants), x, std::forward<Use>(use));
  }

  template <class T>
  CDFP_INLINE static T volume(const double* constants, int point) {
    return volume_of(At<T>(constants), point);
  }

 private:
  template <class T>
  using At = typename Points::template Of<T>;

  template <class OfPoints>
  CDFP_INLINE static auto volume_of(const OfPoints& points, int point) {
    return points.volume(points.column(point & 3), point);
  }

  template <class T, class Use>
  CDFP_INLINE static void each_point(const At<T>& points, const T (&x)[8][3], Use&& use) {
    T m[kModes][3], mean[3][3], tangent[3][4][3];
    to_modes(x, m);
    points.mean_gradient(m, mean);
    tangents(m, tangent);
    const T mean_trace = trace_of(mean);
    for (int point = 0; point < kPoints; ++point) {
      T grad[3][3];
      Symmetric<T> strain;
      point_strain(points, points.column(point & 3), tangent, mean_trace, point, grad, strain);
      use(grad, strain, point);
    }
  }

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
  CDFP_INLINE static void point_strain(const At<T>& points, const typename At<T>::Column& at,
                                       const T (&tangent)[3][4][3], T mean_trace, int point, T (&grad)[3][3],
                                       Symmetric<T>& strain) {
    points.gradient(at, tangent, point, grad);
    green_strain(grad, strain);
    const T correction = (mean_trace - strain.trace()) * T(1.0 / 3);
    strain.xx += correction, strain.yy += correction, strain.zz += correction;
  }
};

}  // namespace cdfp::CDFP_ISA
