/* Wrong calls on purpose: each is answered by a status and a message that names what is wrong. */
#include <math.h>
#include <stdlib.h>

#include "check.h"

/* Two cubes of 1 m, one upon the other. */
static const double kCoordinates[36] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1,
                                        1, 1, 1, 0, 1, 1, 0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 1, 2};
static const int32_t kHexahedra[16] = {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11};
static const int32_t kParts[2] = {0, 0};

static cdfp_model* two_cubes(void) {
  cdfp_model* model = NULL;
  DONE(cdfp_model_create(&model));
  DONE(cdfp_model_set_mesh(model, 12, kCoordinates, 2, kHexahedra, kParts, NULL));
  DONE(cdfp_model_add_elastic_material(model, "glass", 2500, 74e9, 0.2));
  DONE(cdfp_model_add_part(model, "cubes", "glass", CDFP_ONE_POINT, 1.0, NULL));
  DONE(cdfp_model_set_end_time(model, 1e-3));
  return model;
}

static void handles(void) {
  cdfp_model* model = NULL;
  cdfp_topology* topology = NULL;
  void* copy = NULL;

  REFUSED(cdfp_model_set_title(NULL, "x"), CDFP_BAD_ARGUMENT, "cdfp_model_set_title: the model is null");
  REFUSED(cdfp_model_create(NULL), CDFP_BAD_ARGUMENT, "'model' is null");
  DONE(cdfp_model_free(NULL));
  DONE(cdfp_model_free(&model));

  DONE(cdfp_model_create(&model));
  cdfp_model* stale = model;
  REFUSED(cdfp_topology_element_type((cdfp_topology*)model, 0, NULL), CDFP_BAD_ARGUMENT,
          "stands for a model, not for a topology");
  DONE(cdfp_share(model, &copy));
  DONE(cdfp_model_free(&model));
  CHECK(model == NULL);
  DONE(cdfp_model_free(&model));
  DONE(cdfp_model_set_title((cdfp_model*)copy, "still there"));
  DONE(cdfp_free(&copy));
  REFUSED(cdfp_model_set_title(stale, "x"), CDFP_BAD_ARGUMENT, "the model is not alive");
  REFUSED(cdfp_share(stale, &copy), CDFP_BAD_ARGUMENT, "is not alive");
  REFUSED(cdfp_share(NULL, &copy), CDFP_BAD_ARGUMENT, "is null");
  DONE(cdfp_model_free(&stale));
  CHECK(stale == NULL);
  REFUSED(cdfp_model_set_title((cdfp_model*)&topology, "x"), CDFP_BAD_ARGUMENT, "is not alive");
}

static void models(void) {
  cdfp_model* model = NULL;
  cdfp_simulation* simulation = NULL;
  const double v[3] = {0, 0, 0};
  const int32_t directions[3] = {1, 1, 1};

  DONE(cdfp_model_create(&model));
  REFUSED(cdfp_model_set_title(model, NULL), CDFP_BAD_ARGUMENT, "'title' is null");
  REFUSED(cdfp_model_set_mesh(model, -1, kCoordinates, 2, kHexahedra, kParts, NULL), CDFP_BAD_ARGUMENT,
          "'nodes' is negative");
  REFUSED(cdfp_model_set_mesh(model, INT64_C(1) << 40, kCoordinates, 2, kHexahedra, kParts, NULL),
          CDFP_BAD_ARGUMENT, "at most 2147483647");
  REFUSED(cdfp_model_set_mesh(model, 12, NULL, 2, kHexahedra, kParts, NULL), CDFP_BAD_ARGUMENT,
          "'coordinates' is null but 12 entries");
  REFUSED(cdfp_model_add_node_set(model, "set", 3, NULL), CDFP_BAD_ARGUMENT, "'nodes' is null");
  REFUSED(cdfp_model_add_node_set(model, "", 0, NULL), CDFP_BAD_ARGUMENT, "'name' is empty");
  REFUSED(cdfp_model_add_facet_set(model, NULL, 0, NULL), CDFP_BAD_ARGUMENT, "'name' is null");
  REFUSED(cdfp_model_add_part(model, "part", "glass", 7, 1.0, NULL), CDFP_BAD_ARGUMENT, "formulation is 7");
  REFUSED(cdfp_model_add_symmetry_plane(model, 3, 0), CDFP_BAD_ARGUMENT, "no axis 3");
  REFUSED(cdfp_model_add_prescribed_velocity(model, "set", directions, 2, NULL, v), CDFP_BAD_ARGUMENT,
          "'times' is null with 2 values");
  REFUSED(cdfp_model_add_prescribed_velocity(model, "set", NULL, 1, NULL, v), CDFP_BAD_ARGUMENT,
          "'directions' is null");
  REFUSED(cdfp_model_add_initial_velocity(model, "part", NULL, NULL), CDFP_BAD_ARGUMENT,
          "'velocity' is null");
  REFUSED(cdfp_model_set_contact(model, NULL), CDFP_BAD_ARGUMENT, "'settings' is null");
  DONE(cdfp_model_free(&model));

  model = two_cubes();
  REFUSED(cdfp_simulation_create(model, NULL), CDFP_BAD_ARGUMENT, "'simulation' is null");
  DONE(cdfp_model_add_initial_velocity(model, "cube", v, NULL));
  REFUSED(cdfp_simulation_create(model, &simulation), CDFP_BAD_ARGUMENT, "there is no part 'cube'");
  CHECK(simulation == NULL);
  DONE(cdfp_model_free(&model));

  model = two_cubes();
  int32_t nodes[2] = {0, 12};
  DONE(cdfp_model_add_node_set(model, "bottom", 2, nodes));
  REFUSED(cdfp_simulation_create(model, &simulation), CDFP_BAD_MESH, "12");
  DONE(cdfp_model_free(&model));

  double coordinates[36];
  int32_t hexahedra[16];
  model = two_cubes();
  memcpy(coordinates, kCoordinates, sizeof coordinates);
  coordinates[7] = NAN;
  DONE(cdfp_model_set_mesh(model, 12, coordinates, 2, kHexahedra, kParts, NULL));
  REFUSED(cdfp_simulation_create(model, &simulation), CDFP_BAD_MESH, "node 2");
  memcpy(hexahedra, kHexahedra, sizeof hexahedra);
  hexahedra[9] = -1;
  DONE(cdfp_model_set_mesh(model, 12, kCoordinates, 2, hexahedra, kParts, NULL));
  REFUSED(cdfp_simulation_create(model, &simulation), CDFP_BAD_MESH, "element 1");
  DONE(cdfp_model_free(&model));
}

