/// What contact carries from step to step.
#include "core/archive.hpp"

#include "cdfp/contact.hpp"
#include "contact/stages.hpp"

namespace cdfp {

void Surface::archive(Archive& a) {
  a("surface.node_limit", node_limit_);
  a("surface.removed", removed_);
  a("surface.nodes", nodes_);
  a("surface.segments", segments_);
  a("surface.edges", edges_);
  a("surface.data", data_);
  a("surface.edge_data", edge_data_);
  a("surface.row_of_node", row_of_node_);
  a("surface.node_stiffness", node_stiffness_);
  a("surface.incident", incident_);
  a("surface.next_incident", next_incident_);
  a("surface.first_segment", first_segment_);
  a("surface.next_segment", next_segment_);
  a("surface.first_edge", first_edge_);
  a("surface.next_edge", next_edge_);
  a("surface.renamed_segments", renamed_segments_);
  a("surface.renamed_edges", renamed_edges_);
}

void SurfaceContact::archive(Archive& a) {
  Stages& s = *stages_;
  s.surface.archive(a);
  s.search.archive(a);
  a("contact.searched_nodes", s.searched_nodes);
  a("contact.searched_segments", s.searched_segments);
  a("contact.searched_edges", s.searched_edges);
  a("contact.holds", s.holds);
  a("contact.wake", s.wake);
  a("contact.has_pairs", s.has_pairs);
  a("contact.active_nodes", s.active_nodes);
  a("contact.is_partner", s.is_partner);
  a("contact.active_segments", s.active_segments);
  a("contact.planes", s.planes);
  a("contact.edge_wake", s.edge_wake);
  a("contact.edge_has_pairs", s.edge_has_pairs);
  a("contact.active_edges", s.active_edges);
  a("contact.edge_hits", s.edge_hits);
  a("contact.stamp", s.stamp);
  a("contact.ended_here", s.ended_here);
  std::uint64_t pieces = s.pieces.size();
  a("contact.pieces", pieces);
  s.pieces.resize(pieces);
  for (Stages::Piece& piece : s.pieces) a("contact.touches", piece.touches);
  a("contact.edge_touches", s.edge_touches);
  a("contact.removed_pairs", s.removed_pairs);
  a("contact.worst", s.worst);
  a("contact.body_pairs", s.body_pairs);
}

}  // namespace cdfp
