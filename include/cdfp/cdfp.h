/** @file
 * The C interface of cdfp, also what the Fortran module `cdfp` stands on.
 *
 * Rules of the door
 * - Every function returns a status: 0 (CDFP_OK) or one of the codes below; `cdfp_last_error` has the text.
 *   Nothing prints, aborts or throws. When a call fails its results are not set, unless said otherwise.
 * - Handles are made by `..._create` and given back by `..._free`, which nulls the caller's handle and may be
 *   called twice. A handle that was freed elsewhere is recognised and refused, never followed.
 * - Any number of threads may use different handles at once, or ask one handle questions at once. A call that
 *   changes an object while another one uses it is refused (CDFP_BAD_STATE).
 * - Views are a pointer and a count. They belong to the handle; each function says for how long they hold.
 * - Arrays of nodes are (n, 3) row-major, of hexahedra (n, 8), of facets (n, 2): element and local facet.
 * - Numbers of nodes, elements, facets, parts, layers and axes count from 0; -1 is "none". Units are SI.
 * - Strings that go in end with a null character. Strings that come out are copied into `text`, cut to
 *   `capacity - 1` characters and ended with a null; `length` is the length of the whole without the null.
 *   Ask with a capacity of 0 for the length alone.
 */
#ifndef CDFP_CDFP_H
#define CDFP_CDFP_H

#include <stdint.h>

#include "cdfp/material.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

/* ---- status ------------------------------------------------------------------------------------------- */

enum {
  CDFP_OK = 0,
  CDFP_BAD_ARGUMENT = 1, /**< a value, size, name or handle that the caller gave */
  CDFP_BAD_INPUT = 2,    /**< a file's contents */
  CDFP_BAD_MESH = 3,     /**< inverted, degenerate or inconsistent elements */
  CDFP_BAD_STATE = 4,    /**< a call that the object cannot take now */
  CDFP_DIVERGED = 5,     /**< NaN, inverted element or runaway energy while stepping */
  CDFP_IO = 6,           /**< a file that cannot be opened, read or written */
  CDFP_UNAVAILABLE = 7,  /**< an optional part that this build lacks */
  CDFP_INTERNAL = 8      /**< out of memory, or a fault of cdfp */
};

/** Text of the last call that failed on this thread; empty if none did. */
int32_t cdfp_last_error(char* text, int64_t capacity, int64_t* length);
/** The same for callers who count elements, nodes, facets and parts from 1. */
int32_t cdfp_last_error_from_1(char* text, int64_t capacity, int64_t* length);

/** Version of the library that runs: major, minor, patch. */
int32_t cdfp_version(int32_t* major, int32_t* minor, int32_t* patch);

/* ---- handles ------------------------------------------------------------------------------------------ */

typedef struct cdfp_mesh cdfp_mesh;
typedef struct cdfp_model cdfp_model;
typedef struct cdfp_simulation cdfp_simulation;
typedef struct cdfp_recorder cdfp_recorder;
typedef struct cdfp_topology cdfp_topology;
typedef struct cdfp_cohesive cdfp_cohesive;
typedef struct cdfp_contact_search cdfp_contact_search;
typedef struct cdfp_contact cdfp_contact;

/** One more owner of the object behind a handle of any kind: `copy` is a handle of its own to the same
 * object, and each of the two must be freed. The object goes with its last owner. */
int32_t cdfp_share(const void* handle, void** copy);

/** What all the `..._free` below do, for a handle of any kind. */
int32_t cdfp_free(void** handle);

/* ---- meshes that cdfp makes --------------------------------------------------------------------------- */

enum {
  CDFP_REGULAR = 0,  /**< square grid */
  CDFP_GRADED = 1,   /**< grid that gets finer towards the impact point */
  CDFP_O_GRID = 2,   /**< rings around the impact point, turning into the square rim */
  CDFP_IRREGULAR = 3 /**< unstructured quadrilaterals */
};

/** Quarter model of a laminated plate on rubber under a rigid impactor. Lengths in m, z upwards, impact point
 *  at x = y = 0 on the top face. */
typedef struct cdfp_laminated_plate {
  double half_width;
  double lower_glass; /**< thicknesses */
  double pvb;
  double upper_glass;
  double support;
  int32_t lower_layers;
  int32_t pvb_layers;
  int32_t upper_layers;
  int32_t support_layers;
  int32_t columns; /**< along one side */
  int32_t layout;  /**< CDFP_REGULAR, CDFP_GRADED, CDFP_O_GRID or CDFP_IRREGULAR */
  double impactor_radius;
  double impactor_shaft; /**< length of the cylinder above the head */
  double impactor_gap;
  double impactor_refinement;
} cdfp_laminated_plate;

/** The geometry of examples/laminated_glass at the paper's full size. */
int32_t cdfp_laminated_plate_default(cdfp_laminated_plate* plate);

/** Parts: "lower_glass", "pvb", "upper_glass", "support", "impactor". Node sets: "support_bottom",
 *  "symmetry_x", "symmetry_y". Facet sets: "lower_glass_faces", "upper_glass_faces", "support_top",
 *  "impactor_head". */
int32_t cdfp_mesh_create_laminated_plate(const cdfp_laminated_plate* plate, cdfp_mesh** mesh);
int32_t cdfp_mesh_free(cdfp_mesh** mesh);

/* Views of a mesh hold until it is freed. */
int32_t cdfp_mesh_coordinates(const cdfp_mesh* mesh, const double** coordinates, int64_t* nodes);
int32_t cdfp_mesh_hexahedra(const cdfp_mesh* mesh, const int32_t** hexahedra, int64_t* elements);
int32_t cdfp_mesh_parts(const cdfp_mesh* mesh, const int32_t** parts, int64_t* elements);
/** Layer through the thickness from the bottom of its part. */
int32_t cdfp_mesh_layers(const cdfp_mesh* mesh, const int32_t** layers, int64_t* elements);
int32_t cdfp_mesh_part_count(const cdfp_mesh* mesh, int64_t* count);
int32_t cdfp_mesh_part_name(const cdfp_mesh* mesh, int64_t part, char* text, int64_t capacity,
                            int64_t* length);
