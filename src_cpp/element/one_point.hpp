/// Hexahedron with one point: mean gradient (Flanagan and Belytschko 1981) and assumed-strain hourglass
/// stiffness (Belytschko and Bindeman 1993), both from one energy of the corner positions x:
///
///   W = V psi(E) + (1/2) qhat K qhat,     F = sum m_a (x) b_a,     E = (F^T F - I) / 2,
///   q_a = m_a - F H_a (orthogonal to linear fields),   qhat_ia = F_i . q_a  (i: direction, a: hourglass
///   mode),
///
/// with m_a the sums of modes.hpp, b_a the mean gradient and H_a the reference moments in the same modes, and
/// F_i the columns of F. Reference directions are those of the element's own frame, in which K stands; since
/// laws are isotropic, they need no other. Forces are minus the exact derivative of W, so the element is
/// conservative, and rigid motion leaves W alone.
///
/// K, with g_i^2 = 2 mu / (1 - nu) H_ii / 64, H_ij = sqrt(H_ii H_jj), i, j, k distinct:
///   bending  W = 1/2 [(g_i qhat_ij)^2 + (g_j qhat_ji)^2 + 2 nu g_i g_j qhat_ij qhat_ji]   (plane stress
///   along k) shear    W = 1/2 (1 - nu)/2 (g_j qhat_ii + g_i qhat_jj)^2 warping  W = 1/2 (1 - nu^2)/3 (g_i
///   qhat_i4)^2
#pragma once

#include "element/block.hpp"
#include "element/modes.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

/// Any hexahedron. Constants: b_a (7 x 3), H_a of the hourglass modes (4 x 3), g (3), V.
struct Hexahedron {
  static constexpr int kGradient = 0, kMoments = 21, kStiffness = 33, kVolume = 36;
  static constexpr int kConstants = 37;

  /// Columns of F.
  template <class T>
  CDFP_INLINE static void gradient(const double* constants, const T (&m)[kModes][3], T (&f)[3][3]) {
    for (int i = 0; i < 3; ++i) {
      const T b = at<T>(constants, i);
      for (int d = 0; d < 3; ++d) f[i][d] = b * m[0][d];
    }
    for (int a = 1; a < kModes; ++a) {
      for (int i = 0; i < 3; ++i) {
        const T b = at<T>(constants, 3 * a + i);
        for (int d = 0; d < 3; ++d) f[i][d] += b * m[a][d];
      }
    }
  }

  /// q_a in place of m_a.
  template <class T>
  CDFP_INLINE static void remove_linear(const double* constants, const T (&f)[3][3], T (&m)[kModes][3]) {
    for (int a = 3; a < kModes; ++a) {
      for (int i = 0; i < 3; ++i) {
        const T h = at<T>(constants, kMoments + 3 * (a - 3) + i);
        for (int d = 0; d < 3; ++d) m[a][d] -= h * f[i][d];
      }
    }
  }

  /// From dW/dF (columns p) and dW/dq (r, in the hourglass modes) to dW/dm, in place of r.
  template <class T>
  CDFP_INLINE static void modal_force(const double* constants, T (&p)[3][3], T (&r)[kModes][3]) {
    for (int a = 3; a < kModes; ++a) {
      for (int i = 0; i < 3; ++i) {
        const T h = at<T>(constants, kMoments + 3 * (a - 3) + i);
        for (int d = 0; d < 3; ++d) p[i][d] -= h * r[a][d];
      }
    }
    for (int a = 0; a < 3; ++a) r[a][0] = r[a][1] = r[a][2] = T(0.0);
    add_mean(constants, p, r);
  }

  /// Adds to dW/dm what dW/dF (columns p) of the mean gradient gives.
  template <class T>
  CDFP_INLINE static void add_mean(const double* constants, const T (&p)[3][3], T (&r)[kModes][3]) {
    for (int a = 0; a < kModes; ++a) {
      for (int i = 0; i < 3; ++i) {
        const T b = at<T>(constants, 3 * a + i);
        for (int d = 0; d < 3; ++d) r[a][d] += b * p[i][d];
      }
    }
  }

 private:
  template <class T>
  CDFP_INLINE static T at(const double* constants, int component) {
    return load<T>(constants + component * kLanes);
  }
};

/// Extruded along zeta, straight and with parallel ends: most of a plate's elements. What is zero in b_a and
/// H_a is neither stored nor multiplied.
struct Prism {
  // b of xi (x, y), eta (x, y), zeta (z), eta zeta (z), xi zeta (z); H of xi eta (x, y)
  static constexpr int kGradient = 0, kMoments = 7, kStiffness = 9, kVolume = 12;
  static constexpr int kConstants = 13;

