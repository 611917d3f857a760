#include <omp.h>

#include <algorithm>

#include "cohesive/zone_points.hpp"

namespace cdfp {

namespace {

/// A broken face that is pressed hands its load over to the contact between free faces: its spring gives way
/// by this share a step, slow enough for the load to move without a wave, until next to nothing is left.
constexpr double kGivesWay = 0.9;
/// Share of its turn in a step that a pressed face follows. Pressed pairs that have slid push past one
/// another: where their direction followed every wave along the face, they would feed it.
constexpr double kPressedTurn = 0.01;
constexpr std::int64_t kGrain = 4;
constexpr std::size_t kWorthwhile = 16;  ///< facets for which threads are woken

}  // namespace

void CohesiveZone::Points::add_force(const NodeArrays& nodes, double step, double time,
                                     const Threads& threads) {
  broken_elements.clear();
  ahead_of_closed = 0;
  clusters.update([this](Index p) {
    const Point& point = points[p];
    const bool lost = point.broken() && facets[p / 4].broken && facets[p / 4].hand_over == 0;
    return lost ? NodePair{} : NodePair{point.upper, point.lower};
  });
  const Threads awake = live.size() < kWorthwhile ? Threads(1) : threads;
  work.resize(std::max<std::size_t>(work.size(), awake.count()));

  awake.deal_ranges(static_cast<std::int64_t>(live.size()), kGrain,
                    [&](std::int64_t begin, std::int64_t end) {
                      for (std::int64_t k = begin; k < end; ++k) turn(live[k], nodes);
                    });
  ask_users(nodes, step, time);
  balance_couples(nodes);
  const std::span<const Clusters::Cluster> all = clusters.all();
  awake.deal_ranges(static_cast<std::int64_t>(all.size()), kGrain, [&](std::int64_t begin, std::int64_t end) {
    ClusterSolver& w = work[omp_get_thread_num()];
    for (std::int64_t k = begin; k < end; ++k) {
      if (all[k].slots > 0) solve_cluster(all[k], nodes, step, w);
    }
  });
  book_couples(nodes, step);
  find_couples();
  mark_broken(time);
  dismiss();
}

/// The normal of the middle face as it is now; what the points keep as vectors turns with it.
void CohesiveZone::Points::turn(Index facet, const NodeArrays& nodes) {
  Facet& f = facets[facet];
  const std::span<const Point> p = points_of(facet);
  const auto middle = [&](int c) { return nodes.x(p[c].upper) + nodes.x(p[c].lower); };
  const Vec3 doubled = f.corners == 4 ? cross(middle(2) - middle(0), middle(3) - middle(1))
                                      : cross(middle(1) - middle(0), middle(2) - middle(0));
  const Vec3 before = f.normal;
  f.normal = (1 / norm(doubled)) * doubled;
  if (is_pressed(facet)) f.normal = normalized(before + kPressedTurn * (f.normal - before));
  const Vec3 turns = cross(before, f.normal);
  const double bend = 1 / (1 + dot(before, f.normal));
  for (Index c = 0; c < f.corners; ++c) {
    Point& point = points[4 * static_cast<std::size_t>(facet) + c];
    for (Vec3* kept : {&point.preload, &point.slip}) {
      const Vec3 moved = cross(turns, *kept);
      *kept += moved + bend * cross(turns, moved);
    }
    if (f.hand_over > 0) point.contact *= kGivesWay;
  }
  if (f.hand_over > 0) --f.hand_over;
}

/// Users' laws say their tractions at the openings of the step, in one call each.
void CohesiveZone::Points::ask_users(const NodeArrays& nodes, double step, double time) {
  std::vector<UserCohesivePoints::Question> questions;
  for (std::size_t law = 0; law < laws.size(); ++law) {
    if (laws[law].given.kind != CohesiveKind::user) continue;
    questions.clear();
    for (const Index f : live) {
      if (facets[f].law != static_cast<std::int32_t>(law)) continue;
      for (const Point& p : points_of(f)) {
        if (!p.exists() || p.broken()) continue;
        const double inertia = 1 / nodes.mass[p.upper] + 1 / nodes.mass[p.lower];
        questions.push_back({p.user, nodes.x(p.upper) - nodes.x(p.lower), facets[f].normal,
                             kUserStiffness / (0.5 * step * step * inertia * p.area), p.area});
      }
    }
    users[law].ask(laws[law].given, time, step, questions);
  }
}

}  // namespace cdfp
