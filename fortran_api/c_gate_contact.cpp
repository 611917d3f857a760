#include <algorithm>
#include <array>
#include <cmath>

#include "c_gate.hpp"
#include "core/numbered.hpp"

using namespace cdfp;
using namespace cdfp::gate;

static_assert(int32_t(SurfaceContact::Search::none) == CDFP_SEARCH_NONE &&
              int32_t(SurfaceContact::Search::regular) == CDFP_SEARCH_REGULAR &&
              int32_t(SurfaceContact::Search::adaptive) == CDFP_SEARCH_ADAPTIVE);

namespace {

void need_finite(std::span<const double> x, std::span<const Index> nodes, const char* what) {
  for (const Index n : nodes) {
    const double* v = &x[3 * static_cast<std::size_t>(n)];
    if (std::isfinite(v[0] + v[1] + v[2])) continue;
    refuse("the " + std::string(what) + " of node " + numbered(n) +
           " is not finite; the state is lost: take a smaller step");
  }
}

void show(const PairRows& pairs, Rows& rows, const int32_t** start, const int32_t** partners,
          int64_t* count) {
  need(start, "start");
  need(partners, "partners");
  need(count, "rows");
  pairs.compress(rows.start, rows.partners);
  if (rows.start.empty()) rows.start.push_back(0);
  *start = rows.start.data();
  *partners = rows.partners.data();
  *count = static_cast<int64_t>(rows.start.size()) - 1;
}

void need_nodes(std::span<const Index> given, std::size_t nodes, bool triangles, const char* name) {
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] >= 0 && given[i] < static_cast<Index>(nodes)) continue;
    if (triangles && i % 4 == 3 && given[i] == kNone) continue;
    refuse("'" + std::string(name) + "' names node " + numbered(given[i]) + "; there are " +
           std::to_string(nodes) + ", counted from " + numbered(0));
  }
}

SurfaceView surface_view(int64_t nodes, const double* position, int64_t contact_node_count,
                         const int32_t* contact_nodes, int64_t segment_count, const int32_t* segments,
                         int64_t edge_count, const int32_t* edges, const int32_t* groups) {
  const std::size_t n = size_of(nodes, "nodes");
  const std::size_t c = size_of(contact_node_count, "contact_node_count");
  const std::size_t s = size_of(segment_count, "segment_count");
  const std::size_t e = size_of(edge_count, "edge_count");
  need_array(contact_nodes, contact_node_count, "contact_nodes");
  need_array(segments, segment_count, "segments");
  need_array(edges, edge_count, "edges");
  SurfaceView view;
  view.position = vectors(position, nodes, "position");
  view.nodes = {contact_nodes, c};
  view.segments = {segments, 4 * s};
  view.edges = {edges, 2 * e};
  if (groups) view.groups = {groups, n};
  need_nodes(view.nodes, n, false, "contact_nodes");
  need_nodes(view.segments, n, true, "segments");
  need_nodes(view.edges, n, false, "edges");
  need_finite(view.position, view.nodes, "position");
  for (std::size_t i = 0; i < s; ++i) {
    need_finite(view.position, view.segments.subspan(4 * i, view.segments[4 * i + 3] == kNone ? 3 : 4),
                "position");
  }
  return view;
}

void remember_size(Held<cdfp_contact_search>::Object& search, const SurfaceView& view) {
  search.nodes = static_cast<Index>(view.nodes.size());
  search.segments = static_cast<Index>(view.segments.size() / 4);
  search.edges = static_cast<Index>(view.edges.size() / 2);
}

void need_growth(std::size_t now, Index before, const char* what) {
  if (now >= static_cast<std::size_t>(before)) return;
  refuse("there are " + std::to_string(now) + " " + what + ", but the last search knew " +
         std::to_string(before) + "; append new ones, or make a regular search");
}

SurfaceContact::Arrays positions_of(int64_t nodes, const double* position, const int32_t* groups) {
  SurfaceContact::Arrays arrays;
  arrays.position = vectors(position, nodes, "position");
  if (groups) arrays.group = {groups, size_of(nodes, "nodes")};
  return arrays;
}

/// The nodes that the arrays have of those of the surface; `SurfaceContact` refuses if some are missing.
std::span<const Index> nodes_within(const SurfaceContact& contact, int64_t nodes) {
  const std::span<const Index> all = contact.nodes();
  const bool within = std::all_of(all.begin(), all.end(), [nodes](Index n) { return n < nodes; });
  return within ? all : std::span<const Index>();
}

}  // namespace

