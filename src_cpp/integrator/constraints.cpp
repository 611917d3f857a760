#include "integrator/constraints.hpp"

#include <algorithm>
#include <cmath>

#include "model/lookup.hpp"

namespace cdfp {

namespace {

double value_at(const PrescribedVelocity& velocity, double time) {
  const auto& t = velocity.times;
  const auto& v = velocity.values;
  if (t.size() < 2 || time <= t.front()) return v.front();
  if (time >= t.back()) return v.back();
  const std::size_t k = std::upper_bound(t.begin(), t.end(), time) - t.begin();
  const double s = (time - t[k - 1]) / (t[k] - t[k - 1]);
  return v[k - 1] + s * (v[k] - v[k - 1]);
}

std::uint8_t mask_of(const std::array<bool, 3>& directions) {
  return static_cast<std::uint8_t>(directions[0] | directions[1] << 1 | directions[2] << 2);
}

double extent(const Nodes& nodes, int axis) {
  double low = nodes.reference[axis];
  double high = low;
  for (std::size_t i = axis; i < nodes.reference.size(); i += 3) {
    low = std::min(low, nodes.reference[i]);
    high = std::max(high, nodes.reference[i]);
  }
  return high - low;
}

}  // namespace

Constraints::Constraints(const Model& model, Nodes& nodes) {
  for (const SymmetryPlane& plane : model.symmetry_planes) {
    const double tolerance = 1e-9 * extent(nodes, plane.axis);
    for (Index n = 0; n < nodes.count(); ++n) {
      if (nodes.body[n] != kNone || std::abs(nodes.x0(n)[plane.axis] - plane.coordinate) > tolerance)
        continue;
      nodes.fixed[n] |= static_cast<std::uint8_t>(1 << plane.axis);
      nodes.velocity[3 * static_cast<std::size_t>(n) + plane.axis] = 0;
    }
  }
  for (const PrescribedVelocity& velocity : model.prescribed_velocities) {
    const NodeSet& set = node_set(model.mesh, velocity.node_set);
    const bool at_rest =
        std::all_of(velocity.values.begin(), velocity.values.end(), [](double v) { return v == 0; });
    for (const Index n : set.nodes) {
      nodes.fixed[n] |= mask_of(velocity.directions);
      for (int d = 0; d < 3; ++d) {
        if (velocity.directions[d])
          nodes.velocity[3 * static_cast<std::size_t>(n) + d] = value_at(velocity, 0);
      }
    }
    if (!at_rest) moving_.push_back({velocity, set.nodes});
  }
  if (moving_.empty()) return;
  moving_of_node_.resize(nodes.count());
  for (std::size_t m = 0; m < moving_.size(); ++m) {
    for (const Index n : moving_[m].nodes) moving_of_node_[n].push_back(static_cast<Index>(m));
  }
}

void Constraints::follow(const Insertion& insertion) {
  if (moving_.empty()) return;
  for (const auto& [node, mother] : insertion.new_nodes) {
    const std::vector<Index> inherited = moving_of_node_[mother];
    moving_of_node_.push_back(inherited);
    for (const Index m : inherited) moving_[m].nodes.push_back(node);
  }
}

Constraints::Work Constraints::apply(double time, double step, Nodes& nodes) {
  Work work;
  for (const Moving& m : moving_) {
    const double value = value_at(m.velocity, time);
    for (const Index n : m.nodes) {
      for (int d = 0; d < 3; ++d) {
        if (!m.velocity.directions[d]) continue;
        const std::size_t k = 3 * static_cast<std::size_t>(n) + d;
        const double before = nodes.velocity[k];
        const double impulse = nodes.mass[n] * (value - before) - nodes.force[k] * step;
        work.step += impulse * 0.5 * (before + value);
        work.ahead += 0.5 * step * nodes.force[k] * value;
        nodes.velocity[k] = value;
      }
    }
  }
  return work;
}

}  // namespace cdfp
