#include <algorithm>

#include "cohesive/zone_points.hpp"

namespace cdfp {

namespace {

/// A closed face, and one that has not opened yet, is a spring this much stiffer than the inertia that the
/// nodes show in a step. The mean traction takes any stiffness; the plain scheme only what it can follow.
constexpr double kStiffness = 300;
constexpr double kPlainStiffness = 0.5;
/// Opening over reach, at most, at which that spring carries the strength.
constexpr double kRigidOpening = 0.01;
/// The traction that holds new pairs together is found to this share of the strength.
constexpr double kCarried = 1e-10;
constexpr double kTieStiffness = 1e5;
constexpr double kTieTolerance = 1e-10;  ///< of the reach; less is lost in rounding
constexpr int kCarriedRounds = 12;

}  // namespace

/// m/Pa: how far the pair's nodes part in half a step.
double CohesiveZone::Points::yields(const Point& point, const NodeArrays& nodes, double step) const {
  return 0.5 * step * step * (1 / nodes.mass[point.upper] + 1 / nodes.mass[point.lower]) * point.area;
}

/// A spring without limit in place of a pair that has just come to be.
void CohesiveZone::Points::load_tie(Point& point, const NodeArrays& nodes, double step,
                                    ClusterSolver::Point& p) const {
  Increment& i = p.increment;
  const double reach = i.softening.reach;
  i = {};
  i.normal = {1, 0, 0};
  i.softening.reach = reach;
  i.given = point.carried;
  i.unloading = kTieStiffness / yields(point, nodes, step);
  i.linear = true;
  i.area = point.area;
  p.now = {};
}

/// What pairs that have just come to be must carry for their nodes to go on as one, which is what the mesh
/// carried there before (Papoulia, Sam, Vavasis 2003). Where several share a node, the tractions that differ
/// least from those of their facets.
void CohesiveZone::Points::carry(const Clusters::Cluster& cluster, const NodeArrays& nodes, double step,
                                 ClusterSolver& w) {
  const std::span<const Clusters::Slot> slots = clusters.slots(cluster);
  load_cluster(cluster, nodes, step, w);
  for (int round = 0; round < kCarriedRounds; ++round) {
    for (std::size_t i = 0; i < slots.size(); ++i) {
      Point& point = points[slots[i].point];
      if (!(point.contact > 0)) load_tie(point, nodes, step, w.points[i]);
    }
    w.solve(step, kTieTolerance);
    double change = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      Point& point = points[slots[i].point];
      if (point.contact > 0) continue;
      change = std::max(change, norm(w.points[i].reaction.traction - point.carried) / point.strength);
      point.carried = w.points[i].reaction.traction;
    }
    if (change < kCarried) break;
  }
}

/// A pair that has just come to be carries its traction before it moves: its springs, stiff as its nodes'
/// inertia asks for, are loaded by that much. The softening line starts at the facet's strength, or at that
/// traction if it is more, and takes the fracture energy from the nodes.
void CohesiveZone::Points::start(Point& point, const Facet& facet, const NodeArrays& nodes, double step) {
  const double soft = yields(point, nodes, step);
  if (scheme == CohesiveScheme::plain) {
    point.contact = kPlainStiffness / soft;
    return;
  }
  point.contact = kStiffness / soft;
  const Law& law = laws[facet.law];
  if (law.given.kind == CohesiveKind::bilinear) return;
  const Split carried(point.carried, facet.normal);
  const double pressing = std::min(0.0, carried.n);
  point.pressed = 0.5 * pressing * pressing / point.contact;
  point.heat = -point.pressed;
  if (law.given.kind == CohesiveKind::user) {
    point.preload = (pressing / point.contact) * facet.normal;
    users[facet.law].carry(point.user, point.carried - pressing * facet.normal);
    return;
  }
  const double load = effective_traction(point.carried, facet.normal, law.given.shear_ratio);
  point.strength = std::max(point.strength, load);
  const double reach = 2 * law.given.fracture_energy / point.strength;
  const double share = load / point.strength;
  Softening& softening = point.softening;
  softening.start = std::min(kRigidOpening * reach, point.strength / point.contact);
  softening.reach = reach + share * share * softening.start;
  softening.scale = point.strength * softening.reach / (softening.reach - softening.start);
  point.energy = 0.5 * point.strength * reach / (softening.reach - softening.start);
  point.largest = softening.start;
  const double rigid = point.strength / softening.start;
  point.preload = (carried.n / (carried.n < 0 ? point.contact : rigid)) * facet.normal +
                  (1 / (rigid * law.weights.traction)) * carried.t;
  const Split at(point.preload, facet.normal);
  point.stored = 0.5 * rigid * law.weights.quadratic(at.n, at.t2());
  point.lent = point.stored;
}

}  // namespace cdfp
