/// The half-step velocities ahead of nodes that cohesive points tie together.
#pragma once

#include <cstdint>
#include <vector>

#include "cohesive/increment.hpp"

namespace cdfp {

/// Solves, for the nodes a of one cluster with the velocities v at the half step ahead,
///   v_a = free_a - step/m_a sum over points of (+ upper, - lower) area * traction,
/// where a point's traction is its mean over the increment between the half steps and depends on the opening
/// ahead, `now + step/2 (v_upper - v_lower)`. Unknown are the velocities against the first node. Newton's
/// method; where it does not settle, the stiffnesses are fixed and one linear solution, bounded as well, is
/// taken.
class ClusterSolver {
 public:
  struct Node {
    Vec3 behind;    ///< m/s
    Vec3 free;      ///< m/s, ahead without the points' forces
    Vec3 per_mass;  ///< s/kg, step over mass; 0 in directions that do not follow forces
    Vec3 ahead;     ///< out: m/s
    Vec3 load;      ///< out: N, minus the force of the points on the node
  };
  struct Point {
    Increment increment;
    Reaction reaction;  ///< out
    Vec3 now;           ///< m, opening at the step
    std::int32_t upper = 0;
    std::int32_t lower = 0;
  };

  std::vector<Node> nodes;
  std::vector<Point> points;

  /// Solves for what `nodes` and `points` hold, to a share of the points' reach.
  void solve(double step, double tolerance);

  std::int64_t solved = 0;          ///< clusters, counted by the caller
  std::int64_t evaluations = 0;     ///< of all points of a cluster, so far
  std::int64_t approached = 0;      ///< clusters that took more than Newton's method
  std::int64_t softened = 0;        ///< clusters whose springs were made softer for good
  std::int64_t fixed = 0;           ///< clusters that Newton's method left
  std::vector<std::int32_t> broke;  ///< for the caller

 private:
  bool iterate(double tolerance);
  bool flow(double tolerance);
  bool approach(double tolerance);
  template <bool Sloped>
  double evaluate();
  void correct(double drag = 0);
  void start();
  Vec3 opening(const Point& p) const;

  double half_ = 0;
  std::vector<Vec3> relative_;  ///< velocity against the first node
  std::vector<Vec3> before_;
  std::vector<Increment> stiff_;
  std::vector<Vec3> residual_;
  std::vector<double> stiffness_;
  std::vector<double> matrix_;
};

}  // namespace cdfp
