/// What the cohesive zone keeps, and the parts of its step.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cohesive/cluster_solver.hpp"
#include "cohesive/clusters.hpp"
#include "cohesive/cohesive_zone.hpp"
#include "cohesive/facet_frame.hpp"
#include "cohesive/law.hpp"
#include "cohesive/user_points.hpp"

namespace cdfp {

/// 4 / step^2 over the stiffness of a user's law at most: its kinks must not feed energy in.
inline constexpr double kUserStiffness = 0.05;

/// Of the moment of a pair's tractions. What contact overlaps is no arm.
inline Vec3 arm_of(Vec3 opening, Vec3 normal) {
  return opening - std::min(0.0, dot(opening, normal)) * normal;
}

struct CohesiveZone::Points {
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

  Points(const Model& model, CohesiveScheme chosen);
  explicit Points(Index first_element) : scheme(CohesiveScheme::mean_traction), bulk_count(first_element) {}

  void add_law(const CohesiveLaw& law);
  std::int32_t law_number(const std::string& name) const;
  Energy energy_of(Index facet) const;

  // zone_insertion.cpp: new elements, and nodes that elements exchange
  void insert(const Topology& topology, const Insertion& insertion, Facet facet, const NodeArrays& nodes);
  void place(Facet facet, std::span<const Index> corners, const NodeArrays& nodes);
  void give_law(Point& point, const Facet& facet);
  void follow(const Insertion& insertion);
  void revive(Index facet);

  // zone_start.cpp: what a new pair carries
  double yields(const Point& point, const NodeArrays& nodes, double step) const;
  void load_tie(Point& point, const NodeArrays& nodes, double step, ClusterSolver::Point& p) const;
  void carry(const Clusters::Cluster& cluster, const NodeArrays& nodes, double step, ClusterSolver& work);
  void start(Point& point, const Facet& facet, const NodeArrays& nodes, double step);

  // zone_step.cpp: the step
  void add_force(const NodeArrays& nodes, double step, double time, const Threads& threads);
  void turn(Index facet, const NodeArrays& nodes);
  void ask_users(const NodeArrays& nodes, double step, double time);

  // zone_clusters.cpp: tractions of the points that must be solved together
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

  // zone_couples.cpp: moments that opened facets hold
  FacetFrame frame_of(Index facet, const NodeArrays& nodes);
  Vec3 couple_now(Index facet, const NodeArrays& nodes) const;
  void balance_couples(const NodeArrays& nodes);
  void book_couples(const NodeArrays& nodes, double step);
  void find_couples();

  // zone_breaking.cpp: facets that leave
  void mark_broken(double time);
  bool is_pressed(Index facet) const;
  void dismiss();

  std::span<const Point> points_of(Index facet) const {
    return {&points[4 * static_cast<std::size_t>(facet)], static_cast<std::size_t>(facets[facet].corners)};
  }

  CohesiveScheme scheme;
  std::span<const Index> part_of_element;
  std::span<const Index> layer_of_element;
  std::vector<std::int32_t> law_of_part;
  std::vector<Law> laws;
  std::vector<UserCohesivePoints> users;  ///< one a law

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

}  // namespace cdfp
