/// Contact nodes, segments and edges, and who belongs to whom. Entities keep their numbers.
#pragma once

#include <array>
#include <vector>

#include "cdfp/contact.hpp"
#include "core/archive.hpp"

namespace cdfp {

class Surface {
 public:
  struct SegmentData {
    double stiffness;  ///< N/m, zeta K A^2 / V
    double height;     ///< m, V / A; 0 once removed
    Index element;
    Index part;
  };
  struct EdgeData {
    std::array<Index, 2> segments;  ///< both of one element, the later one first
    double stiffness;
    double height;  ///< 0 once removed
  };

  explicit Surface(double penalty_factor) : penalty_factor_(penalty_factor) {}

  Index add_segment(const SurfaceContact::Segment& segment);
  void rename(Index element, Index old_node, Index new_node);
  /// Its segments and edges take no part from now on: each shrinks to one of its corners. Returns whether it
  /// had any.
  bool remove(Index element);
  bool is_removed(Index segment) const { return !(data_[segment].height > 0); }
  bool is_removed_edge(Index edge) const { return !(edge_data_[edge].height > 0); }
  Index removed_count() const { return removed_; }
  /// Whether the element has a segment with these corners.
  bool has_segment(Index element, const std::array<Index, 4>& nodes) const;

  Index segment_count() const { return static_cast<Index>(data_.size()); }
  Index edge_count() const { return static_cast<Index>(edge_data_.size()); }
  Index node_count() const { return static_cast<Index>(nodes_.size()); }

  /// More than the largest number of a contact node.
  Index node_limit() const { return node_limit_; }
  const std::vector<Index>& nodes() const { return nodes_; }
  const std::vector<Index>& segments() const { return segments_; }
  const std::vector<Index>& edges() const { return edges_; }
  const Index* corners(Index segment) const { return &segments_[4 * static_cast<std::size_t>(segment)]; }
  const Index* ends(Index edge) const { return &edges_[2 * static_cast<std::size_t>(edge)]; }
  const SegmentData& data(Index segment) const { return data_[segment]; }
  const EdgeData& edge_data(Index edge) const { return edge_data_[edge]; }

  /// Position of a node in `nodes()`, or kNone.
  Index row(Index node) const {
    return node < static_cast<Index>(row_of_node_.size()) ? row_of_node_[node] : kNone;
  }
  /// Largest penalty of the segments that have had the node.
  double node_stiffness(Index row) const { return node_stiffness_[row]; }
  bool on_surface(Index row) const { return incident_[row] != kNone; }
  /// Of the segments that have the node; kNone if none has.
  Index part(Index row) const { return on_surface(row) ? data_[incident_[row] / 4].part : kNone; }

  /// `visit(segment)` for the segments that have the node as a corner.
  template <class Visit>
  void for_each_incident(Index row, Visit&& visit) const {
    for (Index c = incident_[row]; c != kNone; c = next_incident_[c]) visit(c / 4);
  }

  /// Renamed since the last `clear_renamed`, with repetitions.
  const std::vector<Index>& renamed_segments() const { return renamed_segments_; }
  const std::vector<Index>& renamed_edges() const { return renamed_edges_; }
  void clear_renamed() {
    renamed_segments_.clear();
    renamed_edges_.clear();
  }
  void archive(Archive& a);
  std::size_t memory() const;

 private:
  Index row_for(Index node);
  void attach(Index corner);
  void detach(Index corner);
  void add_edge_between(Index segment, Index other);

  double penalty_factor_;
  Index node_limit_ = 0;
  Index removed_ = 0;
  std::vector<Index> nodes_, segments_, edges_;
  std::vector<SegmentData> data_;
  std::vector<EdgeData> edge_data_;
  std::vector<Index> row_of_node_;
  std::vector<double> node_stiffness_;
  std::vector<Index> incident_, next_incident_;      // chains of corners (4 * segment + i) by contact node
  std::vector<Index> first_segment_, next_segment_;  // chains by element
  std::vector<Index> first_edge_, next_edge_;        // chains by the later one of an edge's segments
  std::vector<Index> renamed_segments_, renamed_edges_;
};

}  // namespace cdfp