static void meshes(void) {
  cdfp_laminated_plate plate;
  cdfp_mesh* mesh = NULL;
  const int32_t* numbers = NULL;
  int64_t count = 0;
  char text[8];

  REFUSED(cdfp_laminated_plate_default(NULL), CDFP_BAD_ARGUMENT, "'plate' is null");
  DONE(cdfp_laminated_plate_default(&plate));
  CHECK(plate.half_width == 75e-3 && plate.columns == 67 && plate.impactor_refinement == 1.0);
  plate.layout = 9;
  REFUSED(cdfp_mesh_create_laminated_plate(&plate, &mesh), CDFP_BAD_ARGUMENT, "layout is 9");
  plate.layout = CDFP_REGULAR;
  plate.pvb = -1;
  CHECK(cdfp_mesh_create_laminated_plate(&plate, &mesh) != CDFP_OK && mesh == NULL);
  plate.pvb = 1e-3;
  plate.columns = 4;
  DONE(cdfp_mesh_create_laminated_plate(&plate, &mesh));
  REFUSED(cdfp_mesh_node_set(mesh, "top", &numbers, &count), CDFP_BAD_ARGUMENT, "'support_bottom'");
  REFUSED(cdfp_mesh_facet_set(mesh, "impactor_head", NULL, &count), CDFP_BAD_ARGUMENT, "'facets' is null");
  REFUSED(cdfp_mesh_part_name(mesh, 5, text, sizeof text, &count), CDFP_BAD_ARGUMENT, "no part 5");
  DONE(cdfp_mesh_part_name(mesh, 0, text, sizeof text, &count));
  CHECK(count == 11 && strcmp(text, "lower_g") == 0);
  DONE(cdfp_mesh_part_name(mesh, 0, NULL, 0, &count));
  CHECK(count == 11);
  REFUSED(cdfp_mesh_part_name(mesh, 0, NULL, 8, &count), CDFP_BAD_ARGUMENT, "'text' is null");
  DONE(cdfp_mesh_free(&mesh));
}

static void topologies(void) {
  cdfp_topology* topology = NULL;
  const int32_t *nodes = NULL, *corners = NULL;
  int32_t element = 0, facet = 0, uses[4], types[2] = {CDFP_HEXAHEDRON, 9}, quad[4];
  int64_t count = 0, more = 0;

  REFUSED(cdfp_topology_create(12, 2, NULL, 15, kHexahedra, &topology), CDFP_BAD_ARGUMENT, "have 16");
  REFUSED(cdfp_topology_create(12, 2, types, 16, kHexahedra, &topology), CDFP_BAD_ARGUMENT, "has type 9");
  REFUSED(cdfp_topology_create(11, 2, NULL, 16, kHexahedra, &topology), CDFP_BAD_MESH, "11");
  REFUSED(cdfp_topology_create(12, 2, NULL, 16, NULL, &topology), CDFP_BAD_ARGUMENT, "is null");
  DONE(cdfp_topology_create(12, 2, NULL, 16, kHexahedra, &topology));
  REFUSED(cdfp_topology_mate(topology, 2, 0, &element, &facet), CDFP_BAD_ARGUMENT, "no element 2");
  REFUSED(cdfp_topology_mate(topology, 0, 6, &element, &facet), CDFP_BAD_ARGUMENT, "no facet 6");
  REFUSED(cdfp_topology_mate(topology, 0, -1, &element, &facet), CDFP_BAD_ARGUMENT, "no facet -1");
  REFUSED(cdfp_topology_facet_nodes(topology, 0, 0, NULL, &count), CDFP_BAD_ARGUMENT, "'nodes' is null");
  REFUSED(cdfp_topology_elements_around_edge(topology, 0, 12, 2, uses, &count), CDFP_BAD_ARGUMENT,
          "no edge 12");
  REFUSED(cdfp_topology_elements_around_node(topology, 12, 2, uses, &count), CDFP_BAD_ARGUMENT, "no node 12");
  uses[2] = uses[3] = -7;
  DONE(cdfp_topology_elements_around_node(topology, 4, 1, uses, &count));
  CHECK(count == 2 && uses[0] == 0 && uses[1] == 4 && uses[2] == -7 && uses[3] == -7);

  int32_t boundary = -1, inner = -1;
  for (int32_t f = 0; f < 6; ++f) {
    DONE(cdfp_topology_mate(topology, 0, f, &element, &facet));
    if (element < 0) boundary = f;
    if (element == 1) inner = f;
  }
  REFUSED(cdfp_topology_insert_cohesive(topology, 0, boundary, &element, &nodes, &count, &corners, &more),
          CDFP_BAD_ARGUMENT, "boundary");
  DONE(cdfp_topology_insert_cohesive(topology, 0, inner, &element, &nodes, &count, &corners, &more));
  CHECK(element == 2 && count == 4 && nodes[0] == 12);
  REFUSED(cdfp_topology_insert_cohesive(topology, 0, inner, &element, &nodes, &count, &corners, &more),
          CDFP_BAD_ARGUMENT, "cohesive");
  DONE(cdfp_topology_facet_nodes(topology, 2, 1, quad, &count));
  CHECK(count == 4);
  DONE(cdfp_topology_check(topology, NULL, 0, &count));
  CHECK(count == 0);
  DONE(cdfp_topology_free(&topology));
}