int32_t cdfp_mesh_node_set(const cdfp_mesh* mesh, const char* name, const int32_t** nodes, int64_t* count);
int32_t cdfp_mesh_facet_set(const cdfp_mesh* mesh, const char* name, const int32_t** facets, int64_t* count);

/* ---- model: what to simulate -------------------------------------------------------------------------- */

enum {
  CDFP_ONE_POINT = 0, /**< mean gradient, one point, assumed-strain hourglass control */
  CDFP_FULL = 1       /**< 2 x 2 x 2 points, mean volumetric strain (does not lock at nu 0.49) */
};

/** An empty model. Names tie its entries together; `cdfp_simulation_create` resolves and checks them, so the
 *  entries may come in any order. All arrays and strings are copied. */
int32_t cdfp_model_create(cdfp_model** model);
int32_t cdfp_model_free(cdfp_model** model);

int32_t cdfp_model_set_title(cdfp_model* model, const char* title);

/** `hexahedra`: corners in the order of VTK (bottom 0-1-2-3, top 4-5-6-7). `parts`: part of each element, by
 *  the order of `cdfp_model_add_part`. `layers` may be NULL. */
int32_t cdfp_model_set_mesh(cdfp_model* model, int64_t nodes, const double* coordinates, int64_t elements,
                            const int32_t* hexahedra, const int32_t* parts, const int32_t* layers);
/** The same for any bulk elements: `types` (elements) of CDFP_HEXAHEDRON and the like; `corners`: how many
 *  numbers `connectivity` holds, the corners of all elements one after the other. A simulation takes
 *  hexahedra, tetrahedra and wedges. */
int32_t cdfp_model_set_mixed_mesh(cdfp_model* model, int64_t nodes, const double* coordinates,
                                  int64_t elements, const int32_t* types, int64_t corners,
                                  const int32_t* connectivity, const int32_t* parts, const int32_t* layers);
int32_t cdfp_model_add_node_set(cdfp_model* model, const char* name, int64_t count, const int32_t* nodes);
int32_t cdfp_model_add_facet_set(cdfp_model* model, const char* name, int64_t count, const int32_t* facets);

int32_t cdfp_model_add_elastic_material(cdfp_model* model, const char* name, double density,
                                        double youngs_modulus, double poissons_ratio);
/** E = static_modulus + rate_modulus * (rate / 1 s^-1)^rate_exponent, rate smoothed over `smoothing_time`. */
int32_t cdfp_model_add_rate_dependent_material(cdfp_model* model, const char* name, double density,
                                               double poissons_ratio, double static_modulus,
                                               double rate_modulus, double rate_exponent,
                                               double smoothing_time);
int32_t cdfp_model_add_rigid_material(cdfp_model* model, const char* name, double density,
                                      double youngs_modulus, double poissons_ratio);

/** A material whose law is the user's: fill it by `cdfp_user_material_default`, then give density, states and
 *  properties. */
typedef struct cdfp_user_material {
  double density;
  double youngs_modulus; /**< of hourglass modes and contact; 0: as the law's first call shows */
  double poissons_ratio;
  const double* properties; /**< (property_count), copied; may be NULL if there are none */
  int64_t property_count;
  int32_t states;         /**< numbers kept at each point */
  int32_t deletion_state; /**< a point where the law makes this state 0 is deleted; -1: none */
  int32_t thread_safe;    /**< not 0: several threads may call the law at once */
} cdfp_user_material;

int32_t cdfp_user_material_default(cdfp_user_material* material);

/** The law's first call comes when a simulation is made: at time 0, with a tiny strain increment, whose
 * stress shows the elastic constants and is dropped while its state is kept. Then it is called once a step
 * for each block of points. `user_data` must live as long as the model and its simulations. */
int32_t cdfp_model_add_user_material(cdfp_model* model, const char* name, const cdfp_user_material* material,
                                     cdfp_material_callback callback, void* user_data);
/** By a `cdfp_material_callback` in a shared library; its user data are NULL. */
int32_t cdfp_model_add_library_material(cdfp_model* model, const char* name,
                                        const cdfp_user_material* material, const char* library,
                                        const char* function);

/** What a VUMAT is told besides. */
typedef struct cdfp_vumat {
  double temperature;
  const double* fields; /**< (field_count), copied; may be NULL if there are none */
  int64_t field_count;
  int32_t single_precision; /**< not 0: its reals have four bytes */
} cdfp_vumat;

int32_t cdfp_vumat_default(cdfp_vumat* vumat);

/** By the subroutine VUMAT of a shared library, which is given `name` as cmname, in capitals. See
 *  cdfp/material_library.hpp. */
int32_t cdfp_model_add_vumat_material(cdfp_model* model, const char* name, const cdfp_user_material* material,
                                      const cdfp_vumat* vumat, const char* library);
/** Names a state of a user's material in output. */
int32_t cdfp_model_set_state_name(cdfp_model* model, const char* material, int32_t state, const char* name);

/** Compiles a source (Fortran, C or C++) to a shared library, as `cdfp build-material` does. */
int32_t cdfp_build_material(const char* source, const char* library, int32_t single_precision);

enum {
  CDFP_LINEAR = 0,        /**< extrinsic, irreversible, path-dependent (Snozzi and Molinari 2013) */
  CDFP_CAMACHO_ORTIZ = 1, /**< extrinsic, from a potential while it loads: mode_ratio 1 */
  CDFP_BILINEAR = 2,      /**< intrinsic, for bonds */
  CDFP_USER = 3           /**< by `cdfp_model_set_cohesive_callback` */
};

/** Cohesive law: fill it by `cdfp_cohesive_law_default`, then give strength and fracture energy. */
typedef struct cdfp_cohesive_law {
  double strength;          /**< Pa */
  double fracture_energy;   /**< G_I, J/m2 */
  double mode_ratio;        /**< G_II / G_I */
  double shear_ratio;       /**< peak shear over strength */
  double friction;          /**< Coulomb coefficient between closed faces */
  double friction_exponent; /**< of the growth of friction with damage */
  double internal_friction; /**< share of a pressure that holds the shear on a facet back */
  double stiffness;        /**< Pa/m: of a bilinear law before its strength; steepest slope of a user's law */
  double weibull_modulus;  /**< of the scatter of the strength over facets; 0: none */
  double weibull_area;     /**< m2 that `strength` belongs to; 0: each facet's own area */
  double rate_sensitivity; /**< c of the factor 1 + c ln(1 + opening rate / reference_rate); 0: none */
  double reference_rate;   /**< m/s */
  int64_t seed;            /**< of the scatter */
  int32_t kind;            /**< CDFP_LINEAR and the like */
} cdfp_cohesive_law;

