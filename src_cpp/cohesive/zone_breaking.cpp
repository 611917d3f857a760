#include <algorithm>

#include "cohesive/zone_points.hpp"

namespace cdfp {

namespace {

constexpr int kHandOverSteps = 130;

}  // namespace

/// Facets whose last point broke are free faces from now on.
void CohesiveZone::Points::mark_broken(double time) {
  broke.clear();
  for (ClusterSolver& w : work) {
    for (const Index p : w.broke) broke.push_back(p / 4);
    w.broke.clear();
  }
  std::sort(broke.begin(), broke.end());
  broke.erase(std::unique(broke.begin(), broke.end()), broke.end());
  std::erase_if(broke, [this](Index f) {
    const std::span<const Point> p = points_of(f);
    return std::any_of(p.begin(), p.end(), [](const Point& q) { return q.exists() && !q.broken(); });
  });
  for (const Index f : broke) {
    Facet& facet = facets[f];
    if (facet.broken) continue;
    facet.broken = true;
    facet.broken_time = time;
    facet.hand_over = kHandOverSteps;
    ++broken_count;
    broken_elements.push_back(facet.element);
  }
}

bool CohesiveZone::Points::is_pressed(Index facet) const {
  const std::span<const Point> p = points_of(facet);
  return std::any_of(p.begin(), p.end(), [](const Point& q) { return q.pressed > 0; });
}

/// Broken facets leave the step once nothing presses them, or the contact of free faces has taken over.
void CohesiveZone::Points::dismiss() {
  const auto is_lost = [this](Index f) {
    const std::span<const Point> p = points_of(f);
    const bool whole =
        std::any_of(p.begin(), p.end(), [](const Point& q) { return q.exists() && !q.broken(); });
    return facets[f].broken && !whole && (facets[f].hand_over == 0 || !is_pressed(f));
  };
  std::erase_if(live, [&](Index f) {
    if (!is_lost(f)) return false;
    Facet& facet = facets[f];
    const Energy now = energy_of(f);
    closed.dissipated += now.dissipated;
    closed.friction += now.friction;
    closed.ga += now.ga;
    facet.live = false;
    facet.hand_over = 0;
    for (Index c = 0; c < facet.corners; ++c) {
      Point& point = points[4 * static_cast<std::size_t>(f) + c];
      closed.friction += point.area * (point.stored_by_nodes() + point.pressed);
      ahead_of_closed += point.area * point.ahead;
      point.taken += point.work - point.stored_by_nodes();
      point.lent = point.growth = point.by_rate = point.work = point.stored = point.pressed = point.heat =
          point.ahead = 0;
      point.slip = point.couple = {};
      if (point.exists()) clusters.touch(point.upper);
    }
    return true;
  });
}

}  // namespace cdfp