static void simulations(void) {
  cdfp_simulation* simulation = NULL;
  cdfp_recorder* recorder = NULL;
  cdfp_body_state body;
  const double* view = NULL;
  double time = -1, position[3];
  int64_t count = -1;
  int32_t layer = 0;

  cdfp_model* model = two_cubes();
  DONE(cdfp_simulation_create(model, &simulation));
  DONE(cdfp_model_free(&model));
  REFUSED(cdfp_simulation_time(simulation, NULL), CDFP_BAD_ARGUMENT, "'time' is null");
  REFUSED(cdfp_simulation_positions(simulation, &view, NULL), CDFP_BAD_ARGUMENT, "'nodes' is null");
  REFUSED(cdfp_simulation_advance(simulation, -1, &count), CDFP_BAD_ARGUMENT, "negative");
  REFUSED(cdfp_simulation_advance_to(simulation, NAN, &count), CDFP_BAD_ARGUMENT, "'time' is nan");
  REFUSED(cdfp_simulation_body(simulation, 0, &body), CDFP_BAD_ARGUMENT, "no rigid body 0");
  REFUSED(cdfp_simulation_warning(simulation, 99, NULL, 0, &count), CDFP_BAD_ARGUMENT, "no warning 99");
  REFUSED(cdfp_simulation_history_column(simulation, -1, NULL, 0, &count), CDFP_BAD_ARGUMENT, "no column -1");
  REFUSED(cdfp_simulation_first_crack(simulation, "cubes", &time, &layer, position), CDFP_BAD_ARGUMENT,
          "no part 'cubes' that may crack");
  REFUSED(cdfp_recorder_create(simulation, "", &recorder), CDFP_BAD_ARGUMENT, "'folder' is empty");
  REFUSED(cdfp_recorder_create(simulation, "/dev/null/folder", &recorder), CDFP_IO, "/dev/null/folder");
  REFUSED(cdfp_recorder_finish(recorder, simulation), CDFP_BAD_ARGUMENT, "the recorder is null");
  DONE(cdfp_simulation_advance(simulation, 3, &count));
  CHECK(count == 3);
  DONE(cdfp_simulation_step(simulation));
  DONE(cdfp_simulation_step_count(simulation, &count));
  CHECK(count == 4);
  DONE(cdfp_simulation_free(&simulation));
}

static void saved_runs(void) {
  const char* path = "bad_calls_restart";
  cdfp_simulation *first = NULL, *second = NULL;
  cdfp_recorder* recorder = NULL;
  const double *x = NULL, *y = NULL;
  int64_t nodes = 0, steps = 0;
  cdfp_model* model = two_cubes();

  REFUSED(cdfp_simulation_save(NULL, path), CDFP_BAD_ARGUMENT, "the simulation is null");
  DONE(cdfp_simulation_create(model, &first));
  DONE(cdfp_simulation_advance(first, 5, NULL));
  REFUSED(cdfp_simulation_save(first, NULL), CDFP_BAD_ARGUMENT, "'path' is null");
  REFUSED(cdfp_simulation_save(first, "no such folder/file"), CDFP_IO, "cannot write");
  DONE(cdfp_simulation_save(first, path));
  REFUSED(cdfp_simulation_restore(first, path), CDFP_BAD_STATE, "5 steps");
  DONE(cdfp_simulation_create(model, &second));
  REFUSED(cdfp_simulation_restore(second, NULL), CDFP_BAD_ARGUMENT, "'path' is null");
  REFUSED(cdfp_simulation_restore(second, "no such file"), CDFP_IO, "cannot read the restart file");
  DONE(cdfp_simulation_restore(second, path));
  DONE(cdfp_simulation_step_count(second, &steps));
  CHECK(steps == 5);
  DONE(cdfp_simulation_advance(first, 5, NULL));
  DONE(cdfp_simulation_advance(second, 5, NULL));
  DONE(cdfp_simulation_positions(first, &x, &nodes));
  DONE(cdfp_simulation_positions(second, &y, &nodes));
  for (int i = 0; i < 3 * nodes; ++i) CHECK(x[i] == y[i]);
  DONE(cdfp_simulation_free(&second));

  const double g[3] = {1, 0, 0};
  DONE(cdfp_model_set_gravity(model, g));
  DONE(cdfp_simulation_create(model, &second));
  REFUSED(cdfp_simulation_restore(second, path), CDFP_BAD_INPUT, "whose gravity is not as in this one");
  REFUSED(cdfp_recorder_continue(second, "", &recorder), CDFP_BAD_ARGUMENT, "'folder' is empty");
  remove(path);
  DONE(cdfp_model_free(&model));
  DONE(cdfp_simulation_free(&first));
  DONE(cdfp_simulation_free(&second));
}

