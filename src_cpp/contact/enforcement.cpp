/// Penalty and Coulomb friction at the pairs that touch (section 4.4, eqs. 25-30).
#include <algorithm>
#include <cmath>

#include "contact/stages.hpp"
#include "core/require.hpp"

namespace cdfp {

namespace {

/// A pair's stiffness is at most so much that k dt^2 (1/m_first + 1/m_second) stays below this (the lightest
/// node of each side counts, so that the bound does not change as the pair slides). Stability would allow
/// more: central differences hold up to 4 for all springs at a node, two facing surfaces that search each
/// other double a pair, and elements take 2 to 3. But the energy of an impact that lasts a few steps only is
/// off by about k dt^2 / m of itself.
constexpr double kStableShare = 0.25;

/// Edges that meet do so with the gap passing through zero. A crossing that is this deep when first seen, as
/// a share of the edges' height, came in sideways and is no contact: the bodies touch elsewhere.
constexpr double kSideways = 0.01;

Vec3 slip_speed(const TouchingPair& pair, const double* velocity) {
  Vec3 speed;  // of the first side against the second
  for (Index i = 0; i < pair.count; ++i) {
    speed += pair.weights[i] * Vec3::load(velocity + 3 * static_cast<std::size_t>(pair.nodes[i]));
  }
  return speed;
}

/// Share of the penalty force in the steps in which the contact begins or will end. There the spring works
/// over part of a step's approach only, `share`, but a force acts over all of it: with (1 + share)/2 of it
/// the work is the spring's energy, where the whole of it takes up to k a^2/8 too much at the start and gives
/// it at the end.
double partial_step(double old_pressed, double pressed, double approach) {
  const bool begins = old_pressed == 0 && approach < pressed;
  const bool ends = approach > -pressed;
  return begins || ends ? 0.5 * (1 + std::abs(pressed / approach)) : 1.0;
}

/// Heat is what the drag takes out of the motion (its work by the trapezoidal rule, as central differences do
/// it) less what the stick spring keeps.
double heat_of_drag(Vec3 old_drag, Vec3 drag, Vec3 slip, double old_stick_energy, double stick_energy) {
  return -0.5 * dot(old_drag + drag, slip) - (stick_energy - old_stick_energy);
}

void bound_stiffness(TouchingPair& pair, const double* mass, double step) {
  double per_mass[2] = {0, 0};
  for (Index i = 0; i < pair.count; ++i) {
    const double m = mass[pair.nodes[i]];
    pair.per_mass[i] = m > 0 ? 1 / m : 0;
    double& side = per_mass[i < pair.first_count ? 0 : 1];
    side = std::max(side, pair.per_mass[i]);
  }
  const double softness = step * step * (per_mass[0] + per_mass[1]);
  if (pair.grip.stiffness * softness > kStableShare) pair.grip.stiffness = kStableShare / softness;
}

void enforce(TouchingPair& pair, const SurfaceContact::Arrays& arrays, double friction, double step) {
  Grip& grip = pair.grip;
  const Vec3 slip = step * slip_speed(pair, arrays.velocity.data());
  const double approach = dot(pair.normal, slip);
  if (pair.origin == TouchingPair::Origin::fresh) {
    grip.stiffness = pair.stiffness;
    pair.ignored = pair.first_count == 2 && std::min(approach, 0.0) - pair.gap > kSideways * pair.height;
    if (pair.ignored) return;
  }
  bound_stiffness(pair, arrays.mass.data(), step);
  if (pair.origin != TouchingPair::Origin::same) {
    // The spring starts, or goes on, as long as this step's approach alone makes it: penetration from before
    // pushes nothing, and a change of face gives no energy.
    grip.offset = std::min(0.0, pair.gap - std::min(0.0, grip.pressed + approach));
  }

  const double old_pressed = grip.pressed;
  const Vec3 old_drag = grip.drag;
  const double old_stick_energy = grip.stick_energy();
  grip.pressed = std::min(0.0, pair.gap - grip.offset);
  if (grip.pressed == 0) grip.offset = std::min(0.0, pair.gap);
  const double pressure = -grip.stiffness * grip.pressed * partial_step(old_pressed, grip.pressed, approach);
  pair.force = pressure * pair.normal;  // (25)
  pair.stored = 0.5 * grip.stiffness * grip.pressed * grip.pressed;
  pair.heat = 0;
  if (friction == 0) return;

  // Coulomb's law with an elastic stick: the spring moves with the face and stretches up to mu F_n / k.
  const Vec3 aside = slip - approach * pair.normal;
  grip.stick += aside;
  grip.stick -= dot(grip.stick, pair.normal) * pair.normal;
  const double stretch = norm(grip.stick), longest = friction * pressure / grip.stiffness;
  if (stretch > longest) grip.stick *= longest / stretch;
  grip.drag = -grip.stiffness * grip.stick;
  pair.heat = heat_of_drag(old_drag, grip.drag, aside, old_stick_energy, grip.stick_energy());
  pair.force += grip.drag;
  pair.stored += grip.stick_energy();
}

}  // namespace

SurfaceContact::BodyPair& SurfaceContact::Stages::body_pair(const TouchingPair& pair) {
  const auto [low, high] = std::minmax(pair.parts[0], pair.parts[1]);
  const std::array<Index, 2> parts{low, high};
  auto found = std::find_if(body_pairs.begin(), body_pairs.end(),
                            [&](const BodyPair& bodies) { return bodies.parts == parts; });
  if (found == body_pairs.end()) found = body_pairs.insert(found, BodyPair{.parts = parts});
  return *found;
}

void SurfaceContact::Stages::add_to_sums(const TouchingPair& pair) {
  BodyPair& bodies = body_pair(pair);
  bodies.stored += pair.stored;
  bodies.friction_heat += pair.heat;
  bodies.deepest = std::max(bodies.deepest, -pair.gap);
  if (pair.stored > 0 && pair.parts[0] != pair.parts[1]) {
    (pair.parts[0] < pair.parts[1] ? pair.force : -pair.force).add_to(bodies.force.data());
  }
  if (-pair.gap > worst.share * pair.height) {
    const bool edges = pair.first_count == 2;
    const Index segment = edges ? surface.edge_data(pair.second).segments[0] : pair.second;
    worst = {-pair.gap / pair.height,       -pair.gap,  pair.nodes[0],
             surface.data(segment).element, pair.parts, edges};
  }
}

void SurfaceContact::add_force(const Arrays& arrays, double step, int threads) {
  Stages& s = *stages_;
  s.need_nodes(arrays.velocity, "velocity");
  s.need_nodes(arrays.force, "force");
  require(3 * arrays.mass.size() == arrays.velocity.size(),
          "'mass' has " + std::to_string(arrays.mass.size()) + " numbers; give one for each of the " +
              std::to_string(arrays.velocity.size() / 3) + " nodes that 'velocity' has");
  require_positive(step, "the step");
  const double friction = s.settings.friction;
  for (BodyPair& bodies : s.body_pairs) bodies.stored = 0, bodies.force = {};
  for (const TouchingPair& lost : s.removed_touches) {
    const Vec3 slip = step * slip_speed(lost, arrays.velocity.data());
    s.body_pair(lost).friction_heat += lost.stored - 0.5 * dot(lost.force, slip);
  }
  s.removed_touches.clear();
  if (friction > 0) {
    for (const TouchingPair* old : s.ended) {
      const Vec3 slip = step * slip_speed(*old, arrays.velocity.data());
      s.body_pair(*old).friction_heat +=
          heat_of_drag(old->grip.drag, Vec3{}, slip, old->grip.stick_energy(), 0);
    }
  }
  s.ended.clear();
  for (std::vector<TouchingPair>* pairs : {&s.node_touches, &s.edge_touches}) {
    share_out(threads, static_cast<std::int64_t>(pairs->size()), [&](std::int64_t i) {
      TouchingPair& pair = (*pairs)[i];
      enforce(pair, arrays, friction, step);
      if (pair.first_count == 1) s.holds[pair.first].grip = pair.grip;
    });
    // One place and one order for the sums at nodes.
    for (const TouchingPair& pair : *pairs) {
      if (pair.ignored) continue;
      s.add_to_sums(pair);
      if (pair.stored > 0) {
        for (Index i = 0; i < pair.count; ++i) {
          (pair.weights[i] * pair.force).add_to(&arrays.force[3 * static_cast<std::size_t>(pair.nodes[i])]);
        }
      }
    }
  }
  for (BodyPair& bodies : s.body_pairs) {
    bodies.peak_force = std::max(bodies.peak_force, norm(Vec3::load(bodies.force.data())));
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
