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
  REFUSED(cdfp_model_add_initial_velocity(model, "part", NULL, NULL), CDFP_BAD_ARGUMENT, "'velocity' is null");
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

int main(void) {
  handles();
  models();
  meshes();
  topologies();
  simulations();
  lost_run();
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