void cdfp::gate::take_settings(const cdfp_contact_settings* given, ContactSettings& settings) {
  need(given, "settings");
  settings.cell_factor = given->cell_factor;
  settings.buffer_factor = given->buffer_factor;
  settings.penalty_factor = given->penalty_factor;
  settings.friction = given->friction;
  settings.depth_limit = given->depth_limit;
  settings.penetration_warning = given->penetration_warning;
  settings.edge_edge = given->edge_edge != 0;
  settings.adaptive = given->adaptive != 0;
}

cdfp_contact_settings cdfp::gate::shown(const ContactSettings& settings) {
  return {.cell_factor = settings.cell_factor,
          .buffer_factor = settings.buffer_factor,
          .penalty_factor = settings.penalty_factor,
          .friction = settings.friction,
          .depth_limit = settings.depth_limit,
          .penetration_warning = settings.penetration_warning,
          .edge_edge = settings.edge_edge,
          .adaptive = settings.adaptive};
}

int32_t cdfp_contact_search_create(double cell_factor, double buffer_factor, int32_t adaptive,
                                   cdfp_contact_search** search) {
  return guarded(__func__, [&] {
    need(search, "search");
    give(std::make_shared<Held<cdfp_contact_search>::Object>(Held<cdfp_contact_search>::Object{
             ContactSearch(cell_factor, buffer_factor, adaptive != 0), 0, 0, 0, {}, {}}),
         search);
  });
}

int32_t cdfp_contact_search_free(cdfp_contact_search** search) {
  return free_handle(__func__, search);
}

int32_t cdfp_contact_search_regular(cdfp_contact_search* search, int64_t nodes, const double* position,
                                    int64_t contact_node_count, const int32_t* contact_nodes,
                                    int64_t segment_count, const int32_t* segments, int64_t edge_count,
                                    const int32_t* edges, const int32_t* groups, int32_t threads) {
  return guarded(__func__, [&] {
    const Change s(search);
    const SurfaceView view = surface_view(nodes, position, contact_node_count, contact_nodes, segment_count,
                                          segments, edge_count, edges, groups);
    s->search.regular(view, threads);
    remember_size(*s, view);
  });
}

int32_t cdfp_contact_search_adaptive(cdfp_contact_search* search, int64_t nodes, const double* position,
                                     int64_t contact_node_count, const int32_t* contact_nodes,
                                     int64_t segment_count, const int32_t* segments, int64_t edge_count,
                                     const int32_t* edges, const int32_t* groups,
                                     int64_t renamed_segment_count, const int32_t* renamed_segments,
                                     int64_t renamed_edge_count, const int32_t* renamed_edges) {
  return guarded(__func__, [&] {
    const Change s(search);
    const SurfaceView view = surface_view(nodes, position, contact_node_count, contact_nodes, segment_count,
                                          segments, edge_count, edges, groups);
    need_growth(view.nodes.size(), s->nodes, "contact nodes");
    need_growth(view.segments.size() / 4, s->segments, "segments");
    need_growth(view.edges.size() / 2, s->edges, "edges");
    const std::size_t rs = size_of(renamed_segment_count, "renamed_segment_count");
    const std::size_t re = size_of(renamed_edge_count, "renamed_edge_count");
    need_array(renamed_segments, renamed_segment_count, "renamed_segments");
    need_array(renamed_edges, renamed_edge_count, "renamed_edges");
    for (std::size_t i = 0; i < rs; ++i) need_number(renamed_segments[i], segment_count, "segment");
    for (std::size_t i = 0; i < re; ++i) need_number(renamed_edges[i], edge_count, "edge");
    s->search.adaptive(view, {renamed_segments, rs}, {renamed_edges, re});
    remember_size(*s, view);
  });
}

int32_t cdfp_contact_search_due(cdfp_contact_search* search, double largest_speed, double step,
                                int32_t* due) {
  return guarded(__func__, [&] {
    const Change s(search);
    need(due, "due");
    if (!(largest_speed >= 0) || !(step >= 0)) {
      refuse("largest_speed is " + std::to_string(largest_speed) + " and step " + std::to_string(step) +
             "; neither may be negative or no number");
    }
    *due = int32_t{s->search.due(largest_speed, step)};
  });
}

