#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/stages.hpp"
#include "core/growth.hpp"
#include "core/numbered.hpp"
#include "core/require.hpp"

namespace cdfp {

namespace {

constexpr std::int64_t kSpeedGrain = 256;

}  // namespace

void SurfaceContact::Stages::grow_to_surface() {
  const auto nodes = static_cast<std::size_t>(surface.node_count());
  const auto segments = static_cast<std::size_t>(surface.segment_count());
  lengthen(holds, nodes);
  lengthen(wake, nodes);
  lengthen(ended_here, nodes);
  lengthen(has_pairs, nodes);
  lengthen(is_partner, segments);
  lengthen(planes, segments);
  if (settings.edge_edge) {
    edge_wake.resize(surface.edge_count(), 0);
    edge_has_pairs.resize(surface.edge_count(), 0);
  }
  searched_nodes = surface.node_count();
  searched_segments = surface.segment_count();
  searched_edges = surface.edge_count();
  surface.clear_renamed();
}

void SurfaceContact::Stages::activate_node(const double* x, Index row) {
  wake[row] = 0;
  const auto take_partner = [&](Index segment) {
    if (is_partner[segment]) return;
    is_partner[segment] = 1;
    active_segments.push_back(segment);
    planes[segment].radius = segment_radius(x, segment);
  };
  search.node_segments().for_each(row, take_partner);
  if (holds[row].segment != kNone) take_partner(holds[row].segment);
  if (has_pairs[row]) return;
  has_pairs[row] = 1;
  active_nodes.push_back(row);
}

void SurfaceContact::Stages::activate_edge(Index edge) {
  edge_wake[edge] = 0;
  if (edge_has_pairs[edge]) return;
  edge_has_pairs[edge] = 1;
  active_edges.push_back(edge);
}

SurfaceContact::SurfaceContact(const ContactSettings& settings) {
  if (!(settings.penalty_factor > 0) || !(settings.friction >= 0) || !(settings.depth_limit > 0) ||
      !(settings.depth_limit <= 1) || !(settings.penetration_warning > 0)) {
    throw Error(Status::bad_argument,
                "contact: penalty_factor and penetration_warning must be positive, friction not negative, "
                "depth_limit in (0, 1]");
  }
  stages_ = std::make_unique<Stages>(settings);
}
SurfaceContact::~SurfaceContact() = default;
SurfaceContact::SurfaceContact(SurfaceContact&&) noexcept = default;
SurfaceContact& SurfaceContact::operator=(SurfaceContact&&) noexcept = default;

Index SurfaceContact::add_segment(const Segment& segment) {
  return stages_->surface.add_segment(segment);
}

void SurfaceContact::rename(Index element, Index old_node, Index new_node) {
  require(element >= 0 && old_node >= 0 && new_node >= 0,
          "element " + numbered(element) + " is to name node " + numbered(new_node) + " for " +
              numbered(old_node) + "; numbers count from " + numbered(0));
  stages_->surface.rename(element, old_node, new_node);
}

void SurfaceContact::split(Index mother, Index copy) {
  Stages& s = *stages_;
  require(mother >= 0 && copy >= 0, "node " + numbered(copy) + " is said to be a copy of node " +
                                        numbered(mother) + "; nodes count from " + numbered(0));
  const Index from = s.surface.row(mother), to = s.surface.row(copy);
  if (from == kNone || to == kNone || from >= static_cast<Index>(s.holds.size())) return;
  if (s.holds.size() <= static_cast<std::size_t>(to)) lengthen(s.holds, static_cast<std::size_t>(to) + 1);
  Stages::Hold& hold = s.holds[from];
  if (hold.segment == kNone) return;
  // Both share the springs, so force and energy stay what they were.
  if (s.surface.on_surface(from)) hold.grip.stiffness *= 0.5;
  s.holds[to] = hold;
  if (!s.surface.on_surface(from)) hold = Stages::Hold{};
}

SurfaceContact::Search SurfaceContact::due(const Arrays& arrays, double step, int threads) {
  Stages& s = *stages_;
  s.need_nodes(arrays.velocity, "velocity");
  const std::vector<Index>& nodes = s.surface.nodes();
  const std::int64_t count = static_cast<std::int64_t>(nodes.size());
  s.piece_speed.assign((count + kSpeedGrain - 1) / kSpeedGrain, 0);
  Threads(threads).for_ranges(count, kSpeedGrain, [&](std::int64_t begin, std::int64_t end) {
    double fastest = 0;
    for (std::int64_t i = begin; i < end; ++i) {
      const double* v = &arrays.velocity[3 * static_cast<std::size_t>(nodes[i])];
      fastest = std::max(fastest, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    s.piece_speed[begin / kSpeedGrain] = fastest;
  });
  double fastest = 0;
  for (const double speed : s.piece_speed) fastest = std::max(fastest, speed);
  if (s.search.due(std::sqrt(fastest), step)) return Search::regular;
  const bool news = s.surface.node_count() > s.searched_nodes ||
                    s.surface.segment_count() > s.searched_segments ||
                    s.surface.edge_count() > s.searched_edges || !s.surface.renamed_segments().empty();
  if (!news) return Search::none;
  return s.settings.adaptive ? Search::adaptive : Search::regular;
}

void SurfaceContact::regular_search(const Arrays& arrays, int threads) {
  Stages& s = *stages_;
  s.need_nodes(arrays.position, "position");
  s.search.regular(s.view(arrays), threads);
  s.search.give_back_room();
  s.grow_to_surface();
  std::fill(s.has_pairs.begin(), s.has_pairs.end(), 0);
  std::fill(s.is_partner.begin(), s.is_partner.end(), 0);
  std::fill(s.edge_has_pairs.begin(), s.edge_has_pairs.end(), 0);
  s.bar_removed();
  s.active_nodes.clear();
  s.active_segments.clear();
  s.active_edges.clear();
  for (Index row = 0; row < s.surface.node_count(); ++row) {
    if (!s.search.node_segments().empty(row) || s.holds[row].segment != kNone) {
      s.activate_node(arrays.position.data(), row);
    }
  }
  for (Index edge = 0; edge < s.search.edge_edges().rows(); ++edge) {
    if (!s.search.edge_edges().empty(edge)) s.activate_edge(edge);
  }
  std::sort(s.active_segments.begin(), s.active_segments.end());
  for (Stages::Piece& piece : s.pieces) {  // their longest is past
    piece.touches.shrink_to_fit();
    piece.ended.shrink_to_fit();
  }
  s.edge_hits.resize(s.active_edges.size());
}

void SurfaceContact::adaptive_search(const Arrays& arrays) {
  Stages& s = *stages_;
  s.need_nodes(arrays.position, "position");
  s.search.adaptive(
      s.view(arrays), s.surface.renamed_segments(),
      s.settings.edge_edge ? std::span<const Index>(s.surface.renamed_edges()) : std::span<const Index>());
  const Index first_new = s.searched_nodes;
  s.grow_to_surface();
  s.bar_removed();
  for (const Index row : s.search.touched_node_rows()) s.activate_node(arrays.position.data(), row);
  for (Index row = first_new; row < s.surface.node_count(); ++row) {
    if (s.holds[row].segment != kNone) s.activate_node(arrays.position.data(), row);
  }
  for (const Index edge : s.search.touched_edge_rows()) s.activate_edge(edge);
  s.edge_hits.resize(s.active_edges.size());
}

void SurfaceContact::Stages::need_nodes(std::span<const double> vectors, const char* name) const {
  require(vectors.size() % 3 == 0 && vectors.size() / 3 >= static_cast<std::size_t>(surface.node_limit()),
          std::string("'") + name + "' is of " + std::to_string(vectors.size() / 3) +
              " nodes, but contact segments name node " + numbered(surface.node_limit() - 1) +
              "; give arrays of all nodes");
}

std::span<const Index> SurfaceContact::nodes() const {
  return stages_->surface.nodes();
}
std::span<const Index> SurfaceContact::segments() const {
  return stages_->surface.segments();
}

Index SurfaceContact::segment_count() const {
  return stages_->surface.segment_count();
}
Index SurfaceContact::edge_count() const {
  return stages_->surface.edge_count();
}
Index SurfaceContact::node_count() const {
  return stages_->surface.node_count();
}
const ContactSearch& SurfaceContact::search() const {
  return stages_->search;
}

std::vector<SurfaceContact::Touch> SurfaceContact::touches() const {
  std::vector<Touch> all;
  stages_->for_each_pair([&](const TouchingPair& p, const Grip&) {
    all.push_back({p.nodes,
                   p.weights,
                   p.first_count,
                   p.count,
                   {p.normal.x, p.normal.y, p.normal.z},
                   p.gap,
                   {p.force.x, p.force.y, p.force.z},
                   {p.parts[0], p.parts[1]}});
  });
  return all;
}
std::size_t SurfaceContact::touching_count() const {
  std::size_t count = stages_->edge_touches.size();
  for (const Stages::Piece& piece : stages_->pieces) count += piece.touches.size();
  return count;
}
double SurfaceContact::stored_energy() const {
  double sum = 0;
  for (const BodyPair& bodies : stages_->body_pairs) sum += bodies.stored;
  return sum;
}
double SurfaceContact::friction_heat() const {
  double sum = 0;
  for (const BodyPair& bodies : stages_->body_pairs) sum += bodies.friction_heat;
  return sum;
}
double SurfaceContact::deepest_penetration() const {
  double deepest = 0;
  for (const BodyPair& bodies : stages_->body_pairs) deepest = std::max(deepest, bodies.deepest);
  return deepest;
}
std::span<const SurfaceContact::BodyPair> SurfaceContact::body_pairs() const {
  return stages_->body_pairs;
}

void SurfaceContact::name_parts(std::vector<std::string> names) {
  stages_->part_names = std::move(names);
}

std::vector<std::string> SurfaceContact::warnings() const {
  const Stages::Deepest& worst = stages_->worst;
  if (worst.share <= stages_->settings.penetration_warning) return {};
  const auto of_part = [&](Index part) {
    const bool named = part >= 0 && part < static_cast<Index>(stages_->part_names.size());
    return named ? " of part " + stages_->part_names[part] : std::string();
  };
  char depth[100];
  std::snprintf(depth, sizeof depth, " went %.3g m deep into element %d", worst.depth,
                static_cast<int>(worst.element));
  char share[100];
  std::snprintf(share, sizeof share, ", %.0f %% of that element's height; ", 100 * worst.share);
  return {(worst.edges ? "contact: an edge at node " : "contact: node ") + std::to_string(worst.node) +
          of_part(worst.parts[0]) + depth + of_part(worst.parts[1]) + share +
          "raise contact.penalty_factor or take smaller steps (contact.penetration_warning sets from which "
          "share on this is said)"};
}

std::size_t SurfaceContact::memory() const {
  const Stages& s = *stages_;
  std::size_t pieces = 0;
  for (const Stages::Piece& piece : s.pieces) {
    pieces += sizeof piece + piece.touches.capacity() * sizeof(TouchingPair) +
              piece.ended.capacity() * sizeof(GrippedPair) + piece.sums.bodies.capacity() * sizeof(BodyPair);
  }
  return s.surface.memory() + s.search.memory() + pieces + s.holds.capacity() * sizeof(Stages::Hold) +
         s.wake.capacity() * sizeof(double) + s.planes.capacity() * sizeof(Stages::Plane) +
         (s.edge_touches.capacity() + s.old_edge_touches.capacity()) * sizeof(GrippedPair);
}

FaceProjection project_on_face(std::span<const double, 3> point, std::span<const double> corners) {
  if (corners.size() != 9 && corners.size() != 12) {
    throw Error(Status::bad_argument, "project_on_face: a face has 3 or 4 corners, (3, 3) or (4, 3) values");
  }
  Vec3 x[4];
  for (std::size_t i = 0; i < corners.size() / 3; ++i) x[i] = Vec3::load(&corners[3 * i]);
  const Vec3 p = Vec3::load(point.data());
  const FacePoint f = corners.size() == 9 ? project_on_triangle(p, x) : project_on_quadrilateral(p, x);
  return {f.shape, {f.normal.x, f.normal.y, f.normal.z}, f.gap, f.outside};
}

}  // namespace cdfp
