/// What a run keeps of itself while it goes: history rows, extremes, first events.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "cdfp/contact.hpp"
#include "cdfp/model.hpp"
#include "cdfp/results.hpp"
#include "cdfp/topology.hpp"
#include "core/archive.hpp"
#include "core/vec3.hpp"
#include "element/element_force.hpp"
#include "state/nodes.hpp"

namespace cdfp {

class Monitor {
 public:
  /// The model must stay.
  explicit Monitor(const Model& model);

  struct Body {
    Vec3 position;
    Vec3 velocity;
    Vec3 force;
  };
  /// Every step: the impactor's (first rigid body's) contact force.
  void watch_force(double time, Vec3 force_on_first_body);
  /// At each insertion of a cohesive element.
  void watch_insertion(double time, const Topology& topology, const Insertion& insertion, const Nodes& nodes);
  /// A row of the history.
  void record(double time, std::int64_t step, double step_size, const Energies& energies,
              const std::vector<PartEnergy>& parts, Index inserted, Index broken,
              const std::vector<Body>& bodies, std::span<const SurfaceContact::BodyPair> contact_pairs);

  const History& history() const { return history_; }
  void archive(Archive& a);
  /// The fields of the summary that come from watching.
  void fill(Summary& summary) const;

 private:
  Vec3 of_whole(Vec3 force) const;
  double whole(Vec3 force) const;  ///< of the whole structure: mirrored components cancel, others multiply

  std::vector<std::string> part_names_;
  std::span<const Index> part_of_element_;
  std::span<const Index> layer_of_element_;
  std::vector<Index> layers_of_part_;
  std::vector<bool> cracks_;
  std::vector<bool> mirrored_{false, false, false};
  double copies_ = 1;
  std::vector<std::array<Index, 2>> contact_pairs_;  ///< of different parts, by column
  History history_;
  Summary extremes_;
  std::vector<Summary::FirstCrack> first_cracks_;  ///< one a part
  std::vector<double> strain_max_;
  std::vector<double> hourglass_max_;
};

}  // namespace cdfp
