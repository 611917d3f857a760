#include "cohesive/cohesive_zone.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "cdfp/error.hpp"
#include "cohesive/cluster_solver.hpp"
#include "cohesive/clusters.hpp"
#include "cohesive/facet_frame.hpp"
#include "cohesive/law.hpp"
#include "cohesive/user_points.hpp"
#include "core/numbered.hpp"

namespace cdfp {

namespace {

/// A closed face, and one that has not opened yet, is a spring this much stiffer than the inertia that the
/// nodes show in a step. The mean traction takes any stiffness; the plain scheme only what it can follow.
constexpr double kStiffness = 300;
constexpr double kPlainStiffness = 0.5;
constexpr double kUserStiffness = 0.05;  ///< of a user's law, whose kinks must not feed energy in either
/// Opening over reach, at most, at which that spring carries the strength.
constexpr double kRigidOpening = 0.01;
/// A broken face that is pressed hands its load over to the contact between free faces: its spring gives way
/// by this share a step, slow enough for the load to move without a wave, until next to nothing is left.
constexpr double kGivesWay = 0.9;
constexpr int kHandOverSteps = 130;
/// The traction that holds new pairs together is found to this share of the strength.
constexpr double kCarried = 1e-10;
constexpr double kTieStiffness = 1e5;
constexpr double kClusterTolerance = 1e-9;  ///< of the reach
constexpr double kTieTolerance = 1e-10;     ///< of the reach; less is lost in rounding
constexpr int kCarriedRounds = 12;
/// Share of its turn in a step that a pressed face follows. Pressed pairs that have slid push past one
/// another: where their direction followed every wave along the face, they would feed it.
constexpr double kPressedTurn = 0.01;
/// A moment below this share of the facet's fracture energy waits until it has grown.
constexpr double kLeastCouple = 1e-9;
constexpr std::int64_t kGrain = 64;
constexpr std::size_t kWorthwhile = 512;  ///< facets for which threads are woken

struct Law {
  CohesiveLaw given;
  ModeWeights weights;
};

/// A node pair of a cohesive element.
struct Point {
  Index upper = kNone;
  Index lower = kNone;
  double area = 0;
  double strength = 0;  ///< Pa
  Softening softening;
  Vec3 carried;        ///< Pa, when the pair came to be
  Vec3 preload;        ///< m, opening at which the law is when the nodes have not moved
  double largest = 0;  ///< effective opening
  double contact = 0;  ///< Pa/m; 0 until the pair exists
  Vec3 slip;           ///< elastic slip of the friction spring
  double growth = 0;   ///< integral of m dD, m
  double work = 0;     ///< J/m2, done against the cohesive traction
  double stored = 0;   ///< J/m2, by the cohesive traction
  double pressed = 0;  ///< J/m2, stored in contact and the friction spring
  double heat = 0;     ///< J/m2, done against contact and friction, less `pressed`
  double taken = 0;    ///< J/m2, of `work`, less what was stored, until the facet broke
  double ahead = 0;    ///< J/m2, of the work above: from the step to the half step ahead of it
  double energy = 0;   ///< J/m2 that the law dissipates, over its growth in m
  double by_rate = 0;  ///< J/m2, dissipated by the part of the traction that the rate adds
  Vec3 couple;         ///< N m, of the cohesive forces on the pair at the last step
  double lent = 0;     ///< J/m2, of the spring's load at insertion, which no work had put in
  Index user = kNone;  ///< place among its user's law's points

  bool exists() const { return upper != lower; }
  /// What the nodes put in: the load at insertion is paid back as the point softens.
  double stored_by_nodes() const { return stored - (lent - (0.5 * softening.scale - energy) * growth); }
  bool broken() const { return largest >= softening.reach; }
};

/// Of the moment of a pair's tractions. What contact overlaps is no arm.
Vec3 arm_of(Vec3 opening, Vec3 normal) {
  return opening - std::min(0.0, dot(opening, normal)) * normal;
}

struct Facet {
  Index element = kNone;
  Index part = 0;
  Index layer = 0;
  std::int32_t corners = 4;
  std::int32_t law = 0;
  Vec3 normal;    ///< from lower to upper
  Vec3 traction;  ///< at insertion
  bool bond = false;
  bool live = false;
  bool broken = false;
  Vec3 couple;        ///< N m, of the law at the openings of the step
  int hand_over = 0;  ///< steps for which a broken face still holds what presses it
  double insertion_time = 0;
  double broken_time = std::numeric_limits<double>::infinity();
};

}  // namespace

struct CohesiveZone::Points {
  Points(const Model& model, CohesiveScheme chosen);
  explicit Points(Index first_element) : scheme(CohesiveScheme::mean_traction), bulk_count(first_element) {}

