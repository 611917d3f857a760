#include <algorithm>
#include <cstddef>

#include "c_gate.hpp"
#include "core/numbered.hpp"

using namespace cdfp;
using namespace cdfp::gate;

static_assert(sizeof(cdfp_cohesive_point) == sizeof(CohesivePoint) &&
                  offsetof(cdfp_cohesive_point, dissipated) == offsetof(CohesivePoint, dissipated) &&
                  offsetof(cdfp_cohesive_point, opening) == offsetof(CohesivePoint, opening) &&
                  offsetof(cdfp_cohesive_point, insertion_traction) ==
                      offsetof(CohesivePoint, insertion_traction),
              "points cross the door in place");

namespace {

/// The caller's points and vectors, (count, 3).
struct Given {
  Given(const cdfp_cohesive_law* given, int64_t count, const double* normals,
        const cdfp_cohesive_point* given_points)
      : law(law_of("law", given)), n(size_of(count, "count")) {
    need_array(normals, count, "normal");
    need_array(given_points, count, "points");
    normal = {normals, 3 * n};
    for (std::size_t i = 0; i < n; ++i) {
      const double* v = normals + 3 * i;
      const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
      if (!(square > 0.99 && square < 1.01)) {
        refuse("the normal of point " + numbered(i) + " is not of length 1; normalise it");
      }
    }
  }
  std::span<const double> vectors_of(const double* data, const char* name) const {
    need_array(data, static_cast<int64_t>(n), name);
    return {data, 3 * n};
  }
  CohesiveLaw law;
  std::size_t n;
  std::span<const double> normal;
};

/// A law over the caller's points, in place.
template <class Law>
void follow_law(const Given& given, const Law& law, const double* opening, cdfp_cohesive_point* points,
                double* traction) {
  need_array(traction, static_cast<int64_t>(given.n), "traction");
  const std::span<const double> openings = given.vectors_of(opening, "opening");
  for (std::size_t i = 0; i < given.n; ++i) {
    if (!(points[i].strength > 0)) {
      refuse("point " + numbered(i) + " has no strength; start it by cdfp_cohesive_law_start");
    }
  }
  law(given.law, openings, given.normal, {reinterpret_cast<CohesivePoint*>(points), given.n},
      {traction, 3 * given.n});
}

}  // namespace

int32_t cdfp_cohesive_law_start(const cdfp_cohesive_law* law, int64_t count, const double* traction,
                                const double* normal, cdfp_cohesive_point* points) {
  return guarded(__func__, [&] {
    const Given given(law, count, normal, points);
    start_cohesive(given.law, given.vectors_of(traction, "traction"), given.normal,
                   {reinterpret_cast<CohesivePoint*>(points), given.n});
  });
}

int32_t cdfp_cohesive_law_traction(const cdfp_cohesive_law* law, int64_t count, const double* opening,
                                   const double* normal, cdfp_cohesive_point* points, double* traction) {
  return guarded(__func__, [&] {
    follow_law(Given(law, count, normal, points), cohesive_traction, opening, points, traction);
  });
}

int32_t cdfp_cohesive_law_mean_traction(const cdfp_cohesive_law* law, int64_t count, const double* opening,
                                        const double* normal, cdfp_cohesive_point* points, double* traction) {
  return guarded(__func__, [&] {
    follow_law(Given(law, count, normal, points), cohesive_mean_traction, opening, points, traction);
  });
}

int32_t cdfp_cohesive_law_stored(const cdfp_cohesive_law* law, int64_t count, const double* normal,
                                 const cdfp_cohesive_point* points, double* stored) {
  return guarded(__func__, [&] {
    const Given given(law, count, normal, points);
    need_array(stored, count, "stored");
    const auto* own = reinterpret_cast<const CohesivePoint*>(points);
    for (std::size_t i = 0; i < given.n; ++i) {
      stored[i] = cohesive_stored(given.law, own[i], std::span<const double, 3>(normal + 3 * i, 3));
    }
  });
}

