/// Contact of a simulation: surface, global search, local search and enforcement as stages of the step.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cdfp/contact.hpp"
#include "cdfp/model.hpp"
#include "cdfp/topology.hpp"
#include "core/parallel.hpp"
#include "state/nodes.hpp"

namespace cdfp {

class Contact {
 public:
  /// Segments are the facets of `model.contact.surfaces`; those with a bulk element on the other side
  /// (bonded) are counted, but take no part until they come free.
  Contact(const Model& model, const Topology& topology);
  ~Contact();

  /// Corners of segments that now name new nodes; the copies are new contact nodes where their mothers were.
  void follow(const Insertion& insertion);
  /// Faces that came free (both sides of broken cohesive elements) become segments; edges follow. Those of
  /// elements that are no more are left out.
  void add_segments(std::span<const FacetUse> facets, const Topology& topology, const Nodes& nodes);

  /// Elements that are no more, and those of their neighbours' facets that came free with them. A neighbour
  /// across a cohesive element counts.
  void remove_elements(std::span<const Index> elements, const Topology& topology, const Nodes& nodes);

  /// The search that is due at this step.
  enum class Search { none, regular, adaptive };
  Search due(const Nodes& nodes, double step);
  void regular_search(const Nodes& nodes, const Threads& threads);
  void adaptive_search(const Nodes& nodes);

  /// Pairs that touch now, and their gaps, slips and directions.
  void local_search(const Nodes& nodes, const Threads& threads);
  /// Penalty and friction forces into `nodes.force`. The same bits for any number of threads.
  void add_force(Nodes& nodes, double step, const Threads& threads);

  std::span<const SurfaceContact::BodyPair> body_pairs() const;
  struct Energy {
    double stored = 0;
    double friction = 0;
  };
  Energy energy() const;

  Index segment_count() const;         ///< of what there is now
  double deepest_penetration() const;  ///< m, seen so far
  std::vector<std::string> warnings() const;
  std::size_t pair_count() const;  ///< candidates of the last search
  std::size_t touching_count() const;
  void archive(Archive& a);
  /// Adds to each node a bound on omega^2 of the contact springs at it, 1/s2, of the last `add_force`: for
  /// the stable step.
  void add_stiffness_over_mass(std::span<double> by_node) const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace cdfp
