#include "integrator/rigid_body.hpp"

#include <algorithm>
#include <cmath>

#include "model/lookup.hpp"

namespace cdfp {

namespace {

/// Gauss points that carry the volume: eight of a hexahedron or wedge, four of a tetrahedron.
struct MassPoints {
  double volume = 0;
  Vec3 first_moment;
  Mat3 second_moment;  ///< sum of volume * x (x) x

  void add(double v, Vec3 x) {
    volume += v;
    first_moment += v * x;
    for (int i = 0; i < 3; ++i) second_moment.r[i] += v * x[i] * x;
  }
};

void add_hexahedron(const Mesh& mesh, const Index* corners, MassPoints& points) {
  static constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const double g = 1 / std::sqrt(3.0);
  for (const auto& at : sign) {
    Vec3 x;
    Mat3 jacobian;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = Vec3::load(&mesh.coordinates[3 * static_cast<std::size_t>(corners[i])]);
      const double a = 1 + sign[i][0] * g * at[0];
      const double b = 1 + sign[i][1] * g * at[1];
      const double c = 1 + sign[i][2] * g * at[2];
      x += a * b * c / 8 * corner;
      jacobian.r[0] += sign[i][0] * b * c / 8 * corner;
      jacobian.r[1] += sign[i][1] * a * c / 8 * corner;
      jacobian.r[2] += sign[i][2] * a * b / 8 * corner;
    }
    points.add(det(jacobian), x);
  }
}

/// Points of Stroud (1971), exact for second moments.
void add_tetrahedron(const Mesh& mesh, const Index* corners, MassPoints& points) {
  constexpr double near = 0.58541019662496845, far = 0.13819660112501051;
  Vec3 x[4], sum;
  for (int i = 0; i < 4; ++i) {
    x[i] = Vec3::load(&mesh.coordinates[3 * static_cast<std::size_t>(corners[i])]);
    sum += x[i];
  }
  const double volume = dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0])) / 6;
  for (const Vec3& corner : x) points.add(volume / 4, far * sum + (near - far) * corner);
}

/// Rotation by the vector `w` (Rodrigues).
Mat3 rotation_by(Vec3 w) {
  const double angle = norm(w);
  if (angle == 0) return Mat3::identity();
  const Vec3 k = w / angle;
  const double s = std::sin(angle);
  const double c = 1 - std::cos(angle);
  Mat3 r = Mat3::identity();
  const Mat3 cross_k{{Vec3{0, -k.z, k.y}, Vec3{k.z, 0, -k.x}, Vec3{-k.y, k.x, 0}}};
  return r + s * cross_k + c * (cross_k * cross_k);
}

/// Rows made orthonormal again: round-off of many small rotations does not gather.
Mat3 orthonormalised(const Mat3& r) {
  const Vec3 a = normalized(r.r[0]);
  const Vec3 b = normalized(r.r[1] - dot(r.r[1], a) * a);
  return {{a, b, cross(a, b)}};
}

Vec3 masked(Vec3 v, const std::array<bool, 3>& fixed) {
  return {fixed[0] ? 0 : v.x, fixed[1] ? 0 : v.y, fixed[2] ? 0 : v.z};
}

}  // namespace

