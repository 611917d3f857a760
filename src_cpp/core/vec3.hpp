/// Vectors and 3 x 3 tensors for code outside the packed kernels.
#pragma once

#include <array>
#include <cmath>

namespace cdfp {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  static Vec3 load(const double* p) { return {p[0], p[1], p[2]}; }
  void store(double* p) const { p[0] = x, p[1] = y, p[2] = z; }
  void add_to(double* p) const { p[0] += x, p[1] += y, p[2] += z; }

  double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }

  Vec3& operator+=(Vec3 b) { return x += b.x, y += b.y, z += b.z, *this; }
  Vec3& operator-=(Vec3 b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  Vec3& operator*=(double s) { return x *= s, y *= s, z *= s, *this; }
  friend Vec3 operator+(Vec3 a, Vec3 b) { return a += b; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return a -= b; }
  friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(Vec3 a, double s) { return a *= s; }
  friend Vec3 operator*(double s, Vec3 a) { return a *= s; }
  friend Vec3 operator/(Vec3 a, double s) { return a *= 1 / s; }
};

inline double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) {
  return std::sqrt(dot(a, a));
}
inline Vec3 normalized(Vec3 a) {
  return a / norm(a);
}

/// Rows `r[0..2]`.
struct Mat3 {
  std::array<Vec3, 3> r{};

  static Mat3 identity() { return {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}; }
  double& operator()(int i, int j) { return r[i][j]; }
  double operator()(int i, int j) const { return r[i][j]; }
  friend Vec3 operator*(const Mat3& a, Vec3 b) { return {dot(a.r[0], b), dot(a.r[1], b), dot(a.r[2], b)}; }
  friend Mat3 operator*(const Mat3& a, const Mat3& b) {
    Mat3 c;
    for (int i = 0; i < 3; ++i) c.r[i] = a(i, 0) * b.r[0] + a(i, 1) * b.r[1] + a(i, 2) * b.r[2];
    return c;
  }
  friend Mat3 operator+(Mat3 a, const Mat3& b) {
    for (int i = 0; i < 3; ++i) a.r[i] += b.r[i];
    return a;
  }
  friend Mat3 operator*(double s, Mat3 a) {
    for (Vec3& row : a.r) row *= s;
    return a;
  }
};

inline Mat3 transpose(const Mat3& a) {
  return {
      {Vec3{a(0, 0), a(1, 0), a(2, 0)}, Vec3{a(0, 1), a(1, 1), a(2, 1)}, Vec3{a(0, 2), a(1, 2), a(2, 2)}}};
}
inline double det(const Mat3& a) {
  return dot(a.r[0], cross(a.r[1], a.r[2]));
}
/// Undefined for a singular `a`.
inline Mat3 inverse(const Mat3& a) {
  const double s = 1 / det(a);
  return transpose({{s * cross(a.r[1], a.r[2]), s * cross(a.r[2], a.r[0]), s * cross(a.r[0], a.r[1])}});
}

}  // namespace cdfp
