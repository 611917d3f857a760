// Every field of a model can be set through the C interface, and results come out of it as they are. The
// structured bindings count the fields: who adds one to a C++ struct is sent here, and from here to cdfp/c.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../../fortran_api/c_gate.hpp"
#include "cdfp/laminated_plate.hpp"

using namespace cdfp;

namespace {

using Vector = std::array<double, 3>;
using Flags = std::array<bool, 3>;

class Fields : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(cdfp_model_create(&handle_), CDFP_OK); }
  void TearDown() override { cdfp_model_free(&handle_); }
  const Model& model() const { return *gate::Look(handle_); }

  cdfp_model* handle_ = nullptr;
};

TEST_F(Fields, Mesh) {
  const double x[] = {1, 2, 3, 4, 5, 6};
  const int32_t hexahedron[] = {0, 1, 0, 1, 0, 1, 0, 1};
  const int32_t part = 0, layer = 4, nodes[] = {1, 0}, facets[] = {0, 5, 0, 2};
  ASSERT_EQ(cdfp_model_set_mesh(handle_, 2, x, 1, hexahedron, &part, &layer), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_node_set(handle_, "nodes", 2, nodes), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_facet_set(handle_, "facets", 2, facets), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_part(handle_, "part", "m", CDFP_FULL, 0.5, "law"), CDFP_OK);

  const auto& [coordinates, types, connectivity, parts, layers, part_names, node_sets, facet_sets] =
      model().mesh;
  EXPECT_EQ(coordinates, std::vector<double>(x, x + 6));
  EXPECT_EQ(types, std::vector{ElementType::hexahedron});
  EXPECT_EQ(connectivity, std::vector<Index>(hexahedron, hexahedron + 8));
  EXPECT_EQ(parts, std::vector<Index>{0});
  EXPECT_EQ(layers, std::vector<Index>{4});
  EXPECT_EQ(part_names, std::vector<std::string>{"part"});
  ASSERT_EQ(node_sets.size(), 1u);
  EXPECT_EQ(node_sets[0].name, "nodes");
  EXPECT_EQ(node_sets[0].nodes, (std::vector<Index>{1, 0}));
  ASSERT_EQ(facet_sets.size(), 1u);
  EXPECT_EQ(facet_sets[0].name, "facets");
  EXPECT_EQ(facet_sets[0].facets, (std::vector<FacetUse>{{0, 5}, {0, 2}}));

  ASSERT_EQ(cdfp_model_set_mesh(handle_, 2, x, 1, hexahedron, &part, nullptr), CDFP_OK);
  EXPECT_TRUE(model().mesh.layers.empty());
  EXPECT_EQ(model().mesh.node_sets.size(), 1u);
}

TEST_F(Fields, Materials) {
  ASSERT_EQ(cdfp_model_add_elastic_material(handle_, "elastic", 1, 2, 3), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_rate_dependent_material(handle_, "rate", 1, 2, 3, 4, 5, 6), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_rigid_material(handle_, "rigid", 4, 5, 6), CDFP_OK);
  ASSERT_EQ(model().materials.size(), 3u);
  static_assert(std::variant_size_v<decltype(Material::law)> == 4);  // users': below
  {
    const auto& [name, law] = model().materials[0];
    const auto& [density, youngs_modulus, poissons_ratio] = std::get<ElasticMaterial>(law);
    EXPECT_EQ(name, "elastic");
    EXPECT_EQ((Vector{density, youngs_modulus, poissons_ratio}), (Vector{1, 2, 3}));
  }
  {
    const auto& [density, poissons_ratio, static_modulus, rate_modulus, rate_exponent, smoothing_time] =
        std::get<RateDependentMaterial>(model().materials[1].law);
    EXPECT_EQ((Vector{density, poissons_ratio, static_modulus}), (Vector{1, 2, 3}));
    EXPECT_EQ((Vector{rate_modulus, rate_exponent, smoothing_time}), (Vector{4, 5, 6}));
  }
  {
    const auto& [density, youngs_modulus, poissons_ratio] = std::get<RigidMaterial>(model().materials[2].law);
    EXPECT_EQ((Vector{density, youngs_modulus, poissons_ratio}), (Vector{4, 5, 6}));
  }
}

