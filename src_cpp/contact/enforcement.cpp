/// Penalty and Coulomb friction at the pairs that touch (section 4.4, eqs. 25-30).
#include <algorithm>
#include <cmath>

#include "contact/stages.hpp"

namespace cdfp {

namespace {

/// A pair's stiffness is at most so much that k dt^2 (1/m_first + 1/m_second) stays below this (the lightest
/// node of each side counts, so that the bound does not change as the pair slides). Central differences hold
/// up to 4 for all springs at a node; two facing surfaces that search each other double a pair, and the
/// elements take up to 2 to 3.
constexpr double kStableShare = 0.5;

void enforce(TouchingPair& pair, const SurfaceContact::Arrays& arrays, double friction, double step) {
  Vec3 slip_speed;  // of the first side against the second
  double per_mass[2] = {0, 0};
  for (Index i = 0; i < pair.count; ++i) {
    const std::size_t node = static_cast<std::size_t>(pair.nodes[i]);
    slip_speed += pair.weights[i] * Vec3::load(&arrays.velocity[3 * node]);
    pair.per_mass[i] = arrays.mass[node] > 0 ? 1 / arrays.mass[node] : 0;
    double& side = per_mass[i < pair.first_count ? 0 : 1];
    side = std::max(side, pair.per_mass[i]);
  }
  const double approach = dot(pair.normal, slip_speed);
  Grip& grip = pair.grip;
  if (pair.fresh) {
    // Penetration older than this step pushes nothing: springs start unloaded.
    grip.stiffness = pair.stiffness;
    grip.offset = std::min(0.0, pair.gap - approach * step);
    grip.stick = Vec3{};
  }
  const double softness = step * step * (per_mass[0] + per_mass[1]);
  if (grip.stiffness * softness > kStableShare) grip.stiffness = kStableShare / softness;

  const double gap = pair.gap - grip.offset;
  pair.heat = 0;
  if (gap >= 0) {
    grip.offset = std::min(0.0, pair.gap);
    pair.heat = grip.stick_energy();
    grip.stick = Vec3{};
    pair.force = Vec3{};
    pair.stored = 0;
    return;
  }
  const double pressure = -grip.stiffness * gap;
  pair.force = pressure * pair.normal;  // (25)
  pair.stored = -0.5 * pressure * gap;
  if (friction == 0) return;

  // Coulomb's law with an elastic stick: the spring moves with the face and stretches up to mu F_n / k.
  grip.stick += step * slip_speed;
  grip.stick -= dot(grip.stick, pair.normal) * pair.normal;
  const double stretch = norm(grip.stick), longest = friction * pressure / grip.stiffness;
  if (stretch > longest) {
    pair.heat = friction * pressure * (stretch - longest);
    grip.stick *= longest / stretch;
  }
  pair.force -= grip.stiffness * grip.stick;
  pair.stored += grip.stick_energy();
}

}  // namespace

void SurfaceContact::add_force(const Arrays& arrays, double step, int threads) {
  Stages& s = *stages_;
  const Threads team(threads);
  const double friction = s.settings.friction;
  s.stored = 0;
  for (std::vector<TouchingPair>* pairs : {&s.node_touches, &s.edge_touches}) {
    team.for_each(static_cast<std::int64_t>(pairs->size()), [&](std::int64_t i) {
      TouchingPair& pair = (*pairs)[i];
      enforce(pair, arrays, friction, step);
      if (pair.first_count == 1) s.holds[pair.first].grip = pair.grip;
    });
    // One place and one order for the sums at nodes.
    for (const TouchingPair& pair : *pairs) {
      s.stored += pair.stored;
      s.heat += pair.heat;
      if (pair.stored > 0) {
        for (Index i = 0; i < pair.count; ++i) {
          (pair.weights[i] * pair.force).add_to(&arrays.force[3 * static_cast<std::size_t>(pair.nodes[i])]);
        }
      }
      s.deepest = std::max(s.deepest, -pair.gap);
      if (-pair.gap > s.worst.share * pair.height) {
        const bool edges = pair.first_count == 2;
        const Index segment = edges ? s.surface.edge_data(pair.second).segments[0] : pair.second;
        const Surface::SegmentData& data = s.surface.data(segment);
        s.worst = {-pair.gap / pair.height, -pair.gap, pair.nodes[0], data.element, data.part, edges};
      }
    }
  }
}

double SurfaceContact::stiffness_over_mass() const {
  // Gershgorin: the largest row sum of M^-1 K bounds omega^2 of the springs.
  std::vector<std::pair<Index, double>> sums;
  for (const std::vector<TouchingPair>* pairs : {&stages_->node_touches, &stages_->edge_touches}) {
    for (const TouchingPair& pair : *pairs) {
      if (!(pair.stored > 0)) continue;
      for (Index i = 0; i < pair.count; ++i) {
        sums.emplace_back(pair.nodes[i],
                          2 * pair.grip.stiffness * std::abs(pair.weights[i]) * pair.per_mass[i]);
      }
    }
  }
  std::sort(sums.begin(), sums.end());
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sum = (i > 0 && sums[i].first == sums[i - 1].first ? sum : 0) + sums[i].second;
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace cdfp
