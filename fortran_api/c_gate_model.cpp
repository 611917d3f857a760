#include <algorithm>
#include <array>

#include "c_gate.hpp"

using namespace cdfp;
using namespace cdfp::gate;

static_assert(int32_t(CohesiveKind::linear) == CDFP_LINEAR &&
              int32_t(CohesiveKind::camacho_ortiz) == CDFP_CAMACHO_ORTIZ &&
              int32_t(CohesiveKind::bilinear) == CDFP_BILINEAR && int32_t(CohesiveKind::user) == CDFP_USER);
static_assert(int32_t(StressRecovery::element_mean) == CDFP_ELEMENT_MEAN &&
              int32_t(StressRecovery::nodal) == CDFP_NODAL);
static_assert(int32_t(Formulation::one_point) == CDFP_ONE_POINT && int32_t(Formulation::full) == CDFP_FULL);

namespace {

void set_mesh(Model& model, int64_t nodes, const double* coordinates, std::size_t elements,
              const int32_t* types, std::span<const Index> connectivity, const int32_t* parts,
              const int32_t* layers) {
  const std::span<const double> x = vectors(coordinates, nodes, "coordinates");
  need_array(parts, static_cast<int64_t>(elements), "parts");
  model.mesh.types = element_types_of(elements, types, connectivity.size());
  model.mesh.coordinates.assign(x.begin(), x.end());
  model.mesh.connectivity.assign(connectivity.begin(), connectivity.end());
  model.mesh.parts.assign(parts, parts + elements);
  model.mesh.layers.assign(layers, layers ? layers + elements : nullptr);
}

std::array<double, 3> vector_or_zero(const double* v) {
  return v ? std::array<double, 3>{v[0], v[1], v[2]} : std::array<double, 3>{};
}

std::array<bool, 3> flags_or_none(const int32_t* f) {
  return f ? std::array<bool, 3>{f[0] != 0, f[1] != 0, f[2] != 0} : std::array<bool, 3>{};
}

}  // namespace

cdfp::CohesiveLaw cdfp::gate::law_of(const char* name, const cdfp_cohesive_law* law) {
  need(law, "law");
  need_number(law->kind, 4, "kind");
  return {.name = name,
          .strength = law->strength,
          .fracture_energy = law->fracture_energy,
          .mode_ratio = law->mode_ratio,
          .shear_ratio = law->shear_ratio,
          .friction = law->friction,
          .friction_exponent = law->friction_exponent,
          .internal_friction = law->internal_friction,
          .kind = static_cast<CohesiveKind>(law->kind),
          .stiffness = law->stiffness,
          .weibull_modulus = law->weibull_modulus,
          .weibull_area = law->weibull_area,
          .seed = law->seed,
          .rate_sensitivity = law->rate_sensitivity,
          .reference_rate = law->reference_rate};
}

void cdfp::gate::set_callback(CohesiveLaw& law, cdfp_cohesive_callback callback, std::int32_t states,
                              void* user_data) {
  if (!callback) refuse("argument 'callback' is null; give the function that computes the traction");
  law.states = states;
  law.callback = [callback, user_data](const CohesivePoints& p) {
    const cdfp_cohesive_points points = {.count = p.count,
                                         .time = p.time,
                                         .step = p.step,
                                         .opening = p.opening,
                                         .normal = p.normal,
                                         .insertion_traction = p.insertion_traction,
                                         .state = p.state,
                                         .traction = p.traction,
                                         .stored = p.stored,
                                         .damage = p.damage};
    callback(&points, user_data);
  };
}

int32_t cdfp_model_create(cdfp_model** model) {
  return guarded(__func__, [&] {
    need(model, "model");
    give(std::make_shared<Model>(), model);
  });
}

int32_t cdfp_model_free(cdfp_model** model) {
  return free_handle(__func__, model);
}

int32_t cdfp_model_set_title(cdfp_model* model, const char* title) {
  return guarded(__func__, [&] {
    need(title, "title");
    Change(model)->title = title;
  });
}

