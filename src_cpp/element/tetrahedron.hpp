/// Linear tetrahedron, total-Lagrangian: one strain, no hourglass modes.
///
///   F = sum_i (x_i - x_0) (x) D_i,   D_i = dN_i/dX of corners 1 to 3,   W = V psi(E).
///
/// Forces are minus the exact derivative of W. It locks where the material is nearly incompressible, and is
/// too stiff in bending: hexahedra are the better choice where a body can be meshed with them.
#pragma once

#include "element/block.hpp"
#include "element/modes.hpp"
#include "material/symmetric.hpp"

namespace cdfp::CDFP_ISA {

/// Constants: D_i (3 x 3), V.
struct Tetrahedron {
  static constexpr int kCorners = 4;
  static constexpr int kPoints = 1;
  static constexpr int kVolume = 9;
  static constexpr int kConstants = 10;
  static constexpr bool kHourglassFollowsLaw = true;

  template <class T, class StressOf>
  CDFP_INLINE static T force(const PartConstants&, const double* constants, const T (&x)[4][3], T (&f)[4][3],
                             StressOf&& stress_of) {
    T grad[3][3], p[3][3];
    gradient(constants, x, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    const Symmetric<T> s = stress_of(strain, 0);
    const Symmetric<T> vs = volume<T>(constants, 0) * s;
    first_piola_kirchhoff(grad, vs, p);
    for (int corner = 1; corner < 4; ++corner) {
      const T d0 = slope<T>(constants, corner, 0), d1 = slope<T>(constants, corner, 1);
      const T d2 = slope<T>(constants, corner, 2);
      for (int d = 0; d < 3; ++d) f[corner][d] = p[0][d] * d0 + p[1][d] * d1 + p[2][d] * d2;
    }
    for (int d = 0; d < 3; ++d) f[0][d] = -(f[1][d] + f[2][d] + f[3][d]);
    return double_dot(s, s);
  }

  template <class T, class DensityOf>
  CDFP_INLINE static void energy(const PartConstants&, const double* constants, const T (&x)[4][3],
                                 T& strain_energy, T& hourglass_energy, DensityOf&& density_of) {
    T grad[3][3];
    gradient(constants, x, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    strain_energy = volume<T>(constants, 0) * density_of(strain, 0);
    hourglass_energy = T(0.0);
  }

  template <class T, class StressOf>
  CDFP_INLINE static void extremes(const double* constants, const T (&x)[4][3], T& strain_square,
                                   T& stress_square, T& hourglass_square, StressOf&& stress_of) {
    T grad[3][3];
    gradient(constants, x, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    const Symmetric<T> s = stress_of(strain, 0);
    strain_square = double_dot(strain, strain);
    stress_square = double_dot(s, s);
    hourglass_square = T(0.0);
  }

  template <class T, class StressOf>
  CDFP_INLINE static T kirchhoff_stress(const double* constants, const T (&x)[4][3], T (&sum)[3][3],
                                        StressOf&& stress_of) {
    T grad[3][3];
    gradient(constants, x, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    push_forward(grad, volume<T>(constants, 0) * stress_of(strain, 0), sum);
    return volume<T>(constants, 0) * determinant(grad);
  }

  /// `use(F, E, point)`, F by columns
  template <class T, class Use>
  CDFP_INLINE static void each_point(const double* constants, const T (&x)[4][3], Use&& use) {
    T grad[3][3];
    gradient(constants, x, grad);
    Symmetric<T> strain;
    green_strain(grad, strain);
    use(grad, strain, 0);
  }

  template <class T>
  CDFP_INLINE static T volume(const double* constants, int) {
    return load<T>(constants + kVolume * kLanes);
  }

 private:
  template <class T>
  CDFP_INLINE static T slope(const double* constants, int corner, int axis) {
    return load<T>(constants + (3 * (corner - 1) + axis) * kLanes);
  }

  /// Columns of F.
  template <class T>
  CDFP_INLINE static void gradient(const double* constants, const T (&x)[4][3], T (&f)[3][3]) {
    T edge[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int d = 0; d < 3; ++d) edge[i][d] = x[i + 1][d] - x[0][d];
    }
    for (int axis = 0; axis < 3; ++axis) {
      const T d0 = slope<T>(constants, 1, axis), d1 = slope<T>(constants, 2, axis);
      const T d2 = slope<T>(constants, 3, axis);
      for (int d = 0; d < 3; ++d) f[axis][d] = edge[0][d] * d0 + edge[1][d] * d1 + edge[2][d] * d2;
    }
  }
};

}  // namespace cdfp::CDFP_ISA