TEST_F(Fields, UserMaterials) {
  cdfp_user_material given;
  ASSERT_EQ(cdfp_user_material_default(&given), CDFP_OK);
  EXPECT_EQ(given.deletion_state, -1);
  const double numbers[] = {5, 6};
  given = {1, 2, 3, numbers, 2, 4, 3, 1};
  const auto law = [](const cdfp_material_points* points, void* user_data) {
    *static_cast<std::int64_t*>(user_data) = points->count;
  };
  std::int64_t asked = 0;
  ASSERT_EQ(cdfp_model_add_user_material(handle_, "user", &given, law, &asked), CDFP_OK);
  ASSERT_EQ(cdfp_model_set_state_name(handle_, "user", 1, "heat"), CDFP_OK);
  const auto& [density, youngs_modulus, poissons_ratio, states, properties, state_names, deletion_state,
               thread_safe, callback, warnings] = std::get<UserMaterial>(model().materials.at(0).law);
  EXPECT_EQ((Vector{density, youngs_modulus, poissons_ratio}), (Vector{1, 2, 3}));
  EXPECT_EQ(properties, (std::vector<double>{5, 6}));
  EXPECT_EQ(states, 4);
  EXPECT_EQ(deletion_state, 3);
  EXPECT_TRUE(thread_safe);
  EXPECT_EQ(state_names, (std::vector<std::string>{"state_1", "heat"}));
  EXPECT_FALSE(warnings);
  MaterialPoints points{};
  points.count = 7;
  callback(points);
  EXPECT_EQ(asked, 7);
  EXPECT_EQ(cdfp_model_add_user_material(handle_, "user", &given, nullptr, nullptr), CDFP_BAD_ARGUMENT);
  EXPECT_EQ(cdfp_model_add_user_material(handle_, "user", nullptr, law, nullptr), CDFP_BAD_ARGUMENT);
  EXPECT_EQ(cdfp_model_add_user_material(handle_, "", &given, law, nullptr), CDFP_BAD_ARGUMENT);
  given.property_count = -1;
  EXPECT_EQ(cdfp_model_add_user_material(handle_, "user", &given, law, nullptr), CDFP_BAD_ARGUMENT);
  given.property_count = 2;
  given.properties = nullptr;
  EXPECT_EQ(cdfp_model_add_user_material(handle_, "user", &given, law, nullptr), CDFP_BAD_ARGUMENT);
  EXPECT_EQ(cdfp_model_set_state_name(handle_, "user", 4, "x"), CDFP_BAD_ARGUMENT);
  EXPECT_EQ(cdfp_model_set_state_name(handle_, "nobody", 0, "x"), CDFP_BAD_ARGUMENT);
  cdfp_vumat vumat;
  ASSERT_EQ(cdfp_vumat_default(&vumat), CDFP_OK);
  given.property_count = 0;
  EXPECT_EQ(cdfp_model_add_vumat_material(handle_, "v", &given, &vumat, "/nowhere.so"), CDFP_IO);
  EXPECT_EQ(cdfp_model_add_library_material(handle_, "v", &given, "/nowhere.so", "law"), CDFP_IO);
  EXPECT_EQ(cdfp_build_material("/nowhere.f", "/tmp/nowhere.so", 0), CDFP_IO);
  EXPECT_EQ(model().materials.size(), 1u);
}

