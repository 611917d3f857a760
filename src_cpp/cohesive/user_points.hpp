/// The points of one user's law: what it keeps, what it is asked and what it answers.
#pragma once

#include <cstddef>
#include <vector>

#include "cdfp/model.hpp"
#include "core/archive.hpp"
#include "core/vec3.hpp"

namespace cdfp {

class UserCohesivePoints {
 public:
  explicit UserCohesivePoints(int states) : states_(static_cast<std::size_t>(states)) {}

  /// A point that carries this at no opening; returns its place.
  Index add(Vec3 insertion_traction);

  /// The point carries this at no opening after all.
  void carry(Index place, Vec3 insertion_traction) { points_[place].insertion_traction = insertion_traction; }

  struct Question {
    Index place;
    Vec3 opening;  ///< m, at the step
    Vec3 normal;
    double stiffest;  ///< Pa/m that the step can follow
    double area;      ///< m2
  };
  /// Asks the law once for all these points.
  void ask(const CohesiveLaw& law, double time, double step, const std::vector<Question>& questions);

  /// The last answers. Once the point has opened the traction is at most `stiffest` times the opening.
  Vec3 traction(Index place) const { return points_[place].traction; }
  double stored(Index place) const { return points_[place].stored; }
  double damage(Index place) const { return points_[place].damage; }

  void archive(Archive& a) {
    a("cohesive_law.points", points_);
    a("cohesive_law.state", state_);
    a("cohesive_law.slope_cost", slope_cost_);
  }

  double slope_cost() const { return slope_cost_; }  ///< J, |work| by which tractions were bounded

 private:
  struct Point {
    Vec3 insertion_traction, opening, traction;
    double stored = 0;
    double damage = 0;
    bool opened = false;  ///< so far that the step could follow a spring from there
  };
  void take(Point& point, const Question& question, Vec3 traction);

  std::size_t states_;
  std::vector<Point> points_;
  std::vector<double> state_;  ///< (points, states)
  double slope_cost_ = 0;
  std::vector<double> opening_, normal_, insertion_, asked_state_, traction_, stored_, damage_;
};

}  // namespace cdfp
