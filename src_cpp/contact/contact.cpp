#include "contact/contact.hpp"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <variant>

#include "cdfp/contact.hpp"
#include "core/archive.hpp"
#include "model/lookup.hpp"

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

}  // namespace

struct Contact::Stages {
  SurfaceContact surface;
  std::vector<double> bulk_modulus;  // by part
  std::span<const Index> part_of_element;
  std::vector<std::int64_t> dormant;  // bonded facets, ascending
  std::unordered_set<Index> removed;  // elements
  int threads = 1;

  static std::int64_t key(FacetUse use) { return std::int64_t{8} * use.element + use.facet; }

  void wake(FacetUse use) {
    const auto found = std::lower_bound(dormant.begin(), dormant.end(), key(use));
    if (found != dormant.end() && *found == key(use)) dormant.erase(found);
  }

  static SurfaceContact::Arrays arrays(const Nodes& nodes) {
    return {nodes.position, nodes.velocity, nodes.mass, nodes.body, {}};
  }

  void add(std::span<const FacetUse> facets, const Topology& topology, std::span<const double> reference) {
    surface.add_facets({topology, reference, part_of_element, bulk_modulus}, facets);
  }
};

Contact::Contact(const Model& model, const Topology& topology)
    : stages_(new Stages{SurfaceContact(model.contact), {}, model.mesh.parts, {}, {}}) {
  Stages& s = *stages_;
  s.surface.name_parts(model.mesh.part_names);
  s.bulk_modulus.assign(model.mesh.part_names.size(), 0);
  for (const Part& part : model.parts) {
    s.bulk_modulus[part_number(model.mesh, part.name)] = bulk_modulus(material(model, part.material));
  }
  for (const std::string& name : model.contact.surfaces) {
    for (const FacetUse use : facet_set(model.mesh, name).facets) {
      if (topology.mate(use).element != kNone) {
        s.dormant.push_back(Stages::key(use));
      } else if (!s.surface.has_facet(topology, use)) {  // sets may share facets
        s.add({&use, 1}, topology, model.mesh.coordinates);
      }
    }
  }
  std::sort(s.dormant.begin(), s.dormant.end());
  s.dormant.erase(std::unique(s.dormant.begin(), s.dormant.end()), s.dormant.end());
  s.dormant.shrink_to_fit();
}
Contact::~Contact() = default;

void Contact::follow(const Insertion& insertion) {
  stages_->surface.follow(insertion.new_nodes, insertion.renumbered);
}

void Contact::add_segments(std::span<const FacetUse> facets, const Topology& topology, const Nodes& nodes) {
  Stages& s = *stages_;
  std::vector<FacetUse> fresh;
  for (const FacetUse use : facets) {
    s.wake(use);
    if (!s.removed.contains(use.element) && !s.surface.has_facet(topology, use)) fresh.push_back(use);
  }
  s.add(fresh, topology, nodes.reference);
}

void Contact::remove_elements(std::span<const Index> elements, const Topology& topology, const Nodes& nodes) {
  Stages& s = *stages_;
  s.removed.insert(elements.begin(), elements.end());
  std::vector<FacetUse> freed;
  for (const Index e : elements) {
    s.surface.remove_element(e);
    for (Index f = 0; f < topology.facet_count(e); ++f) {
      s.wake({e, f});
      FacetUse mate = topology.mate({e, f});
      if (mate.element >= topology.bulk_count()) mate = topology.mate({mate.element, 1 - mate.facet});
      if (mate.element != kNone) freed.push_back(mate);
    }
  }
  add_segments(freed, topology, nodes);
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
  return stages_->surface.segment_count() - stages_->surface.removed_count() +
         static_cast<Index>(stages_->dormant.size());
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
void Contact::archive(Archive& a) {
  Stages& s = *stages_;
  s.surface.archive(a);
  std::vector<Index> removed(s.removed.begin(), s.removed.end());
  std::sort(removed.begin(), removed.end());
  a("contact.dormant", s.dormant);
  a("contact.removed", removed);
  s.removed = {removed.begin(), removed.end()};
}

void Contact::add_stiffness_over_mass(std::span<double> by_node) const {
  stages_->surface.add_stiffness_over_mass(by_node);
}

}  // namespace cdfp