TEST_F(Fields, PartsAndCohesiveLaws) {
  ASSERT_EQ(cdfp_model_add_part(handle_, "part", "m", CDFP_FULL, 0.5, "law"), CDFP_OK);
  {
    const auto& [name, material, formulation, hourglass, cohesive_law] = model().parts.at(0);
    EXPECT_EQ(name + material + cohesive_law, "partmlaw");
    EXPECT_EQ(formulation, Formulation::full);
    EXPECT_EQ(hourglass, 0.5);
  }
  const cdfp_cohesive_law given = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 13, 11, CDFP_USER};
  ASSERT_EQ(cdfp_model_add_cohesive_law(handle_, "law", &given), CDFP_OK);
  {
    const auto& [name, strength, fracture_energy, mode_ratio, shear_ratio, friction, friction_exponent,
                 internal_friction, kind, stiffness, weibull_modulus, weibull_area, seed, rate_sensitivity,
                 reference_rate, states, callback] = model().cohesive_laws.at(0);
    EXPECT_EQ(kind, CohesiveKind::user);
    EXPECT_EQ((Vector{stiffness, weibull_modulus, weibull_area}), (Vector{8, 9, 10}));
    EXPECT_EQ(seed, 11);
    EXPECT_EQ(states, 0);
    EXPECT_FALSE(callback);
    EXPECT_EQ(name, "law");
    EXPECT_EQ((Vector{strength, fracture_energy, mode_ratio}), (Vector{1, 2, 3}));
    EXPECT_EQ((Vector{shear_ratio, friction, friction_exponent}), (Vector{4, 5, 6}));
    EXPECT_EQ(internal_friction, 7);
    EXPECT_EQ((Vector{rate_sensitivity, reference_rate}), (Vector{12, 13}));
  }
  int asked = 0;
  const auto law = [](const cdfp_cohesive_points* points, void* user_data) {
    *static_cast<int*>(user_data) = static_cast<int>(points->count);
    points->damage[0] = points->opening[0] + points->normal[0] + points->insertion_traction[0] +
                        points->state[0] + points->traction[0] + points->stored[0] + points->time +
                        points->step;
  };
  ASSERT_EQ(cdfp_model_set_cohesive_callback(handle_, "law", law, 5, &asked), CDFP_OK);
  EXPECT_EQ(model().cohesive_laws.at(0).states, 5);
  double one[] = {1}, two[] = {2}, four[] = {4}, eight[] = {8}, sixteen[] = {16}, more[] = {32},
         damage[] = {0};
  model().cohesive_laws.at(0).callback({7, 64, 128, one, two, four, eight, sixteen, more, damage});
  EXPECT_EQ(asked, 7);
  EXPECT_EQ(damage[0], 255);
  EXPECT_EQ(cdfp_model_set_cohesive_callback(handle_, "other", law, 5, &asked), CDFP_BAD_ARGUMENT);

  ASSERT_EQ(cdfp_model_add_bond(handle_, "glass", "pvb", "law"), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_bonded_facets(handle_, "faces", "law"), CDFP_OK);
  EXPECT_EQ(model().bonds.at(0).parts, (std::array<std::string, 2>{"glass", "pvb"}));
  EXPECT_EQ(model().bonds.at(0).cohesive_law + model().bonds.at(0).facet_set, "law");
  EXPECT_EQ(model().bonds.at(1).facet_set + model().bonds.at(1).cohesive_law, "faceslaw");
  ASSERT_EQ(cdfp_model_set_stress_recovery(handle_, CDFP_NODAL), CDFP_OK);
  EXPECT_EQ(model().stress_recovery, StressRecovery::nodal);
  EXPECT_EQ(cdfp_model_set_stress_recovery(handle_, 2), CDFP_BAD_ARGUMENT);
  ASSERT_EQ(cdfp_model_set_strength_shares(handle_, 1, two), CDFP_OK);
  EXPECT_EQ(model().strength_shares, std::vector<double>{2});

  cdfp_cohesive_law standard = {};
  ASSERT_EQ(cdfp_cohesive_law_default(&standard), CDFP_OK);
  EXPECT_EQ((Vector{standard.mode_ratio, standard.shear_ratio, standard.friction_exponent}),
            (Vector{1, 1, 1}));
}

