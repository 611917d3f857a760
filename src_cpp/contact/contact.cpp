#include "contact/contact.hpp"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <variant>

#include "cdfp/contact.hpp"
#include "cdfp/error.hpp"

namespace cdfp {

namespace {

double bulk_modulus(const Material& material) {
  struct Visit {
    double operator()(const ElasticMaterial& m) const { return of(m.youngs_modulus, m.poissons_ratio); }
    double operator()(const RateDependentMaterial& m) const {
      return of(m.static_modulus + m.rate_modulus, m.poissons_ratio);  // at 1/s
    }
    double operator()(const RigidMaterial& m) const { return of(m.youngs_modulus, m.poissons_ratio); }
    double operator()(const UserMaterial& m) const { return of(m.youngs_modulus, m.poissons_ratio); }
    static double of(double e, double nu) { return e / (3 * (1 - 2 * nu)); }
  };
  return std::visit(Visit{}, material.law);
}

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

struct Contact::Stages {
  SurfaceContact surface;
  std::vector<double> bulk_modulus;  // by part
  std::vector<Index> part_of_element;
  std::unordered_set<std::int64_t> dormant;  // bonded facets
  int threads = 1;

  static std::int64_t key(FacetUse use) { return std::int64_t{8} * use.element + use.facet; }

  static SurfaceContact::Arrays arrays(const Nodes& nodes) {
    return {nodes.position, nodes.velocity, nodes.mass, nodes.body, {}};
  }

  void add(FacetUse use, const Topology& topology, std::span<const double> reference) {
    const FacetNodes facet = topology.facet_nodes(use);
    const Index part = part_of_element[use.element];
    const double volume = element_volume(topology, reference, use.element);
    surface.add_segment({facet.nodes, use.element, part, bulk_modulus[part],
                         facet_shape(facet, reference, Vec3{}).area, volume});
  }
};

Contact::Contact(const Model& model, const Topology& topology)
    : stages_(new Stages{SurfaceContact(model.contact), {}, model.mesh.parts, {}}) {
  Stages& s = *stages_;
  s.surface.name_parts(model.mesh.part_names);
  s.bulk_modulus.assign(model.mesh.part_names.size(), 0);
  for (const Part& part : model.parts) {
    const auto name = std::find(model.mesh.part_names.begin(), model.mesh.part_names.end(), part.name);
    const auto material = std::find_if(model.materials.begin(), model.materials.end(),
                                       [&](const Material& m) { return m.name == part.material; });
    if (name == model.mesh.part_names.end() || material == model.materials.end()) {
      throw Error(Status::bad_argument, "contact: part \"" + part.name + "\" or its material \"" +
                                            part.material + "\" is not in the model; correct the name");
    }
    s.bulk_modulus[name - model.mesh.part_names.begin()] = bulk_modulus(*material);
  }
  std::unordered_set<std::int64_t> seen;
  for (const std::string& name : model.contact.surfaces) {
    const auto set = std::find_if(model.mesh.facet_sets.begin(), model.mesh.facet_sets.end(),
                                  [&](const FacetSet& f) { return f.name == name; });
    if (set == model.mesh.facet_sets.end()) {
      throw Error(Status::bad_argument,
                  "contact.surfaces names \"" + name + "\", which is no facet set of the mesh");
    }
    for (const FacetUse use : set->facets) {
      if (!seen.insert(Stages::key(use)).second) continue;
      if (topology.mate(use).element == kNone) {
        s.add(use, topology, model.mesh.coordinates);
      } else {
        s.dormant.insert(Stages::key(use));
      }
    }
  }
}
Contact::~Contact() = default;

void Contact::follow(const Insertion& insertion) {
  SurfaceContact& surface = stages_->surface;
  const Index bulk = static_cast<Index>(stages_->part_of_element.size());
  for (const Insertion::Renumbered& r : insertion.renumbered) {
    if (r.element < bulk) surface.rename(r.element, r.old_node, r.new_node);
  }
  for (const Insertion::NewNode& node : insertion.new_nodes) surface.split(node.mother, node.node);
}

void Contact::add_segments(std::span<const FacetUse> facets, const Topology& topology, const Nodes& nodes) {
  for (const FacetUse use : facets) {
    stages_->dormant.erase(Stages::key(use));
    stages_->add(use, topology, nodes.reference);
  }
}

Contact::Search Contact::due(const Nodes& nodes, double step) {
  switch (stages_->surface.due(Stages::arrays(nodes), step, stages_->threads)) {
    case SurfaceContact::Search::regular:
      return Search::regular;
    case SurfaceContact::Search::adaptive:
      return Search::adaptive;
    default:
      return Search::none;
  }
}

void Contact::regular_search(const Nodes& nodes, const Threads& threads) {
  stages_->threads = threads.count();
  stages_->surface.regular_search(Stages::arrays(nodes), stages_->threads);
}

void Contact::adaptive_search(const Nodes& nodes) {
  stages_->surface.adaptive_search(Stages::arrays(nodes));
}

void Contact::local_search(const Nodes& nodes, const Threads& threads) {
  stages_->surface.local_search(Stages::arrays(nodes), threads.count());
}

void Contact::add_force(Nodes& nodes, double step, const Threads& threads) {
  SurfaceContact::Arrays arrays = Stages::arrays(nodes);
  arrays.force = nodes.force;
  stages_->surface.add_force(arrays, step, threads.count());
}

std::span<const SurfaceContact::BodyPair> Contact::body_pairs() const {
  return stages_->surface.body_pairs();
}
Contact::Energy Contact::energy() const {
  return {stages_->surface.stored_energy(), stages_->surface.friction_heat()};
}
Index Contact::segment_count() const {
  return stages_->surface.segment_count() + static_cast<Index>(stages_->dormant.size());
}
double Contact::deepest_penetration() const {
  return stages_->surface.deepest_penetration();
}
std::vector<std::string> Contact::warnings() const {
  return stages_->surface.warnings();
}
std::size_t Contact::pair_count() const {
  const ContactSearch& search = stages_->surface.search();
  return search.node_segments().size() + search.edge_edges().size();
}
std::size_t Contact::touching_count() const {
  return stages_->surface.touching_count();
}
double Contact::stiffness_over_mass() const {
  return stages_->surface.stiffness_over_mass();
}

}  // namespace cdfp
