/// Facets of a topology as segments.
#include <string>

#include "cdfp/contact.hpp"
#include "contact/stages.hpp"
#include "core/numbered.hpp"
#include "core/require.hpp"
#include "core/vec3.hpp"

namespace cdfp {

namespace {

Vec3 node_at(std::span<const double> position, Index node) {
  return Vec3::load(&position[3 * static_cast<std::size_t>(node)]);
}

struct FacetShape {
  double area = 0;
  double volume = 0;  ///< of the cone to the origin `from`
};
FacetShape facet_shape(const FacetNodes& facet, std::span<const double> position, Vec3 from) {
  Vec3 centre;
  for (const Index node : facet.view()) centre += node_at(position, node);
  centre *= 1.0 / facet.count;
  Vec3 area;
  double volume = 0;
  for (Index i = 0; i < facet.count; ++i) {
    const Vec3 a = node_at(position, facet.nodes[i]);
    const Vec3 b = node_at(position, facet.nodes[(i + 1) % facet.count]);
    const Vec3 twice = cross(a - centre, b - centre);
    area += 0.5 * twice;
    volume += dot(centre - from, twice) / 6;
  }
  return {norm(area), volume};
}

double element_volume(const Topology& topology, std::span<const double> position, Index element) {
  const Vec3 from = node_at(position, topology.nodes(element)[0]);
  double volume = 0;
  for (Index f = 0; f < topology.facet_count(element); ++f) {
    volume += facet_shape(topology.facet_nodes({element, f}), position, from).volume;
  }
  return volume;
}

}  // namespace

void SurfaceContact::add_facets(const FacetSource& source, std::span<const FacetUse> facets) {
  const Topology& topology = source.topology;
  require(source.reference.size() == 3 * static_cast<std::size_t>(topology.node_count()),
          "'reference' has " + std::to_string(source.reference.size()) +
              " numbers; give three for each of the " + std::to_string(topology.node_count()) +
              " nodes of the topology");
  require(source.parts.size() == static_cast<std::size_t>(topology.bulk_count()),
          "'parts' has " + std::to_string(source.parts.size()) + " numbers; give one for each of the " +
              std::to_string(topology.bulk_count()) + " bulk elements");
  const auto wrong = [&](const FacetUse& use) -> std::string {
    if (use.element < 0 || use.element >= topology.bulk_count()) {
      return "there are " + std::to_string(topology.bulk_count()) + " bulk elements";
    }
    if (use.facet < 0 || use.facet >= topology.facet_count(use.element)) {
      return "the element has " + std::to_string(topology.facet_count(use.element)) + " facets";
    }
    const Index part = source.parts[use.element];
    if (part < 0 || part >= static_cast<Index>(source.bulk_modulus.size())) {
      return "there are bulk moduli of " + std::to_string(source.bulk_modulus.size()) +
             " parts, but the element is of part " + numbered(part);
    }
    return {};
  };
  for (const FacetUse& use : facets) {
    const std::string fault = wrong(use);
    if (fault.empty()) continue;
    refuse("facet " + numbered(use.facet) + " of element " + numbered(use.element) +
           " cannot be a contact segment: " + fault + ", counted from " + numbered(0));
  }
  for (const FacetUse& use : facets) {
    const FacetNodes facet = topology.facet_nodes(use);
    const Index part = source.parts[use.element];
    add_segment({facet.nodes, use.element, part, source.bulk_modulus[part],
                 facet_shape(facet, source.reference, Vec3{}).area,
                 element_volume(topology, source.reference, use.element)});
  }
}

bool SurfaceContact::has_facet(const Topology& topology, FacetUse facet) const {
  return stages_->surface.has_segment(facet.element, topology.facet_nodes(facet).nodes);
}

void SurfaceContact::follow(std::span<const Insertion::NewNode> new_nodes,
                            std::span<const Insertion::Renumbered> renumbered) {
  for (const Insertion::Renumbered& r : renumbered) rename(r.element, r.old_node, r.new_node);
  for (const Insertion::NewNode& node : new_nodes) split(node.mother, node.node);
}

}  // namespace cdfp