  void add_law(const CohesiveLaw& law);
  void insert(const Topology& topology, const Insertion& insertion, Facet facet, const NodeArrays& nodes);
  void place(Facet facet, std::span<const Index> corners, const NodeArrays& nodes);
  std::int32_t law_number(const std::string& name) const;
  void follow(const Insertion& insertion);
  void give_law(Point& point, const Facet& facet);
  void revive(Index facet);
  void add_force(const NodeArrays& nodes, double step, double time, const Threads& threads);
  void turn(Index facet, const NodeArrays& nodes);
  void ask_users(const NodeArrays& nodes, double step, double time);
  FacetFrame frame_of(Index facet, const NodeArrays& nodes);
  void balance_couples(const NodeArrays& nodes);
  void book_couples(const NodeArrays& nodes, double step);
  Vec3 couple_now(Index facet, const NodeArrays& nodes) const;
  void find_couples();
  double yields(const Point& point, const NodeArrays& nodes, double step) const;
  void carry(const Clusters::Cluster& cluster, const NodeArrays& nodes, double step, ClusterSolver& work);
  void load_tie(Point& point, const NodeArrays& nodes, double step, ClusterSolver::Point& p) const;
  void start(Point& point, const Facet& facet, const NodeArrays& nodes, double step);
  void solve_cluster(const Clusters::Cluster& cluster, const NodeArrays& nodes, double step,
                     ClusterSolver& work);
  void load_cluster(const Clusters::Cluster& cluster, const NodeArrays& nodes, double step,
                    ClusterSolver& work) const;
  void load_point(const Clusters::Slot& slot, double step, ClusterSolver& work,
                  ClusterSolver::Point& p) const;
  void solve_plain(const Clusters::Cluster& cluster, double step, ClusterSolver& work) const;
  void store_cluster(const Clusters::Cluster& cluster, const NodeArrays& nodes, double step,
                     ClusterSolver& work);
  double opened_to(const Point& point, const Increment& i, const Split& at, std::int32_t law) const;
  double stored_in(const Point& point, const Increment& i, const Split& at, std::int32_t law) const;
  void mark_broken(double time);
  bool is_pressed(Index facet) const;
  void dismiss();
  Energy energy_of(Index facet) const;

  std::span<const Point> points_of(Index facet) const {
    return {&points[4 * static_cast<std::size_t>(facet)], static_cast<std::size_t>(facets[facet].corners)};
  }
  CohesiveScheme scheme;
  std::vector<Index> part_of_element;
  std::vector<Index> layer_of_element;
  std::vector<std::int32_t> law_of_part;
  std::vector<Law> laws;
  std::vector<UserPoints> users;  ///< one a law