int32_t cdfp_contact_search_lengths(const cdfp_contact_search* search, double* cell, double* buffer,
                                    double* travel) {
  return guarded(__func__, [&] {
    const Look s(search);
    set(cell, s->search.cell_length(), "cell");
    set(buffer, s->search.buffer(), "buffer");
    set(travel, s->search.travel(), "travel");
  });
}

int32_t cdfp_contact_search_node_segments(cdfp_contact_search* search, const int32_t** start,
                                          const int32_t** partners, int64_t* rows) {
  return guarded(__func__, [&] {
    const Change s(search);
    show(s->search.node_segments(), s->node_segments, start, partners, rows);
  });
}

int32_t cdfp_contact_search_edge_edges(cdfp_contact_search* search, const int32_t** start,
                                       const int32_t** partners, int64_t* rows) {
  return guarded(__func__, [&] {
    const Change s(search);
    show(s->search.edge_edges(), s->edge_edges, start, partners, rows);
  });
}

int32_t cdfp_project_on_face(const double* point, int64_t corners, const double* coordinates, double* shape,
                             double* normal, double* gap, double* outside) {
  return guarded(__func__, [&] {
    need(point, "point");
    need(coordinates, "coordinates");
    need(shape, "shape");
    need(normal, "normal");
    if (corners != 3 && corners != 4) {
      refuse("a face has 3 or 4 corners, not " + std::to_string(corners));
    }
    const std::size_t n = 3 * static_cast<std::size_t>(corners);
    const auto finite = [](double v) { return std::isfinite(v); };
    if (!std::all_of(coordinates, coordinates + n, finite) || !std::all_of(point, point + 3, finite)) {
      refuse("'point' or 'coordinates' is not finite");
    }
    const FaceProjection found = project_on_face(std::span<const double, 3>(point, 3), {coordinates, n});
    std::copy(found.shape.begin(), found.shape.end(), shape);
    std::copy(found.normal.begin(), found.normal.end(), normal);
    set(gap, found.gap, "gap");
    set(outside, found.outside, "outside");
  });
}

int32_t cdfp_contact_settings_default(cdfp_contact_settings* settings) {
  return guarded(__func__, [&] { set(settings, shown(ContactSettings()), "settings"); });
}

int32_t cdfp_contact_create(const cdfp_contact_settings* settings, cdfp_contact** contact) {
  return guarded(__func__, [&] {
    need(contact, "contact");
    ContactSettings given;
    take_settings(settings, given);
    give(std::make_shared<Held<cdfp_contact>::Object>(
             Held<cdfp_contact>::Object{SurfaceContact(given), {}, {}, {}, {}, {}}),
         contact);
  });
}

int32_t cdfp_contact_free(cdfp_contact** contact) {
  return free_handle(__func__, contact);
}

int32_t cdfp_contact_name_part(cdfp_contact* contact, int32_t part, const char* name) {
  return guarded(__func__, [&] {
    const Change c(contact);
    need(name, "name");
    if (part < 0) refuse("there is no part " + numbered(part) + "; parts count from " + numbered(0));
    if (c->part_names.size() <= static_cast<std::size_t>(part)) c->part_names.resize(part + 1);
    c->part_names[part] = name;
    c->contact.name_parts(c->part_names);
  });
}

int32_t cdfp_contact_add_segments(cdfp_contact* contact, int64_t count, const int32_t* segments,
                                  const int32_t* elements, const int32_t* parts, const double* bulk_modulus,
                                  const double* area, const double* volume) {
  return guarded(__func__, [&] {
    const Change c(contact);
    const std::size_t n = size_of(count, "count");
    need_array(segments, count, "segments");
    need_array(elements, count, "elements");
    need_array(parts, count, "parts");
    need_array(bulk_modulus, count, "bulk_modulus");
    need_array(area, count, "area");
    need_array(volume, count, "volume");
    for (std::size_t i = 0; i < n; ++i) {
      SurfaceContact::Segment segment;
      std::copy_n(segments + 4 * i, 4, segment.nodes.begin());
      segment.element = elements[i];
      segment.part = parts[i];
      segment.bulk_modulus = bulk_modulus[i];
      segment.area = area[i];
      segment.volume = volume[i];
      c->contact.add_segment(segment);
    }
  });
}

