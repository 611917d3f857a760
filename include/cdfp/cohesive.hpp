/// The cohesive law at points whose arrays are the caller's: extrinsic, irreversible, path-dependent (Snozzi
/// and Molinari 2013; Chen, Zang, Xu 2015, eqs. 8-10).
///
/// A point starts with the traction that the face carried. Its strength is the effective traction at that
/// time and its reach follows from the fracture energy, so that opening dissipates G_I, sliding kappa G_I,
/// and a mixed path what lies along it.
#pragma once

#include <array>
#include <span>

#include "cdfp/model.hpp"

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
/// other lengths, a law without strength or energy, and a traction that neither pulls nor shears.
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

}  // namespace cdfp
