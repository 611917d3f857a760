#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "cdfp/cohesive.hpp"
#include "cohesive/check_law.hpp"
#include "cohesive/cohesive_zone.hpp"
#include "core/numbered.hpp"
#include "core/require.hpp"

namespace cdfp {

struct CohesiveElements::Kept {
  explicit Kept(Index first) : first_element(first), zone(first) {}

  Index first_element;
  CohesiveZone zone;
  std::vector<CohesiveLaw> laws;
  std::vector<std::uint8_t> fixed;  ///< of the nodes that were named; of all others 0
  Index nodes = 0;                  ///< more than the largest that an element names
  Insertion changes;

  Index place(Index element) const {
    const Index place = element - first_element;
    require(place >= 0 && place < zone.count(),
            "there is no cohesive element " + numbered(element) + "; they have the numbers from " +
                numbered(first_element) + " to " + numbered(first_element + zone.count() - 1));
    return place;
  }

  void need_nodes(std::size_t n) const {
    require(n >= static_cast<std::size_t>(nodes), "the arrays are of " + std::to_string(n) +
                                                      " nodes, but cohesive elements name node " +
                                                      numbered(nodes - 1) + "; give arrays of all nodes");
  }

  NodeArrays view(const Arrays& arrays) {
    const std::size_t n = arrays.mass.size();
    const auto check = [n](std::size_t size, const char* name) {
      require(size == 3 * n, std::string("'") + name + "' has " + std::to_string(size) +
                                 " numbers; give three for each of the " + std::to_string(n) +
                                 " nodes that 'mass' has");
    };
    check(arrays.position.size(), "position");
    check(arrays.velocity.size(), "velocity");
    need_nodes(n);
    if (fixed.size() < n) fixed.resize(n, 0);
    NodeArrays view;
    view.position = arrays.position;
    view.velocity = arrays.velocity;
    view.mass = arrays.mass;
    view.force = arrays.force;
    view.fixed = fixed;
    return view;
  }
};

CohesiveElements::CohesiveElements(Index first_element) {
  require(first_element >= 0, "the first cohesive element has the number " + numbered(first_element) +
                                  "; give the count of bulk elements, or 0");
  kept_ = std::make_unique<Kept>(first_element);
}
CohesiveElements::~CohesiveElements() = default;
CohesiveElements::CohesiveElements(CohesiveElements&&) noexcept = default;
CohesiveElements& CohesiveElements::operator=(CohesiveElements&&) noexcept = default;

Index CohesiveElements::add_law(const CohesiveLaw& law) {
  check_law(law);
  kept_->zone.add_law(law);
  kept_->laws.push_back(law);
  return law_count() - 1;
}

Index CohesiveElements::law_count() const {
  return static_cast<Index>(kept_->laws.size());
}

void CohesiveElements::hold(std::span<const Index> nodes, std::array<bool, 3> directions) {
  for (const Index n : nodes) {
    require(n >= 0, "node " + numbered(n) + " is to be held; nodes count from " + numbered(0));
  }
  if (nodes.empty()) return;
  const auto count = static_cast<std::size_t>(*std::max_element(nodes.begin(), nodes.end())) + 1;
  if (kept_->fixed.size() < count) kept_->fixed.resize(count, 0);
  const int bits = int{directions[0]} | 2 * int{directions[1]} | 4 * int{directions[2]};
  for (const Index n : nodes) kept_->fixed[n] = static_cast<std::uint8_t>(bits);
}

void CohesiveElements::follow(const Insertion& insertion) {
  follow(insertion.new_nodes, insertion.renumbered);
}

void CohesiveElements::follow(std::span<const Insertion::NewNode> new_nodes,
                              std::span<const Insertion::Renumbered> renumbered) {
  Kept& k = *kept_;
  for (const Insertion::NewNode& n : new_nodes) {
    require(n.node >= 0 && n.mother >= 0 && n.node != n.mother,
            "'new_nodes' says that node " + numbered(n.node) + " is a copy of node " + numbered(n.mother) +
                "; give rows of new node and mother");
  }
  Insertion& changes = k.changes;
  changes.renumbered.clear();
  for (const Insertion::Renumbered& r : renumbered) {
    if (r.element < k.first_element) continue;
    const Index place = k.place(r.element);
    require(r.corner >= 0 && r.corner < 2 * k.zone.corner_count(place) && r.new_node >= 0,
            "'renumbered' names corner " + numbered(r.corner) + " of cohesive element " +
                numbered(r.element) + ", which has " + std::to_string(2 * k.zone.corner_count(place)) +
                ", and node " + numbered(r.new_node));
    changes.renumbered.push_back(r);
    k.nodes = std::max(k.nodes, r.new_node + 1);
  }
  changes.new_nodes.assign(new_nodes.begin(), new_nodes.end());
  for (const Insertion::NewNode& n : new_nodes) {
    const std::uint8_t held =
        static_cast<std::size_t>(n.mother) < k.fixed.size() ? k.fixed[n.mother] : std::uint8_t{0};
    if (held == 0 && static_cast<std::size_t>(n.node) >= k.fixed.size()) continue;
    if (k.fixed.size() <= static_cast<std::size_t>(n.node)) k.fixed.resize(n.node + 1, 0);
    k.fixed[n.node] = held;
  }
  k.zone.follow(changes);
}

void CohesiveElements::insert(Index element, Index law, std::span<const Index> corners,
                              std::array<double, 3> traction, std::span<const double> position, double time) {
  Kept& k = *kept_;
  const std::string where = "cohesive element " + numbered(element);
  require(element == k.first_element + k.zone.count(), where + " is not the next one, which is " +
                                                           std::to_string(k.first_element + k.zone.count()) +
                                                           "; insert them in the order of their numbers");
  require(law >= 0 && law < law_count(), where + " has the law " + numbered(law) + "; there are " +
                                             std::to_string(law_count()) + ", counted from " + numbered(0));
  require(corners.size() == 6 || corners.size() == 8,
          where + " has " + std::to_string(corners.size()) + " corners; give 6 or 8, the upper face first");
  NodeArrays nodes;
  nodes.position = position;
  const auto n = static_cast<Index>(position.size() / 3);
  for (const Index corner : corners) {
    require(corner >= 0 && corner < n, where + " names node " + numbered(corner) + "; the arrays have " +
                                           std::to_string(n) + ", counted from " + numbered(0));
    require(std::isfinite(dot(nodes.x(corner), nodes.x(corner))),
            where + ": the position of node " + numbered(corner) + " is not finite");
  }
  const std::size_t half = corners.size() / 2;
  const auto middle = [&](std::size_t c) { return nodes.x(corners[c]) + nodes.x(corners[c + half]); };
  const Vec3 area = half == 4 ? cross(middle(2) - middle(0), middle(3) - middle(1))
                              : cross(middle(1) - middle(0), middle(2) - middle(0));
  require(norm(area) > 0, where + " has no area; its corners lie on a line");
  const Vec3 carried = Vec3::load(traction.data());
  require(std::isfinite(norm(carried)), where + ": the traction is not finite");
  const CohesiveKind kind = k.laws[law].kind;
  require(norm(carried) > 0 || kind == CohesiveKind::bilinear || kind == CohesiveKind::user,
          where + " carries nothing, but its law starts at the traction of the facet; give that traction");
  k.zone.insert(law, corners, carried, nodes, time);
  k.nodes = std::max(k.nodes, *std::max_element(corners.begin(), corners.end()) + 1);
}

void CohesiveElements::add_force(const Arrays& arrays, double step, double time, int threads) {
  Kept& k = *kept_;
  const NodeArrays nodes = k.view(arrays);
  require(nodes.force.size() == nodes.position.size(), "'force' has " + std::to_string(nodes.force.size()) +
                                                           " numbers; give three for each of the " +
                                                           std::to_string(nodes.mass.size()) + " nodes");
  require_positive(step, "the step");
  const Index bad = k.zone.first_bad_node(nodes);
  if (bad != kNone) {
    const bool massless = !(nodes.mass[bad] > 0);
    refuse("node " + numbered(bad) + " of a cohesive element has " +
           (massless ? "no positive mass; divide the masses of nodes that were split between them"
                     : "a position or velocity that is not finite; the state is lost: take a smaller step"));
  }
  k.zone.add_force(nodes, step, time, Threads(threads));
}

Index CohesiveElements::count() const {
  return kept_->zone.count();
}
Index CohesiveElements::broken_count() const {
  return kept_->zone.broken_count();
}
std::span<const Index> CohesiveElements::broken_now() const {
  return kept_->zone.broken_now();
}

Index CohesiveElements::corner_count(Index element) const {
  return kept_->zone.corner_count(kept_->place(element));
}

CohesivePointState CohesiveElements::point(Index element, Index corner) const {
  const Index corners = corner_count(element);
  require(corner >= 0 && corner < corners, "cohesive element " + numbered(element) + " has no pair " +
                                               numbered(corner) + "; it has " + std::to_string(corners) +
                                               ", counted from " + numbered(0));
  return kept_->zone.point(kept_->place(element), corner);
}

CohesiveElements::Energy CohesiveElements::energy() const {
  const CohesiveZone::Energy energy = kept_->zone.energy();
  return {energy.stored, energy.dissipated, energy.friction, energy.ga};
}

double CohesiveElements::stiffness_over_mass(std::span<const double> mass) const {
  kept_->need_nodes(mass.size());
  NodeArrays nodes;
  nodes.mass = mass;
  return kept_->zone.stiffness_over_mass(nodes);
}

}  // namespace cdfp
