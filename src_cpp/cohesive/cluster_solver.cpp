#include "cohesive/cluster_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cdfp {

namespace {

constexpr int kIterations = 30;
constexpr int kUndamped = 2;  ///< iterations before a correction that does not help is halved
constexpr int kFlowSteps = 400;
constexpr double kSoftened =
    0.01;  ///< of the stiffness, for good, where even a slow approach does not settle

/// Gaussian elimination with row exchange; `b` becomes the solution.
void eliminate(int n, double* a, double* b) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
    }
    if (pivot != k) {
      for (int j = k; j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
      std::swap(b[k], b[pivot]);
    }
    const double inverse = 1 / a[k * n + k];
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] * inverse;
      if (factor == 0) continue;
      for (int j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    double sum = b[i];
    for (int j = i + 1; j < n; ++j) sum -= a[i * n + j] * b[j];
    b[i] = sum / a[i * n + i];
  }
}

double largest_of(Vec3 a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

Vec3 times(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

}  // namespace

Vec3 ClusterSolver::opening(const Point& p) const {
  return p.now + half_ * (relative_[p.upper] - relative_[p.lower]);
}

/// Reactions, loads, residuals and stiffness at `relative_`; returns the largest residual as an opening.
template <bool Sloped>
double ClusterSolver::evaluate() {
  ++evaluations;
  const int n = static_cast<int>(nodes.size());
  const int columns = 3 * (n - 1);
  for (Node& node : nodes) node.load = {};
  if constexpr (Sloped) std::fill_n(stiffness_.begin(), 3 * n * columns, 0.0);
  for (Point& p : points) {
    p.reaction = p.increment.at<Sloped>(opening(p));
    const Vec3 force = p.increment.area * p.reaction.traction;
    nodes[p.upper].load += force;
    nodes[p.lower].load -= force;
    if constexpr (!Sloped) continue;
    const double scale = half_ * p.increment.area;
    const int ends[2] = {p.upper, p.lower};
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 2; ++column) {
        if (ends[column] == 0) continue;
        const double s = row == column ? scale : -scale;
        double* block = &stiffness_[3 * ends[row] * columns + 3 * (ends[column] - 1)];
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) block[i * columns + j] += s * p.reaction.slope.v[3 * i + j];
        }
      }
    }
  }
  double size = 0;
  for (int a = 1; a < n; ++a) {
    residual_[a] = relative_[a] - (nodes[a].free - nodes[0].free) + times(nodes[a].per_mass, nodes[a].load) -
                   times(nodes[0].per_mass, nodes[0].load);
    size = std::max(size, half_ * largest_of(residual_[a]));
  }
  return size;
}

/// One correction of `relative_` from the residuals and the stiffness: Newton's without `drag`.
void ClusterSolver::correct(double drag) {
  const int n = static_cast<int>(nodes.size());
  const int columns = 3 * (n - 1);
  matrix_.resize(columns * columns + columns);
  double* right = &matrix_[columns * columns];
  for (int a = 1; a < n; ++a) {
    for (int i = 0; i < 3; ++i) {
      const int row = 3 * (a - 1) + i;
      const double own = nodes[a].per_mass[i];
      const double first = nodes[0].per_mass[i];
      const double* own_row = &stiffness_[(3 * a + i) * columns];
      const double* first_row = &stiffness_[i * columns];
      for (int j = 0; j < columns; ++j) matrix_[row * columns + j] = own * own_row[j] - first * first_row[j];
      matrix_[row * columns + row] += 1 + drag;
      right[row] = residual_[a][i];
    }
  }
  if (n == 2) {
    const double* m = matrix_.data();
    const Mat3 whole{{Vec3::load(m), Vec3::load(m + 3), Vec3::load(m + 6)}};
    (inverse(whole) * Vec3::load(right)).store(right);
  } else {
    eliminate(columns, matrix_.data(), right);
  }
  for (int a = 1; a < n; ++a) {
    before_[a] = relative_[a];
    relative_[a] -= Vec3::load(right + 3 * (a - 1));
  }
}

bool ClusterSolver::iterate(double tolerance) {
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kIterations; ++i) {
    // The first solution often stands: its slope is only asked for if it does not.
    double size = i == 1 ? evaluate<false>() : evaluate<true>();
    if (size <= tolerance) return true;
    if (i == 1) size = evaluate<true>();
    for (int halvings = 0; i >= kUndamped && size >= previous && halvings < 6; ++halvings) {
      for (std::size_t a = 1; a < nodes.size(); ++a) relative_[a] = 0.5 * (relative_[a] + before_[a]);
      size = evaluate<true>();
      if (size <= tolerance) return true;
    }
    if (!std::isfinite(size)) return false;
    previous = size;
    correct();
  }
  return evaluate<true>() <= tolerance;
}

void ClusterSolver::start() {
  for (std::size_t a = 1; a < nodes.size(); ++a) relative_[a] = nodes[a].behind - nodes[0].behind;
}

/// Follows d relative / d tau = -residual by implicit steps (pseudo-transient continuation): where the
/// traction falls faster than inertia gives way, Newton's method points anywhere, but the flow goes on to
/// where the points have opened.
bool ClusterSolver::flow(double tolerance) {
  start();
  double drag = 1;
  double size = evaluate<true>();
  for (int i = 0; i < kFlowSteps; ++i) {
    if (size <= tolerance) return true;
    if (!std::isfinite(size)) return false;
    correct(drag);
    const double previous = std::exchange(size, evaluate<true>());
    drag = std::clamp(size < previous ? 0.5 * drag : 3 * drag, 1e-6, 1e3);
  }
  return size <= tolerance;
}

/// Softer springs first, then step by step the true ones.
bool ClusterSolver::approach(double tolerance) {
  ++approached;
  stiff_.clear();
  for (const Point& p : points) stiff_.push_back(p.increment);
  start();
  bool settled = false;
  for (const double share : {0.01, 0.05, 0.2, 1.0}) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].increment = stiff_[i];
      if (share < 1) points[i].increment.soften(share);
    }
    settled = iterate(tolerance);
  }
  return settled;
}

void ClusterSolver::solve(double step, double share) {
  const std::size_t n = nodes.size();
  half_ = 0.5 * step;
  relative_.assign(n, {});
  before_.resize(n);
  residual_.resize(n);
  stiffness_.resize(9 * n * n);
  double reach = std::numeric_limits<double>::infinity();
  for (const Point& p : points) reach = std::min(reach, p.increment.softening.reach);
  const double tolerance = share * reach;

  start();
  bool settled = iterate(tolerance);
  if (!settled) settled = approach(tolerance);
  if (!settled) settled = flow(tolerance);
  if (!settled) {
    ++softened;
    for (Point& p : points) p.increment.soften(kSoftened);
    settled = iterate(tolerance);
  }
  if (!settled) {
    ++fixed;
    start();
    for (Point& p : points) p.increment.freeze(opening(p));
    evaluate<true>();
    correct();
    evaluate<true>();
  }
  for (Node& node : nodes) node.ahead = node.free - times(node.per_mass, node.load);
}

}  // namespace cdfp
