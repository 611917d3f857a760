#include "cohesive/cohesive_zone.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cdfp/error.hpp"
#include "cohesive/zone_points.hpp"
#include "core/numbered.hpp"
#include "model/lookup.hpp"

namespace cdfp {

CohesiveZone::Points::Points(const Model& model, CohesiveScheme chosen)
    : scheme(chosen), part_of_element(model.mesh.parts), layer_of_element(model.mesh.layers) {
  for (const CohesiveLaw& law : model.cohesive_laws) add_law(law);
  law_of_part.assign(model.mesh.part_names.size(), -1);
  for (const Part& part : model.parts) {
    if (part.cohesive_law.empty()) continue;
    law_of_part[part_number(model.mesh, part.name)] = law_number(part.cohesive_law);
  }
}

void CohesiveZone::Points::add_law(const CohesiveLaw& law) {
  if (!(law.strength > 0) || !(law.fracture_energy > 0) || !(law.mode_ratio > 0) || !(law.shear_ratio > 0)) {
    throw Error(Status::bad_argument, "cohesive law '" + law.name +
                                          "' needs a positive strength, fracture_energy, mode_ratio and "
                                          "shear_ratio");
  }
  laws.push_back({law, ModeWeights(law)});
  users.emplace_back(law.states);
}

std::int32_t CohesiveZone::Points::law_number(const std::string& name) const {
  const auto law = std::find_if(laws.begin(), laws.end(), [&](const Law& l) { return l.given.name == name; });
  if (law == laws.end()) throw Error(Status::bad_argument, "there is no cohesive law '" + name + "'");
  return static_cast<std::int32_t>(law - laws.begin());
}

CohesiveZone::Energy CohesiveZone::Points::energy_of(Index facet) const {
  Energy sum;
  for (const Points::Point& p : points_of(facet)) {
    const double stored = p.stored_by_nodes();
    sum.stored += p.area * (stored + p.pressed - p.ahead);
    sum.dissipated += p.area * (p.work - stored);
    sum.friction += p.area * p.heat;
    // A user's law says by its work what it dissipates.
    sum.ga += p.area * (p.user == kNone ? p.energy * p.growth + p.by_rate : p.work - stored);
  }
  return sum;
}

CohesiveZone::CohesiveZone(const Model& model, CohesiveScheme scheme)
    : points_(std::make_unique<Points>(model, scheme)) {}

CohesiveZone::CohesiveZone(Index first_element) : points_(std::make_unique<Points>(first_element)) {}

CohesiveZone::~CohesiveZone() = default;

CohesiveZone::CohesiveZone(CohesiveZone&&) noexcept = default;

CohesiveZone& CohesiveZone::operator=(CohesiveZone&&) noexcept = default;

void CohesiveZone::insert(const Topology& topology, const Insertion& insertion, const OpenFacet& facet,
                          const NodeArrays& nodes, double time) {
  Points::Facet inserted;
  inserted.law = points_->law_of_part[points_->part_of_element[insertion.lower.element]];
  inserted.traction = facet.traction;
  inserted.insertion_time = time;
  if (inserted.law < 0) {
    throw Error(Status::bad_argument,
                "element " + numbered(insertion.lower.element) +
                    " belongs to a part without a cohesive law; its facets cannot open");
  }
  points_->insert(topology, insertion, inserted, nodes);
}

void CohesiveZone::insert_bond(const Topology& topology, const Insertion& insertion, const std::string& law,
                               const NodeArrays& nodes) {
  Points::Facet inserted;
  inserted.law = points_->law_number(law);
  inserted.bond = true;
  points_->insert(topology, insertion, inserted, nodes);
}

void CohesiveZone::add_law(const CohesiveLaw& law) {
  points_->add_law(law);
}

void CohesiveZone::follow(const Insertion& insertion) {
  points_->follow(insertion);
}

void CohesiveZone::insert(Index law, std::span<const Index> corners, Vec3 traction, const NodeArrays& nodes,
                          double time) {
  Points::Facet inserted;
  inserted.element = points_->bulk_count + count();
  inserted.law = law;
  inserted.traction = traction;
  inserted.insertion_time = time;
  points_->place(inserted, corners, nodes);
}

Index CohesiveZone::first_bad_node(const NodeArrays& nodes) const {
  for (const Index f : points_->live) {
    for (const Points::Point& p : points_->points_of(f)) {
      if (!p.exists()) continue;
      for (const Index n : {p.upper, p.lower}) {
        const double moves = dot(nodes.x(n), nodes.x(n)) + dot(nodes.v(n), nodes.v(n));
        if (!std::isfinite(moves) || !(nodes.mass[n] > 0)) return n;
      }
    }
  }
  return kNone;
}

Index CohesiveZone::corner_count(Index facet) const {
  return points_->facets[facet].corners;
}

CohesivePointState CohesiveZone::point(Index facet, Index corner) const {
  const Points::Point& p = points_->points[4 * static_cast<std::size_t>(facet) + corner];
  CohesivePointState state;
  state.upper = p.upper;
  state.lower = p.lower;
  state.area = p.area;
  state.strength = p.strength;
  state.reach = p.softening.reach;
  state.largest = p.largest;
  state.damage = p.softening.damage(p.largest);
  state.stored = p.stored_by_nodes() + p.pressed;
  state.dissipated = p.taken + p.work - p.stored_by_nodes();
  return state;
}

void CohesiveZone::add_force(const NodeArrays& nodes, double step, double time, const Threads& threads) {
  points_->add_force(nodes, step, time, threads);
}

std::span<const Index> CohesiveZone::broken_now() const {
  return points_->broken_elements;
}

Index CohesiveZone::count() const {
  return static_cast<Index>(points_->facets.size());
}

Index CohesiveZone::broken_count() const {
  return points_->broken_count;
}

CohesiveZone::Energy CohesiveZone::energy() const {
  Energy sum = points_->closed;
  sum.stored -= points_->ahead_of_closed + points_->ahead_of_couples;
  for (const Index f : points_->live) {
    const Energy e = points_->energy_of(f);
    sum.stored += e.stored;
    sum.dissipated += e.dissipated;
    sum.friction += e.friction;
    sum.ga += e.ga;
  }
  for (const UserCohesivePoints& user : points_->users) sum.slope_cost += user.slope_cost();
  return sum;
}

double CohesiveZone::stiffness_over_mass(const NodeArrays& nodes) const {
  // Gershgorin: the largest row sum of M^-1 K bounds omega^2 of the springs.
  std::vector<std::pair<Index, double>> sums;
  for (const Index f : points_->live) {
    const CohesiveLaw& law = points_->laws[points_->facets[f].law].given;
    if (law.kind != CohesiveKind::user) continue;
    for (const Points::Point& p : points_->points_of(f)) {
      if (!p.exists() || p.broken()) continue;
      for (const Index n : {p.upper, p.lower}) {
        if (nodes.mass[n] > 0) sums.emplace_back(n, 2 * law.stiffness * p.area / nodes.mass[n]);
      }
    }
  }
  std::sort(sums.begin(), sums.end());
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sum = (i > 0 && sums[i].first == sums[i - 1].first ? sum : 0) + sums[i].second;
    largest = std::max(largest, sum);
  }
  // At 2 / sqrt of this, `kUserStiffness` bounds no slope.
  return 2 / kUserStiffness * largest;
}