int32_t cdfp_cohesive_law_default(cdfp_cohesive_law* law);
int32_t cdfp_model_add_cohesive_law(cdfp_model* model, const char* name, const cdfp_cohesive_law* law);

/** What a user's law is asked for: all its points at a step. Vectors are (count, 3). */
typedef struct cdfp_cohesive_points {
  int64_t count;
  double time;                      /**< s */
  double step;                      /**< s */
  const double* opening;            /**< m, upper side minus lower side */
  const double* normal;             /**< from lower to upper */
  const double* insertion_traction; /**< Pa, what the law must give at no opening; 0 in a bond */
  double* state;                    /**< (count, states), 0 at insertion; the law's own */
  double* traction;                 /**< out: Pa, that the upper side exerts on the lower one */
  double* stored;                   /**< out: J/m2 that closing gives back */
  double* damage;                   /**< out: 0 to 1; broken for good at 1 */
} cdfp_cohesive_points;

typedef void (*cdfp_cohesive_callback)(const cdfp_cohesive_points* points, void* user_data);

/** The traction of the CDFP_USER law of that name. It keeps `states` numbers at each point. Simulations of
 *  the model call it, once a step; it must not call cdfp with their handles, and `user_data` must live as
 *  long as they do. */
int32_t cdfp_model_set_cohesive_callback(cdfp_model* model, const char* cohesive_law,
                                         cdfp_cohesive_callback callback, int32_t states, void* user_data);

/** Cohesive elements from the start between all elements of two parts that share nodes, or on the facets of a
 *  set, by a CDFP_BILINEAR or CDFP_USER law. */
int32_t cdfp_model_add_bond(cdfp_model* model, const char* first_part, const char* second_part,
                            const char* cohesive_law);
int32_t cdfp_model_add_bonded_facets(cdfp_model* model, const char* facet_set, const char* cohesive_law);

/** How the traction on a facet follows from the stresses of elements. */
enum {
  CDFP_ELEMENT_MEAN = 0, /**< mean of the facet's two elements */
  CDFP_NODAL = 1         /**< mean over the elements of a part around each corner, then over the corners */
};
int32_t cdfp_model_set_stress_recovery(cdfp_model* model, int32_t recovery);

/** `shares` (count, one an element): share of its law's strength that an element has; a facet has the mean of
 *  its two elements. A count of 0: all have all of it. */
int32_t cdfp_model_set_strength_shares(cdfp_model* model, int64_t count, const double* shares);

/** The first part added is number 0 of the mesh's `parts`. `cohesive_law` may be NULL or empty: does not
 *  crack. `hourglass`: share of the assumed-strain stiffness (CDFP_ONE_POINT). */
int32_t cdfp_model_add_part(cdfp_model* model, const char* name, const char* material, int32_t formulation,
                            double hourglass, const char* cohesive_law);

/** All elements of a part move as one. `inertia` (9, kg m2 about the centre of mass) may be NULL: from the
 *  mesh; the velocities (3) and the flags (3, not 0: held) may be NULL: zero. */
int32_t cdfp_model_add_rigid_body(cdfp_model* model, const char* part, double mass, const double* inertia,
                                  const double* velocity, const double* angular_velocity,
                                  const int32_t* translation_fixed, const int32_t* rotation_fixed);

int32_t cdfp_model_add_symmetry_plane(cdfp_model* model, int32_t axis, double coordinate);

/** `directions` (3): not 0 where the velocity is prescribed. `times` (count) ascend; NULL with a count of 1:
 *  `values[0]` for good. */
int32_t cdfp_model_add_prescribed_velocity(cdfp_model* model, const char* node_set, const int32_t* directions,
                                           int64_t count, const double* times, const double* values);
/** velocity + gradient * position. `velocity` (3), m/s; `gradient` (9, row by row), 1/s, may be NULL: none.
 */
int32_t cdfp_model_add_initial_velocity(cdfp_model* model, const char* part, const double* velocity,
                                        const double* gradient);
int32_t cdfp_model_set_gravity(cdfp_model* model, const double* gravity);

/** What a load is given at a step. Vectors are (nodes, 3); nodes that cracks made are among them. */
typedef struct cdfp_nodal_load {
  int64_t nodes;
  double time;            /**< s */
  const double* position; /**< m */
  const double* velocity; /**< m/s, at the half step that led to `position` */
  double* force;          /**< N: of elements and gravity so far; the load is what is added */
} cdfp_nodal_load;

typedef void (*cdfp_load_callback)(const cdfp_nodal_load* load, void* user_data);

/** Forces of the caller's own, once a step; their work is external work. The callback must not call cdfp with
 *  the simulation's handle, and `user_data` must live as long as the model's simulations do. */
int32_t cdfp_model_set_load_callback(cdfp_model* model, cdfp_load_callback callback, void* user_data);

/** What `cdfp_model_get_contact` fills and `cdfp_model_set_contact` takes: get, change what differs, set. */
typedef struct cdfp_contact_settings {
  double cell_factor;         /**< w1: cell length over mean segment length */
  double buffer_factor;       /**< w2: buffer over mean segment length */
  double penalty_factor;      /**< zeta in k = zeta K A^2 / V */
  double friction;            /**< Coulomb coefficient */
  double depth_limit;         /**< deepest penetration that counts, over the segment's element height */
  double penetration_warning; /**< share of that height from which a warning names the pair */
  int32_t edge_edge;          /**< 0: node-face pairs only */
  int32_t adaptive;           /**< 0: a regular search whenever contact entities are new */
} cdfp_contact_settings;