/* A step far beyond the stable one: the run is lost, the state stays readable, other runs go on. */
static void lost_run(void) {
  cdfp_simulation *lost = NULL, *other = NULL;
  cdfp_energies energies;
  const double* view = NULL;
  const double push = 1;
  const int32_t bottom[4] = {0, 1, 2, 3}, up[3] = {0, 0, 1};
  int64_t steps = 0, nodes = 0;

  cdfp_model* model = two_cubes();
  DONE(cdfp_simulation_create(model, &other));
  DONE(cdfp_model_add_node_set(model, "bottom", 4, bottom));
  DONE(cdfp_model_add_prescribed_velocity(model, "bottom", up, 1, NULL, &push));
  DONE(cdfp_model_set_fixed_step(model, 1e-3));
  DONE(cdfp_model_set_end_time(model, 100));
  DONE(cdfp_model_set_history_interval(model, 1));
  DONE(cdfp_simulation_create(model, &lost));
  DONE(cdfp_model_free(&model));
  REFUSED(cdfp_simulation_advance(lost, 100000, NULL), CDFP_DIVERGED, "stable");
  DONE(cdfp_simulation_step_count(lost, &steps));
  CHECK(steps > 0 && steps < 100000);
  DONE(cdfp_simulation_positions(lost, &view, &nodes));
  CHECK(nodes == 12);
  DONE(cdfp_simulation_energies(lost, &energies));
  DONE(cdfp_simulation_step(other));
  DONE(cdfp_simulation_free(&lost));
  DONE(cdfp_simulation_free(&other));
}

/* Two cubes that do not share nodes: 0 to 7 below, 8 to 15 above, at the same places in between. */
typedef struct Halves {
  double x[48], v[48], f[48], mass[16];
  int32_t corners[8]; /**< of the cohesive element between them */
} Halves;

static Halves halves(void) {
  Halves h;
  memset(&h, 0, sizeof h);
  memcpy(h.x, kCoordinates, 24 * sizeof(double));
  memcpy(h.x + 24, kCoordinates + 12, 24 * sizeof(double));
  for (int32_t n = 0; n < 16; ++n) h.mass[n] = 312.5;
  for (int32_t n = 0; n < 4; ++n) h.corners[n] = 8 + n, h.corners[4 + n] = 4 + n;
  return h;
}

static cdfp_cohesive_law glass(void) {
  cdfp_cohesive_law law;
  DONE(cdfp_cohesive_law_default(&law));
  law.strength = 60e6;
  law.fracture_energy = 10;
  return law;
}

static void cohesive_points(void) {
  const cdfp_cohesive_law law = glass();
  cdfp_cohesive_point point;
  const double pull[3] = {0, 0, 60e6}, press[3] = {0, 0, -1}, up[3] = {0, 0, 1}, crooked[3] = {0, 1, 1};
  double traction[3], stored = 0;
  memset(&point, 0, sizeof point);

  REFUSED(cdfp_cohesive_law_start(NULL, 1, pull, up, &point), CDFP_BAD_ARGUMENT, "'law' is null");
  REFUSED(cdfp_cohesive_law_start(&law, 1, NULL, up, &point), CDFP_BAD_ARGUMENT, "'traction' is null");
  REFUSED(cdfp_cohesive_law_start(&law, -1, pull, up, &point), CDFP_BAD_ARGUMENT, "'count' is negative");
  REFUSED(cdfp_cohesive_law_start(&law, 1, pull, crooked, &point), CDFP_BAD_ARGUMENT, "is not of length 1");
  REFUSED(cdfp_cohesive_law_start(&law, 1, press, up, &point), CDFP_BAD_ARGUMENT, "neither pulls nor shears");
  REFUSED(cdfp_cohesive_law_traction(&law, 1, up, up, &point, traction), CDFP_BAD_ARGUMENT, "no strength");
  DONE(cdfp_cohesive_law_start(&law, 1, pull, up, &point));
  const double reach = 2 * law.fracture_energy / law.strength;
  CHECK(fabs(point.reach - reach) < 1e-12 * reach);
  const double half[3] = {0, 0, 0.5 * reach}, whole[3] = {0, 0, reach};
  DONE(cdfp_cohesive_law_traction(&law, 1, half, up, &point, traction));
  CHECK(fabs(traction[2] - 30e6) < 1);
  DONE(cdfp_cohesive_law_stored(&law, 1, up, &point, &stored));
  CHECK(fabs(stored - 0.5 * 30e6 * 0.5 * reach) < 1e-9);
  DONE(cdfp_cohesive_law_mean_traction(&law, 1, whole, up, &point, traction));
  CHECK(fabs(point.dissipated - law.fracture_energy) < 1e-9);
  DONE(cdfp_cohesive_law_traction(&law, 1, whole, up, &point, traction));
  CHECK(traction[2] == 0);
}

