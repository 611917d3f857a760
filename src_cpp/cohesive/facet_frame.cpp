#include "cohesive/facet_frame.hpp"

namespace cdfp {

FacetFrame::FacetFrame(std::span<const NodePair> pairs, const NodeArrays& nodes) : pairs_(pairs) {
  Vec3 centre;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    arm_[c] = 0.5 * (nodes.x(pairs[c].upper) + nodes.x(pairs[c].lower));
    centre += arm_[c] / static_cast<double>(pairs.size());
  }
  Mat3 inertia;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    arm_[c] -= centre;
    const Vec3 r = arm_[c];
    inertia = inertia + dot(r, r) * Mat3::identity() + -1.0 * Mat3{{r.x * r, r.y * r, r.z * r}};
  }
  inverse_inertia_ = inverse(inertia);
}

void FacetFrame::add_couple(Vec3 couple, const NodeArrays& nodes) const {
  const Vec3 turn = inverse_inertia_ * couple;
  for (std::size_t c = 0; c < pairs_.size(); ++c) {
    const Vec3 half = 0.5 * cross(turn, arm_[c]);
    half.add_to(&nodes.force[3 * static_cast<std::size_t>(pairs_[c].upper)]);
    half.add_to(&nodes.force[3 * static_cast<std::size_t>(pairs_[c].lower)]);
  }
}

}  // namespace cdfp
