#include <algorithm>
#include <array>

#include "cohesive/zone_points.hpp"

namespace cdfp {

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

}  // namespace cdfp