static void cohesive_elements(void) {
  Halves h = halves();
  cdfp_cohesive* cohesive = NULL;
  cdfp_topology* topology = NULL;
  cdfp_cohesive_law law = glass();
  cdfp_cohesive_pair pairs[4];
  const double pull[3] = {0, 0, 60e6};
  const int32_t parts[2] = {0, 0}, wrong_parts[2] = {0, 3}, laws[1] = {0}, no_law[1] = {7},
                held[3] = {1, 1, 1};
  const int32_t stray[2] = {20, -1}, renamed[4] = {5, 0, 8, 20};
  double stress[12] = {0};
  const int32_t *facets = NULL, *broken = NULL;
  const double* tractions = NULL;
  int64_t count = 0, more = 0;
  int32_t number = -1;

  REFUSED(cdfp_cohesive_create(-1, &cohesive), CDFP_BAD_ARGUMENT, "number -1");
  REFUSED(cdfp_cohesive_count(cohesive, &count, &more), CDFP_BAD_ARGUMENT, "the cohesive service is null");
  DONE(cdfp_cohesive_create(0, &cohesive));
  REFUSED(cdfp_cohesive_add_law(cohesive, NULL, &number), CDFP_BAD_ARGUMENT, "'law' is null");
  law.strength = NAN;
  REFUSED(cdfp_cohesive_add_law(cohesive, &law, &number), CDFP_BAD_ARGUMENT, "strength");
  law = glass();
  law.kind = CDFP_USER;
  REFUSED(cdfp_cohesive_add_law(cohesive, &law, &number), CDFP_BAD_ARGUMENT, "needs a callback");
  REFUSED(cdfp_cohesive_add_user_law(cohesive, &law, NULL, 0, NULL, &number), CDFP_BAD_ARGUMENT,
          "'callback' is null");
  law = glass();
  DONE(cdfp_cohesive_add_law(cohesive, &law, &number));
  CHECK(number == 0);

  REFUSED(cdfp_cohesive_insert(cohesive, 3, 0, 8, h.corners, pull, 16, h.x, 0), CDFP_BAD_ARGUMENT,
          "not the next one");
  REFUSED(cdfp_cohesive_insert(cohesive, 0, 1, 8, h.corners, pull, 16, h.x, 0), CDFP_BAD_ARGUMENT, "law 1");
  REFUSED(cdfp_cohesive_insert(cohesive, 0, 0, 8, h.corners, pull, 10, h.x, 0), CDFP_BAD_ARGUMENT,
          "names node 10");
  REFUSED(cdfp_cohesive_insert(cohesive, 0, 0, 8, h.corners, NULL, 16, h.x, 0), CDFP_BAD_ARGUMENT,
          "carries nothing");
  h.x[14] = NAN;
  REFUSED(cdfp_cohesive_insert(cohesive, 0, 0, 8, h.corners, pull, 16, h.x, 0), CDFP_BAD_ARGUMENT,
          "node 4 is not finite");
  h = halves();
  DONE(cdfp_cohesive_insert(cohesive, 0, 0, 8, h.corners, pull, 16, h.x, 0));
  REFUSED(cdfp_cohesive_hold(cohesive, 1, stray + 1, held), CDFP_BAD_ARGUMENT, "node -1");
  REFUSED(cdfp_cohesive_follow(cohesive, 1, stray, 0, NULL), CDFP_BAD_ARGUMENT, "copy of node -1");
  REFUSED(cdfp_cohesive_follow(cohesive, 0, NULL, 1, renamed), CDFP_BAD_ARGUMENT, "no cohesive element 5");
  REFUSED(cdfp_cohesive_pairs(cohesive, 1, pairs, &count), CDFP_BAD_ARGUMENT, "no cohesive element 1");
  REFUSED(cdfp_cohesive_add_force(cohesive, 16, h.x, h.v, h.mass, h.f, 0, 0, 1), CDFP_BAD_ARGUMENT, "step");
  REFUSED(cdfp_cohesive_add_force(cohesive, 10, h.x, h.v, h.mass, h.f, 1e-6, 0, 1), CDFP_BAD_ARGUMENT,
          "give arrays of all nodes");
  REFUSED(cdfp_cohesive_add_force(cohesive, 16, h.x, NULL, h.mass, h.f, 1e-6, 0, 1), CDFP_BAD_ARGUMENT,
          "'velocity' is null");
  h.v[25] = INFINITY;
  REFUSED(cdfp_cohesive_add_force(cohesive, 16, h.x, h.v, h.mass, h.f, 1e-6, 0, 1), CDFP_BAD_ARGUMENT,
          "node 8 of a cohesive element");
  h = halves();
  DONE(cdfp_cohesive_add_force(cohesive, 16, h.x, h.v, h.mass, h.f, 1e-6, 0, 1));
  CHECK(h.f[26] < 0 && h.f[14] > 0 && h.f[2] == 0);
  DONE(cdfp_cohesive_pairs(cohesive, 0, pairs, &count));
  CHECK(count == 4 && pairs[0].upper == 8 && pairs[0].lower == 4 && fabs(pairs[0].strength - 60e6) < 1);
  DONE(cdfp_cohesive_broken_now(cohesive, &broken, &count));
  CHECK(count == 0);

  DONE(cdfp_topology_create(12, 2, NULL, 16, kHexahedra, &topology));
  REFUSED(cdfp_cohesive_find_open(cohesive, topology, 12, kCoordinates, 2, stress, 1, &facets, &tractions,
                                  &count),
          CDFP_BAD_STATE, "call cdfp_cohesive_set_parts first");
  REFUSED(cdfp_cohesive_set_parts(cohesive, topology, 11, kCoordinates, 2, parts, 1, laws, 0, NULL),
          CDFP_BAD_ARGUMENT, "12 nodes");
  REFUSED(cdfp_cohesive_set_parts(cohesive, topology, 12, kCoordinates, 2, wrong_parts, 1, laws, 0, NULL),
          CDFP_BAD_ARGUMENT, "element 1 is of part 3");
  REFUSED(cdfp_cohesive_set_parts(cohesive, topology, 12, kCoordinates, 2, parts, 1, no_law, 0, NULL),
          CDFP_BAD_ARGUMENT, "law 7");
  REFUSED(cdfp_cohesive_set_parts(cohesive, topology, 12, kCoordinates, 2, parts, 1, laws, 2, NULL),
          CDFP_BAD_ARGUMENT, "no recovery 2");
  DONE(cdfp_cohesive_set_parts(cohesive, topology, 12, kCoordinates, 2, parts, 1, laws, 0, NULL));
  REFUSED(cdfp_cohesive_find_open(cohesive, topology, 12, kCoordinates, 1, stress, 1, &facets, &tractions,
                                  &count),
          CDFP_BAD_ARGUMENT, "'stress' has 6 numbers");
  stress[7] = NAN;
  REFUSED(cdfp_cohesive_find_open(cohesive, topology, 12, kCoordinates, 2, stress, 1, &facets, &tractions,
                                  &count),
          CDFP_BAD_ARGUMENT, "the stress of element 1");
  stress[7] = 0;
  stress[2] = stress[8] = 61e6;
  DONE(cdfp_cohesive_find_open(cohesive, topology, 12, kCoordinates, 2, stress, 1, &facets, &tractions,
                               &count));
  CHECK(count == 1 && facets[0] == 0 && facets[2] == 0 && fabs(tractions[2] - 61e6) < 1);
  stress[8] = 58e6;
  DONE(cdfp_cohesive_find_open(cohesive, topology, 12, kCoordinates, 2, stress, 1, &facets, &tractions,
                               &count));
  CHECK(count == 0);

  cdfp_cohesive* stale = cohesive;
  DONE(cdfp_cohesive_free(&cohesive));
  DONE(cdfp_cohesive_free(&cohesive));
  REFUSED(cdfp_cohesive_count(stale, &count, &more), CDFP_BAD_ARGUMENT, "is not alive");
  REFUSED(cdfp_cohesive_count((cdfp_cohesive*)topology, &count, &more), CDFP_BAD_ARGUMENT,
          "stands for a topology");
  DONE(cdfp_topology_free(&topology));
}