/** A facet set that may touch others and itself; without any the scene has no contact. */
int32_t cdfp_model_add_contact_surface(cdfp_model* model, const char* facet_set);
int32_t cdfp_model_get_contact(const cdfp_model* model, cdfp_contact_settings* settings);
int32_t cdfp_model_set_contact(cdfp_model* model, const cdfp_contact_settings* settings);

int32_t cdfp_model_set_end_time(cdfp_model* model, double end);
/** 0: automatic, a share of the stable step that `cdfp_model_set_step_factor` sets. */
int32_t cdfp_model_set_fixed_step(cdfp_model* model, double fixed_step);
int32_t cdfp_model_set_step_factor(cdfp_model* model, double step_factor);
/** Steps between rows of the history. */
int32_t cdfp_model_set_history_interval(cdfp_model* model, int64_t history_interval);
/** 0: as many as the machine has. Results are the same bits for any number. */
int32_t cdfp_model_set_threads(cdfp_model* model, int32_t threads);

/* ---- simulation --------------------------------------------------------------------------------------- */

/** J. `balance` = (all that is stored and dissipated) / (initial + external work). */
typedef struct cdfp_energies {
  double kinetic;
  double strain; /**< without hourglass */
  double hourglass;
  double material_dissipated;
  double cohesive_stored;
  double cohesive_dissipated;
  double cohesive_friction;
  double contact_stored;
  double contact_friction;
  double external_work;
  double initial;
  double balance;
} cdfp_energies;

/** Of a rigid body; the force (N) is by contact, on what is modelled. */
typedef struct cdfp_body_state {
  double position[3];
  double velocity[3];
  double angular_velocity[3];
  double contact_force[3];
} cdfp_body_state;

/** As `summary.json`; NaN for what never came about. */
typedef struct cdfp_summary {
  int64_t elements;
  int64_t nodes_initial;
  int64_t nodes_final;
  int64_t segments_initial;
  int64_t segments_final;
  int64_t steps;
  int64_t threads;
  int64_t dt_element;
  int64_t cohesive_inserted;
  int64_t cohesive_broken;
  double simulated_time_s;
  double dt_s;
  double dt_stable_s;
  double wall_s;
  double peak_rss_mb;
  double energy_balance_min;
  double energy_balance_max;
  double hourglass_over_strain_max;
  double cohesive_dissipated_over_ga;
  double cohesive_slope_cost_j;
  double first_contact_s;
  double peak_force_n;
  double peak_force_time_s;
  double impactor_rebound_mps;
  double deepest_penetration_m;
} cdfp_summary;

/** Two parts that have touched, or one that touched itself. */
typedef struct cdfp_contact_pair {
  double peak_force_n; /**< on what is modelled */
  double stored_j;     /**< in contact springs now */
  double friction_heat_j;
  double deepest_penetration_m;
} cdfp_contact_pair;

/** Checks the model and builds what it needs. The model is copied: it may be changed, used again or freed. */
int32_t cdfp_simulation_create(const cdfp_model* model, cdfp_simulation** simulation);
int32_t cdfp_simulation_free(cdfp_simulation** simulation);

/** One step. CDFP_DIVERGED if the state is lost; it stays readable. */
int32_t cdfp_simulation_step(cdfp_simulation* simulation);
/** As many steps as are left, at most `steps`; `done` may be NULL. */
int32_t cdfp_simulation_advance(cdfp_simulation* simulation, int64_t steps, int64_t* done);
/** Steps until half a step from `time` or nearer, or the end; `done` may be NULL. */
int32_t cdfp_simulation_advance_to(cdfp_simulation* simulation, double time, int64_t* done);

/** Writes all that the next step needs into a file, which takes its place when it is whole. */
int32_t cdfp_simulation_save(const cdfp_simulation* simulation, const char* path);
/** Goes on from there, in a simulation that was built from the same model and not stepped yet: it takes the
 *  same steps to the bit, with any number of threads. Title, threads, time and output of the model may be
 *  others. What callbacks keep for themselves is theirs to bring back. CDFP_BAD_INPUT for a file that is cut
 *  short, damaged, of another model or version; nothing is changed then. */
int32_t cdfp_simulation_restore(cdfp_simulation* simulation, const char* path);

/** Called after every step with the handle that was stepped; not 0: no further step of this call. It may look
 *  at the simulation and change its state, but not step it. */
typedef int32_t (*cdfp_step_callback)(cdfp_simulation* simulation, void* user_data);
/** NULL: none. */
int32_t cdfp_simulation_set_monitor(cdfp_simulation* simulation, cdfp_step_callback callback,
                                    void* user_data);

int32_t cdfp_simulation_finished(const cdfp_simulation* simulation, int32_t* finished);
int32_t cdfp_simulation_time(const cdfp_simulation* simulation, double* time);
int32_t cdfp_simulation_step_size(const cdfp_simulation* simulation, double* step_size);
int32_t cdfp_simulation_stable_step(const cdfp_simulation* simulation, double* stable_step);
int32_t cdfp_simulation_controlling_element(const cdfp_simulation* simulation, int32_t* element);
int32_t cdfp_simulation_step_count(const cdfp_simulation* simulation, int64_t* steps);
int32_t cdfp_simulation_node_count(const cdfp_simulation* simulation, int64_t* nodes);

/* Views of the nodal state, (n, 3) or (n), in place: they hold until the next step. */
int32_t cdfp_simulation_positions(const cdfp_simulation* simulation, const double** positions,
                                  int64_t* nodes);
/** Half a step ahead of the positions. */
int32_t cdfp_simulation_velocities(const cdfp_simulation* simulation, const double** velocities,
                                   int64_t* nodes);
/** All nodal forces of the last step. */
int32_t cdfp_simulation_forces(const cdfp_simulation* simulation, const double** forces, int64_t* nodes);
int32_t cdfp_simulation_masses(const cdfp_simulation* simulation, const double** masses, int64_t* nodes);
/** Cauchy stress, mean over each element, into `stress` (elements, 6): xx yy zz xy yz zx, Pa. */
int32_t cdfp_simulation_get_stresses(const cdfp_simulation* simulation, int64_t elements, double* stress);

