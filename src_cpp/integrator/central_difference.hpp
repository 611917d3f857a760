/// Explicit central differences in leapfrog form: positions at the step, velocities at the half step.
#pragma once

#include "core/parallel.hpp"
#include "state/nodes.hpp"

namespace cdfp {

/// x += step * v for nodes outside rigid bodies; forces are set to zero for the stages to come.
void drift(double step, Nodes& nodes, const Threads& threads);

/// v += step * f / m in the directions that are free.
void accelerate(double step, Nodes& nodes, const Threads& threads);

/// Adds mass * gravity to the forces of deformable nodes.
void add_gravity(Vec3 gravity, Nodes& nodes, const Threads& threads);

/// 1/2 sum m v(n-1/2) . v(n+1/2) over nodes outside rigid bodies: with the potential energy at n it is what
/// leapfrog conserves. `nodes.velocity` is v(n+1/2), `nodes.force` belongs to n. Directions that are
/// constrained count with v(n+1/2) alone.
double kinetic_energy(double step, const Nodes& nodes, const Threads& threads);

/// Work of gravity over the drift to come: mass * gravity . v * step.
double gravity_work(Vec3 gravity, double step, const Nodes& nodes, const Threads& threads);

}  // namespace cdfp