static void contact_services(void) {
  Halves h = halves();
  cdfp_contact_search* search = NULL;
  cdfp_contact* contact = NULL;
  cdfp_contact_settings settings;
  const int32_t nodes[8] = {4, 5, 6, 7, 8, 9, 10, 11}, faces[8] = {4, 5, 6, 7, 8, 11, 10, 9}, far_node = 16;
  const int32_t elements[2] = {0, 1}, parts[2] = {0, 1};
  const double modulus[2] = {1e9, 1e9}, area[2] = {1, 1}, volume[2] = {1, 1}, flat[2] = {1, 0};
  const int32_t *start = NULL, *partners = NULL;
  const cdfp_touch* touches = NULL;
  double shape[4], normal[3], gap = 0, outside = 0;
  int64_t rows = 0, count = 0;
  int32_t due = -1;

  REFUSED(cdfp_contact_search_create(0, 0.4, 1, &search), CDFP_BAD_ARGUMENT, "must be positive");
  DONE(cdfp_contact_search_create(1, 0.4, 1, &search));
  REFUSED(cdfp_contact_search_regular(search, 16, h.x, 1, &far_node, 2, faces, 0, NULL, NULL, 1),
          CDFP_BAD_ARGUMENT, "'contact_nodes' names node 16");
  REFUSED(cdfp_contact_search_regular(search, 16, NULL, 8, nodes, 2, faces, 0, NULL, NULL, 1),
          CDFP_BAD_ARGUMENT, "'position' is null");
  REFUSED(cdfp_contact_search_adaptive(search, 16, h.x, 8, nodes, 2, faces, 0, NULL, NULL, 0, NULL, 0, NULL),
          CDFP_BAD_STATE, "needs a regular one before");
  REFUSED(cdfp_contact_search_due(search, NAN, 1e-6, &due), CDFP_BAD_ARGUMENT, "largest_speed is nan");
  h.x[15] = NAN;
  REFUSED(cdfp_contact_search_regular(search, 16, h.x, 8, nodes, 2, faces, 0, NULL, NULL, 1),
          CDFP_BAD_ARGUMENT, "position of node 5 is not finite");
  h = halves();
  DONE(cdfp_contact_search_regular(search, 16, h.x, 8, nodes, 2, faces, 0, NULL, NULL, 1));
  REFUSED(cdfp_contact_search_adaptive(search, 16, h.x, 7, nodes, 2, faces, 0, NULL, NULL, 0, NULL, 0, NULL),
          CDFP_BAD_ARGUMENT, "append new ones");
  DONE(cdfp_contact_search_node_segments(search, &start, &partners, &rows));
  CHECK(rows == 8 && start[8] == 8 && partners[0] == 1 && partners[7] == 0);
  DONE(cdfp_contact_search_due(search, 0, 1e-6, &due));
  CHECK(due == 0);
  DONE(cdfp_contact_search_free(&search));

  REFUSED(cdfp_project_on_face(h.x, 5, h.x, shape, normal, &gap, &outside), CDFP_BAD_ARGUMENT, "not 5");
  REFUSED(cdfp_project_on_face(h.x, 4, NULL, shape, normal, &gap, &outside), CDFP_BAD_ARGUMENT,
          "'coordinates' is null");
  DONE(cdfp_project_on_face(h.x, 4, h.x + 12, shape, normal, &gap, &outside));
  CHECK(fabs(gap + 1) < 1e-12 && fabs(shape[0] - 1) < 1e-12 && normal[2] == 1);

  DONE(cdfp_contact_settings_default(&settings));
  REFUSED(cdfp_contact_create(NULL, &contact), CDFP_BAD_ARGUMENT, "'settings' is null");
  settings.friction = -1;
  REFUSED(cdfp_contact_create(&settings, &contact), CDFP_BAD_ARGUMENT, "friction not negative");
  settings.friction = 0.1;
  DONE(cdfp_contact_create(&settings, &contact));
  REFUSED(cdfp_contact_add_segments(contact, 2, faces, elements, parts, modulus, area, flat),
          CDFP_BAD_ARGUMENT, "contact segment 1");
  DONE(cdfp_contact_free(&contact));
  DONE(cdfp_contact_create(&settings, &contact));
  DONE(cdfp_contact_add_segments(contact, 2, faces, elements, parts, modulus, area, volume));
  REFUSED(cdfp_contact_local_search(contact, 16, h.x, 1), CDFP_BAD_STATE, "ask `due`");
  REFUSED(cdfp_contact_due(contact, 11, h.v, 1e-6, 1, &due), CDFP_BAD_ARGUMENT, "name node 11");
  REFUSED(cdfp_contact_due(contact, 16, h.v, -1, 1, &due), CDFP_BAD_ARGUMENT, "the step is -1");
  h.v[12] = NAN;
  REFUSED(cdfp_contact_due(contact, 16, h.v, 1e-6, 1, &due), CDFP_BAD_ARGUMENT, "velocity of node 4");
  h = halves();
  DONE(cdfp_contact_due(contact, 16, h.v, 1e-6, 1, &due));
  CHECK(due == CDFP_SEARCH_REGULAR);
  h.x[26] = NAN;
  REFUSED(cdfp_contact_regular_search(contact, 16, h.x, NULL, 1), CDFP_BAD_ARGUMENT, "position of node 8");
  h = halves();
  for (int n = 8; n < 16; ++n) h.x[3 * n + 2] -= 1e-3, h.v[3 * n + 2] = -1e3;
  DONE(cdfp_contact_regular_search(contact, 16, h.x, NULL, 1));
  DONE(cdfp_contact_local_search(contact, 16, h.x, 1));
  REFUSED(cdfp_contact_add_force(contact, 16, h.v, NULL, h.f, 1e-6, 1), CDFP_BAD_ARGUMENT, "'mass' is null");
  REFUSED(cdfp_contact_add_force(contact, 16, h.v, h.mass, h.f, NAN, 1), CDFP_BAD_ARGUMENT,
          "the step is nan");
  DONE(cdfp_contact_add_force(contact, 16, h.v, h.mass, h.f, 1e-6, 1));
  CHECK(h.f[26] > 0 && h.f[14] < 0);
  DONE(cdfp_contact_touches(contact, &touches, &count));
  CHECK(count == 8 && touches[0].count == 5 && touches[0].gap < 0);
  REFUSED(cdfp_contact_warning(contact, 3, NULL, 0, &count), CDFP_BAD_ARGUMENT, "no warning 3");
  cdfp_contact* stale = contact;
  DONE(cdfp_contact_free(&contact));
  REFUSED(cdfp_contact_touches(stale, &touches, &count), CDFP_BAD_ARGUMENT, "is not alive");
}