TEST_F(Fields, Motion) {
  const double inertia[] = {1, 2, 3, 4, 5, 6, 7, 8, 9}, v[] = {1, 2, 3}, w[] = {4, 5, 6}, times[] = {0, 1};
  const int32_t x[] = {1, 0, 0}, z[] = {0, 0, 1};
  ASSERT_EQ(cdfp_model_add_rigid_body(handle_, "body", 2.5, inertia, v, w, x, z), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_rigid_body(handle_, "body", 2.5, nullptr, nullptr, nullptr, nullptr, nullptr),
            CDFP_OK);
  ASSERT_EQ(cdfp_model_add_symmetry_plane(handle_, 2, 7), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_prescribed_velocity(handle_, "nodes", z, 2, times, v), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_initial_velocity(handle_, "part", w, inertia), CDFP_OK);
  {
    const auto& [part, mass, moments, velocity, angular_velocity, translation_fixed, rotation_fixed] =
        model().rigid_bodies.at(0);
    EXPECT_EQ(part, "body");
    EXPECT_EQ(mass, 2.5);
    EXPECT_EQ(moments, (std::array<double, 9>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(velocity, (Vector{1, 2, 3}));
    EXPECT_EQ(angular_velocity, (Vector{4, 5, 6}));
    EXPECT_EQ(translation_fixed, (Flags{true, false, false}));
    EXPECT_EQ(rotation_fixed, (Flags{false, false, true}));
  }
  EXPECT_FALSE(model().rigid_bodies.at(1).inertia.has_value());
  EXPECT_EQ(model().rigid_bodies.at(1).velocity, Vector{});
  EXPECT_EQ(model().rigid_bodies.at(1).rotation_fixed, Flags{});
  {
    const auto& [axis, coordinate] = model().symmetry_planes.at(0);
    EXPECT_EQ(axis, 2);
    EXPECT_EQ(coordinate, 7);
  }
  {
    const auto& [node_set, directions, when, values] = model().prescribed_velocities.at(0);
    EXPECT_EQ(node_set, "nodes");
    EXPECT_EQ(directions, (Flags{false, false, true}));
    EXPECT_EQ(when, (std::vector<double>{0, 1}));
    EXPECT_EQ(values, (std::vector<double>{1, 2}));
  }
  {
    const auto& [part, velocity, gradient] = model().initial_velocities.at(0);
    EXPECT_EQ(gradient, (std::array<double, 9>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(part, "part");
    EXPECT_EQ(velocity, (Vector{4, 5, 6}));
  }
}

TEST_F(Fields, Settings) {
  const double g[] = {1, 2, 3};
  const cdfp_contact_settings contact_given = {1, 2, 3, 4, 5, 6, 0, 0};
  cdfp_contact_settings back = {};
  ASSERT_EQ(cdfp_model_set_title(handle_, "title"), CDFP_OK);
  ASSERT_EQ(cdfp_model_set_gravity(handle_, g), CDFP_OK);
  ASSERT_EQ(cdfp_model_add_contact_surface(handle_, "faces"), CDFP_OK);
  ASSERT_EQ(cdfp_model_get_contact(handle_, &back), CDFP_OK);
  EXPECT_TRUE(back.edge_edge && back.adaptive);
  ASSERT_EQ(cdfp_model_set_contact(handle_, &contact_given), CDFP_OK);
  ASSERT_EQ(cdfp_model_get_contact(handle_, &back), CDFP_OK);
  EXPECT_EQ((Vector{back.cell_factor, back.buffer_factor, back.depth_limit}), (Vector{1, 2, 5}));
  EXPECT_EQ(back.penetration_warning, 6);
  EXPECT_FALSE(back.edge_edge || back.adaptive);
  ASSERT_EQ(cdfp_model_set_end_time(handle_, 6), CDFP_OK);
  ASSERT_EQ(cdfp_model_set_fixed_step(handle_, 7), CDFP_OK);
  ASSERT_EQ(cdfp_model_set_step_factor(handle_, 8), CDFP_OK);
  ASSERT_EQ(cdfp_model_set_history_interval(handle_, 9), CDFP_OK);
  ASSERT_EQ(cdfp_model_set_threads(handle_, 10), CDFP_OK);

  const auto& [title, mesh, materials, parts, laws, bonds, recovery, shares, bodies, planes, prescribed,
               initial, gravity, load, contact, time, output, threads] = model();
  EXPECT_FALSE(load);
  EXPECT_EQ(title, "title");
  EXPECT_EQ(gravity, (Vector{1, 2, 3}));
  EXPECT_EQ(threads, 10);
  {
    const auto& [surfaces, cell, buffer, penalty, friction, depth, warning, edge_edge, adaptive] = contact;
    EXPECT_EQ(surfaces, std::vector<std::string>{"faces"});
    EXPECT_EQ((Vector{cell, buffer, penalty}), (Vector{1, 2, 3}));
    EXPECT_EQ(friction, 4);
    EXPECT_EQ((Vector{depth, warning}), (Vector{5, 6}));
    EXPECT_FALSE(edge_edge || adaptive);
  }
  {
    const auto& [end, fixed_step, step_factor] = time;
    EXPECT_EQ((Vector{end, fixed_step, step_factor}), (Vector{6, 7, 8}));
  }
  {
    const auto& [snapshot_times, history_interval, restart_interval] =
        output;  // the caller's loop has its own times
    EXPECT_TRUE(snapshot_times.empty());
    EXPECT_EQ(history_interval, 9);
    EXPECT_EQ(restart_interval, 0);
  }
}

TEST_F(Fields, LaminatedPlate) {
  LaminatedPlate p;
  const auto& [half_width, lower_glass, pvb, upper_glass, support, lower_layers, pvb_layers, upper_layers,
               support_layers, columns, layout, radius, shaft, gap, refinement] = p;
  cdfp_laminated_plate c;
  ASSERT_EQ(cdfp_laminated_plate_default(&c), CDFP_OK);
  EXPECT_EQ((Vector{c.half_width, c.lower_glass, c.pvb}), (Vector{half_width, lower_glass, pvb}));
  EXPECT_EQ((Vector{c.upper_glass, c.support, c.impactor_radius}), (Vector{upper_glass, support, radius}));
  EXPECT_EQ((Vector{c.impactor_shaft, c.impactor_gap, c.impactor_refinement}),
            (Vector{shaft, gap, refinement}));
  EXPECT_EQ((std::array{c.lower_layers, c.pvb_layers, c.upper_layers, c.support_layers, c.columns, c.layout}),
            (std::array{lower_layers, pvb_layers, upper_layers, support_layers, columns, Index(layout)}));

  c = {50e-3, 2e-3, 1e-3, 3e-3, 4e-3, 2, 1, 3, 2, 5, CDFP_REGULAR, 9e-3, 6e-3, 1e-4, 0.9};
  p.half_width = 50e-3, p.lower_glass = 2e-3, p.pvb = 1e-3, p.upper_glass = 3e-3, p.support = 4e-3;
  p.lower_layers = 2, p.pvb_layers = 1, p.upper_layers = 3, p.support_layers = 2, p.columns = 5;
  p.layout = PlateColumns::regular, p.impactor_radius = 9e-3, p.impactor_shaft = 6e-3;
  p.impactor_gap = 1e-4, p.impactor_refinement = 0.9;
  cdfp_mesh* mesh = nullptr;
  ASSERT_EQ(cdfp_mesh_create_laminated_plate(&c, &mesh), CDFP_OK);
  const Mesh wanted = laminated_plate_mesh(p);
  EXPECT_EQ(gate::Look(mesh)->coordinates, wanted.coordinates);
  EXPECT_EQ(gate::Look(mesh)->connectivity, wanted.connectivity);
  EXPECT_EQ(gate::Look(mesh)->layers, wanted.layers);
  cdfp_mesh_free(&mesh);
}

/// A cube that is hit by a smaller, rigid one above it.
void fill_scene(cdfp_model* model) {
  std::vector<double> x;
  for (const double z : {0.0, 1.0}) x.insert(x.end(), {0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z});
  for (const double z : {1.0, 1.5}) x.insert(x.end(), {.2, .3, z, .8, .3, z, .8, .7, z, .2, .7, z});
  const int32_t hexahedra[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, parts[] = {0, 1};
  const int32_t facets[] = {0, 1, 1, 0};
  const double v[] = {0.1, 0, -1}, w[] = {0, 0, 2}, g[] = {0, 0, -1};
  cdfp_model_set_mesh(model, 16, x.data(), 2, hexahedra, parts, nullptr);
  cdfp_model_add_facet_set(model, "faces", 2, facets);
  cdfp_model_add_contact_surface(model, "faces");
  cdfp_model_add_elastic_material(model, "soft", 1000, 1e6, 0.3);
  cdfp_model_add_rigid_material(model, "hard", 1000, 1e6, 0.3);
  const cdfp_cohesive_law law = {1e9, 10, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, CDFP_LINEAR};
  cdfp_model_add_cohesive_law(model, "law", &law);
  cdfp_model_add_part(model, "cube", "soft", CDFP_ONE_POINT, 1, "law");
  cdfp_model_add_part(model, "hammer", "hard", CDFP_ONE_POINT, 1, nullptr);
  cdfp_model_add_rigid_body(model, "hammer", 1000, nullptr, v, w, nullptr, nullptr);
  cdfp_model_set_gravity(model, g);
  cdfp_model_set_end_time(model, 1);
  cdfp_model_set_threads(model, 1);
}

TEST_F(Fields, Results) {
  fill_scene(handle_);
  cdfp_simulation* simulation = nullptr;
  ASSERT_EQ(cdfp_simulation_create(handle_, &simulation), CDFP_OK);
  ASSERT_EQ(cdfp_simulation_advance(simulation, 5, nullptr), CDFP_OK);
  const gate::Look native(simulation);
  {
    cdfp_energies c;
    ASSERT_EQ(cdfp_simulation_energies(simulation, &c), CDFP_OK);
    const auto [kinetic, strain, hourglass, material, stored, dissipated, friction, contact, heat, work,
                initial] = native->energies();
    EXPECT_EQ((Vector{c.kinetic, c.strain, c.hourglass}), (Vector{kinetic, strain, hourglass}));
    EXPECT_EQ((Vector{c.material_dissipated, c.cohesive_stored, c.cohesive_dissipated}),
              (Vector{material, stored, dissipated}));
    EXPECT_EQ((Vector{c.cohesive_friction, c.contact_stored, c.contact_friction}),
              (Vector{friction, contact, heat}));
    EXPECT_EQ((Vector{c.external_work, c.initial, c.balance}),
              (Vector{work, initial, native->energies().balance()}));
    EXPECT_GT(c.kinetic, 0);
    EXPECT_GT(c.strain, 0);
    EXPECT_GT(c.contact_stored, 0);
  }
  {
    cdfp_body_state c;
    ASSERT_EQ(cdfp_simulation_body(simulation, 0, &c), CDFP_OK);
    const auto [position, velocity, angular_velocity, contact_force] = native->body(0);
    EXPECT_EQ(std::to_array(c.position), position);
    EXPECT_EQ(std::to_array(c.velocity), velocity);
    EXPECT_EQ(std::to_array(c.angular_velocity), angular_velocity);
    EXPECT_EQ(std::to_array(c.contact_force), contact_force);
    EXPECT_GT(c.contact_force[2], 0);
  }
  {
    cdfp_summary c;
    ASSERT_EQ(cdfp_simulation_summary(simulation, &c), CDFP_OK);
    const Summary s = native->summary();
    EXPECT_EQ(c.elements, s.elements);
    EXPECT_EQ(c.nodes_initial, 16);
    EXPECT_EQ(c.nodes_final, s.nodes_final);
    EXPECT_EQ(c.segments_initial, s.segments_initial);
    EXPECT_EQ(c.segments_final, s.segments_final);
    EXPECT_EQ(c.steps, 5);
    EXPECT_EQ(c.threads, 1);
    EXPECT_EQ(c.dt_element, s.dt_element);
    EXPECT_EQ(c.simulated_time_s, native->time());
    EXPECT_EQ(c.dt_s, s.dt_s);
    EXPECT_EQ(c.dt_stable_s, s.dt_stable_s);
    EXPECT_GT(c.peak_rss_mb, 1);
    EXPECT_EQ((Vector{c.energy_balance_min, c.energy_balance_max, c.hourglass_over_strain_max}),
              (Vector{s.energy_balance_min, s.energy_balance_max, s.hourglass_over_strain_max}));
    EXPECT_EQ((Vector{c.first_contact_s, c.peak_force_n, c.peak_force_time_s}),
              (Vector{s.first_contact_s, s.peak_force_n, s.peak_force_time_s}));
    EXPECT_EQ(c.impactor_rebound_mps, s.impactor_rebound_mps);
    EXPECT_EQ(c.deepest_penetration_m, s.deepest_penetration_m);
    EXPECT_GT(c.deepest_penetration_m, 0);
  }
  {
    int64_t count = 0, length = 0;
    ASSERT_EQ(cdfp_simulation_contact_pair_count(simulation, &count), CDFP_OK);
    const std::vector<Summary::ContactPair> pairs = native->summary().contact_pairs;
    ASSERT_EQ(count, 1);
    ASSERT_EQ(pairs.size(), 1u);
    const auto [parts, peak, stored, heat, deepest] = pairs[0];
    cdfp_contact_pair c;
    ASSERT_EQ(cdfp_simulation_contact_pair(simulation, 0, &c), CDFP_OK);
    EXPECT_EQ((std::vector{c.peak_force_n, c.stored_j, c.friction_heat_j, c.deepest_penetration_m}),
              (std::vector{peak, stored, heat, deepest}));
    EXPECT_GT(c.peak_force_n, 0);
    for (const int side : {0, 1}) {
      char name[32];
      ASSERT_EQ(cdfp_simulation_contact_pair_part(simulation, 0, side, name, sizeof name, &length), CDFP_OK);
      EXPECT_EQ(name, parts[std::size_t(side)]);
    }
  }
  {
    double time = 0, position[3];
    int32_t layer = 0;
    ASSERT_EQ(cdfp_simulation_first_crack(simulation, "cube", &time, &layer, position), CDFP_OK);
    EXPECT_TRUE(std::isnan(time));
    EXPECT_EQ(layer, kNone);
  }
  cdfp_simulation_free(&simulation);
}

}  // namespace
