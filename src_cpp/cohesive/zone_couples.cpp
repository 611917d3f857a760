#include <algorithm>

#include "cohesive/zone_points.hpp"

namespace cdfp {

namespace {

/// A moment below this share of the facet's fracture energy waits until it has grown.
constexpr double kLeastCouple = 1e-9;

}  // namespace

FacetFrame CohesiveZone::Points::frame_of(Index facet, const NodeArrays& nodes) {
  const std::span<const Point> p = points_of(facet);
  for (std::size_t c = 0; c < p.size(); ++c) pairs[c] = {p[c].upper, p[c].lower};
  return FacetFrame({pairs.data(), p.size()}, nodes);
}

/// N m, of the law's tractions at the openings of the step.
Vec3 CohesiveZone::Points::couple_now(Index facet, const NodeArrays& nodes) const {
  const Facet& f = facets[facet];
  const ModeWeights& weights = laws[f.law].weights;
  Vec3 sum;
  if (!f.live) return sum;
  for (const Point& p : points_of(facet)) {
    if (!p.exists() || p.broken()) continue;
    const Vec3 opening = nodes.x(p.upper) - nodes.x(p.lower);
    const Vec3 arm = arm_of(opening, f.normal);
    if (p.user != kNone) {
      sum += p.area * cross(arm, users[f.law].traction(p.user));
      continue;
    }
    const Split at(opening + p.preload, f.normal);
    const double largest = std::max(p.largest, weights.opening(at.n, at.t2()));
    if (largest == 0) continue;
    const Vec3 path = std::max(at.n, 0.0) * f.normal + weights.traction * at.t;
    sum += (p.area * p.softening.stiffness(largest)) * cross(arm, path);
  }
  return sum;
}

/// The tractions' mean over the step is only known when these forces are: what the law at the step's openings
/// misses of it follows one step later.
void CohesiveZone::Points::balance_couples(const NodeArrays& nodes) {
  for (Couple& couple : couples) {
    Facet& facet = facets[couple.facet];
    facet.couple = couple_now(couple.facet, nodes);
    couple.held = couple.left + facet.couple;
    double area = 0;
    for (const Point& p : points_of(couple.facet)) area += p.area;
    if (norm(couple.held) > kLeastCouple * area * laws[facet.law].given.fracture_energy) {
      frame_of(couple.facet, nodes).add_couple(couple.held, nodes);
    } else {
      facet.couple -= couple.held;
      couple.held = {};
    }
  }
}

/// The work of those couples, once the forces of the step are known.
void CohesiveZone::Points::book_couples(const NodeArrays& nodes, double step) {
  ahead_of_couples = 0;
  const auto kick = [&](Index n) {
    Vec3 change = (step / nodes.mass[n]) * nodes.f(n);
    for (int d = 0; d < 3; ++d) {
      if (nodes.held(n) >> d & 1) change[d] = 0;
    }
    return change;
  };
  for (const Couple& couple : couples) {
    if (norm(couple.held) == 0) continue;
    const FacetFrame frame = frame_of(couple.facet, nodes);
    const Vec3 turned = frame.spin([&](Index n) { return step * (nodes.v(n) + 0.5 * kick(n)); });
    const Vec3 ahead = frame.spin([&](Index n) { return (0.5 * step) * (nodes.v(n) + kick(n)); });
    closed.dissipated -= dot(couple.held, turned);
    ahead_of_couples -= dot(couple.held, ahead);
  }
}

/// Those to hold in the next step.
void CohesiveZone::Points::find_couples() {
  couples.clear();
  for (const Index f : live) {
    Couple couple{f, {}, -facets[f].couple};
    for (const Point& p : points_of(f)) couple.left += p.couple;
    facets[f].couple = {};
    couples.push_back(couple);
  }
}

}  // namespace cdfp
