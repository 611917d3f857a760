#include "cohesive/user_points.hpp"

#include <algorithm>
#include <cmath>

#include "cdfp/error.hpp"

namespace cdfp {

Index UserCohesivePoints::add(Vec3 insertion_traction) {
  points_.push_back({});
  points_.back().insertion_traction = insertion_traction;
  state_.resize(state_.size() + states_, 0.0);
  return static_cast<Index>(points_.size()) - 1;
}

void UserCohesivePoints::ask(const CohesiveLaw& law, double time, double step,
                             const std::vector<Question>& questions) {
  const std::size_t n = questions.size();
  if (n == 0) return;
  for (std::vector<double>* rows : {&opening_, &normal_, &insertion_, &traction_}) rows->resize(3 * n);
  asked_state_.resize(states_ * n);
  stored_.assign(n, 0.0);
  damage_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point& point = points_[questions[i].place];
    questions[i].opening.store(&opening_[3 * i]);
    questions[i].normal.store(&normal_[3 * i]);
    point.insertion_traction.store(&insertion_[3 * i]);
    Vec3{}.store(&traction_[3 * i]);
    damage_[i] = point.damage;
    std::copy_n(state_.begin() + static_cast<std::ptrdiff_t>(states_ * questions[i].place), states_,
                asked_state_.begin() + static_cast<std::ptrdiff_t>(states_ * i));
  }
  law.callback({static_cast<std::int64_t>(n), time, step, opening_.data(), normal_.data(), insertion_.data(),
                asked_state_.data(), traction_.data(), stored_.data(), damage_.data()});
  for (std::size_t i = 0; i < n; ++i) {
    Point& point = points_[questions[i].place];
    const Vec3 traction = Vec3::load(&traction_[3 * i]);
    if (!std::isfinite(norm(traction)) || !std::isfinite(stored_[i]) || !std::isfinite(damage_[i])) {
      throw Error(Status::diverged, "the user's cohesive law '" + law.name +
                                        "' gave a number that is not finite at time " +
                                        std::to_string(1e6 * time) + " us; check it for divisions by zero");
    }
    take(point, questions[i], traction);
    point.stored = stored_[i];
    point.damage = std::clamp(damage_[i], point.damage, 1.0);
    std::copy_n(asked_state_.begin() + static_cast<std::ptrdiff_t>(states_ * i), states_,
                state_.begin() + static_cast<std::ptrdiff_t>(states_ * questions[i].place));
  }
}

/// A traction that falls behind a steep law would feed energy in; one that is bounded by the opening does
/// not.
void UserCohesivePoints::take(Point& point, const Question& question, Vec3 traction) {
  const double size = norm(traction);
  const double most = question.stiffest * norm(question.opening);
  if (size <= most) {
    point.opened = true;
  } else if (point.opened) {
    const Vec3 kept = (most / size) * traction;
    slope_cost_ += question.area * std::abs(dot(traction - kept, question.opening - point.opening));
    traction = kept;
  }
  point.traction = traction;
  point.opening = question.opening;
}

}  // namespace cdfp
