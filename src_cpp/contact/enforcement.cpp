/// Penalty and Coulomb friction at the pairs that touch (section 4.4, eqs. 25-30).
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/stages.hpp"
#include "core/numbered.hpp"
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

void bound_stiffness(TouchingPair& pair, Grip& grip, const double* mass, double step) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double lightest[2] = {kInfinite, kInfinite};
  for (Index i = 0; i < pair.count; ++i) {
    const double m = mass[pair.nodes[i]] > 0 ? mass[pair.nodes[i]] : kInfinite;
    pair.mass[i] = static_cast<float>(m);
    double& side = lightest[i < pair.first_count ? 0 : 1];
    side = std::min(side, m);
  }
  const double softness = step * step * (1 / lightest[0] + 1 / lightest[1]);
  if (grip.stiffness * softness > kStableShare) grip.stiffness = kStableShare / softness;
}

SurfaceContact::BodyPair& find_or_add(std::vector<SurfaceContact::BodyPair>& all,
                                      const std::array<Index, 2>& parts) {
  const auto [low, high] = std::minmax(parts[0], parts[1]);
  const std::array<Index, 2> ascending{low, high};
  auto found = std::find_if(all.begin(), all.end(), [&](const SurfaceContact::BodyPair& bodies) {
    return bodies.parts == ascending;
  });
  if (found == all.end()) found = all.insert(found, SurfaceContact::BodyPair{.parts = ascending});
  return *found;
}

}  // namespace

double SurfaceContact::Stages::stiffness(const TouchingPair& pair) const {
  return pair.first_count == 2
             ? std::min(surface.edge_data(pair.first).stiffness, surface.edge_data(pair.second).stiffness)
             : std::min(surface.data(pair.second).stiffness, surface.node_stiffness(pair.first));
}

void SurfaceContact::Stages::enforce(TouchingPair& pair, Grip& grip, const Arrays& arrays,
                                     double step) const {
  const double friction = settings.friction;
  const Vec3 slip = step * slip_speed(pair, arrays.velocity.data());
  const double approach = dot(pair.normal, slip);
  if (pair.origin == TouchingPair::Origin::fresh) {
    grip.stiffness = stiffness(pair);
    pair.ignored = pair.first_count == 2 && std::min(approach, 0.0) - pair.gap > kSideways * pair.height;
    if (pair.ignored) return;
  }
  const Vec3 old_drag = grip.drag();
  bound_stiffness(pair, grip, arrays.mass.data(), step);
  if (pair.origin != TouchingPair::Origin::same) {
    // The spring starts, or goes on, as long as this step's approach alone makes it: penetration from before
    // pushes nothing, and a change of face gives no energy.
    grip.offset = std::min(0.0, pair.gap - std::min(0.0, grip.pressed + approach));
  }

  const double old_pressed = grip.pressed;
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
  pair.heat = heat_of_drag(old_drag, grip.drag(), aside, old_stick_energy, grip.stick_energy());
  pair.force += grip.drag();
  pair.stored += grip.stick_energy();
}

void SurfaceContact::Stages::add_to_sums(const TouchingPair& pair, Sums& sums) const {
  if (pair.ignored) return;
  BodyPair& bodies = find_or_add(sums.bodies, pair.parts);
  bodies.stored += pair.stored;
  bodies.friction_heat += pair.heat;
  bodies.deepest = std::max(bodies.deepest, -pair.gap);
  if (pair.stored > 0) {
    if (pair.parts[0] != pair.parts[1]) {
      (pair.parts[0] < pair.parts[1] ? pair.force : -pair.force).add_to(bodies.force.data());
    }
    const auto [least, largest] = std::minmax_element(pair.nodes.begin(), pair.nodes.begin() + pair.count);
    sums.nodes = {std::min(sums.nodes[0], *least), std::max(sums.nodes[1], *largest)};
  }
  if (-pair.gap > sums.worst.share * pair.height) {
    const bool edges = pair.first_count == 2;
    const Index segment = edges ? surface.edge_data(pair.second).segments[0] : pair.second;
    sums.worst = {-pair.gap / pair.height,       -pair.gap,  pair.nodes[0],
                  surface.data(segment).element, pair.parts, edges};
  }
}

void SurfaceContact::Stages::add_to_bodies(const Sums& sums) {
  for (const BodyPair& part : sums.bodies) {
    BodyPair& bodies = find_or_add(body_pairs, part.parts);
    bodies.stored += part.stored;
    bodies.friction_heat += part.friction_heat;
    bodies.deepest = std::max(bodies.deepest, part.deepest);
    Vec3::load(part.force.data()).add_to(bodies.force.data());
  }
  if (sums.worst.share > worst.share) worst = sums.worst;
}

