// One element with a law from outside, taken along a path of deformation gradients.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cdfp/error.hpp"
#include "cdfp/material_library.hpp"
#include "element/element_force.hpp"

namespace cdfp::test {

using Eigen::Matrix3d;

/// A folder of the test's own, for libraries that it compiles.
inline std::string scratch_folder() {
  struct Folder {
    std::string path =
        (std::filesystem::temp_directory_path() / ("cdfp_vumat_test_" + std::to_string(getpid()))).string();
    Folder() { std::filesystem::create_directories(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path); }
  };
  static const Folder folder;
  return folder.path;
}

inline std::string compiled(const std::string& source, bool single = false) {
  const std::string library = scratch_folder() + "/" + std::filesystem::path(source).stem().string() +
                              (single ? "_single.so" : ".so");
  if (!std::filesystem::exists(library)) {
    build_material(std::string(CDFP_SOURCE_DIR) + "/" + source, library, {single});
  }
  return library;
}

struct VumatCase {
  std::string source;  ///< from the top of the tree
  std::vector<double> properties;
  int states = 0;
  VumatOptions options{};
  double density = 2000;
  int deletion_state = -1;
  bool thread_safe = false;
};

inline UserMaterial vumat_material(const VumatCase& c) {
  UserMaterial material;
  material.density = c.density;
  material.properties = c.properties;
  material.states = c.states;
  material.deletion_state = c.deletion_state;
  material.thread_safe = c.thread_safe;
  load_vumat(compiled(c.source, c.options.single_precision), c.options, material);
  return material;
}

/// The unit cube as a hexahedron (or a row of them), its nodes moved by F.
class Cubes {
 public:
  explicit Cubes(const UserMaterial& material, Formulation formulation = Formulation::one_point,
                 Index count = 1) {
    Model model;
    Mesh& mesh = model.mesh;
    mesh.part_names = {"cubes"};
    for (Index i = 0; i <= count; ++i) {
      for (int k = 0; k < 4; ++k) {
        mesh.coordinates.insert(mesh.coordinates.end(), {double(i), double(k & 1), double(k >> 1)});
      }
    }
    for (Index e = 0; e < count; ++e) {
      mesh.types.push_back(ElementType::hexahedron);
      mesh.parts.push_back(0);
      for (const Index n : {0, 4, 5, 1, 2, 6, 7, 3}) mesh.connectivity.push_back(4 * e + n);
    }
    Part part;
    part.name = "cubes";
    part.material = "law";
    part.formulation = formulation;
    model.parts = {part};
    model.materials = {{"law", material}};
    model.threads = 1;
    reference_ = mesh.coordinates;
    elements_.emplace(model);
  }

  ElementForce& elements() { return *elements_; }
  const std::vector<double>& position() const { return position_; }

  std::span<const Index> move(const Matrix3d& f, double step) {
    time_ += step;
    position_.resize(reference_.size());
    for (std::size_t n = 0; n < reference_.size(); n += 3) {
      const Eigen::Vector3d x = f * Eigen::Vector3d(reference_[n], reference_[n + 1], reference_[n + 2]);
      for (std::size_t d = 0; d < 3; ++d) position_[n + d] = x[Eigen::Index(d)];
    }
    return elements_->advance_user_laws(position_, time_, step, Threads(1));
  }
  /// Along F(t) from 0 to `end` in equal steps.
  void follow(const std::function<Matrix3d(double)>& f, double end, int steps) {
    for (int i = 1; i <= steps; ++i) move(f(end * i / steps), end / steps);
  }
  Matrix3d stress(Index element = 0) const {
    const Mat3 s = elements_->stress(element, position_);
    Matrix3d m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = s(i / 3, i % 3);
    return m;
  }
  double state(int number, Index element = 0) const { return elements_->mean_state(element, number - 1); }

 private:
  std::vector<double> reference_, position_;
  std::optional<ElementForce> elements_;
  double time_ = 0;
};

}  // namespace cdfp::test