std::vector<CrackFacet> CohesiveZone::facets(const Topology& topology) const {
  std::vector<CrackFacet> out;
  out.reserve(points_->facets.size());
  for (Index f = 0; f < count(); ++f) {
    const Points::Facet& facet = points_->facets[f];
    CrackFacet crack;
    crack.corners = facet.corners;
    crack.part = facet.part;
    crack.layer = facet.layer;
    crack.insertion_time = facet.insertion_time;
    crack.broken_time = facet.broken_time;
    const std::span<const Index> nodes = topology.nodes(facet.element);
    std::copy_n(nodes.begin(), facet.corners, crack.upper.begin());
    std::copy_n(nodes.begin() + facet.corners, facet.corners, crack.lower.begin());
    double damage = 0;
    int existing = 0;
    for (const Points::Point& p : points_->points_of(f)) {
      if (!p.exists()) continue;
      ++existing;
      damage += p.softening.damage(p.largest);
    }
    crack.damage = facet.broken ? 1 : existing > 0 ? damage / existing : 0;
    if (!facet.bond || crack.damage > 0) out.push_back(crack);
  }
  return out;
}

CohesiveZone::Cost CohesiveZone::cost() const {
  Cost sum;
  for (const ClusterSolver& w : points_->work) {
    sum.clusters += w.solved;
    sum.evaluations += w.evaluations;
    sum.approached += w.approached;
    sum.softened += w.softened;
    sum.unsettled += w.fixed;
  }
  return sum;
}

void CohesiveZone::archive(Archive& a) {
  Points& p = *points_;
  a("cohesive.facets", p.facets);
  a("cohesive.points", p.points);
  a("cohesive.live", p.live);
  p.clusters.archive(a);
  for (UserCohesivePoints& user : p.users) user.archive(a);
  a("cohesive.couples", p.couples);
  a("cohesive.broken_elements", p.broken_elements);
  a("cohesive.broken_count", p.broken_count);
  a("cohesive.bulk_count", p.bulk_count);
  a("cohesive.closed", p.closed);
  a("cohesive.ahead_of_closed", p.ahead_of_closed);
  a("cohesive.ahead_of_couples", p.ahead_of_couples);
}

}  // namespace cdfp