  template <class T>
  CDFP_INLINE static void gradient(const double* constants, const T (&m)[kModes][3], T (&f)[3][3]) {
    T b[7];
    for (int k = 0; k < 7; ++k) b[k] = at<T>(constants, k);
    for (int d = 0; d < 3; ++d) {
      f[0][d] = b[0] * m[0][d] + b[2] * m[1][d];
      f[1][d] = b[1] * m[0][d] + b[3] * m[1][d];
      f[2][d] = b[4] * m[2][d] + b[5] * m[3][d] + b[6] * m[4][d];
    }
  }

  template <class T>
  CDFP_INLINE static void remove_linear(const double* constants, const T (&f)[3][3], T (&m)[kModes][3]) {
    const T hx = at<T>(constants, kMoments), hy = at<T>(constants, kMoments + 1);
    for (int d = 0; d < 3; ++d) m[5][d] -= hx * f[0][d] + hy * f[1][d];
  }

  template <class T>
  CDFP_INLINE static void modal_force(const double* constants, T (&p)[3][3], T (&r)[kModes][3]) {
    const T hx = at<T>(constants, kMoments), hy = at<T>(constants, kMoments + 1);
    for (int d = 0; d < 3; ++d) {
      p[0][d] -= hx * r[5][d];
      p[1][d] -= hy * r[5][d];
      r[0][d] = r[1][d] = r[2][d] = T(0.0);
    }
    add_mean(constants, p, r);
  }

  template <class T>
  CDFP_INLINE static void add_mean(const double* constants, const T (&p)[3][3], T (&r)[kModes][3]) {
    T b[7];
    for (int k = 0; k < 7; ++k) b[k] = at<T>(constants, k);
    for (int d = 0; d < 3; ++d) {
      r[0][d] += b[0] * p[0][d] + b[1] * p[1][d];
      r[1][d] += b[2] * p[0][d] + b[3] * p[1][d];
      r[2][d] += b[4] * p[2][d];
      r[3][d] += b[5] * p[2][d];
      r[4][d] += b[6] * p[2][d];
    }
  }

 private:
  template <class T>
  CDFP_INLINE static T at(const double* constants, int component) {
    return load<T>(constants + component * kLanes);
  }
};

template <class Shape>
struct OnePoint {
  static constexpr int kCorners = 8;
  static constexpr int kPoints = 1;
  static constexpr int kConstants = Shape::kConstants;
  static constexpr bool kHourglassFollowsLaw = false;  ///< its stiffness is that of a constant modulus

  /// `stress_of(strain, point)` gives the second Piola-Kirchhoff stress. Returns its greatest squared norm.
  template <class T, class StressOf>
  CDFP_INLINE static T force(const PartConstants& part, const double* constants, const T (&x)[8][3],
                             T (&f)[8][3], StressOf&& stress_of) {
    T m[kModes][3], grad[3][3], p[3][3];
    to_modes(x, m);
    Shape::gradient(constants, m, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    const Symmetric<T> s = stress_of(strain, 0);
    const Symmetric<T> vs = load<T>(constants + Shape::kVolume * kLanes) * s;
    first_piola_kirchhoff(grad, vs, p);
    Shape::remove_linear(constants, grad, m);
    add_hourglass(part, constants, grad, p, m);
    Shape::modal_force(constants, p, m);
    to_corners(m, f);
    return double_dot(s, s);
  }

  /// J: of the points by `density_of(strain, point)`, J/m3, and of the hourglass.
  template <class T, class DensityOf>
  CDFP_INLINE static void energy(const PartConstants& part, const double* constants, const T (&x)[8][3],
                                 T& strain_energy, T& hourglass_energy, DensityOf&& density_of) {
    T m[kModes][3], grad[3][3];
    to_modes(x, m);
    Shape::gradient(constants, m, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    strain_energy = load<T>(constants + Shape::kVolume * kLanes) * density_of(strain, 0);
    Shape::remove_linear(constants, grad, m);
    T amplitude[3][4], force_of[3][4];
    amplitudes(grad, m, amplitude);
    stiffness(part, constants, amplitude, force_of);
    T twice(0.0);
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < 4; ++a) twice += amplitude[i][a] * force_of[i][a];
    }
    hourglass_energy = T(0.5) * twice;
  }