/// Each thread adds to nodes of its own, in the order of the pairs: the same sums for any number of threads.
void SurfaceContact::Stages::add_to_nodes(const Arrays& arrays, int threads) const {
  // Where a share of the nodes begins: by what the pieces touch, so that the work is even.
  std::vector<Index> seen;
  for_each_piece([&](const Sums& sums, auto&&) {
    if (sums.nodes[1] >= 0) seen.insert(seen.end(), sums.nodes.begin(), sums.nodes.end());
  });
  std::sort(seen.begin(), seen.end());
  const std::int64_t shares = std::min<std::int64_t>(threads, 1 + std::ssize(seen) / 8);
  const auto bound = [&](std::int64_t share) {
    if (share == 0) return Index{0};
    return share == shares ? surface.node_limit() : seen[seen.size() * share / shares];
  };
  Threads(static_cast<int>(shares)).for_each(shares, [&](std::int64_t share) {
    const Index begin = bound(share), end = bound(share + 1);
    for_each_piece([&](const Sums& sums, auto&& for_each_pair) {
      if (sums.nodes[0] >= end || sums.nodes[1] < begin) return;
      for_each_pair([&](const TouchingPair& pair, const Grip&) {
        if (!(pair.stored > 0) || pair.ignored) return;
        for (Index i = 0; i < pair.count; ++i) {
          const Index node = pair.nodes[i];
          if (node < begin || node >= end) continue;
          (pair.weights[i] * pair.force).add_to(&arrays.force[3 * static_cast<std::size_t>(node)]);
        }
      });
    });
  });
}

void SurfaceContact::add_force(const Arrays& arrays, double step, int threads) {
  Stages& s = *stages_;
  s.need_nodes(arrays.velocity, "velocity");
  s.need_nodes(arrays.force, "force");
  require(3 * arrays.mass.size() == arrays.velocity.size(),
          "'mass' has " + std::to_string(arrays.mass.size()) + " numbers; give one for each of the " +
              std::to_string(arrays.velocity.size() / 3) + " nodes that 'velocity' has");
  require_positive(step, "the step");
  for (BodyPair& bodies : s.body_pairs) bodies.stored = 0, bodies.force = {};
  for (const TouchingPair& lost : s.removed_pairs) {
    const Vec3 slip = step * slip_speed(lost, arrays.velocity.data());
    find_or_add(s.body_pairs, lost.parts).friction_heat += lost.stored - 0.5 * dot(lost.force, slip);
  }
  s.removed_pairs.clear();
  if (s.settings.friction > 0) {
    for (const GrippedPair& old : s.ended) {
      const Vec3 slip = step * slip_speed(old.pair, arrays.velocity.data());
      find_or_add(s.body_pairs, old.pair.parts).friction_heat +=
          heat_of_drag(old.grip.drag(), Vec3{}, slip, old.grip.stick_energy(), 0);
    }
  }
  s.ended.clear();
  Threads(threads).deal_ranges(std::ssize(s.pieces), 1, [&](std::int64_t i, std::int64_t) {
    Stages::Sums& sums = s.pieces[i].sums.start(s.worst);
    for (TouchingPair& pair : s.pieces[i].touches) {
      s.enforce(pair, s.holds[pair.first].grip, arrays, step);
      s.add_to_sums(pair, sums);
    }
  });
  s.edge_sums.resize((s.edge_touches.size() + Stages::kPiece - 1) / Stages::kPiece);
  Threads(threads).deal_ranges(std::ssize(s.edge_touches), Stages::kPiece,
                               [&](std::int64_t begin, std::int64_t end) {
                                 Stages::Sums& sums = s.edge_sums[begin / Stages::kPiece].start(s.worst);
                                 for (std::int64_t i = begin; i < end; ++i) {
                                   s.enforce(s.edge_touches[i].pair, s.edge_touches[i].grip, arrays, step);
                                   s.add_to_sums(s.edge_touches[i].pair, sums);
                                 }
                               });
  s.add_to_nodes(arrays, threads);
  s.for_each_piece([&](const Stages::Sums& sums, auto&&) { s.add_to_bodies(sums); });
  for (BodyPair& bodies : s.body_pairs) {
    bodies.peak_force = std::max(bodies.peak_force, norm(Vec3::load(bodies.force.data())));
  }
}

void SurfaceContact::add_stiffness_over_mass(std::span<double> by_node) const {
  require(by_node.size() >= static_cast<std::size_t>(stages_->surface.node_limit()),
          "'by_node' has " + std::to_string(by_node.size()) + " numbers, but contact segments name node " +
              numbered(stages_->surface.node_limit() - 1) + "; give one for each node");
  stages_->for_each_pair([&](const TouchingPair& pair, const Grip& grip) {
    if (!(pair.stored > 0)) return;
    for (Index i = 0; i < pair.count; ++i) {
      by_node[pair.nodes[i]] += 2 * grip.stiffness * std::abs(pair.weights[i]) / pair.mass[i];
    }
  });
}

double SurfaceContact::stiffness_over_mass() const {
  // Gershgorin: the largest row sum of M^-1 K bounds omega^2 of the springs.
  std::vector<double> sums(stages_->surface.node_limit(), 0);
  add_stiffness_over_mass(sums);
  return sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
}

}  // namespace cdfp