int32_t cdfp_model_set_mesh(cdfp_model* model, int64_t nodes, const double* coordinates, int64_t elements,
                            const int32_t* hexahedra, const int32_t* parts, const int32_t* layers) {
  return guarded(__func__, [&] {
    const Change m(model);
    need_array(hexahedra, elements, "hexahedra");
    const std::size_t e = size_of(elements, "elements");
    set_mesh(*m, nodes, coordinates, e, nullptr, {hexahedra, 8 * e}, parts, layers);
  });
}

int32_t cdfp_model_set_mixed_mesh(cdfp_model* model, int64_t nodes, const double* coordinates,
                                  int64_t elements, const int32_t* types, int64_t corners,
                                  const int32_t* connectivity, const int32_t* parts, const int32_t* layers) {
  return guarded(__func__, [&] {
    const Change m(model);
    const std::size_t e = size_of(elements, "elements");
    const std::size_t c = size_of(corners, "corners");
    need_array(types, elements, "types");
    need_array(connectivity, corners, "connectivity");
    set_mesh(*m, nodes, coordinates, e, types, {connectivity, c}, parts, layers);
  });
}

int32_t cdfp_model_add_node_set(cdfp_model* model, const char* name, int64_t count, const int32_t* nodes) {
  return guarded(__func__, [&] {
    const Change m(model);
    const std::size_t n = size_of(count, "count");
    need_array(nodes, count, "nodes");
    m->mesh.node_sets.push_back({name_of(name, "name"), {nodes, nodes + n}});
  });
}

int32_t cdfp_model_add_facet_set(cdfp_model* model, const char* name, int64_t count, const int32_t* facets) {
  return guarded(__func__, [&] {
    const Change m(model);
    const std::size_t n = size_of(count, "count");
    need_array(facets, count, "facets");
    FacetSet set{name_of(name, "name"), std::vector<FacetUse>(n)};
    for (std::size_t i = 0; i < n; ++i) set.facets[i] = {facets[2 * i], facets[2 * i + 1]};
    m->mesh.facet_sets.push_back(std::move(set));
  });
}

int32_t cdfp_model_add_elastic_material(cdfp_model* model, const char* name, double density,
                                        double youngs_modulus, double poissons_ratio) {
  return guarded(__func__, [&] {
    Change(model)->materials.push_back(
        {name_of(name, "name"),
         ElasticMaterial{
             .density = density, .youngs_modulus = youngs_modulus, .poissons_ratio = poissons_ratio}});
  });
}

int32_t cdfp_model_add_rate_dependent_material(cdfp_model* model, const char* name, double density,
                                               double poissons_ratio, double static_modulus,
                                               double rate_modulus, double rate_exponent,
                                               double smoothing_time) {
  return guarded(__func__, [&] {
    Change(model)->materials.push_back(
        {name_of(name, "name"), RateDependentMaterial{.density = density,
                                                      .poissons_ratio = poissons_ratio,
                                                      .static_modulus = static_modulus,
                                                      .rate_modulus = rate_modulus,
                                                      .rate_exponent = rate_exponent,
                                                      .smoothing_time = smoothing_time}});
  });
}

int32_t cdfp_model_add_rigid_material(cdfp_model* model, const char* name, double density,
                                      double youngs_modulus, double poissons_ratio) {
  return guarded(__func__, [&] {
    Change(model)->materials.push_back(
        {name_of(name, "name"),
         RigidMaterial{
             .density = density, .youngs_modulus = youngs_modulus, .poissons_ratio = poissons_ratio}});
  });
}

int32_t cdfp_cohesive_law_default(cdfp_cohesive_law* law) {
  return guarded(__func__, [&] {
    need(law, "law");
    const CohesiveLaw d;
    *law = {.strength = d.strength,
            .fracture_energy = d.fracture_energy,
            .mode_ratio = d.mode_ratio,
            .shear_ratio = d.shear_ratio,
            .friction = d.friction,
            .friction_exponent = d.friction_exponent,
            .internal_friction = d.internal_friction,
            .stiffness = d.stiffness,
            .weibull_modulus = d.weibull_modulus,
            .weibull_area = d.weibull_area,
            .rate_sensitivity = d.rate_sensitivity,
            .reference_rate = d.reference_rate,
            .seed = d.seed,
            .kind = static_cast<int32_t>(d.kind)};
  });
}

