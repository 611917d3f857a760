/// Cohesive fracture as services on a caller's arrays: which facets open, the forces of cohesive elements
/// between the caller's nodes, and the law at single points.
///
/// The law is extrinsic, irreversible and path-dependent (Snozzi and Molinari 2013; Chen, Zang, Xu 2015, eqs.
/// 8-10), unless another kind is asked for. A point starts with the traction that the face carried. Its
/// strength is the effective traction at that time and its reach follows from the fracture energy, so that
/// opening dissipates G_I, sliding kappa G_I, and a mixed path what lies along it.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"

namespace cdfp {

/// State of one point; `start_cohesive` fills it in.
struct CohesivePoint {
  double strength = 0;                         ///< Pa, effective traction at insertion
  double reach = 0;                            ///< m, effective opening at which no traction is left
  double largest = 0;                          ///< m, largest effective opening so far
  double dissipated = 0;                       ///< J/m2
  std::array<double, 3> opening{};             ///< m, at the last call: upper side minus lower side
  std::array<double, 3> insertion_traction{};  ///< Pa, carried until the point opens

  bool broken() const { return largest >= reach; }
};

/// Effective traction Te = sqrt(<Tn>^2 + (|Tt|/eta)^2) of a traction on a face with unit normal `normal`.
double effective_traction(const CohesiveLaw& law, std::span<const double, 3> traction,
                          std::span<const double, 3> normal);

/// Points that carry `traction` (n, 3), Pa, on faces with unit normals `normal` (n, 3), that the upper side
/// exerts on the lower one; the normal points from lower to upper. Throws `Error(bad_argument)` for arrays of
/// other lengths, a law without strength or energy or with a rate, which only `CohesiveElements` knows, and a
/// traction that neither pulls nor shears.
void start_cohesive(const CohesiveLaw& law, std::span<const double> traction, std::span<const double> normal,
                    std::span<CohesivePoint> points);

/// Traction (n, 3) at `opening` (n, 3), m. The state goes along the straight segment from the last opening. A
/// closed face (negative normal opening) has no normal traction: contact is the caller's.
void cohesive_traction(const CohesiveLaw& law, std::span<const double> opening,
                       std::span<const double> normal, std::span<CohesivePoint> points,
                       std::span<double> traction);

/// Mean traction over the increment from the last opening to `opening`: times the increment it is exactly the
/// change of stored energy and a dissipation that is never negative. With leapfrog, call it with the openings
/// at the half steps and solve for the one ahead, with copies of the points until the solution stands.
void cohesive_mean_traction(const CohesiveLaw& law, std::span<const double> opening,
                            std::span<const double> normal, std::span<CohesivePoint> points,
                            std::span<double> traction);

/// J/m2 that the point gives back when it closes.
double cohesive_stored(const CohesiveLaw& law, const CohesivePoint& point, std::span<const double, 3> normal);

/// Which facets reach their strength under the caller's element stresses: those between two elements of one
/// part that has a law.
class CohesiveCriterion {
 public:
  struct Settings {
    std::vector<CohesiveLaw> laws;
    std::vector<Index> law_of_part;  ///< place in `laws`, kNone: the part does not crack
    std::vector<Index> parts;        ///< part of each bulk element, a place in `law_of_part`
    StressRecovery recovery = StressRecovery::element_mean;
    std::vector<double> strength_shares;  ///< one a bulk element, or empty: see `Model::strength_shares`
  };
  /// `coordinates` (n, 3): of the undeformed mesh, for the areas that scattered strengths need. Throws
  /// `Error(bad_argument)` naming the law, part or size that is wrong.
  CohesiveCriterion(const Topology& topology, std::span<const double> coordinates, const Settings& settings);
  ~CohesiveCriterion();
  CohesiveCriterion(CohesiveCriterion&&) noexcept;
  CohesiveCriterion& operator=(CohesiveCriterion&&) noexcept;