/* What callbacks may do to the simulation that calls them. */
typedef struct Answers {
  cdfp_simulation* simulation;
  int32_t look, step, change;
  int calls;
} Answers;

static int32_t monitor(cdfp_simulation* simulation, void* user_data) {
  Answers* answers = user_data;
  double time = 0;
  const double* v = NULL;
  int64_t nodes = 0;
  answers->look = cdfp_simulation_time(simulation, &time);
  answers->step = cdfp_simulation_step(simulation);
  DONE(cdfp_simulation_velocities(simulation, &v, &nodes));
  answers->change = cdfp_simulation_set_velocities(simulation, nodes, v);
  return ++answers->calls == 3;
}

static void lift(const cdfp_nodal_load* load, void* user_data) {
  Answers* answers = user_data;
  double time = 0;
  if (answers->simulation) answers->look = cdfp_simulation_time(answers->simulation, &time);
  for (int64_t n = 0; n < load->nodes; ++n) load->force[3 * n + 2] += 1000;
  ++answers->calls;
}

static void callbacks(void) {
  Answers answers = {0}, lifts = {0};
  cdfp_simulation* simulation = NULL;
  cdfp_energies energies;
  const double* v = NULL;
  double moved[36], time = 0, step = 0, stress[12];
  int64_t done = 0, nodes = 0;
  cdfp_model* model = two_cubes();

  REFUSED(cdfp_model_set_load_callback(model, NULL, NULL), CDFP_BAD_ARGUMENT, "'callback' is null");
  DONE(cdfp_model_set_load_callback(model, lift, &lifts));
  DONE(cdfp_simulation_create(model, &simulation));
  DONE(cdfp_simulation_set_monitor(simulation, monitor, &answers));
  DONE(cdfp_simulation_advance(simulation, 10, &done));
  CHECK(done == 3 && answers.calls == 3);
  CHECK(answers.look == CDFP_OK && answers.step == CDFP_BAD_STATE && answers.change == CDFP_OK);
  CHECK(strstr(last_error(), "is being stepped") != NULL);

  DONE(cdfp_simulation_set_monitor(simulation, NULL, NULL));
  lifts.simulation = simulation;
  DONE(cdfp_simulation_step(simulation));
  CHECK(lifts.look == CDFP_BAD_STATE && lifts.calls == 5);
  CHECK(strstr(last_error(), "in use by another call") != NULL);
  lifts.simulation = NULL;
  DONE(cdfp_simulation_advance_to(simulation, 5e-4, NULL));
  DONE(cdfp_simulation_energies(simulation, &energies));
  CHECK(energies.external_work > 0 && fabs(energies.balance - 1) < 1e-9);
  DONE(cdfp_simulation_velocities(simulation, &v, &nodes));
  DONE(cdfp_simulation_time(simulation, &time));
  DONE(cdfp_simulation_step_size(simulation, &step));
  double mean = 0; /* by mass: the nodes between the cubes have twice that of the others */
  for (int n = 0; n < 12; ++n) mean += v[3 * n + 2] * (n >= 4 && n < 8 ? 2 : 1) / 16;
  CHECK(fabs(mean - 12000.0 / 5000 * (time + 0.5 * step)) < 1e-6 * mean);

  memcpy(moved, v, sizeof moved);
  for (int n = 0; n < 12; ++n) moved[3 * n] += 2;
  REFUSED(cdfp_simulation_set_velocities(simulation, 11, moved), CDFP_BAD_ARGUMENT, "the 12 nodes");
  REFUSED(cdfp_simulation_set_velocities(simulation, 12, NULL), CDFP_BAD_ARGUMENT, "'velocities' is null");
  moved[4] = NAN;
  REFUSED(cdfp_simulation_set_velocities(simulation, 12, moved), CDFP_BAD_ARGUMENT, "node 1 is not a finite");
  moved[4] = v[4];
  DONE(cdfp_simulation_set_velocities(simulation, 12, moved));
  DONE(cdfp_simulation_energies(simulation, &energies));
  CHECK(energies.kinetic > 0.5 * 5000 * 4 && fabs(energies.balance - 1) < 1e-9);
  REFUSED(cdfp_simulation_get_stresses(simulation, 3, stress), CDFP_BAD_ARGUMENT, "the simulation has 2");
  DONE(cdfp_simulation_positions(simulation, &v, &nodes));
  memcpy(moved, v, sizeof moved);
  for (int n = 0; n < 12; ++n) moved[3 * n + 2] += 1e-5 * v[3 * n + 2];
  DONE(cdfp_simulation_set_positions(simulation, 12, moved));
  DONE(cdfp_simulation_get_stresses(simulation, 2, stress));
  CHECK(fabs(stress[2] - 1e-5 * 74e9 * 0.8 / (1.2 * 0.6)) < 0.1 * stress[2]);
  DONE(cdfp_simulation_energies(simulation, &energies));
  CHECK(fabs(energies.balance - 1) < 1e-9);
  DONE(cdfp_simulation_advance(simulation, 5, NULL));
  DONE(cdfp_simulation_energies(simulation, &energies));
  CHECK(fabs(energies.balance - 1) < 1e-3);
  DONE(cdfp_simulation_free(&simulation));
  DONE(cdfp_model_free(&model));
}

