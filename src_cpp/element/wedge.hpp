/// Wedge (linear triangular prism), one strain and its slope through the thickness:
///
///   W = V/2 [psi(E + E') + psi(E - E')] + 1/2 k_t omega^2 + 1/2 k_z (a^2 + b^2 - a b),
///   F = mean gradient of the corner positions, E = (F^T F - I) / 2,
///   q_1, q_2 = what F leaves of the change of the upright edges along the triangle (zero for linear fields),
///   qhat_k = F^T q_k,   E' = symmetric part of qhat_1 (x) P_1 + qhat_2 (x) P_2 in the middle plane,
///   E'_zz = -nu / (1 - nu) (E'_xx + E'_yy),   omega = its antisymmetric part, a, b = z of qhat_1, qhat_2.
///
/// Assumed strains as of Belytschko and Bindeman 1993: bending across the triangles is that of plane stress
/// and has no shear, so that one layer bends as a plate does and near incompressibility adds no constraint;
/// the law sees it at two points, at 1 / sqrt 3 of half the height. The other two modes are elastic: torsion
/// about the height as of an equilateral bar (Saint-Venant: 0.6 of the polar moment) and bending along the
/// height with Young's modulus. Within a layer the strain is constant, as in any linear triangle, so
/// that a plate's triangles should be no longer than it is thick: shear stiffens longer ones. Since the
/// mean gradient is exact, the element passes the patch test in any shape; forces are minus the exact
/// derivative of W.
///
/// Reference directions are those of the element's own frame: z normal to the middle triangle, x along its
/// first edge.
#pragma once

#include "element/block.hpp"
#include "element/modes.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

/// Constants: gradient of the modes (5 x 3), reference values of the modes 3 and 4 (2 x 3), P_k (2 x 2), k_t,
/// k_z, nu / (1 - nu), V.
///
/// Modes, of corners 0-1-2 below and 3-4-5 above: 0 and 1: edges 01 and 02, below and above together; 2:
/// above less below, of all corners; 3 and 4: above less below of edges 01 and 02.
struct Wedge {
  static constexpr int kCorners = 6;
  static constexpr int kPoints = 2;
  static constexpr int kModesOfWedge = 5;
  static constexpr int kMoments = 15, kSlopes = 21, kStiffness = 25, kPoisson = 27, kVolume = 28;
  static constexpr int kConstants = 29;
  static constexpr bool kHourglassFollowsLaw = true;  ///< bending is the law's

  template <class T, class StressOf>
  CDFP_INLINE static T force(const PartConstants&, const double* constants, const T (&x)[6][3], T (&f)[6][3],
                             StressOf&& stress_of) {
    const Deformation<T> now(constants, x);
    const Symmetric<T> below = stress_of(now.at_point(0), 0), above = stress_of(now.at_point(1), 1);
    const T half_volume = volume<T>(constants, 0);
    T p[3][3], r[2][3], m[kModesOfWedge][3];
    first_piola_kirchhoff(now.f, half_volume * (above + below), p);
    const Symmetric<T> n = half_volume * (above - below);
    const T across = now.poisson * n.zz, twist = T(0.5) * at<T>(constants, kStiffness) * now.twist;
    const T warp = at<T>(constants, kStiffness + 1);
    for (int k = 0; k < 2; ++k) {
      const T px = slope<T>(constants, k, 0), py = slope<T>(constants, k, 1);
      const T force_of[3] = {(n.xx - across) * px + (n.xy + twist) * py,
                             (n.yy - across) * py + (n.xy - twist) * px,
                             warp * (now.amplitude[k][2] - T(0.5) * now.amplitude[1 - k][2])};
      for (int d = 0; d < 3; ++d) {
        r[k][d] = force_of[0] * now.f[0][d] + force_of[1] * now.f[1][d] + force_of[2] * now.f[2][d];
        for (int i = 0; i < 3; ++i) p[i][d] += force_of[i] * now.q[k][d];
      }
    }
    for (int k = 0; k < 2; ++k) {
      for (int i = 0; i < 3; ++i) {
        const T h = at<T>(constants, kMoments + 3 * k + i);
        for (int d = 0; d < 3; ++d) p[i][d] -= h * r[k][d];
      }
    }
    for (int a = 0; a < kModesOfWedge; ++a) {
      const T b0 = at<T>(constants, 3 * a), b1 = at<T>(constants, 3 * a + 1),
              b2 = at<T>(constants, 3 * a + 2);
      for (int d = 0; d < 3; ++d) m[a][d] = b0 * p[0][d] + b1 * p[1][d] + b2 * p[2][d];
    }
    for (int d = 0; d < 3; ++d) {
      const T up1 = m[3][d] + r[0][d], up2 = m[4][d] + r[1][d];
      const T low = -(m[0][d] + m[1][d]), high = m[2][d] - (up1 + up2);
      f[0][d] = low - high, f[3][d] = low + high;
      f[1][d] = m[0][d] - (m[2][d] + up1), f[4][d] = m[0][d] + (m[2][d] + up1);
      f[2][d] = m[1][d] - (m[2][d] + up2), f[5][d] = m[1][d] + (m[2][d] + up2);
    }
    return max(double_dot(above, above), double_dot(below, below));
  }

  template <class T, class DensityOf>
  CDFP_INLINE static void energy(const PartConstants&, const double* constants, const T (&x)[6][3],
                                 T& strain_energy, T& hourglass_energy, DensityOf&& density_of) {
    const Deformation<T> now(constants, x);
    strain_energy =
        volume<T>(constants, 0) * (density_of(now.at_point(0), 0) + density_of(now.at_point(1), 1));
    const T a = now.amplitude[0][2], b = now.amplitude[1][2];
    hourglass_energy = T(0.5) * (at<T>(constants, kStiffness) * now.twist * now.twist +
                                 at<T>(constants, kStiffness + 1) * (a * a + b * b - a * b));
  }