  /// Squared norms of strain, stress and hourglass amplitudes q, the greatest of all points.
  template <class T, class StressOf>
  CDFP_INLINE static void extremes(const double* constants, const T (&x)[8][3], T& strain_square,
                                   T& stress_square, T& hourglass_square, StressOf&& stress_of) {
    T m[kModes][3], grad[3][3];
    to_modes(x, m);
    Shape::gradient(constants, m, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    const Symmetric<T> s = stress_of(strain, 0);
    strain_square = double_dot(strain, strain);
    stress_square = double_dot(s, s);
    Shape::remove_linear(constants, grad, m);
    hourglass_square = T(0.0);
    for (int a = 3; a < kModes; ++a) {
      for (int d = 0; d < 3; ++d) hourglass_square += m[a][d] * m[a][d];
    }
  }

  /// Sum over points of volume * F S F^T, and the present volume.
  template <class T, class StressOf>
  CDFP_INLINE static T kirchhoff_stress(const double* constants, const T (&x)[8][3], T (&sum)[3][3],
                                        StressOf&& stress_of) {
    T m[kModes][3], grad[3][3];
    to_modes(x, m);
    Shape::gradient(constants, m, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    const Symmetric<T> s = stress_of(strain, 0);
    push_forward(grad, volume<T>(constants, 0) * s, sum);
    return volume<T>(constants, 0) * determinant(grad);
  }

  /// `use(F, E, point)`, F by columns
  template <class T, class Use>
  CDFP_INLINE static void each_point(const double* constants, const T (&x)[8][3], Use&& use) {
    T m[kModes][3], grad[3][3];
    to_modes(x, m);
    Shape::gradient(constants, m, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    use(grad, strain, 0);
  }

  /// m3, of a point
  template <class T>
  CDFP_INLINE static T volume(const double* constants, int) {
    return load<T>(constants + Shape::kVolume * kLanes);
  }

 private:
  /// qhat_ia
  template <class T>
  CDFP_INLINE static void amplitudes(const T (&f)[3][3], const T (&m)[kModes][3], T (&qhat)[3][4]) {
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < 4; ++a) {
        qhat[i][a] = f[i][0] * m[3 + a][0] + f[i][1] * m[3 + a][1] + f[i][2] * m[3 + a][2];
      }
    }
  }

  /// Q = K qhat
  template <class T>
  CDFP_INLINE static void stiffness(const PartConstants& part, const double* constants, const T (&qhat)[3][4],
                                    T (&force_of)[3][4]) {
    T g[3];
    for (int i = 0; i < 3; ++i) g[i] = load<T>(constants + (Shape::kStiffness + i) * kLanes);
    const T coupling(part.bending_coupling), shear(part.shear_share), warping(part.warping_share);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const T along = g[i] * qhat[i][j], across = g[j] * qhat[j][i];
      force_of[i][j] = g[i] * (along + coupling * across);
      force_of[j][i] = g[j] * (across + coupling * along);
      force_of[i][3] = warping * g[i] * g[i] * qhat[i][3];
    }
    const T xy = shear * (g[1] * qhat[0][0] + g[0] * qhat[1][1]);
    const T yz = shear * (g[2] * qhat[1][1] + g[1] * qhat[2][2]);
    const T xz = shear * (g[2] * qhat[0][0] + g[0] * qhat[2][2]);
    force_of[0][0] = g[1] * xy + g[2] * xz;
    force_of[1][1] = g[0] * xy + g[2] * yz;
    force_of[2][2] = g[1] * yz + g[0] * xz;
  }

  /// Adds to dW/dF (columns p) what the hourglass energy gives, and puts dW/dq in place of q.
  template <class T>
  CDFP_INLINE static void add_hourglass(const PartConstants& part, const double* constants,
                                        const T (&f)[3][3], T (&p)[3][3], T (&m)[kModes][3]) {
    T qhat[3][4], force_of[3][4];
    amplitudes(f, m, qhat);
    stiffness(part, constants, qhat, force_of);
    for (int d = 0; d < 3; ++d) {
      for (int i = 0; i < 3; ++i) {
        for (int a = 0; a < 4; ++a) p[i][d] += force_of[i][a] * m[3 + a][d];
      }
      for (int a = 0; a < 4; ++a) {
        m[3 + a][d] = force_of[0][a] * f[0][d] + force_of[1][a] * f[1][d] + force_of[2][a] * f[2][d];
      }
    }
  }
};

}  // namespace cdfp::CDFP_ISA