int32_t cdfp_contact_add_facets(cdfp_contact* contact, const cdfp_topology* topology, int64_t nodes,
                                const double* coordinates, int64_t count, const int32_t* facets,
                                int64_t elements, const int32_t* parts, int64_t part_count,
                                const double* bulk_modulus) {
  return guarded(__func__, [&] {
    const Change c(contact);
    const Look t(topology);
    const std::size_t n = size_of(count, "count");
    const std::size_t e = size_of(elements, "elements");
    const std::size_t p = size_of(part_count, "part_count");
    need_array(facets, count, "facets");
    need_array(parts, elements, "parts");
    need_array(bulk_modulus, part_count, "bulk_modulus");
    std::vector<FacetUse> uses(n);
    for (std::size_t i = 0; i < n; ++i) uses[i] = {facets[2 * i], facets[2 * i + 1]};
    c->contact.add_facets(
        {t->topology, vectors(coordinates, nodes, "coordinates"), {parts, e}, {bulk_modulus, p}}, uses);
  });
}

int32_t cdfp_contact_follow(cdfp_contact* contact, int64_t new_node_count, const int32_t* new_nodes,
                            int64_t renumbered_count, const int32_t* renumbered) {
  return guarded(__func__, [&] {
    const Change c(contact);
    const Changes changes(new_node_count, new_nodes, renumbered_count, renumbered);
    c->contact.follow(changes.new_nodes, changes.renumbered);
  });
}

int32_t cdfp_contact_remove_elements(cdfp_contact* contact, int64_t count, const int32_t* elements) {
  return guarded(__func__, [&] {
    const Change c(contact);
    const std::size_t n = size_of(count, "count");
    need_array(elements, count, "elements");
    for (std::size_t i = 0; i < n; ++i) c->contact.remove_element(elements[i]);
  });
}

int32_t cdfp_contact_due(cdfp_contact* contact, int64_t nodes, const double* velocity, double step,
                         int32_t threads, int32_t* search) {
  return guarded(__func__, [&] {
    const Change c(contact);
    need(search, "search");
    if (!(step > 0)) refuse("the step is " + std::to_string(step) + "; it must be positive");
    SurfaceContact::Arrays arrays;
    arrays.velocity = vectors(velocity, nodes, "velocity");
    need_finite(arrays.velocity, nodes_within(c->contact, nodes), "velocity");
    *search = static_cast<int32_t>(c->contact.due(arrays, step, threads));
  });
}

int32_t cdfp_contact_regular_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                    const int32_t* groups, int32_t threads) {
  return guarded(__func__, [&] {
    const Change c(contact);
    const SurfaceContact::Arrays arrays = positions_of(nodes, position, groups);
    need_finite(arrays.position, nodes_within(c->contact, nodes), "position");
    c->contact.regular_search(arrays, threads);
  });
}

int32_t cdfp_contact_adaptive_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                     const int32_t* groups) {
  return guarded(__func__, [&] {
    const Change c(contact);
    const SurfaceContact::Arrays arrays = positions_of(nodes, position, groups);
    need_finite(arrays.position, nodes_within(c->contact, nodes), "position");
    c->contact.adaptive_search(arrays);
  });
}

int32_t cdfp_contact_local_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                  int32_t threads) {
  return guarded(__func__, [&] {
    const Change c(contact);
    c->contact.local_search(positions_of(nodes, position, nullptr), threads);
  });
}

int32_t cdfp_contact_add_force(cdfp_contact* contact, int64_t nodes, const double* velocity,
                               const double* mass, double* force, double step, int32_t threads) {
  return guarded(__func__, [&] {
    const Change c(contact);
    need_array(mass, nodes, "mass");
    SurfaceContact::Arrays arrays;
    arrays.velocity = vectors(velocity, nodes, "velocity");
    arrays.mass = {mass, size_of(nodes, "nodes")};
    arrays.force = vectors(force, nodes, "force");
    c->contact.add_force(arrays, step, threads);
  });
}

int32_t cdfp_contact_counts(const cdfp_contact* contact, int64_t* nodes, int64_t* segments, int64_t* edges,
                            int64_t* touching) {
  return guarded(__func__, [&] {
    const Look c(contact);
    set(nodes, int64_t{c->contact.node_count()}, "nodes");
    set(segments, int64_t{c->contact.segment_count()}, "segments");
    set(edges, int64_t{c->contact.edge_count()}, "edges");
    set(touching, static_cast<int64_t>(c->contact.touching_count()), "touching");
  });
}