RigidMotion::RigidMotion(const Model& model, Index body, Nodes& nodes) {
  const RigidBody& given = model.rigid_bodies[body];
  const Index part = part_number(model.mesh, given.part);
  MassPoints points;
  std::vector<bool> mine(nodes.count(), false);
  const std::vector<Index> first = first_corners(model.mesh);
  for (Index e = 0; e < model.mesh.element_count(); ++e) {
    if (model.mesh.parts[e] != part) continue;
    const Index* corners = &model.mesh.connectivity[first[e]];
    switch (model.mesh.types[e]) {
      case ElementType::tetrahedron:
        add_tetrahedron(model.mesh, corners, points);
        break;
      case ElementType::wedge: {  // a hexahedron with two of its edges fallen into points
        const Index fallen[8] = {corners[0], corners[1], corners[2], corners[2],
                                 corners[3], corners[4], corners[5], corners[5]};
        add_hexahedron(model.mesh, fallen, points);
        break;
      }
      default:
        add_hexahedron(model.mesh, corners, points);
    }
    for (Index i = first[e]; i < first[e + 1]; ++i) mine[model.mesh.connectivity[i]] = true;
  }
  mass_ = given.mass;
  translation_fixed_ = given.translation_fixed;
  rotation_fixed_ = given.rotation_fixed;
  rotates_ = !(rotation_fixed_[0] && rotation_fixed_[1] && rotation_fixed_[2]);
  center_ = points.first_moment / points.volume;
  if (rotates_) {
    Mat3 inertia;
    if (given.inertia) {
      for (int i = 0; i < 9; ++i) inertia(i / 3, i % 3) = (*given.inertia)[i];
    } else {
      const double density = mass_ / points.volume;
      Mat3 second = points.second_moment;
      for (int i = 0; i < 3; ++i) second.r[i] -= points.volume * center_[i] * center_;
      const double trace = second(0, 0) + second(1, 1) + second(2, 2);
      inertia = density * (trace * Mat3::identity() + -1.0 * second);
    }
    inertia_inverse_ = inverse(inertia);
    const Vec3 spin = Vec3::load(given.angular_velocity.data());
    angular_momentum_ = inertia * spin;
  }
  velocity_ = masked(Vec3::load(given.velocity.data()), translation_fixed_);
  angular_velocity_ = rotates_ ? spin_of(angular_momentum_) : Vec3{};

  for (Index n = 0; n < nodes.count(); ++n) {
    if (!mine[n]) continue;
    nodes_.push_back(n);
    arms_.push_back(nodes.x0(n) - center_);
    nodes.body[n] = body;
    nodes.fixed[n] = 7;
    nodes.mass[n] = mass_;
  }
  set_node_velocities(nodes);
}

Vec3 RigidMotion::spin_of(Vec3 angular_momentum) const {
  const Vec3 local = transpose(rotation_) * angular_momentum;
  return masked(rotation_ * (inertia_inverse_ * local), rotation_fixed_);
}

void RigidMotion::drift(double step, Nodes& nodes) {
  center_ += step * velocity_;
  if (rotates_) {
    rotation_ = orthonormalised(rotation_by(step * angular_velocity_) * rotation_);
    angular_velocity_ = spin_of(angular_momentum_);
  }
  move_nodes(nodes);
}

void RigidMotion::accelerate(double step, Vec3 gravity, Nodes& nodes) {
  force_ = {};
  Vec3 torque;
  for (const Index n : nodes_) {
    const Vec3 f = nodes.f(n);
    if (f.x == 0 && f.y == 0 && f.z == 0) continue;
    force_ += f;
    torque += cross(nodes.x(n) - center_, f);
  }
  last_acceleration_ = masked(force_ / mass_ + gravity, translation_fixed_);
  velocity_ += step * last_acceleration_;
  if (rotates_) {
    last_torque_ = torque;
    angular_momentum_ += step * torque;
    angular_velocity_ = spin_of(angular_momentum_);
  }
  set_node_velocities(nodes);
}

double RigidMotion::kinetic_energy(double step) const {
  const Vec3 behind = velocity_ - step * last_acceleration_;
  double energy = 0.5 * mass_ * dot(behind, velocity_);
  if (rotates_) energy += 0.5 * dot(angular_momentum_ - step * last_torque_, angular_velocity_);
  return energy;
}

void RigidMotion::move_nodes(Nodes& nodes) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Vec3 arm = rotates_ ? rotation_ * arms_[i] : arms_[i];
    (center_ + arm).store(&nodes.position[3 * static_cast<std::size_t>(nodes_[i])]);
  }
}

void RigidMotion::set_node_velocities(Nodes& nodes) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Vec3 v = velocity_;
    if (rotates_) v += cross(angular_velocity_, rotation_ * arms_[i]);
    v.store(&nodes.velocity[3 * static_cast<std::size_t>(nodes_[i])]);
  }
}

}  // namespace cdfp
