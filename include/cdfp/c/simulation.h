/** @file
 * A simulation, and its results in a folder.
 */
#ifndef CDFP_C_SIMULATION_H
#define CDFP_C_SIMULATION_H

#include <stdint.h>

#include "cdfp/c/common.h"

/* NOLINTBEGIN(readability-identifier-naming): names of a C interface */

#ifdef __cplusplus
extern "C" {
#endif

/* ---- simulation -------------------------------------------------------------------------------------------
 */

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

/* ---- results in a folder ----------------------------------------------------------------------------------
 */

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

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
