!> The C interface of cdfp, one to one: see cdfp/cdfp.h, which says what each function does. Numbers count
!> from 0 here and strings end with c_null_char; the module `cdfp` is what Fortran programs call. Results are
!> `intent(inout)` since a call that fails leaves them as they are.
module cdfp_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none
  public

  integer(c_int32_t), parameter :: &
    CDFP_OK = 0, CDFP_BAD_ARGUMENT = 1, CDFP_BAD_INPUT = 2, CDFP_BAD_MESH = 3, CDFP_BAD_STATE = 4, &
    CDFP_DIVERGED = 5, CDFP_IO = 6, CDFP_UNAVAILABLE = 7, CDFP_INTERNAL = 8
  integer(c_int32_t), parameter :: CDFP_REGULAR = 0, CDFP_GRADED = 1, CDFP_O_GRID = 2, CDFP_IRREGULAR = 3
  integer(c_int32_t), parameter :: CDFP_ONE_POINT = 0, CDFP_FULL = 1
  integer(c_int32_t), parameter :: CDFP_LINEAR = 0, CDFP_CAMACHO_ORTIZ = 1, CDFP_BILINEAR = 2, CDFP_USER = 3
  integer(c_int32_t), parameter :: CDFP_ELEMENT_MEAN = 0, CDFP_NODAL = 1
  integer(c_int32_t), parameter :: &
    CDFP_HEXAHEDRON = 0, CDFP_TETRAHEDRON = 1, CDFP_WEDGE = 2, CDFP_PYRAMID = 3, &
    CDFP_COHESIVE_QUADRILATERAL = 4, CDFP_COHESIVE_TRIANGLE = 5

  type, bind(c) :: cdfp_laminated_plate
    real(c_double) :: half_width, lower_glass, pvb, upper_glass, support
    integer(c_int32_t) :: lower_layers, pvb_layers, upper_layers, support_layers, columns, layout
    real(c_double) :: impactor_radius, impactor_shaft, impactor_gap, impactor_refinement
  end type

  type, bind(c) :: cdfp_cohesive_law
    real(c_double) :: strength, fracture_energy, mode_ratio, shear_ratio, friction, friction_exponent
    real(c_double) :: internal_friction, stiffness, weibull_modulus, weibull_area, rate_sensitivity, reference_rate
    integer(c_int64_t) :: seed
    integer(c_int32_t) :: kind
  end type

  type, bind(c) :: cdfp_cohesive_points
    integer(c_int64_t) :: count
    real(c_double) :: time, step
    type(c_ptr) :: opening, normal, insertion_traction, state, traction, stored, damage
  end type

  type, bind(c) :: cdfp_contact_settings
    real(c_double) :: cell_factor, buffer_factor, penalty_factor, friction, depth_limit
    integer(c_int32_t) :: edge_edge, adaptive
  end type

  type, bind(c) :: cdfp_energies
    real(c_double) :: kinetic, strain, hourglass, material_dissipated, cohesive_stored, cohesive_dissipated
    real(c_double) :: cohesive_friction, contact_stored, contact_friction, external_work, initial, balance
  end type

  type, bind(c) :: cdfp_body_state
    real(c_double) :: position(3), velocity(3), angular_velocity(3), contact_force(3)
  end type

  type, bind(c) :: cdfp_summary
    integer(c_int64_t) :: elements, nodes_initial, nodes_final, segments_initial, segments_final
    integer(c_int64_t) :: steps, threads, dt_element, cohesive_inserted, cohesive_broken
    real(c_double) :: simulated_time_s, dt_s, dt_stable_s, wall_s, peak_rss_mb
    real(c_double) :: energy_balance_min, energy_balance_max, hourglass_over_strain_max
    real(c_double) :: cohesive_dissipated_over_ga, cohesive_slope_cost_j, first_contact_s, peak_force_n
    real(c_double) :: peak_force_time_s, impactor_rebound_mps, deepest_penetration_m
  end type

  interface
    function cdfp_last_error(text, capacity, length) bind(c) result(status)
      import
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function

    function cdfp_version(major, minor, patch) bind(c) result(status)
      import
      integer(c_int32_t), intent(inout) :: major, minor, patch
      integer(c_int32_t) :: status
    end function

    function cdfp_share(handle, copy) bind(c) result(status)
      import
      type(c_ptr), value :: handle
      type(c_ptr), intent(inout) :: copy
      integer(c_int32_t) :: status
    end function

    function cdfp_free(handle) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: handle
      integer(c_int32_t) :: status
    end function

    function cdfp_laminated_plate_default(plate) bind(c) result(status)
      import
      type(cdfp_laminated_plate), intent(inout) :: plate
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_create_laminated_plate(plate, mesh) bind(c) result(status)
      import
      type(cdfp_laminated_plate), intent(in) :: plate
      type(c_ptr), intent(inout) :: mesh
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_free(mesh) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: mesh
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_coordinates(mesh, coordinates, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: coordinates
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_hexahedra(mesh, hexahedra, elements) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: hexahedra
      integer(c_int64_t), intent(inout) :: elements
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_parts(mesh, parts, elements) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: parts
      integer(c_int64_t), intent(inout) :: elements
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_layers(mesh, layers, elements) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: layers
      integer(c_int64_t), intent(inout) :: elements
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_part_count(mesh, count) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_part_name(mesh, part, text, capacity, length) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: part
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_node_set(mesh, name, nodes, count) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(inout) :: nodes
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_mesh_facet_set(mesh, name, facets, count) bind(c) result(status)
      import
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(inout) :: facets
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_model_create(model) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: model
      integer(c_int32_t) :: status
    end function

    function cdfp_model_free(model) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: model
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_title(model, title) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: title(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_mesh(model, nodes, coordinates, elements, hexahedra, parts, &
        layers) bind(c) result(status)
      import
      type(c_ptr), value :: model
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int64_t), value :: elements
      integer(c_int32_t), intent(in) :: hexahedra(*), parts(*)
      integer(c_int32_t), intent(in), optional :: layers(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_node_set(model, name, count, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: count
      integer(c_int32_t), intent(in) :: nodes(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_facet_set(model, name, count, facets) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: count
      integer(c_int32_t), intent(in) :: facets(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_elastic_material(model, name, density, youngs_modulus, &
        poissons_ratio) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: density, youngs_modulus, poissons_ratio
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_rate_dependent_material(model, name, density, poissons_ratio, static_modulus, &
        rate_modulus, rate_exponent, smoothing_time) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: density, poissons_ratio, static_modulus, rate_modulus, rate_exponent, &
        smoothing_time
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_rigid_material(model, name, density, youngs_modulus, &
        poissons_ratio) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: density, youngs_modulus, poissons_ratio
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_law_default(law) bind(c) result(status)
      import
      type(cdfp_cohesive_law), intent(inout) :: law
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_cohesive_law(model, name, law) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      type(cdfp_cohesive_law), intent(in) :: law
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_cohesive_callback(model, cohesive_law, callback, states, &
        user_data) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: cohesive_law(*)
      type(c_funptr), value :: callback
      integer(c_int32_t), value :: states
      type(c_ptr), value :: user_data
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_bond(model, first_part, second_part, cohesive_law) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: first_part(*), second_part(*), cohesive_law(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_bonded_facets(model, facet_set, cohesive_law) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: facet_set(*), cohesive_law(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_stress_recovery(model, recovery) bind(c) result(status)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: recovery
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_strength_shares(model, count, shares) bind(c) result(status)
      import
      type(c_ptr), value :: model
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: shares(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_part(model, name, material, formulation, hourglass, &
        cohesive_law) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*), material(*)
      integer(c_int32_t), value :: formulation
      real(c_double), value :: hourglass
      character(kind=c_char), intent(in), optional :: cohesive_law(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_rigid_body(model, part, mass, inertia, velocity, angular_velocity, &
        translation_fixed, rotation_fixed) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: part(*)
      real(c_double), value :: mass
      real(c_double), intent(in), optional :: inertia(9), velocity(3), angular_velocity(3)
      integer(c_int32_t), intent(in), optional :: translation_fixed(3), rotation_fixed(3)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_symmetry_plane(model, axis, coordinate) bind(c) result(status)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: axis
      real(c_double), value :: coordinate
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_prescribed_velocity(model, node_set, directions, count, times, &
        values) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: node_set(*)
      integer(c_int32_t), intent(in) :: directions(3)
      integer(c_int64_t), value :: count
      real(c_double), intent(in), optional :: times(*)
      real(c_double), intent(in) :: values(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_initial_velocity(model, part, velocity, gradient) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: part(*)
      real(c_double), intent(in) :: velocity(3)
      real(c_double), intent(in), optional :: gradient(9)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_gravity(model, gravity) bind(c) result(status)
      import
      type(c_ptr), value :: model
      real(c_double), intent(in) :: gravity(3)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_contact_surface(model, facet_set) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: facet_set(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_get_contact(model, settings) bind(c) result(status)
      import
      type(c_ptr), value :: model
      type(cdfp_contact_settings), intent(inout) :: settings
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_contact(model, settings) bind(c) result(status)
      import
      type(c_ptr), value :: model
      type(cdfp_contact_settings), intent(in) :: settings
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_end_time(model, end) bind(c) result(status)
      import
      type(c_ptr), value :: model
      real(c_double), value :: end
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_fixed_step(model, fixed_step) bind(c) result(status)
      import
      type(c_ptr), value :: model
      real(c_double), value :: fixed_step
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_step_factor(model, step_factor) bind(c) result(status)
      import
      type(c_ptr), value :: model
      real(c_double), value :: step_factor
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_history_interval(model, history_interval) bind(c) result(status)
      import
      type(c_ptr), value :: model
      integer(c_int64_t), value :: history_interval
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_threads(model, threads) bind(c) result(status)
      import
      type(c_ptr), value :: model
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_create(model, simulation) bind(c) result(status)
      import
      type(c_ptr), value :: model
      type(c_ptr), intent(inout) :: simulation
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_free(simulation) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: simulation
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_step(simulation) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_advance(simulation, steps, done) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: steps
      integer(c_int64_t), intent(inout), optional :: done
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_advance_to(simulation, time, done) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      real(c_double), value :: time
      integer(c_int64_t), intent(inout), optional :: done
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_finished(simulation, finished) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int32_t), intent(inout) :: finished
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_time(simulation, time) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      real(c_double), intent(inout) :: time
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_step_size(simulation, step_size) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      real(c_double), intent(inout) :: step_size
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_stable_step(simulation, stable_step) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      real(c_double), intent(inout) :: stable_step
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_controlling_element(simulation, element) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int32_t), intent(inout) :: element
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_step_count(simulation, steps) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), intent(inout) :: steps
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_node_count(simulation, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_positions(simulation, positions, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(c_ptr), intent(inout) :: positions
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_velocities(simulation, velocities, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(c_ptr), intent(inout) :: velocities
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_forces(simulation, forces, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(c_ptr), intent(inout) :: forces
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_masses(simulation, masses, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(c_ptr), intent(inout) :: masses
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_body_count(simulation, bodies) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), intent(inout) :: bodies
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_body(simulation, body, state) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: body
      type(cdfp_body_state), intent(inout) :: state
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_cohesive_count(simulation, inserted, broken) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), intent(inout) :: inserted, broken
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_energies(simulation, energies) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(cdfp_energies), intent(inout) :: energies
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_summary(simulation, summary) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(cdfp_summary), intent(inout) :: summary
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_first_crack(simulation, part, time, layer, position) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      character(kind=c_char), intent(in) :: part(*)
      real(c_double), intent(inout) :: time
      integer(c_int32_t), intent(inout) :: layer
      real(c_double), intent(inout) :: position(3)
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_warning_count(simulation, count) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_warning(simulation, warning, text, capacity, length) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: warning
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_history(simulation, values, rows, columns) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(c_ptr), intent(inout) :: values
      integer(c_int64_t), intent(inout) :: rows, columns
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_history_column(simulation, column, text, capacity, &
        length) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: column
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function

    function cdfp_recorder_create(simulation, folder, recorder) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      character(kind=c_char), intent(in) :: folder(*)
      type(c_ptr), intent(inout) :: recorder
      integer(c_int32_t) :: status
    end function

    function cdfp_recorder_free(recorder) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: recorder
      integer(c_int32_t) :: status
    end function

    function cdfp_recorder_snapshot(recorder, simulation) bind(c) result(status)
      import
      type(c_ptr), value :: recorder, simulation
      integer(c_int32_t) :: status
    end function

    function cdfp_recorder_finish(recorder, simulation) bind(c) result(status)
      import
      type(c_ptr), value :: recorder, simulation
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_create(nodes, elements, types, corners, connectivity, &
        topology) bind(c) result(status)
      import
      integer(c_int64_t), value :: nodes, elements
      integer(c_int32_t), intent(in), optional :: types(*)
      integer(c_int64_t), value :: corners
      integer(c_int32_t), intent(in) :: connectivity(*)
      type(c_ptr), intent(inout) :: topology
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_free(topology) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: topology
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_node_count(topology, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_element_count(topology, elements, bulk) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int64_t), intent(inout) :: elements, bulk
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_element_type(topology, element, type) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element
      integer(c_int32_t), intent(inout) :: type
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_element_nodes(topology, element, nodes, count) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element
      type(c_ptr), intent(inout) :: nodes
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_facet_count(topology, element, facets) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element
      integer(c_int64_t), intent(inout) :: facets
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_edge_count(topology, element, edges) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element
      integer(c_int64_t), intent(inout) :: edges
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_mate(topology, element, facet, mate_element, mate_facet) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element, facet
      integer(c_int32_t), intent(inout) :: mate_element, mate_facet
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_facet_nodes(topology, element, facet, nodes, count) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element, facet
      integer(c_int32_t), intent(inout) :: nodes(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_edge_nodes(topology, element, edge, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element, edge
      integer(c_int32_t), intent(inout) :: nodes(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_elements_around_edge(topology, element, edge, capacity, uses, &
        count) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element, edge
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: uses(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_elements_around_node(topology, node, capacity, uses, &
        count) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: node
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: uses(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_insert_cohesive(topology, element, facet, cohesive_element, new_nodes, &
        new_node_count, renumbered, renumbered_count) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      integer(c_int32_t), value :: element, facet
      integer(c_int32_t), intent(inout) :: cohesive_element
      type(c_ptr), intent(inout) :: new_nodes
      integer(c_int64_t), intent(inout) :: new_node_count
      type(c_ptr), intent(inout) :: renumbered
      integer(c_int64_t), intent(inout) :: renumbered_count
      integer(c_int32_t) :: status
    end function

    function cdfp_topology_check(topology, text, capacity, length) bind(c) result(status)
      import
      type(c_ptr), value :: topology
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function
  end interface
end module cdfp_c
