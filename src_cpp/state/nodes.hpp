/// The nodal state: the one owner of positions, velocities, forces and masses. It grows when nodes are split.
/// Services work on views of it or of a caller's arrays.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cdfp/types.hpp"
#include "core/archive.hpp"
#include "core/growth.hpp"
#include "core/vec3.hpp"
#include "state/slabs.hpp"

namespace cdfp {

struct Nodes {
  std::span<const double> reference;  ///< (n, 3) undeformed position, m: of the mesh, which must stay
  std::vector<double> position;       ///< (n, 3) at the end of the step, m
  std::vector<double> velocity;       ///< (n, 3) at the half step, m/s
  std::vector<double> force;          ///< (n, 3) sum over all stages of the step, N
  std::vector<double> mass;           ///< (n) lumped, kg
  std::vector<std::uint8_t> fixed;    ///< (n) bit d: direction d follows a constraint, not its force
  std::vector<Index> body;            ///< (n) rigid body that carries the node, or kNone
  NodePieces pieces;

  explicit Nodes(std::span<const double> coordinates)
      : reference(coordinates),
        position(coordinates.begin(), coordinates.end()),
        velocity(reference.size(), 0.0),
        force(reference.size(), 0.0),
        mass(reference.size() / 3, 0.0),
        fixed(mass.size(), 0),
        body(mass.size(), kNone),
        pieces(coordinates) {}

  Index count() const { return static_cast<Index>(mass.size()); }
  Vec3 x(Index n) const { return Vec3::load(&position[3 * static_cast<std::size_t>(n)]); }
  Vec3 v(Index n) const { return Vec3::load(&velocity[3 * static_cast<std::size_t>(n)]); }
  Vec3 f(Index n) const { return Vec3::load(&force[3 * static_cast<std::size_t>(n)]); }
  Vec3 x0(Index n) const { return Vec3::load(&reference[3 * static_cast<std::size_t>(n)]); }

  void archive(Archive& a) {
    a("nodes.position", position);
    a("nodes.velocity", velocity);
    a("nodes.force", force);
    a("nodes.mass", mass);
    a("nodes.fixed", fixed);
    a("nodes.body", body);
  }

  /// Appends a copy of `mother` (all but its mass, which the caller divides) here and to `coordinates`, which
  /// `reference` shows, and returns its number.
  Index clone(Index mother, std::vector<double>& coordinates) {
    for (std::vector<double>* field : {&coordinates, &position, &velocity, &force}) {
      make_room(*field, field->size() + 3);
      for (int d = 0; d < 3; ++d) field->push_back((*field)[3 * static_cast<std::size_t>(mother) + d]);
    }
    reference = coordinates;
    append(mass, mass[mother]);
    append(fixed, fixed[mother]);
    append(body, body[mother]);
    return count() - 1;
  }
};

/// Arrays of all nodes, wherever they are kept.
struct NodeArrays {
  std::span<const double> position;     ///< (n, 3)
  std::span<const double> velocity;     ///< (n, 3)
  std::span<const double> mass;         ///< (n)
  std::span<double> force;              ///< (n, 3); empty where nothing adds to it
  std::span<const std::uint8_t> fixed;  ///< (n)
  std::span<const Index> body;          ///< (n); empty: no rigid bodies

  NodeArrays() = default;
  // NOLINTBEGIN(google-explicit-constructor,hicpp-explicit-conversions): nodes are node arrays
  NodeArrays(const Nodes& n)
      : position(n.position), velocity(n.velocity), mass(n.mass), fixed(n.fixed), body(n.body) {}
  NodeArrays(Nodes& n) : NodeArrays(std::as_const(n)) { force = n.force; }
  // NOLINTEND(google-explicit-constructor,hicpp-explicit-conversions)

  Vec3 x(Index n) const { return Vec3::load(&position[3 * static_cast<std::size_t>(n)]); }
  Vec3 v(Index n) const { return Vec3::load(&velocity[3 * static_cast<std::size_t>(n)]); }
  Vec3 f(Index n) const { return Vec3::load(&force[3 * static_cast<std::size_t>(n)]); }
  /// Bit d: direction d does not follow the node's force.
  std::uint8_t held(Index n) const { return body.empty() || body[n] == kNone ? fixed[n] : 7; }
};

}  // namespace cdfp
