#include "integrator/central_difference.hpp"

#include <numeric>
#include <vector>

namespace cdfp {

namespace {

constexpr std::int64_t kGrain = 256;

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
  std::vector<double> pieces((nodes.count() + kGrain - 1) / kGrain, 0);
  threads.for_ranges(nodes.count(), kGrain, [&](std::int64_t begin, std::int64_t end) {
    double sum = 0;
    for (auto n = static_cast<Index>(begin); n < end; ++n) {
      if (nodes.body[n] == kNone && nodes.mass[n] > 0) sum += value(n);
    }
    pieces[begin / kGrain] = sum;
  });
  return std::accumulate(pieces.begin(), pieces.end(), 0.0);
}

}  // namespace

void drift(double step, Nodes& nodes, const Threads& threads) {
  double* x = nodes.position.data();
  double* f = nodes.force.data();
  const double* v = nodes.velocity.data();
  // Rigid nodes move along here too; their body places them afterwards.
  threads.for_ranges(static_cast<std::int64_t>(nodes.position.size()), 3 * kGrain,
                     [&](std::int64_t begin, std::int64_t end) {
                       for (std::int64_t i = begin; i < end; ++i) {
                         x[i] += step * v[i];
                         f[i] = 0;
                       }
                     });
}

void accelerate(double step, Nodes& nodes, const Threads& threads) {
  double* v = nodes.velocity.data();
  const double* f = nodes.force.data();
  threads.for_ranges(nodes.count(), kGrain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const double s = step / nodes.mass[n];
      const std::uint8_t fixed = nodes.fixed[n];
      if (!(fixed & 1)) v[3 * n] += s * f[3 * n];
      if (!(fixed & 2)) v[3 * n + 1] += s * f[3 * n + 1];
      if (!(fixed & 4)) v[3 * n + 2] += s * f[3 * n + 2];
    }
  });
}

void add_gravity(Vec3 gravity, Nodes& nodes, const Threads& threads) {
  threads.for_ranges(nodes.count(), kGrain, [&](std::int64_t begin, std::int64_t end) {
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
