/// Rigid bodies: translation and rotation of the nodes of a part under the forces on them.
#pragma once

#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "core/archive.hpp"
#include "core/vec3.hpp"
#include "state/nodes.hpp"

namespace cdfp {

class RigidMotion {
 public:
  /// Takes the nodes of the body's part: marks them in `nodes.body` and gives each the mass of the whole
  /// body, which is what a contact at the node has to move.
  RigidMotion(const Model& model, Index body, Nodes& nodes);

  void drift(double step, Nodes& nodes);
  /// Velocity over `step` under the forces on the nodes and gravity; nodes get their velocities.
  void accelerate(double step, Vec3 gravity, Nodes& nodes);

  /// With v(n-1/2) . v(n+1/2) for the square: with potential energy at n it is what leapfrog conserves, J.
  double kinetic_energy(double step) const;

  /// Work of gravity over the drift to come, J.
  double gravity_work(Vec3 gravity, double step) const { return step * mass_ * dot(gravity, velocity_); }

  void archive(Archive& a) {
    a("rigid_body.center", center_);
    a("rigid_body.rotation", rotation_);
    a("rigid_body.velocity", velocity_);
    a("rigid_body.angular_momentum", angular_momentum_);
    a("rigid_body.angular_velocity", angular_velocity_);
    a("rigid_body.force", force_);
    a("rigid_body.last_acceleration", last_acceleration_);
    a("rigid_body.last_torque", last_torque_);
  }

  Vec3 center() const { return center_; }
  Vec3 velocity() const { return velocity_; }
  Vec3 angular_velocity() const { return angular_velocity_; }
  Vec3 force() const { return force_; }  ///< N, on the nodes at the last `accelerate`
  double mass() const { return mass_; }

 private:
  void move_nodes(Nodes& nodes) const;
  void set_node_velocities(Nodes& nodes) const;
  Vec3 spin_of(Vec3 angular_momentum) const;

  std::array<bool, 3> translation_fixed_;
  std::array<bool, 3> rotation_fixed_;
  bool rotates_;
  std::vector<Index> nodes_;
  std::vector<Vec3> arms_;  ///< from the centre, undeformed
  double mass_;
  Mat3 inertia_inverse_;  ///< undeformed frame
  Vec3 center_;
  Mat3 rotation_ = Mat3::identity();
  Vec3 velocity_;
  Vec3 angular_momentum_;
  Vec3 angular_velocity_;
  Vec3 force_;
  Vec3 last_acceleration_;
  Vec3 last_torque_;
};

}  // namespace cdfp
