#include "integrator/central_difference.hpp"

#include <numeric>
#include <vector>

namespace cdfp {

namespace {

/// Acceleration of a node in its free directions.
Vec3 acceleration(const Nodes& nodes, Index n) {
  const double per_mass = 1 / nodes.mass[n];
  const std::uint8_t fixed = nodes.fixed[n];
  const Vec3 f = nodes.f(n);
  return {fixed & 1 ? 0 : f.x * per_mass, fixed & 2 ? 0 : f.y * per_mass, fixed & 4 ? 0 : f.z * per_mass};
}

/// Sum of `value(n)` over deformable nodes that carry mass, piece by piece.
template <class Value>
double sum_over_free(const Nodes& nodes, const Threads& threads, Value&& value) {
  std::vector<double> pieces((nodes.count() + kNodePiece - 1) / kNodePiece, 0);
  nodes.pieces.for_each(nodes.count(), threads, [&](std::int64_t begin, std::int64_t end) {
    double sum = 0;
    for (auto n = static_cast<Index>(begin); n < end; ++n) {
      if (nodes.body[n] == kNone && nodes.mass[n] > 0) sum += value(n);
    }
    pieces[begin / kNodePiece] = sum;
  });
  return std::accumulate(pieces.begin(), pieces.end(), 0.0);
}

}  // namespace

// Pointers and numbers stand inside the pieces: from outside they would be read again after every store.

void drift(double step, Nodes& nodes, const Threads& threads) {
  // Rigid nodes move along here too; their body places them afterwards.
  nodes.pieces.for_each(nodes.count(), threads, [&](std::int64_t begin, std::int64_t end) {
    double* const x = nodes.position.data();
    double* const f = nodes.force.data();
    const double* const v = nodes.velocity.data();
    const double length = step;
    for (std::int64_t i = 3 * begin; i < 3 * end; ++i) {
      x[i] += length * v[i];
      f[i] = 0;
    }
  });
}

void accelerate(double step, Nodes& nodes, const Threads& threads) {
  nodes.pieces.for_each(nodes.count(), threads, [&](std::int64_t begin, std::int64_t end) {
    double* const v = nodes.velocity.data();
    const double* const f = nodes.force.data();
    const double* const mass = nodes.mass.data();
    const std::uint8_t* const fixed = nodes.fixed.data();
    const double length = step;
    for (std::int64_t n = begin; n < end; ++n) {
      const double s = length / mass[n];
      if (!(fixed[n] & 1)) v[3 * n] += s * f[3 * n];
      if (!(fixed[n] & 2)) v[3 * n + 1] += s * f[3 * n + 1];
      if (!(fixed[n] & 4)) v[3 * n + 2] += s * f[3 * n + 2];
    }
  });
}

void add_gravity(Vec3 gravity, Nodes& nodes, const Threads& threads) {
  nodes.pieces.for_each(nodes.count(), threads, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      if (nodes.body[n] == kNone) (nodes.mass[n] * gravity).add_to(&nodes.force[3 * n]);
    }
  });
}

double kinetic_energy(double step, const Nodes& nodes, const Threads& threads) {
  return sum_over_free(nodes, threads, [&](Index n) {
    const Vec3 v = nodes.v(n);
    return 0.5 * nodes.mass[n] * dot(v - step * acceleration(nodes, n), v);
  });
}

double gravity_work(Vec3 gravity, double step, const Nodes& nodes, const Threads& threads) {
  return sum_over_free(nodes, threads,
                       [&](Index n) { return step * nodes.mass[n] * dot(gravity, nodes.v(n)); });
}

}  // namespace cdfp
