/// Which candidates touch: a node goes to one face, edges meet edges (section 4.2, appendices E and F).
#include <algorithm>
#include <cmath>
#include <limits>

#include "cdfp/error.hpp"
#include "contact/stages.hpp"

namespace cdfp {

namespace {

/// A face is met from its front: the node's own surface must look against it by at least this cosine. It
/// keeps nodes from faces beside them (neighbours across a fresh crack, walls that they slide along).
constexpr double kFacing = 0.1;
/// Slack past a face's border, over its radius, so that neighbours leave no gap between them.
constexpr double kBorder = 1e-6;
/// A node under a concave ridge projects past both faces, by less than its depth; so far a face still takes
/// it.
constexpr double kRidge = 0.02;
/// A loaded node that slides off a border where nothing else takes it (blocks stacked edge over edge) stays
/// with its face so far, over the face's radius: to let go would lose what its springs hold.
constexpr double kOverhang = 0.1;
/// Gaps above this share of the radius (with its sign) are rounding.
constexpr double kNoGap = -1e-11;
constexpr double kLeastSine = 0.05;
constexpr double kOutOfCone = 0.1;

Vec3 at(const double* x, Index node) {
  return Vec3::load(x + 3 * static_cast<std::size_t>(node));
}

}  // namespace

Vec3 SurfaceContact::Stages::segment_normal(const double* x, Index segment) const {
  const Index* c = surface.corners(segment);
  const Vec3 a = at(x, c[0]), b = at(x, c[1]), d = at(x, c[2]);
  const Vec3 n = c[3] == kNone ? cross(b - a, d - a) : cross(d - a, at(x, c[3]) - b);  // E.1: sum of corners
  const double length = norm(n);
  return length > 0 ? n / length : Vec3{};
}

double SurfaceContact::Stages::segment_radius(const double* x, Index segment) const {
  const Index* c = surface.corners(segment);
  const int count = c[3] == kNone ? 3 : 4;
  Vec3 centre;
  for (int i = 0; i < count; ++i) centre += at(x, c[i]) / count;
  double radius = 0;
  for (int i = 0; i < count; ++i) radius = std::max(radius, norm(at(x, c[i]) - centre));
  return radius;
}

void SurfaceContact::Stages::place_plane(const double* x, Index segment) {
  const Index* c = surface.corners(segment);
  const Vec3 a = at(x, c[0]), b = at(x, c[1]), d = at(x, c[2]);
  Plane& face = planes[segment];
  Vec3 n;
  if (c[3] == kNone) {
    n = cross(b - a, d - a);
    face.centre = (a + b + d) / 3;
  } else {
    const Vec3 e = at(x, c[3]);
    n = cross(d - a, e - b);
    face.centre = 0.25 * (a + b + d + e);
  }
  const double nn = dot(n, n);
  face.normal = nn > 0 ? n / std::sqrt(nn) : Vec3{};
  face.warp = std::abs(dot(face.normal, a - face.centre));
}

FacePoint SurfaceContact::Stages::project(const double* x, Vec3 p, Index segment, double xi,
                                          double eta) const {
  const Index* c = surface.corners(segment);
  const Vec3 corner[4] = {at(x, c[0]), at(x, c[1]), at(x, c[2]), c[3] == kNone ? Vec3{} : at(x, c[3])};
  return c[3] == kNone ? project_on_triangle(p, corner) : project_on_quadrilateral(p, corner, xi, eta);
}

/// Mean of the unit normals of the node's own faces.
Vec3 SurfaceContact::Stages::node_normal(const double* x, Index row) const {
  Vec3 sum;
  surface.for_each_incident(row, [&](Index segment) { sum += segment_normal(x, segment); });
  const double length = norm(sum);
  return length > 0 ? sum / length : Vec3{};
}

bool SurfaceContact::Stages::shares_element(Index row, Index segment) const {
  bool shares = false;
  surface.for_each_incident(
      row, [&](Index own) { shares |= surface.data(own).element == surface.data(segment).element; });
  return shares;
}

TouchingPair SurfaceContact::Stages::node_pair(Index row, Index segment, const FacePoint& point) const {
  const Index* c = surface.corners(segment);
  const std::array<double, 4>& shape = point.shape;
  TouchingPair pair;
  pair.nodes = {surface.nodes()[row], c[0], c[1], c[2], c[3]};
  pair.count = c[3] == kNone ? 4 : 5;
  pair.weights = {1, -shape[0], -shape[1], -shape[2], -shape[3]};
  pair.first = row;
  pair.second = segment;
  pair.parts = {surface.part(row), surface.data(segment).part};
  pair.gap = point.gap;
  pair.height = surface.data(segment).height;
  pair.normal = point.normal;
  return pair;
}

void SurfaceContact::Stages::let_go(Index row, const FacePoint& under_held, Piece& piece) {
  Hold& hold = holds[row];
  if (hold.segment != kNone) piece.ended.push_back({node_pair(row, hold.segment, under_held), hold.grip});
  hold = Hold{};
}

/// The pair is fresh unless the face holds the node already.
void SurfaceContact::Stages::touch(Index row, Index segment, const FacePoint& point, Piece& piece) {
  Hold& hold = holds[row];
  piece.touches.push_back(node_pair(row, segment, point));
  if (hold.segment == segment) piece.touches.back().origin = TouchingPair::Origin::same;
  hold.segment = segment;
  hold.piece = static_cast<Index>(&piece - pieces.data());
  hold.place = static_cast<Index>(piece.touches.size()) - 1;
  hold.xi = static_cast<float>(point.xi), hold.eta = static_cast<float>(point.eta);
}

void SurfaceContact::Stages::look_at_node(const double* x, Index row, Piece& piece) {
  const double travel = search.travel();
  if (wake[row] > travel) return;
  const Vec3 p = at(x, surface.nodes()[row]);

  // The face that holds the node keeps it while it stays under it.
  const Index held = holds[row].segment;
  FacePoint under_held;
  bool overhangs = false;
  if (held != kNone) {
    under_held = project(x, p, held, holds[row].xi, holds[row].eta);
    const double radius = planes[held].radius;
    const bool behind = under_held.gap < kNoGap * radius && under_held.gap > -surface.data(held).height;
    if (behind && under_held.outside <= kBorder * radius - under_held.gap) {
      touch(row, held, under_held, piece);
      return;
    }
    overhangs = behind && holds[row].grip.pressed < 0 && under_held.outside <= kOverhang * radius;
  }

  struct {
    Index segment = kNone;
    FacePoint point;
  } hit;
  bool have_normal = false;
  Vec3 own_normal;
  double best = std::numeric_limits<double>::infinity();
  double room = std::numeric_limits<double>::infinity();
  search.node_segments().for_each(row, [&](Index segment) {
    const Plane& face = planes[segment];
    const Vec3 from_centre = p - face.centre;
    const double height = dot(face.normal, from_centre);
    const double above = height - face.warp;
    // Most candidates leave here, those that rest on the face with no gap among them.
    if (above > kNoGap * face.radius) {
      room = std::min(room, std::max(above, 0.0));
      return;
    }
    const double deepest_gap = settings.depth_limit * surface.data(segment).height;
    const double below = -height - face.warp - deepest_gap;
    if (below > 0) {
      room = std::min(room, below);
      return;
    }
    const double reach = (1 + kRidge) * (face.radius + travel);
    const double distance2 = dot(from_centre, from_centre);
    if (distance2 > (reach + deepest_gap) * (reach + deepest_gap)) {
      room = std::min(room, (std::sqrt(distance2) - reach - deepest_gap) / (1 + kRidge));
      return;
    }
    if (!have_normal) {
      own_normal = node_normal(x, row);
      have_normal = true;
    }
    if (dot(own_normal, face.normal) > 0.3) {  // turned away; to turn back takes movement
      room = std::min(room, 0.05 * face.radius);
      return;
    }
    const FacePoint point = project(x, p, segment);
    if (point.gap > kNoGap * face.radius) {
      room = std::min(room, std::max(point.gap, 0.0));
      return;
    }
    room = std::min(room, std::max(0.0, point.outside - kRidge * face.radius));
    const double facing = -dot(own_normal, point.normal);
    const bool under = point.outside <= kBorder * face.radius;
    const bool under_ridge =
        point.outside <= std::min(-point.gap, kRidge * face.radius) && -point.gap <= kRidge * face.radius;
    if (facing < kFacing || point.gap < -deepest_gap || !(under || under_ridge)) return;
    const double way_out = -point.gap / facing;
    if (way_out < best * (1 - 1e-9) && !shares_element(row, segment)) {
      best = way_out;
      hit = {segment, point};
    }
  });
  if (hit.segment == kNone && overhangs) hit = {held, under_held};
  if (hit.segment != held) let_go(row, under_held, piece);
  wake[row] = hit.segment == kNone ? travel + room : 0;
  if (hit.segment != kNone) touch(row, hit.segment, hit.point, piece);
}

/// Appendix F, with the normal held inside both edges' cones of face normals: only then does the way out of
/// the other body lead over the two edges. `room`: lowered to the travel before which the pair can't touch.
bool SurfaceContact::Stages::edges_touch(const double* x, Index m, Index n, double& room,
                                         TouchingPair* touch) const {
  const Index *ab = surface.ends(m), *cd = surface.ends(n);
  const Vec3 a = at(x, ab[0]), b = at(x, ab[1]), c = at(x, cd[0]), d = at(x, cd[1]);
  const Vec3 between = 0.5 * (a + b - c - d);
  const double length_ab = norm(b - a), length_cd = norm(d - c), shorter = std::min(length_ab, length_cd);
  const double reach = 0.5 * (length_ab + length_cd);
  const double distance2 = dot(between, between);
  if (distance2 > reach * reach) {
    room = std::min(room, std::sqrt(distance2) - reach);
    return false;
  }
  if (surface.is_removed_edge(m) || surface.is_removed_edge(n)) return false;
  const LineCrossing crossing = cross_lines(a, b, c, d);
  if (crossing.sine < kLeastSine) {
    room = std::min(room, crossing.sine < 0.6 * kLeastSine ? 0.01 * shorter : 0.0);
    return false;
  }
  const Surface::EdgeData &first = surface.edge_data(m), &second = surface.edge_data(n);
  const Vec3 n1 = segment_normal(x, first.segments[0]), n2 = segment_normal(x, first.segments[1]);
  const Vec3 n3 = segment_normal(x, second.segments[0]), n4 = segment_normal(x, second.segments[1]);
  const Vec3 normal = dot(crossing.normal, n3 + n4 - n1 - n2) < 0 ? -crossing.normal : crossing.normal;
  const double out_of_cone = std::max({dot(normal, n1), dot(normal, n2), -dot(normal, n3), -dot(normal, n4)});
  if (out_of_cone > kOutOfCone) {
    room = std::min(room, out_of_cone > kOutOfCone + 0.2 ? 0.02 * shorter * crossing.sine : 0.0);
    return false;
  }
  const double gap = dot(normal, a + crossing.s * (b - a) - c - crossing.t * (d - c));
  const double deepest_gap = settings.depth_limit * std::min(first.height, second.height);
  if (gap > kNoGap * shorter || gap < -deepest_gap) {
    room = std::min(room, std::max({gap, -gap - deepest_gap, 0.0}));
    return false;
  }
  room = 0;
  constexpr double slack = 1e-9;
  if (std::min(crossing.s, crossing.t) < -slack || std::max(crossing.s, crossing.t) > 1 + slack) return false;
  if (touch != nullptr) {
    *touch = TouchingPair{};
    touch->nodes = {ab[0], ab[1], cd[0], cd[1], kNone};
    touch->weights = {1 - crossing.s, crossing.s, crossing.t - 1, -crossing.t, 0};
    touch->first_count = 2;
    touch->count = 4;
    touch->first = m;
    touch->second = n;
    touch->parts = {surface.data(first.segments[0]).part, surface.data(second.segments[0]).part};
    touch->normal = normal;
    touch->gap = gap;
    touch->height = std::min(first.height, second.height);
  }
  return true;
}

void SurfaceContact::Stages::look_at_edge(const double* x, Index active) {
  const Index edge = active_edges[active];
  std::array<Index, 4>& partners = edge_hits[active];
  partners.fill(kNone);
  const double travel = search.travel();
  if (edge_wake[edge] > travel) return;
  double room = std::numeric_limits<double>::infinity();
  std::size_t found = 0;
  search.edge_edges().for_each(edge, [&](Index other) {
    if (edges_touch(x, edge, other, room, nullptr) && found < partners.size()) partners[found++] = other;
  });
  edge_wake[edge] = travel + room;
}

void SurfaceContact::local_search(const Arrays& arrays, int threads) {
  Stages& s = *stages_;
  s.need_nodes(arrays.position, "position");
  if (s.surface.node_count() > s.searched_nodes || s.surface.segment_count() > s.searched_segments) {
    throw Error(Status::bad_state,
                "contact: the surface has grown since the last search; ask `due` in every step and make the "
                "search that it names before the local one");
  }
  const double* x = arrays.position.data();

  ++s.stamp;
  const std::int64_t faces = static_cast<std::int64_t>(s.active_segments.size());
  share_out(threads, faces, [&](std::int64_t i) { s.place_plane(x, s.active_segments[i]); });
  const std::int64_t nodes = static_cast<std::int64_t>(s.active_nodes.size());
  s.pieces.resize(static_cast<std::size_t>((nodes + Stages::kPiece - 1) / Stages::kPiece));
  Threads(threads).deal_ranges(nodes, Stages::kPiece, [&](std::int64_t begin, std::int64_t end) {
    Stages::Piece& piece = s.pieces[begin / Stages::kPiece];
    piece.touches.clear();
    piece.ended.clear();
    for (std::int64_t i = begin; i < end; ++i) s.look_at_node(x, s.active_nodes[i], piece);
  });

  const std::int64_t edges = static_cast<std::int64_t>(s.active_edges.size());
  share_out(threads, edges, [&](std::int64_t i) { s.look_at_edge(x, static_cast<Index>(i)); });
  s.hit_edges.clear();
  for (std::int64_t i = 0; i < edges; ++i) {
    for (const Index partner : s.edge_hits[i]) {
      if (partner == kNone) break;
      s.hit_edges.push_back({s.active_edges[i], partner});
    }
  }
  std::sort(s.hit_edges.begin(), s.hit_edges.end());
  std::swap(s.edge_touches, s.old_edge_touches);
  s.edge_touches.resize(s.hit_edges.size());
  share_out(threads, static_cast<std::int64_t>(s.hit_edges.size()), [&](std::int64_t i) {
    double room = 0;
    s.edge_touches[i].grip = Grip{};
    s.edges_touch(x, s.hit_edges[i][0], s.hit_edges[i][1], room, &s.edge_touches[i].pair);
  });
  s.hand_over();
}

}  // namespace cdfp