/* Changes of the state between steps, (nodes, 3). Nodes of rigid bodies and directions that are prescribed
 * keep what they have; the energy that a change brings is external work. */
/** Contact is searched anew. */
int32_t cdfp_simulation_set_positions(cdfp_simulation* simulation, int64_t nodes, const double* positions);
/** Half a step ahead of the positions. */
int32_t cdfp_simulation_set_velocities(cdfp_simulation* simulation, int64_t nodes, const double* velocities);

int32_t cdfp_simulation_body_count(const cdfp_simulation* simulation, int64_t* bodies);
/** Bodies in the order of `cdfp_model_add_rigid_body`. */
int32_t cdfp_simulation_body(const cdfp_simulation* simulation, int64_t body, cdfp_body_state* state);

int32_t cdfp_simulation_cohesive_count(const cdfp_simulation* simulation, int64_t* inserted, int64_t* broken);
/** Copies a number of each element to `values` (elements): "von_mises" or "max_principal" (Pa), or with
 * users' materials a state by its name, "stress_xx" and the like, "deleted". NaN where an element has none.
 */
int32_t cdfp_simulation_element_field(const cdfp_simulation* simulation, const char* name, int64_t elements,
                                      double* values);
int32_t cdfp_simulation_energies(const cdfp_simulation* simulation, cdfp_energies* energies);
int32_t cdfp_simulation_summary(const cdfp_simulation* simulation, cdfp_summary* summary);
/** Of a part that may crack: `time` is NaN and `layer` -1 while it has not; `position` (3) is the centre of
 *  the facet in the undeformed mesh. */
int32_t cdfp_simulation_first_crack(const cdfp_simulation* simulation, const char* part, double* time,
                                    int32_t* layer, double* position);
/** Pairs of parts that have touched, in the order in which they first did. */
int32_t cdfp_simulation_contact_pair_count(const cdfp_simulation* simulation, int64_t* count);
int32_t cdfp_simulation_contact_pair(const cdfp_simulation* simulation, int64_t pair,
                                     cdfp_contact_pair* values);
/** Name of the part on a side of the pair, 0 or 1. */
int32_t cdfp_simulation_contact_pair_part(const cdfp_simulation* simulation, int64_t pair, int32_t side,
                                          char* text, int64_t capacity, int64_t* length);

/** Stages of the step: wall time so far and calls, and the name of the stage. */
int32_t cdfp_simulation_stage_count(const cdfp_simulation* simulation, int64_t* count);
int32_t cdfp_simulation_stage(const cdfp_simulation* simulation, int64_t stage, double* seconds,
                              int64_t* calls, char* text, int64_t capacity, int64_t* length);
int32_t cdfp_simulation_warning_count(const cdfp_simulation* simulation, int64_t* count);
int32_t cdfp_simulation_warning(const cdfp_simulation* simulation, int64_t warning, char* text,
                                int64_t capacity, int64_t* length);

/** Rows of the history one after the other, `columns` values each; holds until the next step. */
int32_t cdfp_simulation_history(const cdfp_simulation* simulation, const double** values, int64_t* rows,
                                int64_t* columns);
/** Name with its unit, such as "time_s". */
int32_t cdfp_simulation_history_column(const cdfp_simulation* simulation, int64_t column, char* text,
                                       int64_t capacity, int64_t* length);

/* ---- results in a folder ------------------------------------------------------------------------------ */

/** Makes the folder and removes from it what an earlier run left. */
int32_t cdfp_recorder_create(const cdfp_simulation* simulation, const char* folder, cdfp_recorder** recorder);
/** For a simulation that was restored: keeps what the run up to then has left in the folder. */
int32_t cdfp_recorder_continue(const cdfp_simulation* simulation, const char* folder,
                               cdfp_recorder** recorder);
int32_t cdfp_recorder_free(cdfp_recorder** recorder);
/** The state now as a snapshot for ParaView, and the history so far. */
int32_t cdfp_recorder_snapshot(cdfp_recorder* recorder, const cdfp_simulation* simulation);
/** history.csv, results.h5, summary.json and the pictures. */
int32_t cdfp_recorder_finish(cdfp_recorder* recorder, const cdfp_simulation* simulation);

/* ---- TopS on the caller's connectivity ---------------------------------------------------------------- */

enum {
  CDFP_HEXAHEDRON = 0,
  CDFP_TETRAHEDRON = 1,
  CDFP_WEDGE = 2,
  CDFP_PYRAMID = 3,
  CDFP_COHESIVE_QUADRILATERAL = 4, /**< 8 nodes: upper face 0-1-2-3, lower face 4-5-6-7 */
  CDFP_COHESIVE_TRIANGLE = 5       /**< 6 nodes: upper face 0-1-2, lower face 3-4-5 */
};

/** `types` (elements) may be NULL: all hexahedra. `corners`: how many numbers `connectivity` holds, the
 *  corners of all elements one after the other. */
int32_t cdfp_topology_create(int64_t nodes, int64_t elements, const int32_t* types, int64_t corners,
                             const int32_t* connectivity, cdfp_topology** topology);
int32_t cdfp_topology_free(cdfp_topology** topology);

int32_t cdfp_topology_node_count(const cdfp_topology* topology, int64_t* nodes);
/** `elements`: bulk and cohesive; the bulk elements come first. */
int32_t cdfp_topology_element_count(const cdfp_topology* topology, int64_t* elements, int64_t* bulk);
int32_t cdfp_topology_element_type(const cdfp_topology* topology, int32_t element, int32_t* type);
/** Corners of an element now; the view holds until the next insertion. */
int32_t cdfp_topology_element_nodes(const cdfp_topology* topology, int32_t element, const int32_t** nodes,
                                    int64_t* count);
int32_t cdfp_topology_facet_count(const cdfp_topology* topology, int32_t element, int64_t* facets);
int32_t cdfp_topology_edge_count(const cdfp_topology* topology, int32_t element, int64_t* edges);
/** The facet on the other side: of a cohesive element if one stands between, -1 and -1 at the boundary.
 *  Facet 0 of a cohesive element is its upper face, facet 1 its lower face. */
int32_t cdfp_topology_mate(const cdfp_topology* topology, int32_t element, int32_t facet,
                           int32_t* mate_element, int32_t* mate_facet);