  /// `hourglass_square` in the measure of a hexahedron's sums, whose squared norm over the corners is eight:
  /// that of q_1 and q_2 is q (G (x) I)^-1 q, with G = (4 2, 2 4), of norm one and on six corners.
  template <class T, class StressOf>
  CDFP_INLINE static void extremes(const double* constants, const T (&x)[6][3], T& strain_square,
                                   T& stress_square, T& hourglass_square, StressOf&& stress_of) {
    const Deformation<T> now(constants, x);
    strain_square = stress_square = T(0.0);
    for (int point = 0; point < kPoints; ++point) {
      const Symmetric<T> strain = now.at_point(point), s = stress_of(strain, point);
      strain_square = max(strain_square, double_dot(strain, strain));
      stress_square = max(stress_square, double_dot(s, s));
    }
    hourglass_square = T(0.0);
    for (int d = 0; d < 3; ++d) {
      const T a = now.q[0][d], b = now.q[1][d];
      hourglass_square += T(64.0 / 6 / 3) * (a * a + b * b - a * b);
    }
  }

  template <class T, class StressOf>
  CDFP_INLINE static T kirchhoff_stress(const double* constants, const T (&x)[6][3], T (&sum)[3][3],
                                        StressOf&& stress_of) {
    const Deformation<T> now(constants, x);
    const Symmetric<T> s = stress_of(now.at_point(0), 0) + stress_of(now.at_point(1), 1);
    push_forward(now.f, volume<T>(constants, 0) * s, sum);
    return T(2.0) * volume<T>(constants, 0) * determinant(now.f);
  }

  /// `use(F, strain, point)`, F by columns
  template <class T, class Use>
  CDFP_INLINE static void each_point(const double* constants, const T (&x)[6][3], Use&& use) {
    const Deformation<T> now(constants, x);
    for (int point = 0; point < kPoints; ++point) use(now.f, now.at_point(point), point);
  }

  template <class T>
  CDFP_INLINE static T volume(const double* constants, int) {
    return T(0.5) * load<T>(constants + kVolume * kLanes);
  }

 private:
  template <class T>
  CDFP_INLINE static T at(const double* constants, int component) {
    return load<T>(constants + component * kLanes);
  }
  template <class T>
  CDFP_INLINE static T slope(const double* constants, int k, int axis) {
    return at<T>(constants, kSlopes + 2 * k + axis);
  }

  template <class T>
  struct Deformation {
    T poisson;                   ///< nu / (1 - nu)
    T f[3][3];                   ///< columns
    T q[2][3];                   ///< by direction in space
    T amplitude[2][3];           ///< qhat
    Symmetric<T> strain, slope;  ///< slope: from the middle to the point above
    T twist;

    CDFP_INLINE Deformation(const double* constants, const T (&x)[6][3])
        : poisson(at<T>(constants, kPoisson)) {
      T m[kModesOfWedge][3];
      for (int d = 0; d < 3; ++d) {
        const T low1 = x[1][d] - x[0][d], low2 = x[2][d] - x[0][d];
        const T high1 = x[4][d] - x[3][d], high2 = x[5][d] - x[3][d];
        m[0][d] = high1 + low1, m[3][d] = high1 - low1;
        m[1][d] = high2 + low2, m[4][d] = high2 - low2;
        m[2][d] = T(3.0) * (x[3][d] - x[0][d]) + m[3][d] + m[4][d];
      }
      for (int i = 0; i < 3; ++i) {
        for (int d = 0; d < 3; ++d) f[i][d] = T(0.0);
        for (int a = 0; a < kModesOfWedge; ++a) {
          const T b = at<T>(constants, 3 * a + i);
          for (int d = 0; d < 3; ++d) f[i][d] += b * m[a][d];
        }
      }
      green_strain(f, strain);
      T px[2], py[2];
      for (int k = 0; k < 2; ++k) {
        px[k] = Wedge::slope<T>(constants, k, 0), py[k] = Wedge::slope<T>(constants, k, 1);
        const T h0 = at<T>(constants, kMoments + 3 * k), h1 = at<T>(constants, kMoments + 3 * k + 1),
                h2 = at<T>(constants, kMoments + 3 * k + 2);
        for (int d = 0; d < 3; ++d) q[k][d] = m[3 + k][d] - (h0 * f[0][d] + h1 * f[1][d] + h2 * f[2][d]);
        for (int i = 0; i < 3; ++i) {
          amplitude[k][i] = f[i][0] * q[k][0] + f[i][1] * q[k][1] + f[i][2] * q[k][2];
        }
      }
      const T xy = amplitude[0][0] * py[0] + amplitude[1][0] * py[1];
      const T yx = amplitude[0][1] * px[0] + amplitude[1][1] * px[1];
      slope.xx = amplitude[0][0] * px[0] + amplitude[1][0] * px[1];
      slope.yy = amplitude[0][1] * py[0] + amplitude[1][1] * py[1];
      slope.xy = T(0.5) * (xy + yx);
      slope.zz = -(poisson * (slope.xx + slope.yy));
      slope.yz = slope.xz = T(0.0);
      twist = T(0.5) * (xy - yx);
    }
    CDFP_INLINE Symmetric<T> at_point(int point) const {
      return point == 0 ? strain - slope : strain + slope;
    }
  };
};

}  // namespace cdfp::CDFP_ISA
