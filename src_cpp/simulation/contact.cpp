/// The surface of contact and its searches.
#include "simulation/stages.hpp"

namespace cdfp {

void Simulation::Stages::update_surface() {
  if (!gone_.empty()) {
    contact->remove_elements(gone_, topology, nodes);
    gone_.clear();
  }
  const std::span<const Index> broken = cohesive ? cohesive->broken_now() : std::span<const Index>();
  if (broken.empty()) return;
  freed_.clear();
  for (const Index e : broken) {
    freed_.push_back(topology.mate({e, 0}));
    freed_.push_back(topology.mate({e, 1}));
  }
  contact->add_segments(freed_, topology, nodes);
}

void Simulation::Stages::search() {
  Contact::Search due = contact->due(nodes, step_size);
  if (search_anew_) due = Contact::Search::regular;
  search_anew_ = false;
  switch (due) {
    case Contact::Search::none:
      break;
    case Contact::Search::regular:
      clock.time(regular_clock_, [this] { contact->regular_search(nodes, threads); });
      break;
    case Contact::Search::adaptive:
      clock.time(adaptive_clock_, [this] { contact->adaptive_search(nodes); });
      break;
  }
}

}  // namespace cdfp