  std::vector<Facet> facets;
  std::vector<Point> points;  ///< four a facet
  std::vector<Index> live;    ///< facets with a point that exists and is not lost
  Clusters clusters;
  std::vector<ClusterSolver> work;  ///< one a thread
  std::vector<Index> broke;
  struct Couple {
    Index facet;
    Vec3 held;  ///< N m, by the facet's frame in this step
    Vec3 left;  ///< N m, of the cohesive forces in the last step, that the law at its openings missed
  };
  std::vector<Couple> couples;
  std::array<NodePair, 4> pairs;
  std::vector<Index> broken_elements;
  Index broken_count = 0;
  Index bulk_count = 0;
  Energy closed;               ///< of facets that left `live`
  double ahead_of_closed = 0;  ///< J, as `Point::ahead`, of those that left in the last step
  double ahead_of_couples = 0;
};

CohesiveZone::Points::Points(const Model& model, CohesiveScheme chosen)
    : scheme(chosen), part_of_element(model.mesh.parts), layer_of_element(model.mesh.layers) {
  for (const CohesiveLaw& law : model.cohesive_laws) add_law(law);
  law_of_part.assign(model.mesh.part_names.size(), -1);
  for (const Part& part : model.parts) {
    if (part.cohesive_law.empty()) continue;
    const auto name = std::find(model.mesh.part_names.begin(), model.mesh.part_names.end(), part.name);
    if (name == model.mesh.part_names.end()) {
      throw Error(Status::bad_argument, "the mesh has no part '" + part.name + "'");
    }
    law_of_part[name - model.mesh.part_names.begin()] = law_number(part.cohesive_law);
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

void CohesiveZone::Points::insert(const Topology& topology, const Insertion& insertion, Facet facet,
                                  const NodeArrays& nodes) {
  bulk_count = topology.bulk_count();
  follow(insertion);
  facet.element = insertion.cohesive_element;
  facet.part = part_of_element[insertion.lower.element];
  facet.layer = layer_of_element.empty() ? 0 : layer_of_element[insertion.lower.element];
  place(facet, topology.nodes(insertion.cohesive_element), nodes);
}

/// `corners`: of the upper face, then of the lower face in its element's outward order.
void CohesiveZone::Points::place(Facet facet, std::span<const Index> corners, const NodeArrays& nodes) {
  const auto f = static_cast<Index>(facets.size());
  facet.corners = static_cast<std::int32_t>(corners.size() / 2);
  const Index n = facet.corners;
  std::array<Vec3, 4> middle;
  for (Index c = 0; c < n; ++c) middle[c] = 0.5 * (nodes.x(corners[c]) + nodes.x(corners[c + n]));
  facets.push_back(facet);

  for (Index c = 0; c < 4; ++c) {
    Point point;
    if (c < n) {
      point.upper = corners[c];
      point.lower = corners[c + n];
      const Vec3 next = middle[(c + 1) % n] - middle[c];
      const Vec3 previous = middle[(c + n - 1) % n] - middle[c];
      point.area = norm(cross(next, previous)) / (n == 4 ? 4 : 6);
    }
    points.push_back(point);
  }
  turn(f, nodes);
  for (Index c = 0; c < n; ++c) {
    Point& point = points[4 * static_cast<std::size_t>(f) + c];
    give_law(point, facets[f]);
    clusters.add(4 * f + c, point.upper);
    if (point.exists()) revive(f);
  }
}

/// An extrinsic law softens from the facet's traction down. An intrinsic one rises to its strength first.
void CohesiveZone::Points::give_law(Point& point, const Facet& facet) {
  const CohesiveLaw& law = laws[facet.law].given;
  if (law.kind == CohesiveKind::bilinear) {
    point.strength = law.strength;
    const double reach = 2 * law.fracture_energy / law.strength;
    const double start = law.strength / law.stiffness;
    point.softening = {law.strength * reach / (reach - start), reach, start};
    point.largest = start;
    point.energy = 0.5 * point.softening.scale;
    return;
  }
  point.carried = facet.traction;
  point.strength = effective_traction(facet.traction, facet.normal, law.shear_ratio);
  if (!(point.strength > 0)) point.strength = law.strength;
  point.softening = {point.strength, 2 * law.fracture_energy / point.strength};
  point.energy = 0.5 * point.strength;
  if (law.kind == CohesiveKind::user) {
    point.softening.scale = point.energy = 0;
    const Split carried(facet.traction, facet.normal);
    point.user = users[facet.law].add(carried.t + std::max(carried.n, 0.0) * facet.normal);
  }
}

/// New nodes, and corners of older cohesive elements that name them now.
void CohesiveZone::Points::follow(const Insertion& insertion) {
  for (const auto& [node, mother] : insertion.new_nodes) clusters.copy(node, mother);
  for (const Insertion::Renumbered& r : insertion.renumbered) {
    const Index f = r.element - bulk_count;
    if (f < 0 || f >= static_cast<Index>(facets.size())) continue;
    const Index n = facets[f].corners;
    Point& point = points[4 * static_cast<std::size_t>(f) + r.corner % n];
    (r.corner < n ? point.upper : point.lower) = r.new_node;
    clusters.touch(r.new_node);
    if (point.exists()) revive(f);
  }
}

void CohesiveZone::Points::revive(Index facet) {
  if (facets[facet].live) return;
  facets[facet].live = true;
  live.push_back(facet);
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

  awake.for_ranges(static_cast<std::int64_t>(live.size()), kGrain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) turn(live[k], nodes);
  });
  ask_users(nodes, step, time);
  balance_couples(nodes);
  const std::span<const Clusters::Cluster> all = clusters.all();
  awake.for_ranges(static_cast<std::int64_t>(all.size()), kGrain, [&](std::int64_t begin, std::int64_t end) {
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

/// Users' laws say their tractions at the openings of the step, in one call each.
void CohesiveZone::Points::ask_users(const NodeArrays& nodes, double step, double time) {
  std::vector<UserPoints::Question> questions;
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

CohesiveZone::Energy CohesiveZone::Points::energy_of(Index facet) const {
  Energy sum;
  for (const Point& p : points_of(facet)) {
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
  Facet inserted;
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
  Facet inserted;
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
  Facet inserted;
  inserted.element = points_->bulk_count + count();
  inserted.law = law;
  inserted.traction = traction;
  inserted.insertion_time = time;
  points_->place(inserted, corners, nodes);
}

Index CohesiveZone::first_bad_node(const NodeArrays& nodes) const {
  for (const Index f : points_->live) {
    for (const Point& p : points_->points_of(f)) {
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
  const Point& p = points_->points[4 * static_cast<std::size_t>(facet) + corner];
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
  for (const UserPoints& user : points_->users) sum.slope_cost += user.slope_cost();
  return sum;
}

double CohesiveZone::stiffness_over_mass(const NodeArrays& nodes) const {
  // Gershgorin: the largest row sum of M^-1 K bounds omega^2 of the springs.
  std::vector<std::pair<Index, double>> sums;
  for (const Index f : points_->live) {
    const CohesiveLaw& law = points_->laws[points_->facets[f].law].given;
    if (law.kind != CohesiveKind::user) continue;
    for (const Point& p : points_->points_of(f)) {
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
    const Facet& facet = points_->facets[f];
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
    for (const Point& p : points_->points_of(f)) {
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
  for (UserPoints& user : p.users) user.archive(a);
  a("cohesive.couples", p.couples);
  a("cohesive.broken_elements", p.broken_elements);
  a("cohesive.broken_count", p.broken_count);
  a("cohesive.bulk_count", p.bulk_count);
  a("cohesive.closed", p.closed);
  a("cohesive.ahead_of_closed", p.ahead_of_closed);
  a("cohesive.ahead_of_couples", p.ahead_of_couples);
}

}  // namespace cdfp