int32_t cdfp_model_add_cohesive_law(cdfp_model* model, const char* name, const cdfp_cohesive_law* law) {
  return guarded(__func__, [&] {
    const Change m(model);
    m->cohesive_laws.push_back(law_of(name_of(name, "name").c_str(), law));
  });
}

int32_t cdfp_model_set_cohesive_callback(cdfp_model* model, const char* cohesive_law,
                                         cdfp_cohesive_callback callback, int32_t states, void* user_data) {
  return guarded(__func__, [&] {
    const Change m(model);
    const std::string name = name_of(cohesive_law, "cohesive_law");
    const auto law = std::find_if(m->cohesive_laws.begin(), m->cohesive_laws.end(),
                                  [&](const CohesiveLaw& l) { return l.name == name; });
    if (law == m->cohesive_laws.end()) refuse("there is no cohesive law '" + name + "'; add it first");
    set_callback(*law, callback, states, user_data);
  });
}

int32_t cdfp_model_add_bond(cdfp_model* model, const char* first_part, const char* second_part,
                            const char* cohesive_law) {
  return guarded(__func__, [&] {
    const Change m(model);
    m->bonds.push_back({.facet_set = {},
                        .parts = {name_of(first_part, "first_part"), name_of(second_part, "second_part")},
                        .cohesive_law = name_of(cohesive_law, "cohesive_law")});
  });
}

int32_t cdfp_model_add_bonded_facets(cdfp_model* model, const char* facet_set, const char* cohesive_law) {
  return guarded(__func__, [&] {
    const Change m(model);
    m->bonds.push_back({.facet_set = name_of(facet_set, "facet_set"),
                        .parts = {},
                        .cohesive_law = name_of(cohesive_law, "cohesive_law")});
  });
}

int32_t cdfp_model_set_stress_recovery(cdfp_model* model, int32_t recovery) {
  return guarded(__func__, [&] {
    const Change m(model);
    need_number(recovery, 2, "recovery");
    m->stress_recovery = static_cast<StressRecovery>(recovery);
  });
}

int32_t cdfp_model_set_strength_shares(cdfp_model* model, int64_t count, const double* shares) {
  return guarded(__func__, [&] {
    const Change m(model);
    const std::size_t n = size_of(count, "count");
    need_array(shares, count, "shares");
    m->strength_shares.assign(shares, shares + n);
  });
}

int32_t cdfp_model_add_part(cdfp_model* model, const char* name, const char* material, int32_t formulation,
                            double hourglass, const char* cohesive_law) {
  return guarded(__func__, [&] {
    const Change m(model);
    if (formulation != CDFP_ONE_POINT && formulation != CDFP_FULL) {
      refuse("formulation is " + std::to_string(formulation) + "; take CDFP_ONE_POINT or CDFP_FULL");
    }
    Part part{.name = name_of(name, "name"),
              .material = name_of(material, "material"),
              .formulation = static_cast<Formulation>(formulation),
              .hourglass = hourglass,
              .cohesive_law = cohesive_law ? cohesive_law : ""};
    m->mesh.part_names.push_back(part.name);
    m->parts.push_back(std::move(part));
  });
}

int32_t cdfp_model_add_rigid_body(cdfp_model* model, const char* part, double mass, const double* inertia,
                                  const double* velocity, const double* angular_velocity,
                                  const int32_t* translation_fixed, const int32_t* rotation_fixed) {
  return guarded(__func__, [&] {
    RigidBody body;
    body.part = name_of(part, "part");
    body.mass = mass;
    if (inertia) std::copy_n(inertia, 9, body.inertia.emplace().begin());
    body.velocity = vector_or_zero(velocity);
    body.angular_velocity = vector_or_zero(angular_velocity);
    body.translation_fixed = flags_or_none(translation_fixed);
    body.rotation_fixed = flags_or_none(rotation_fixed);
    Change(model)->rigid_bodies.push_back(std::move(body));
  });
}