/** `nodes` has room for 4; outward order. */
int32_t cdfp_topology_facet_nodes(const cdfp_topology* topology, int32_t element, int32_t facet,
                                  int32_t* nodes, int64_t* count);
/** `nodes` has room for 2. Local facets and edges are numbered as in cdfp/topology.hpp. */
int32_t cdfp_topology_edge_nodes(const cdfp_topology* topology, int32_t element, int32_t edge,
                                 int32_t* nodes);
/** Pairs of element and local edge around an edge, in cyclic order. `uses` has room for `capacity` pairs;
 *  `count` is that of all pairs, those included for which there was no room. */
int32_t cdfp_topology_elements_around_edge(const cdfp_topology* topology, int32_t element, int32_t edge,
                                           int64_t capacity, int32_t* uses, int64_t* count);
/** Pairs of element and corner around a node, ascending; room and count as above. */
int32_t cdfp_topology_elements_around_node(const cdfp_topology* topology, int32_t node, int64_t capacity,
                                           int32_t* uses, int64_t* count);

/** Inserts a cohesive element at an inner facet between two bulk elements. `new_nodes`: pairs of new node
 *  and the node that it copies, in the order of their numbers. `renumbered`: element, corner, old node, new
 *  node for every corner that changed. Both views hold until the next insertion. */
int32_t cdfp_topology_insert_cohesive(cdfp_topology* topology, int32_t element, int32_t facet,
                                      int32_t* cohesive_element, const int32_t** new_nodes,
                                      int64_t* new_node_count, const int32_t** renumbered,
                                      int64_t* renumbered_count);
/** The first relation that does not hold; length 0 if all do. */
int32_t cdfp_topology_check(const cdfp_topology* topology, char* text, int64_t capacity, int64_t* length);

/* ---- the cohesive law at single points ---------------------------------------------------------------- */

/** State of one point of the extrinsic irreversible law; `cdfp_cohesive_law_start` fills it in. */
typedef struct cdfp_cohesive_point {
  double strength;   /**< Pa, effective traction at insertion */
  double reach;      /**< m, effective opening at which no traction is left */
  double largest;    /**< m, largest effective opening so far; broken once it is `reach` */
  double dissipated; /**< J/m2 */
  double opening[3]; /**< m, at the last call */
  double insertion_traction[3];
} cdfp_cohesive_point;

/* Vectors are (count, 3); the laws of cdfp/cohesive.hpp, which says more. */

/** Points that carry `traction` on faces with unit normals `normal`, from the lower to the upper side. */
int32_t cdfp_cohesive_law_start(const cdfp_cohesive_law* law, int64_t count, const double* traction,
                                const double* normal, cdfp_cohesive_point* points);
/** Traction at `opening`; the state goes along the straight segment from the last one. */
int32_t cdfp_cohesive_law_traction(const cdfp_cohesive_law* law, int64_t count, const double* opening,
                                   const double* normal, cdfp_cohesive_point* points, double* traction);
/** Mean traction over the increment: times the increment it is exactly the change of energy. */
int32_t cdfp_cohesive_law_mean_traction(const cdfp_cohesive_law* law, int64_t count, const double* opening,
                                        const double* normal, cdfp_cohesive_point* points, double* traction);
/** J/m2 that each point gives back when it closes: `stored` (count). */
int32_t cdfp_cohesive_law_stored(const cdfp_cohesive_law* law, int64_t count, const double* normal,
                                 const cdfp_cohesive_point* points, double* stored);

/* ---- cohesive elements between the caller's nodes ----------------------------------------------------- */

/* For a driver of its own by central differences; the forces are those of a full simulation. In a step: move
 * the nodes, compute all other forces, open facets (`cdfp_cohesive_find_open`; for each of them
 * `cdfp_topology_insert_cohesive`, `cdfp_cohesive_follow`, `cdfp_cohesive_insert`),
 * `cdfp_cohesive_add_force`, and only then change the velocities by step * force / mass. */

/** Elements have consecutive numbers from `first_element` on: the count of bulk elements for those of a
 *  topology, 0 for those of a caller who numbers them alone. */
int32_t cdfp_cohesive_create(int32_t first_element, cdfp_cohesive** cohesive);
int32_t cdfp_cohesive_free(cdfp_cohesive** cohesive);

/** `number`: by which elements and parts name the law, from 0 in the order of these calls. */
int32_t cdfp_cohesive_add_law(cdfp_cohesive* cohesive, const cdfp_cohesive_law* law, int32_t* number);
/** A CDFP_USER law: see `cdfp_model_set_cohesive_callback`. */
int32_t cdfp_cohesive_add_user_law(cdfp_cohesive* cohesive, const cdfp_cohesive_law* law,
                                   cdfp_cohesive_callback callback, int32_t states, void* user_data,
                                   int32_t* number);
/** These nodes do not follow forces where `directions` (3) is not 0: prescribed, or of a rigid body. Their
 *  copies inherit it. */
int32_t cdfp_cohesive_hold(cdfp_cohesive* cohesive, int64_t count, const int32_t* nodes,
                           const int32_t* directions);

/** For `cdfp_cohesive_find_open`: `parts` (elements, the bulk ones), `law_of_part` (part_count, -1: does not
 *  crack), `recovery` (CDFP_ELEMENT_MEAN or CDFP_NODAL), `strength_shares` (elements, may be NULL). All laws
 *  must have been added. `coordinates` of the undeformed mesh. */
int32_t cdfp_cohesive_set_parts(cdfp_cohesive* cohesive, const cdfp_topology* topology, int64_t nodes,
                                const double* coordinates, int64_t elements, const int32_t* parts,
                                int64_t part_count, const int32_t* law_of_part, int32_t recovery,
                                const double* strength_shares);
/** Facets between two elements of one part that reach their strength. `stress` (elements, 6): Cauchy, xx yy
 *  zz xy yz zx. `facets` (count, 3): element, facet, law; `tractions` (count, 3). The views hold until the
 *  next such call. */
int32_t cdfp_cohesive_find_open(cdfp_cohesive* cohesive, const cdfp_topology* topology, int64_t nodes,
                                const double* position, int64_t elements, const double* stress,
                                int32_t threads, const int32_t** facets, const double** tractions,
                                int64_t* count);

