#include <algorithm>

#include "cohesive/zone_points.hpp"

namespace cdfp {

namespace {

constexpr double kClusterTolerance = 1e-9;  ///< of the reach

}  // namespace

void CohesiveZone::Points::solve_cluster(const Clusters::Cluster& cluster, const NodeArrays& nodes,
                                         double step, ClusterSolver& w) {
  const std::span<const Clusters::Slot> slots = clusters.slots(cluster);
  const auto is_new = [this](const Clusters::Slot& slot) { return !(points[slot.point].contact > 0); };
  if (std::any_of(slots.begin(), slots.end(), is_new)) {
    if (scheme == CohesiveScheme::mean_traction) carry(cluster, nodes, step, w);
    for (const Clusters::Slot& slot : slots) {
      if (is_new(slot)) start(points[slot.point], facets[slot.point / 4], nodes, step);
    }
  }
  load_cluster(cluster, nodes, step, w);
  if (scheme == CohesiveScheme::plain) {
    solve_plain(cluster, step, w);
  } else {
    w.solve(step, kClusterTolerance);
  }
  ++w.solved;
  store_cluster(cluster, nodes, step, w);
}

void CohesiveZone::Points::load_cluster(const Clusters::Cluster& cluster, const NodeArrays& nodes,
                                        double step, ClusterSolver& w) const {
  const std::span<const Index> members = clusters.nodes(cluster);
  w.nodes.resize(members.size());
  for (std::size_t a = 0; a < members.size(); ++a) {
    const Index n = members[a];
    ClusterSolver::Node& node = w.nodes[a];
    const double per_mass = step / nodes.mass[n];
    const std::uint8_t fixed = nodes.held(n);
    node.per_mass = {fixed & 1 ? 0 : per_mass, fixed & 2 ? 0 : per_mass, fixed & 4 ? 0 : per_mass};
    node.behind = nodes.v(n);
    const Vec3 f = nodes.f(n);
    node.free = node.behind + Vec3{node.per_mass.x * f.x, node.per_mass.y * f.y, node.per_mass.z * f.z};
  }
  const std::span<const Clusters::Slot> slots = clusters.slots(cluster);
  w.points.resize(slots.size());
  for (std::size_t i = 0; i < slots.size(); ++i) {
    ClusterSolver::Point& p = w.points[i];
    p.upper = slots[i].upper;
    p.lower = slots[i].lower;
    p.now = nodes.x(members[p.upper]) - nodes.x(members[p.lower]) + points[slots[i].point].preload;
    load_point(slots[i], step, w, p);
  }
}

void CohesiveZone::Points::load_point(const Clusters::Slot& slot, double step, ClusterSolver& w,
                                      ClusterSolver::Point& p) const {
  const Point& point = points[slot.point];
  const Facet& facet = facets[slot.point / 4];
  const Law& law = laws[facet.law];
  const Vec3 behind = w.nodes[p.upper].behind - w.nodes[p.lower].behind;
  Increment& i = p.increment;
  const Split from(p.now - 0.5 * step * behind, facet.normal);
  i = {};
  i.normal = facet.normal;
  i.from_n = from.n;
  i.from_t = from.t;
  i.weights = law.weights;
  i.softening = point.softening;
  i.largest = point.largest;
  i.r0 = std::min(point.largest, law.weights.opening(from.n, from.t2()));
  i.area = point.area;
  if (point.user == kNone) {
    i.unloading = point.largest > 0 ? point.softening.stiffness(point.largest) : 0;
  } else {
    i.given = users[facet.law].traction(point.user);
  }
  i.rate = {law.given.rate_sensitivity, step * law.given.reference_rate};
  if (facet.broken && facet.hand_over == 0) return;
  i.contact = point.contact;
  i.slip = point.slip - dot(point.slip, facet.normal) * facet.normal;
  if (law.given.friction > 0) {
    i.friction = law.given.friction *
                 friction_share(point.softening.damage(point.largest), law.given.friction_exponent);
  }
}

/// Tractions at the openings of the step.
void CohesiveZone::Points::solve_plain(const Clusters::Cluster& cluster, double step,
                                       ClusterSolver& w) const {
  const std::span<const Clusters::Slot> slots = clusters.slots(cluster);
  for (ClusterSolver::Node& node : w.nodes) node.load = {};
  for (std::size_t s = 0; s < slots.size(); ++s) {
    ClusterSolver::Point& p = w.points[s];
    Increment& i = p.increment;
    const Split at(p.now, i.normal);
    const double r = i.weights.opening(at.n, at.t2());
    const double largest = std::max(i.largest, r);
    p.reaction = {};
    if (points[slots[s].point].user != kNone) {
      p.reaction.traction = i.given;
    } else if (largest == 0) {
      p.reaction.traction = facets[slots[s].point / 4].traction;
    } else {
      double k = i.softening.stiffness(largest);
      if (r > i.largest && i.rate.sensitivity > 0) k *= 1 + i.rate.excess(r - i.largest);
      p.reaction.traction = k * (std::max(at.n, 0.0) * i.normal + i.weights.traction * at.t);
    }
    if (at.n < 0 && i.contact > 0) {
      p.reaction.contact = i.contact * at.n;
      p.reaction.traction += p.reaction.contact * i.normal;
      const Vec3 before = p.now - step * (w.nodes[p.upper].behind - w.nodes[p.lower].behind);
      const Vec3 trial = i.slip + at.t - Split(before, i.normal).t;
      const double limit = -i.friction * i.contact * at.n;
      const double length = i.contact * norm(trial);
      p.reaction.slip = length > limit ? (limit / length) * trial : trial;
      p.reaction.friction = i.contact * p.reaction.slip;
      p.reaction.traction += p.reaction.friction;
    }
    const Vec3 force = i.area * p.reaction.traction;
    w.nodes[p.upper].load += force;
    w.nodes[p.lower].load -= force;
  }
  for (ClusterSolver::Node& node : w.nodes) {
    node.ahead = node.free - Vec3{node.per_mass.x * node.load.x, node.per_mass.y * node.load.y,
                                  node.per_mass.z * node.load.z};
  }
}

/// The largest opening so far; of a user's point the damage stands for it.
double CohesiveZone::Points::opened_to(const Point& point, const Increment& i, const Split& at,
                                       std::int32_t law) const {
  if (point.user != kNone) return users[law].damage(point.user) * point.softening.reach;
  return std::max(i.largest, i.weights.opening(at.n, at.t2()));
}

double CohesiveZone::Points::stored_in(const Point& point, const Increment& i, const Split& at,
                                       std::int32_t law) const {
  if (point.user != kNone) return users[law].stored(point.user);
  if (!(point.largest > 0)) return 0;
  return 0.5 * point.softening.stiffness(point.largest) * i.weights.quadratic(at.n, at.t2());
}

/// Forces into the nodes; the points' state and accounts at the half step ahead.
void CohesiveZone::Points::store_cluster(const Clusters::Cluster& cluster, const NodeArrays& nodes,
                                         double step, ClusterSolver& w) {
  const std::span<const Index> members = clusters.nodes(cluster);
  for (std::size_t a = 0; a < members.size(); ++a) {
    (-w.nodes[a].load).add_to(&nodes.force[3 * static_cast<std::size_t>(members[a])]);
  }
  const std::span<const Clusters::Slot> slots = clusters.slots(cluster);
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const ClusterSolver::Point& p = w.points[s];
    const Increment& i = p.increment;
    Point& point = points[slots[s].point];
    const Vec3 behind = w.nodes[p.upper].behind - w.nodes[p.lower].behind;
    const Vec3 ahead = w.nodes[p.upper].ahead - w.nodes[p.lower].ahead;
    const Vec3 moved = (0.5 * step) * (behind + ahead);
    const bool plain = scheme == CohesiveScheme::plain;
    const Vec3 from = plain ? p.now - step * behind : p.now - (0.5 * step) * behind;
    const Vec3 to = plain ? p.now : from + moved;
    const Split at(to, i.normal);

    const bool whole = !point.broken();
    const double r = i.weights.opening(at.n, at.t2());
    if (whole && point.user == kNone && r > point.largest) {
      point.growth += weighted_growth(i.weights, i.normal, from, to, point.largest, point.softening.reach);
      if (!i.linear) point.by_rate += i.rate_work(at, r);
    }
    point.largest = opened_to(point, i, at, facets[slots[s].point / 4].law);
    if (whole && point.broken()) w.broke.push_back(slots[s].point);

    if (i.contact > 0) point.contact = i.contact;
    const Reaction& reaction = p.reaction;
    const Vec3 closed_face = reaction.contact * i.normal + reaction.friction;
    point.work += dot(reaction.traction - closed_face, moved);
    point.stored = stored_in(point, i, at, facets[slots[s].point / 4].law);
    const double gap = std::min(at.n, 0.0);
    const double pressed = 0.5 * i.contact * (gap * gap + dot(reaction.slip, reaction.slip));
    point.heat += dot(closed_face, moved) - (pressed - point.pressed);
    point.pressed = pressed;
    point.slip = reaction.slip;
    point.ahead = (0.5 * step) * dot(reaction.traction, ahead);
    const Vec3 opening = nodes.x(members[p.upper]) - nodes.x(members[p.lower]);
    point.couple = i.area * cross(arm_of(opening, i.normal), reaction.traction - closed_face);
  }
}

}  // namespace cdfp
