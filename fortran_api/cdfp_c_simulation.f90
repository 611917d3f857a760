!> The C interface, one to one: simulations and their results. See `cdfp_c`.
module cdfp_c_simulation
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none
  public

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

  type, bind(c) :: cdfp_contact_pair
    real(c_double) :: peak_force_n, stored_j, friction_heat_j, deepest_penetration_m
  end type

  interface
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

    function cdfp_simulation_set_monitor(simulation, callback, user_data) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(c_funptr), value :: callback
      type(c_ptr), value :: user_data
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_save(simulation, path) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_restore(simulation, path) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      character(kind=c_char), intent(in) :: path(*)
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

    function cdfp_simulation_get_stresses(simulation, elements, stress) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: elements
      real(c_double), intent(inout) :: stress(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_set_positions(simulation, nodes, positions) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: positions(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_set_velocities(simulation, nodes, velocities) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: velocities(*)
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

    function cdfp_simulation_contact_pair_count(simulation, count) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_contact_pair(simulation, pair, values) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: pair
      type(cdfp_contact_pair), intent(inout) :: values
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_contact_pair_part(simulation, pair, side, text, capacity, &
        length) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: pair
      integer(c_int32_t), value :: side
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_stage_count(simulation, count) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_stage(simulation, stage, seconds, calls, text, capacity, &
        length) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      integer(c_int64_t), value :: stage
      real(c_double), intent(inout) :: seconds
      integer(c_int64_t), intent(inout) :: calls
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
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

    function cdfp_recorder_continue(simulation, folder, recorder) bind(c) result(status)
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
  end interface
end module cdfp_c_simulation
