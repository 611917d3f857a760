#include "contact/surface.hpp"

#include <algorithm>
#include <string>

#include "cdfp/error.hpp"
#include "core/growth.hpp"
#include "core/numbered.hpp"

namespace cdfp {

Index Surface::row_for(Index node) {
  if (node >= static_cast<Index>(row_of_node_.size())) {
    lengthen(row_of_node_, static_cast<std::size_t>(node) + 1, kNone);
  }
  if (row_of_node_[node] == kNone) {
    row_of_node_[node] = node_count();
    append(nodes_, node);
    node_limit_ = std::max(node_limit_, node + 1);
    append(node_stiffness_, 0.0);
    append(incident_, kNone);
  }
  return row_of_node_[node];
}

void Surface::attach(Index corner) {
  const Index row = row_for(segments_[corner]);
  next_incident_[corner] = incident_[row];
  incident_[row] = corner;
  node_stiffness_[row] = std::max(node_stiffness_[row], data_[corner / 4].stiffness);
}

void Surface::detach(Index corner) {
  Index* link = &incident_[row_of_node_[segments_[corner]]];
  while (*link != corner) link = &next_incident_[*link];
  *link = next_incident_[corner];
}

Index Surface::add_segment(const SurfaceContact::Segment& segment) {
  const Index number = segment_count();
  if (segment.element < 0 || !(segment.area > 0) || !(segment.volume > 0) || !(segment.bulk_modulus > 0) ||
      *std::min_element(segment.nodes.begin(), segment.nodes.begin() + 3) < 0) {
    throw Error(Status::bad_argument,
                "contact segment " + numbered(number) + " of element " + numbered(segment.element) +
                    ": element and corners must be given, area, volume and bulk modulus positive");
  }
  make_room(data_, data_.size() + 1);
  data_.push_back({penalty_factor_ * segment.bulk_modulus * segment.area * segment.area / segment.volume,
                   segment.volume / segment.area, segment.element, segment.part});
  make_room(segments_, segments_.size() + 4);
  segments_.insert(segments_.end(), segment.nodes.begin(), segment.nodes.end());
  lengthen(next_incident_, segments_.size(), kNone);
  for (Index i = 0; i < 4 && segment.nodes[i] != kNone; ++i) attach(4 * number + i);

  if (segment.element >= static_cast<Index>(first_segment_.size())) {
    lengthen(first_segment_, static_cast<std::size_t>(segment.element) + 1, kNone);
  }
  append(first_edge_, kNone);
  for (Index other = first_segment_[segment.element]; other != kNone; other = next_segment_[other]) {
    add_edge_between(number, other);
  }
  append(next_segment_, first_segment_[segment.element]);
  first_segment_[segment.element] = number;
  return number;
}

void Surface::add_edge_between(Index segment, Index other) {
  const Index *a = corners(segment), *b = corners(other);
  const Index size = a[3] == kNone ? 3 : 4;
  const auto shared = [&](Index node) { return node != kNone && std::find(b, b + 4, node) != b + 4; };
  for (Index i = 0; i < size; ++i) {
    const Index from = a[i], to = a[(i + 1) % size];
    if (!shared(from) || !shared(to)) continue;
    edges_.insert(edges_.end(), {from, to});
    edge_data_.push_back({{segment, other},
                          0.5 * (data_[segment].stiffness + data_[other].stiffness),
                          std::min(data_[segment].height, data_[other].height)});
    append(next_edge_, first_edge_[segment]);
    first_edge_[segment] = edge_count() - 1;
    return;
  }
}

void Surface::rename(Index element, Index old_node, Index new_node) {
  if (element >= static_cast<Index>(first_segment_.size())) return;
  for (Index s = first_segment_[element]; s != kNone; s = next_segment_[s]) {
    for (Index c = 4 * s; c < 4 * s + 4; ++c) {
      if (segments_[c] != old_node) continue;
      detach(c);
      segments_[c] = new_node;
      attach(c);
      renamed_segments_.push_back(s);
    }
    for (Index e = first_edge_[s]; e != kNone; e = next_edge_[e]) {
      for (Index i = 2 * e; i < 2 * e + 2; ++i) {
        if (edges_[i] != old_node) continue;
        edges_[i] = new_node;
        renamed_edges_.push_back(e);
      }
    }
  }
}

bool Surface::remove(Index element) {
  if (element >= static_cast<Index>(first_segment_.size()) || first_segment_[element] == kNone) return false;
  for (Index s = first_segment_[element]; s != kNone; s = next_segment_[s]) {
    Index* nodes = &segments_[4 * static_cast<std::size_t>(s)];
    for (Index i = 0; i < 4 && nodes[i] != kNone; ++i) detach(4 * s + i);
    nodes[1] = nodes[2] = nodes[0];
    nodes[3] = kNone;
    data_[s].height = 0;
    ++removed_;
    for (Index e = first_edge_[s]; e != kNone; e = next_edge_[e]) {
      edges_[2 * static_cast<std::size_t>(e) + 1] = edges_[2 * static_cast<std::size_t>(e)];
      edge_data_[e].height = 0;
    }
  }
  first_segment_[element] = kNone;
  return true;
}

bool Surface::has_segment(Index element, const std::array<Index, 4>& nodes) const {
  if (element >= static_cast<Index>(first_segment_.size())) return false;
  for (Index s = first_segment_[element]; s != kNone; s = next_segment_[s]) {
    if (std::equal(nodes.begin(), nodes.end(), corners(s))) return true;
  }
  return false;
}

std::size_t Surface::memory() const {
  const std::size_t indices = nodes_.capacity() + segments_.capacity() + edges_.capacity() +
                              row_of_node_.capacity() + incident_.capacity() + next_incident_.capacity() +
                              first_segment_.capacity() + next_segment_.capacity() + first_edge_.capacity() +
                              next_edge_.capacity();
  return indices * sizeof(Index) + data_.capacity() * sizeof(SegmentData) +
         edge_data_.capacity() * sizeof(EdgeData) + node_stiffness_.capacity() * sizeof(double);
}

}  // namespace cdfp