static void mixed_meshes(void) {
  const double x[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const int32_t types[2] = {CDFP_TETRAHEDRON, CDFP_TETRAHEDRON}, odd[2] = {CDFP_TETRAHEDRON, 9};
  const int32_t corners[8] = {0, 1, 2, 3, 1, 4, 2, 3};
  cdfp_model* model = NULL;
  cdfp_simulation* simulation = NULL;
  DONE(cdfp_model_create(&model));
  REFUSED(cdfp_model_set_mixed_mesh(model, 5, x, 2, NULL, 8, corners, kParts, NULL), CDFP_BAD_ARGUMENT,
          "'types' is null");
  REFUSED(cdfp_model_set_mixed_mesh(model, 5, x, 2, odd, 8, corners, kParts, NULL), CDFP_BAD_ARGUMENT,
          "element 1 has type 9");
  REFUSED(cdfp_model_set_mixed_mesh(model, 5, x, 2, types, 7, corners, kParts, NULL), CDFP_BAD_ARGUMENT,
          "the 2 elements have 8");
  DONE(cdfp_model_set_mixed_mesh(model, 5, x, 2, types, 8, corners, kParts, NULL));
  DONE(cdfp_model_add_elastic_material(model, "glass", 2500, 74e9, 0.2));
  DONE(cdfp_model_add_part(model, "tetrahedra", "glass", CDFP_FULL, 1.0, NULL));
  DONE(cdfp_model_set_end_time(model, 1e-4));
  DONE(cdfp_simulation_create(model, &simulation));
  DONE(cdfp_simulation_advance(simulation, 3, NULL));
  DONE(cdfp_simulation_free(&simulation));
  DONE(cdfp_model_free(&model));
}

/* A wedge with a tetrahedron on it runs; a pyramid is refused with its cure. */
static void wedges(void) {
  const double x[21] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 0.3, 0.3, 2};
  const int32_t types[2] = {CDFP_WEDGE, CDFP_TETRAHEDRON}, pyramid[2] = {CDFP_PYRAMID, CDFP_TETRAHEDRON};
  const int32_t corners[10] = {0, 1, 2, 3, 4, 5, 3, 4, 5, 6}, of_pyramid[9] = {0, 3, 4, 1, 2, 3, 4, 5, 6};
  cdfp_model* model = NULL;
  cdfp_simulation* simulation = NULL;
  DONE(cdfp_model_create(&model));
  DONE(cdfp_model_set_mixed_mesh(model, 7, x, 2, types, 10, corners, kParts, NULL));
  DONE(cdfp_model_add_elastic_material(model, "glass", 2500, 74e9, 0.2));
  DONE(cdfp_model_add_part(model, "body", "glass", CDFP_FULL, 1.0, NULL));
  DONE(cdfp_model_set_end_time(model, 1e-4));
  DONE(cdfp_simulation_create(model, &simulation));
  DONE(cdfp_simulation_advance(simulation, 3, NULL));
  DONE(cdfp_simulation_free(&simulation));
  DONE(cdfp_model_set_mixed_mesh(model, 7, x, 2, pyramid, 9, of_pyramid, kParts, NULL));
  REFUSED(cdfp_simulation_create(model, &simulation), CDFP_BAD_ARGUMENT,
          "cut each pyramid into two tetrahedra");
  DONE(cdfp_model_free(&model));
}

int main(void) {
  handles();
  models();
  meshes();
  topologies();
  simulations();
  saved_runs();
  wedges();
  lost_run();
  cohesive_points();
  cohesive_elements();
  contact_services();
  callbacks();
  mixed_meshes();
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