int32_t cdfp_contact_nodes(const cdfp_contact* contact, const int32_t** nodes, int64_t* count) {
  return guarded(__func__, [&] {
    const Look c(contact);
    need(nodes, "nodes");
    need(count, "count");
    *nodes = c->contact.nodes().data();
    *count = static_cast<int64_t>(c->contact.nodes().size());
  });
}

int32_t cdfp_contact_node_segments(cdfp_contact* contact, const int32_t** start, const int32_t** partners,
                                   int64_t* rows) {
  return guarded(__func__, [&] {
    const Change c(contact);
    show(c->contact.search().node_segments(), c->node_segments, start, partners, rows);
  });
}

int32_t cdfp_contact_edge_edges(cdfp_contact* contact, const int32_t** start, const int32_t** partners,
                                int64_t* rows) {
  return guarded(__func__, [&] {
    const Change c(contact);
    show(c->contact.search().edge_edges(), c->edge_edges, start, partners, rows);
  });
}

int32_t cdfp_contact_touches(cdfp_contact* contact, const cdfp_touch** touches, int64_t* count) {
  return guarded(__func__, [&] {
    const Change c(contact);
    need(touches, "touches");
    need(count, "count");
    c->touches.clear();
    for (const SurfaceContact::Touch& t : c->contact.touches()) {
      cdfp_touch& touch = c->touches.emplace_back();
      std::copy(t.weights.begin(), t.weights.end(), touch.weights);
      std::copy(t.normal.begin(), t.normal.end(), touch.normal);
      touch.gap = t.gap;
      std::copy(t.force.begin(), t.force.end(), touch.force);
      std::fill_n(touch.nodes, 5, kNone);
      std::copy_n(t.nodes.begin(), t.count, touch.nodes);
      touch.first_count = t.first_count;
      touch.count = t.count;
      std::copy_n(t.parts, 2, touch.parts);
    }
    *touches = c->touches.data();
    *count = static_cast<int64_t>(c->touches.size());
  });
}

int32_t cdfp_contact_body_pairs(cdfp_contact* contact, const cdfp_body_pair** pairs, int64_t* count) {
  return guarded(__func__, [&] {
    const Change c(contact);
    need(pairs, "pairs");
    need(count, "count");
    c->pairs.clear();
    for (const SurfaceContact::BodyPair& p : c->contact.body_pairs()) {
      c->pairs.push_back({.force = {p.force[0], p.force[1], p.force[2]},
                          .stored = p.stored,
                          .friction_heat = p.friction_heat,
                          .peak_force = p.peak_force,
                          .deepest = p.deepest,
                          .parts = {p.parts[0], p.parts[1]}});
    }
    *pairs = c->pairs.data();
    *count = static_cast<int64_t>(c->pairs.size());
  });
}

int32_t cdfp_contact_energies(const cdfp_contact* contact, double* stored, double* friction_heat,
                              double* deepest) {
  return guarded(__func__, [&] {
    const Look c(contact);
    set(stored, c->contact.stored_energy(), "stored");
    set(friction_heat, c->contact.friction_heat(), "friction_heat");
    set(deepest, c->contact.deepest_penetration(), "deepest");
  });
}

int32_t cdfp_contact_stiffness_over_mass(const cdfp_contact* contact, double* stiffness_over_mass) {
  return guarded(__func__, [&] {
    set(stiffness_over_mass, Look(contact)->contact.stiffness_over_mass(), "stiffness_over_mass");
  });
}

int32_t cdfp_contact_warning_count(const cdfp_contact* contact, int64_t* count) {
  return guarded(
      __func__, [&] { set(count, static_cast<int64_t>(Look(contact)->contact.warnings().size()), "count"); });
}

int32_t cdfp_contact_warning(const cdfp_contact* contact, int64_t warning, char* text, int64_t capacity,
                             int64_t* length) {
  return guarded(__func__, [&] {
    const std::vector<std::string> warnings = Look(contact)->contact.warnings();
    need_number(warning, static_cast<int64_t>(warnings.size()), "warning");
    copy_text(warnings[warning], text, capacity, length);
  });
}