int32_t cdfp_model_add_symmetry_plane(cdfp_model* model, int32_t axis, double coordinate) {
  return guarded(__func__, [&] {
    const Change m(model);
    need_number(axis, 3, "axis");
    m->symmetry_planes.push_back({axis, coordinate});
  });
}

int32_t cdfp_model_add_prescribed_velocity(cdfp_model* model, const char* node_set, const int32_t* directions,
                                           int64_t count, const double* times, const double* values) {
  return guarded(__func__, [&] {
    const Change m(model);
    const std::size_t n = size_of(count, "count");
    need(directions, "directions");
    need_array(values, count, "values");
    if (!times && n != 1) {
      refuse("argument 'times' is null with " + std::to_string(n) +
             " values; without times there is one value, which holds for good");
    }
    PrescribedVelocity prescribed{name_of(node_set, "node_set"), flags_or_none(directions), {}, {}};
    if (times) prescribed.times.assign(times, times + n);
    prescribed.values.assign(values, values + n);
    m->prescribed_velocities.push_back(std::move(prescribed));
  });
}

int32_t cdfp_model_add_initial_velocity(cdfp_model* model, const char* part, const double* velocity,
                                        const double* gradient) {
  return guarded(__func__, [&] {
    const Change m(model);
    need(velocity, "velocity");
    InitialVelocity initial{name_of(part, "part"), vector_or_zero(velocity), {}};
    if (gradient) std::copy_n(gradient, 9, initial.gradient.begin());
    m->initial_velocities.push_back(std::move(initial));
  });
}

int32_t cdfp_model_set_gravity(cdfp_model* model, const double* gravity) {
  return guarded(__func__, [&] {
    const Change m(model);
    need(gravity, "gravity");
    m->gravity = vector_or_zero(gravity);
  });
}

int32_t cdfp_model_set_load_callback(cdfp_model* model, cdfp_load_callback callback, void* user_data) {
  return guarded(__func__, [&] {
    const Change m(model);
    if (!callback) refuse("argument 'callback' is null; give the function that adds the forces");
    m->load = [callback, user_data](const NodalLoad& l) {
      const cdfp_nodal_load load = {
          .nodes = l.nodes, .time = l.time, .position = l.position, .velocity = l.velocity, .force = l.force};
      callback(&load, user_data);
    };
  });
}

int32_t cdfp_model_add_contact_surface(cdfp_model* model, const char* facet_set) {
  return guarded(__func__,
                 [&] { Change(model)->contact.surfaces.push_back(name_of(facet_set, "facet_set")); });
}

int32_t cdfp_model_get_contact(const cdfp_model* model, cdfp_contact_settings* settings) {
  return guarded(__func__, [&] {
    const Look m(model);
    set(settings, shown(m->contact), "settings");
  });
}

int32_t cdfp_model_set_contact(cdfp_model* model, const cdfp_contact_settings* settings) {
  return guarded(__func__, [&] { take_settings(settings, Change(model)->contact); });
}

int32_t cdfp_model_set_end_time(cdfp_model* model, double end) {
  return guarded(__func__, [&] { Change(model)->time.end = end; });
}

int32_t cdfp_model_set_fixed_step(cdfp_model* model, double fixed_step) {
  return guarded(__func__, [&] { Change(model)->time.fixed_step = fixed_step; });
}

int32_t cdfp_model_set_step_factor(cdfp_model* model, double step_factor) {
  return guarded(__func__, [&] { Change(model)->time.step_factor = step_factor; });
}

int32_t cdfp_model_set_history_interval(cdfp_model* model, int64_t history_interval) {
  return guarded(__func__, [&] { Change(model)->output.history_interval = history_interval; });
}

int32_t cdfp_model_set_threads(cdfp_model* model, int32_t threads) {
  return guarded(__func__, [&] { Change(model)->threads = threads; });
}