int32_t cdfp_cohesive_create(int32_t first_element, cdfp_cohesive** cohesive) {
  return guarded(__func__, [&] {
    need(cohesive, "cohesive");
    give(std::make_shared<Held<cdfp_cohesive>::Object>(
             Held<cdfp_cohesive>::Object{CohesiveElements(first_element), {}, {}, {}, {}, {}}),
         cohesive);
  });
}

int32_t cdfp_cohesive_free(cdfp_cohesive** cohesive) {
  return free_handle(__func__, cohesive);
}

namespace {

void add_law(Held<cdfp_cohesive>::Object& cohesive, const CohesiveLaw& law, int32_t* number) {
  need(number, "number");
  *number = cohesive.elements.add_law(law);
  cohesive.laws.push_back(law);
}

}  // namespace

int32_t cdfp_cohesive_add_law(cdfp_cohesive* cohesive, const cdfp_cohesive_law* law, int32_t* number) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    add_law(*c, law_of(numbered(std::ssize(c->laws)).c_str(), law), number);
  });
}

int32_t cdfp_cohesive_add_user_law(cdfp_cohesive* cohesive, const cdfp_cohesive_law* law,
                                   cdfp_cohesive_callback callback, int32_t states, void* user_data,
                                   int32_t* number) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    CohesiveLaw given = law_of(numbered(std::ssize(c->laws)).c_str(), law);
    given.kind = CohesiveKind::user;
    set_callback(given, callback, states, user_data);
    add_law(*c, given, number);
  });
}

int32_t cdfp_cohesive_hold(cdfp_cohesive* cohesive, int64_t count, const int32_t* nodes,
                           const int32_t* directions) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    const std::size_t n = size_of(count, "count");
    need_array(nodes, count, "nodes");
    need(directions, "directions");
    c->elements.hold({nodes, n}, {directions[0] != 0, directions[1] != 0, directions[2] != 0});
  });
}

int32_t cdfp_cohesive_set_parts(cdfp_cohesive* cohesive, const cdfp_topology* topology, int64_t nodes,
                                const double* coordinates, int64_t elements, const int32_t* parts,
                                int64_t part_count, const int32_t* law_of_part, int32_t recovery,
                                const double* strength_shares) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    const Look t(topology);
    const std::size_t e = size_of(elements, "elements");
    const std::size_t p = size_of(part_count, "part_count");
    need_array(parts, elements, "parts");
    need_array(law_of_part, part_count, "law_of_part");
    need_number(recovery, 2, "recovery");
    CohesiveCriterion::Settings settings;
    settings.laws = c->laws;
    settings.parts.assign(parts, parts + e);
    settings.law_of_part.assign(law_of_part, law_of_part + p);
    settings.recovery = static_cast<StressRecovery>(recovery);
    settings.strength_shares.assign(strength_shares, strength_shares ? strength_shares + e : nullptr);
    c->criterion.emplace(t->topology, vectors(coordinates, nodes, "coordinates"), settings);
  });
}

int32_t cdfp_cohesive_find_open(cdfp_cohesive* cohesive, const cdfp_topology* topology, int64_t nodes,
                                const double* position, int64_t elements, const double* stress,
                                int32_t threads, const int32_t** facets, const double** tractions,
                                int64_t* count) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    const Look t(topology);
    need(facets, "facets");
    need(tractions, "tractions");
    need(count, "count");
    const std::size_t e = size_of(elements, "elements");
    need_array(stress, elements, "stress");
    if (!c->criterion) {
      throw Error(Status::bad_state, "no parts are known; call cdfp_cohesive_set_parts first");
    }
    c->criterion->find(t->topology, vectors(position, nodes, "position"), {stress, 6 * e}, c->open, threads);
    c->facets.clear();
    c->tractions.clear();
    for (const CohesiveCriterion::Opening& open : c->open) {
      c->facets.insert(c->facets.end(), {open.lower.element, open.lower.facet, open.law});
      c->tractions.insert(c->tractions.end(), open.traction.begin(), open.traction.end());
    }
    *facets = c->facets.data();
    *tractions = c->tractions.data();
    *count = static_cast<int64_t>(c->open.size());
  });
}