  struct Opening {
    FacetUse lower;                    ///< use by the bulk element with the smaller number
    Index law = kNone;                 ///< of its part
    std::array<double, 3> traction{};  ///< Pa, that the upper side exerts on the lower one
  };
  /// In ascending order of `lower`. `position` (n, 3); `stress` (bulk elements, 6): Cauchy stress, Pa, in the
  /// order xx yy zz xy yz zx. Throws `Error(bad_argument)` for arrays of other lengths and a stress that is
  /// not finite.
  void find(const Topology& topology, std::span<const double> position, std::span<const double> stress,
            std::vector<Opening>& open, int threads = 1);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// A node pair of a cohesive element after the last `add_force`.
struct CohesivePointState {
  Index upper = kNone;    ///< node
  Index lower = kNone;    ///< node; the same as `upper` while the two sides hold together there
  double area = 0;        ///< m2 that the pair stands for
  double strength = 0;    ///< Pa, effective traction at insertion
  double reach = 0;       ///< m, effective opening at which no traction is left
  double largest = 0;     ///< m, largest effective opening so far
  double damage = 0;      ///< 0 to 1
  double stored = 0;      ///< J/m2 that closing, or letting go of the closed faces, gives back
  double dissipated = 0;  ///< J/m2 that the cohesive traction took out of the motion
};

/// Cohesive elements between the caller's nodes, for a driver of its own by central differences. Tractions
/// are those of the full simulation: the mean of the law over the increment between the half steps, solved
/// for at the node pairs that share nodes, so that an element dissipates what its law says.
///
/// In a step: move the nodes, compute all other forces, open facets (`follow` and `insert` after each
/// insertion in the topology), `add_force`, and only then change the velocities by step * force / mass.
class CohesiveElements {
 public:
  /// Arrays over all nodes of the mesh, which may move and grow between calls.
  struct Arrays {
    std::span<const double> position;  ///< (n, 3), m
    std::span<const double> velocity;  ///< (n, 3), m/s, at the half step that led to `position`
    std::span<const double> mass;      ///< (n), kg
    std::span<double> force;           ///< (n, 3), N: all others of the step; only `add_force` needs it
  };

  /// Elements are named by consecutive numbers from `first_element` on: the count of bulk elements for those
  /// of a `Topology`, 0 for those of a caller that numbers them by itself.
  explicit CohesiveElements(Index first_element = 0);
  ~CohesiveElements();
  CohesiveElements(CohesiveElements&&) noexcept;
  CohesiveElements& operator=(CohesiveElements&&) noexcept;

  /// Its number.
  Index add_law(const CohesiveLaw& law);
  Index law_count() const;

  /// These nodes do not follow forces in the directions that are true: they are prescribed, or a rigid body
  /// carries them. Copies made by `follow` inherit it; said again, it replaces.
  void hold(std::span<const Index> nodes, std::array<bool, 3> directions);

  /// After every insertion in the topology, before `insert`: the copies of nodes, and the corners of cohesive
  /// elements that now name them. Rows for bulk elements are skipped.
  void follow(const Insertion& insertion);
  void follow(std::span<const Insertion::NewNode> new_nodes,
              std::span<const Insertion::Renumbered> renumbered);

  /// The next element. `corners`: of the upper face, then of the lower face, node i above node i + 4 (or 3);
  /// by the lower ones the right-hand normal points from lower to upper, as TopS has it. `traction`: Pa, what
  /// the upper side exerts on the lower one at that time; zero for a bilinear law or a bond by a user's.
  /// Throws `Error(bad_argument)` naming what is wrong; nothing is changed then.
  void insert(Index element, Index law, std::span<const Index> corners, std::array<double, 3> traction,
              std::span<const double> position, double time);

  /// Adds the forces at the node pairs, closed faces' contact and friction among them, to `arrays.force`, and
  /// advances the state. The same bits for any number of threads.
  void add_force(const Arrays& arrays, double step, double time, int threads = 1);

  Index count() const;
  Index broken_count() const;
  /// Elements that lost their last pair in the last `add_force`, ascending: their faces are free.
  std::span<const Index> broken_now() const;
  /// 3 or 4; throws for an element that does not exist.
  Index corner_count(Index element) const;
  CohesivePointState point(Index element, Index corner) const;

  /// J, at the last `add_force`.
  struct Energy {
    double stored = 0;
    double dissipated = 0;  ///< by the cohesive tractions
    double friction = 0;    ///< heat between closed faces
    double by_law = 0;      ///< what the laws say for the same openings
  };
  Energy energy() const;
  /// 1/s2: omega^2 that users' laws add to the elements' for the stable step; the built-in ones add none.
  double stiffness_over_mass(std::span<const double> mass) const;

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace cdfp
