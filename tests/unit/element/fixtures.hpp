// Small models for the element tests.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "cdfp/model.hpp"
#include "element/element_force.hpp"

namespace cdfp::test {

using Positions = std::vector<double>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

inline Vector3d at(const std::vector<double>& x, Index node) {
  return {x[3 * std::size_t(node)], x[3 * std::size_t(node) + 1], x[3 * std::size_t(node) + 2]};
}
inline void put(std::vector<double>& x, Index node, const Vector3d& value) {
  for (int d = 0; d < 3; ++d) x[3 * std::size_t(node) + d] = value[d];
}

struct Box {
  Index nx = 1, ny = 1, nz = 1;
  double lx = 1, ly = 1, lz = 1;

  Index node(Index i, Index j, Index k) const { return i + (nx + 1) * (j + (ny + 1) * k); }
  bool on_boundary(Index i, Index j, Index k) const {
    return i == 0 || j == 0 || k == 0 || i == nx || j == ny || k == nz;
  }
};

inline Mesh box_mesh(const Box& box) {
  Mesh mesh;
  mesh.part_names = {"body"};
  for (Index k = 0; k <= box.nz; ++k) {
    for (Index j = 0; j <= box.ny; ++j) {
      for (Index i = 0; i <= box.nx; ++i) {
        mesh.coordinates.insert(mesh.coordinates.end(),
                                {box.lx * i / box.nx, box.ly * j / box.ny, box.lz * k / box.nz});
      }
    }
  }
  for (Index k = 0; k < box.nz; ++k) {
    for (Index j = 0; j < box.ny; ++j) {
      for (Index i = 0; i < box.nx; ++i) {
        mesh.types.push_back(ElementType::hexahedron);
        mesh.parts.push_back(0);
        for (Index up = 0; up < 2; ++up) {
          mesh.connectivity.insert(mesh.connectivity.end(),
                                   {box.node(i, j, k + up), box.node(i + 1, j, k + up),
                                    box.node(i + 1, j + 1, k + up), box.node(i, j + 1, k + up)});
        }
      }
    }
  }
  return mesh;
}

/// Each hexahedron in six tetrahedra around the diagonal 0-6; neighbours match where all are cut alike.
inline Mesh cut_into_tetrahedra(const Mesh& hexahedra) {
  static constexpr int kCut[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                     {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  Mesh mesh;
  mesh.coordinates = hexahedra.coordinates;
  mesh.part_names = hexahedra.part_names;
  for (Index e = 0; e < hexahedra.element_count(); ++e) {
    for (const auto& corners : kCut) {
      mesh.types.push_back(ElementType::tetrahedron);
      mesh.parts.push_back(hexahedra.parts[e]);
      for (const int c : corners) mesh.connectivity.push_back(hexahedra.connectivity[8 * std::size_t(e) + c]);
    }
  }
  return mesh;
}

/// Each hexahedron in two wedges along its third direction, by turns of the diagonal from column to column,
/// as `turned` says of the hexahedron; neighbours match.
inline Mesh cut_into_wedges(const Mesh& hexahedra, const std::function<bool(Index)>& turned = {}) {
  static constexpr int kCut[2][2][6] = {{{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}},
                                        {{0, 1, 3, 4, 5, 7}, {1, 2, 3, 5, 6, 7}}};
  Mesh mesh;
  mesh.coordinates = hexahedra.coordinates;
  mesh.part_names = hexahedra.part_names;
  for (Index e = 0; e < hexahedra.element_count(); ++e) {
    for (const auto& corners : kCut[turned && turned(e) ? 1 : 0]) {
      mesh.types.push_back(ElementType::wedge);
      mesh.parts.push_back(hexahedra.parts[e]);
      for (const int c : corners) mesh.connectivity.push_back(hexahedra.connectivity[8 * std::size_t(e) + c]);
    }
  }
  return mesh;
}

inline Index corners_of(ElementType type) {
  return type == ElementType::hexahedron ? 8 : type == ElementType::wedge ? 6 : 4;
}

/// Moves every node by up to `amount` in each direction.
inline void distort(std::vector<double>& coordinates, double amount, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-amount, amount);
  for (double& c : coordinates) c += shift(random);
}

/// Moves the columns of a box mesh sideways: elements stay extruded along z.
inline void distort_columns(Mesh& mesh, const Box& box, double amount, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-amount, amount);
  for (Index j = 0; j <= box.ny; ++j) {
    for (Index i = 0; i <= box.nx; ++i) {
      const Vector3d s(shift(random), shift(random), 0);
      for (Index k = 0; k <= box.nz; ++k) {
        put(mesh.coordinates, box.node(i, j, k), at(mesh.coordinates, box.node(i, j, k)) + s);
      }
    }
  }
}

inline Model model_of(Mesh mesh, Formulation formulation, double modulus = 74e9, double nu = 0.2,
                      double density = 2500) {
  Model model;
  for (const std::string& name : mesh.part_names) {
    Part part;
    part.name = name;
    part.material = "elastic";
    part.formulation = formulation;
    model.parts.push_back(part);
  }
  model.materials.push_back({"elastic", ElasticMaterial{density, modulus, nu}});
  model.mesh = std::move(mesh);
  model.threads = 1;
  return model;
}

inline std::vector<double> force_of(ElementForce& elements, const Positions& x, double step = 0,
                                    const Threads& threads = Threads(1)) {
  std::vector<double> force(x.size(), 0.0);
  elements.add_force(x, force, step, threads);
  return force;
}

inline PartEnergy energy_of(const ElementForce& elements, const Positions& x) {
  PartEnergy sum;
  for (const PartEnergy& part : elements.energies(x, Threads(1))) {
    sum.strain += part.strain;
    sum.hourglass += part.hourglass;
    sum.dissipated += part.dissipated;
  }
  return sum;
}

/// x -> a x + b
inline Positions mapped(const Positions& x, const Matrix3d& a, const Vector3d& b = Vector3d::Zero()) {
  Positions y(x.size());
  for (Index n = 0; n < Index(x.size() / 3); ++n) put(y, n, a * at(x, n) + b);
  return y;
}

inline Matrix3d random_matrix(double size, std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-size, size);
  Matrix3d m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = entry(random);
  return m;
}

inline Matrix3d to_eigen(const Mat3& m) {
  Matrix3d e;
  for (int i = 0; i < 9; ++i) e(i / 3, i % 3) = m(i / 3, i % 3);
  return e;
}

inline double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

/// -d force / d x by central differences.
inline Eigen::MatrixXd stiffness(ElementForce& elements, const Positions& x, double h) {
  const auto n = Eigen::Index(x.size());
  Eigen::MatrixXd k(n, n);
  Positions moved = x;
  for (Eigen::Index i = 0; i < n; ++i) {
    moved[i] = x[i] + h;
    const std::vector<double> plus = force_of(elements, moved);
    moved[i] = x[i] - h;
    const std::vector<double> minus = force_of(elements, moved);
    moved[i] = x[i];
    for (Eigen::Index j = 0; j < n; ++j) k(j, i) = (minus[j] - plus[j]) / (2 * h);
  }
  return 0.5 * (k + k.transpose());
}

/// Rows and columns of the degrees of freedom that `is_free`.
inline Eigen::MatrixXd reduced(const Eigen::MatrixXd& k, const std::vector<Eigen::Index>& free) {
  Eigen::MatrixXd r(free.size(), free.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = 0; j < free.size(); ++j) r(Eigen::Index(i), Eigen::Index(j)) = k(free[i], free[j]);
  }
  return r;
}

}  // namespace cdfp::test