/** What `cdfp_topology_insert_cohesive` has reported, after each insertion and before `cdfp_cohesive_insert`:
 *  `new_nodes` (new_node_count, 2), `renumbered` (renumbered_count, 4). */
int32_t cdfp_cohesive_follow(cdfp_cohesive* cohesive, int64_t new_node_count, const int32_t* new_nodes,
                             int64_t renumbered_count, const int32_t* renumbered);
/** The next element. `corners` is 6 or 8: the upper face, then the lower face, as
 *  `cdfp_topology_element_nodes` gives them. `traction` (3): what the upper side exerts on the lower one now;
 *  NULL: nothing, for bonds. */
int32_t cdfp_cohesive_insert(cdfp_cohesive* cohesive, int32_t element, int32_t law, int64_t corners,
                             const int32_t* connectivity, const double* traction, int64_t nodes,
                             const double* position, double time);
/** Adds to `force`, which holds all others of the step. `velocity`: at the half step that led to `position`.
 */
int32_t cdfp_cohesive_add_force(cdfp_cohesive* cohesive, int64_t nodes, const double* position,
                                const double* velocity, const double* mass, double* force, double step,
                                double time, int32_t threads);

int32_t cdfp_cohesive_count(const cdfp_cohesive* cohesive, int64_t* elements, int64_t* broken);
/** Elements whose faces came free in the last `cdfp_cohesive_add_force`, ascending; the view holds until the
 *  next. */
int32_t cdfp_cohesive_broken_now(const cdfp_cohesive* cohesive, const int32_t** elements, int64_t* count);

/** A node pair after the last `cdfp_cohesive_add_force`. */
typedef struct cdfp_cohesive_pair {
  double area;     /**< m2 that it stands for */
  double strength; /**< Pa, effective traction at insertion */
  double reach;    /**< m, effective opening at which no traction is left */
  double largest;  /**< m, largest effective opening so far */
  double damage;   /**< 0 to 1 */
  double stored;   /**< J/m2 */
  double dissipated;
  int32_t upper; /**< node */
  int32_t lower; /**< node; the same while the two sides hold together there */
} cdfp_cohesive_pair;

/** `pairs` has room for 4. */
int32_t cdfp_cohesive_pairs(const cdfp_cohesive* cohesive, int32_t element, cdfp_cohesive_pair* pairs,
                            int64_t* count);

/** J: stored, dissipated by the cohesive tractions, friction heat between closed faces, and what the laws say
 *  that the same openings dissipate. */
int32_t cdfp_cohesive_energies(const cdfp_cohesive* cohesive, double* stored, double* dissipated,
                               double* friction, double* by_law);
/** omega^2 in 1/s2 that users' laws add to the elements' for the stable step 2/omega; the others add none. */
int32_t cdfp_cohesive_stiffness_over_mass(const cdfp_cohesive* cohesive, int64_t nodes, const double* mass,
                                          double* stiffness_over_mass);

/* ---- contact search on the caller's arrays ------------------------------------------------------------ */

/** `cell_factor` and `buffer_factor`: cell and buffer over the mean segment length (1.0 and 0.4 are usual).
 *  `adaptive`: not 0 if `cdfp_contact_search_adaptive` will be called. */
int32_t cdfp_contact_search_create(double cell_factor, double buffer_factor, int32_t adaptive,
                                   cdfp_contact_search** search);
int32_t cdfp_contact_search_free(cdfp_contact_search** search);

/** All candidate pairs. `contact_nodes` (contact_node_count); `segments` (segment_count, 4): corners, -1 last
 *  in a triangle; `edges` (edge_count, 2); `groups` (nodes): entities of one group >= 0 do not pair; may be
 *  NULL. */
int32_t cdfp_contact_search_regular(cdfp_contact_search* search, int64_t nodes, const double* position,
                                    int64_t contact_node_count, const int32_t* contact_nodes,
                                    int64_t segment_count, const int32_t* segments, int64_t edge_count,
                                    const int32_t* edges, const int32_t* groups, int32_t threads);
/** Adds the pairs of what was appended to the arrays since the last search, and of old segments and edges
 * that name other nodes at the same place. */
int32_t cdfp_contact_search_adaptive(cdfp_contact_search* search, int64_t nodes, const double* position,
                                     int64_t contact_node_count, const int32_t* contact_nodes,
                                     int64_t segment_count, const int32_t* segments, int64_t edge_count,
                                     const int32_t* edges, const int32_t* groups,
                                     int64_t renamed_segment_count, const int32_t* renamed_segments,
                                     int64_t renamed_edge_count, const int32_t* renamed_edges);
/** Once a step: whether entities may have moved so far that a regular search is due. */
int32_t cdfp_contact_search_due(cdfp_contact_search* search, double largest_speed, double step, int32_t* due);
/** m: cell length, buffer, bound on the relative movement since the last regular search. */
int32_t cdfp_contact_search_lengths(const cdfp_contact_search* search, double* cell, double* buffer,
                                    double* travel);
/** Pairs as compressed rows: the partners of row r stand in [start[r], start[r + 1]), ascending. Rows are
 *  places in `contact_nodes`, partners segments. The views hold until the next call with this handle. */
int32_t cdfp_contact_search_node_segments(cdfp_contact_search* search, const int32_t** start,
                                          const int32_t** partners, int64_t* rows);
/** The same for edges: the row is the smaller edge of each pair. */
int32_t cdfp_contact_search_edge_edges(cdfp_contact_search* search, const int32_t** start,
                                       const int32_t** partners, int64_t* rows);

/** The point of a face closest to `point` (3). `corners` is 3 or 4, `coordinates` (corners, 3) in outward
 *  order. `shape` has room for 4: shape functions of the corners there; `normal` (3): unit, outward; `gap`:
 *  negative behind the face; `outside`: how far past the face's border. */
int32_t cdfp_project_on_face(const double* point, int64_t corners, const double* coordinates, double* shape,
                             double* normal, double* gap, double* outside);

/* ---- contact and friction forces on the caller's arrays ----------------------------------------------- */