int32_t cdfp_cohesive_follow(cdfp_cohesive* cohesive, int64_t new_node_count, const int32_t* new_nodes,
                             int64_t renumbered_count, const int32_t* renumbered) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    const Changes changes(new_node_count, new_nodes, renumbered_count, renumbered);
    c->elements.follow(changes.new_nodes, changes.renumbered);
  });
}

int32_t cdfp_cohesive_insert(cdfp_cohesive* cohesive, int32_t element, int32_t law, int64_t corners,
                             const int32_t* connectivity, const double* traction, int64_t nodes,
                             const double* position, double time) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    const std::size_t n = size_of(corners, "corners");
    need_array(connectivity, corners, "connectivity");
    std::array<double, 3> carried{};
    if (traction) std::copy_n(traction, 3, carried.begin());
    c->elements.insert(element, law, {connectivity, n}, carried, vectors(position, nodes, "position"), time);
  });
}

int32_t cdfp_cohesive_add_force(cdfp_cohesive* cohesive, int64_t nodes, const double* position,
                                const double* velocity, const double* mass, double* force, double step,
                                double time, int32_t threads) {
  return guarded(__func__, [&] {
    const Change c(cohesive);
    need_array(mass, nodes, "mass");
    c->elements.add_force({vectors(position, nodes, "position"),
                           vectors(velocity, nodes, "velocity"),
                           {mass, size_of(nodes, "nodes")},
                           vectors(force, nodes, "force")},
                          step, time, threads);
  });
}

int32_t cdfp_cohesive_count(const cdfp_cohesive* cohesive, int64_t* elements, int64_t* broken) {
  return guarded(__func__, [&] {
    const Look c(cohesive);
    set(elements, int64_t{c->elements.count()}, "elements");
    set(broken, int64_t{c->elements.broken_count()}, "broken");
  });
}

int32_t cdfp_cohesive_broken_now(const cdfp_cohesive* cohesive, const int32_t** elements, int64_t* count) {
  return guarded(__func__, [&] {
    const Look c(cohesive);
    need(elements, "elements");
    need(count, "count");
    const std::span<const Index> broken = c->elements.broken_now();
    *elements = broken.data();
    *count = static_cast<int64_t>(broken.size());
  });
}

int32_t cdfp_cohesive_pairs(const cdfp_cohesive* cohesive, int32_t element, cdfp_cohesive_pair* pairs,
                            int64_t* count) {
  return guarded(__func__, [&] {
    const Look c(cohesive);
    need(pairs, "pairs");
    need(count, "count");
    const Index corners = c->elements.corner_count(element);
    for (Index i = 0; i < corners; ++i) {
      const CohesivePointState p = c->elements.point(element, i);
      pairs[i] = {.area = p.area,
                  .strength = p.strength,
                  .reach = p.reach,
                  .largest = p.largest,
                  .damage = p.damage,
                  .stored = p.stored,
                  .dissipated = p.dissipated,
                  .upper = p.upper,
                  .lower = p.lower};
    }
    *count = corners;
  });
}

int32_t cdfp_cohesive_energies(const cdfp_cohesive* cohesive, double* stored, double* dissipated,
                               double* friction, double* by_law) {
  return guarded(__func__, [&] {
    const CohesiveElements::Energy energy = Look(cohesive)->elements.energy();
    set(stored, energy.stored, "stored");
    set(dissipated, energy.dissipated, "dissipated");
    set(friction, energy.friction, "friction");
    set(by_law, energy.by_law, "by_law");
  });
}

int32_t cdfp_cohesive_stiffness_over_mass(const cdfp_cohesive* cohesive, int64_t nodes, const double* mass,
                                          double* stiffness_over_mass) {
  return guarded(__func__, [&] {
    const Look c(cohesive);
    const std::size_t n = size_of(nodes, "nodes");
    need_array(mass, nodes, "mass");
    set(stiffness_over_mass, c->elements.stiffness_over_mass({mass, n}), "stiffness_over_mass");
  });
}