/* In a step, after all forces but the cohesive ones: `cdfp_contact_due`, the search that it names,
 * `cdfp_contact_local_search`, `cdfp_contact_add_force`. Arrays are those of all nodes of the mesh. */

/** What a model starts with. */
int32_t cdfp_contact_settings_default(cdfp_contact_settings* settings);
int32_t cdfp_contact_create(const cdfp_contact_settings* settings, cdfp_contact** contact);
int32_t cdfp_contact_free(cdfp_contact** contact);

/** For messages. */
int32_t cdfp_contact_name_part(cdfp_contact* contact, int32_t part, const char* name);
/** Segments: `segments` (count, 4) corners in outward order, -1 last in a triangle; `elements` that own them;
 *  `parts`; `bulk_modulus` in Pa; `area` in m2; `volume` of the element in m3. */
int32_t cdfp_contact_add_segments(cdfp_contact* contact, int64_t count, const int32_t* segments,
                                  const int32_t* elements, const int32_t* parts, const double* bulk_modulus,
                                  const double* area, const double* volume);
/** The same for facets (count, 2) of a topology, at the start or when the faces of a crack came free: mates
 * of the broken cohesive elements' facets. `coordinates` of the undeformed mesh, for nodes as they are
 * numbered now; `parts` of the bulk elements; `bulk_modulus` (part_count). */
int32_t cdfp_contact_add_facets(cdfp_contact* contact, const cdfp_topology* topology, int64_t nodes,
                                const double* coordinates, int64_t count, const int32_t* facets,
                                int64_t elements, const int32_t* parts, int64_t part_count,
                                const double* bulk_modulus);
/** What `cdfp_topology_insert_cohesive` has reported, after each insertion: renames corners of segments, and
 *  shares the springs between split nodes. */
int32_t cdfp_contact_follow(cdfp_contact* contact, int64_t new_node_count, const int32_t* new_nodes,
                            int64_t renumbered_count, const int32_t* renumbered);

/** Elements that are no more: their segments and edges leave, and what touches them is let go. Numbers of
 *  segments stay. The faces of neighbours that are free now come by `cdfp_contact_add_facets`. */
int32_t cdfp_contact_remove_elements(cdfp_contact* contact, int64_t count, const int32_t* elements);

enum {
  CDFP_SEARCH_NONE = 0,
  CDFP_SEARCH_REGULAR = 1, /**< call `cdfp_contact_regular_search` */
  CDFP_SEARCH_ADAPTIVE = 2 /**< call `cdfp_contact_adaptive_search` */
};

/** Once a step. `velocity` that led to the positions. */
int32_t cdfp_contact_due(cdfp_contact* contact, int64_t nodes, const double* velocity, double step,
                         int32_t threads, int32_t* search);
/** `groups` (nodes): rigid body of each node or -1; may be NULL. */
int32_t cdfp_contact_regular_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                    const int32_t* groups, int32_t threads);
int32_t cdfp_contact_adaptive_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                     const int32_t* groups);
int32_t cdfp_contact_local_search(cdfp_contact* contact, int64_t nodes, const double* position,
                                  int32_t threads);
/** Adds to `force`. */
int32_t cdfp_contact_add_force(cdfp_contact* contact, int64_t nodes, const double* velocity,
                               const double* mass, double* force, double step, int32_t threads);

/** Contact nodes, segments (removed ones included), edges, and pairs that touch. */
int32_t cdfp_contact_counts(const cdfp_contact* contact, int64_t* nodes, int64_t* segments, int64_t* edges,
                            int64_t* touching);
/** The contact nodes, which are the rows of `cdfp_contact_node_segments`; holds until segments or splits are
 *  new. */
int32_t cdfp_contact_nodes(const cdfp_contact* contact, const int32_t** nodes, int64_t* count);
/** Candidate pairs as compressed rows: see `cdfp_contact_search_node_segments`. */
int32_t cdfp_contact_node_segments(cdfp_contact* contact, const int32_t** start, const int32_t** partners,
                                   int64_t* rows);
int32_t cdfp_contact_edge_edges(cdfp_contact* contact, const int32_t** start, const int32_t** partners,
                                int64_t* rows);

/** A pair that touches: `force` acts on the first `first_count` nodes by their weights, its opposite on the
 *  others by theirs. */
typedef struct cdfp_touch {
  double weights[5]; /**< positive on the first side, negative on the other; each side sums to 1 */
  double normal[3];  /**< out of the other side */
  double gap;        /**< m, negative */
  double force[3];   /**< N */
  int32_t nodes[5];
  int32_t first_count; /**< 1: node on face; 2: edge on edge */
  int32_t count;       /**< of nodes */
  int32_t parts[2];
} cdfp_touch;

/** The view holds until the next call with this handle. */
int32_t cdfp_contact_touches(cdfp_contact* contact, const cdfp_touch** touches, int64_t* count);

/** Two parts that have touched, in ascending order, or one that touched itself. */
typedef struct cdfp_body_pair {
  double force[3];      /**< N, on the first by the second at the last `cdfp_contact_add_force` */
  double stored;        /**< J, in springs then */
  double friction_heat; /**< J, so far */
  double peak_force;    /**< N, so far */
  double deepest;       /**< m, so far */
  int32_t parts[2];
} cdfp_body_pair;

/** In the order in which they first touched; the view holds until the next call with this handle. */
int32_t cdfp_contact_body_pairs(cdfp_contact* contact, const cdfp_body_pair** pairs, int64_t* count);
/** J stored in springs, J of friction heat so far, m of the deepest penetration so far. */
int32_t cdfp_contact_energies(const cdfp_contact* contact, double* stored, double* friction_heat,
                              double* deepest);
/** omega^2 in 1/s2 that the contact springs add to the elements' for the stable step 2/omega. */
int32_t cdfp_contact_stiffness_over_mass(const cdfp_contact* contact, double* stiffness_over_mass);
int32_t cdfp_contact_warning_count(const cdfp_contact* contact, int64_t* count);
int32_t cdfp_contact_warning(const cdfp_contact* contact, int64_t warning, char* text, int64_t capacity,
                             int64_t* length);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
