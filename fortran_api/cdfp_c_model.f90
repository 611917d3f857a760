!> The C interface, one to one: what to simulate. See `cdfp_c`.
module cdfp_c_model
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none
  public

  integer(c_int32_t), parameter :: CDFP_ONE_POINT = 0, CDFP_FULL = 1
  integer(c_int32_t), parameter :: CDFP_LINEAR = 0, CDFP_CAMACHO_ORTIZ = 1, CDFP_BILINEAR = 2, CDFP_USER = 3
  integer(c_int32_t), parameter :: CDFP_ELEMENT_MEAN = 0, CDFP_NODAL = 1

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

  type, bind(c) :: cdfp_nodal_load
    integer(c_int64_t) :: nodes
    real(c_double) :: time
    type(c_ptr) :: position, velocity, force
  end type

  type, bind(c) :: cdfp_contact_settings
    real(c_double) :: cell_factor, buffer_factor, penalty_factor, friction, depth_limit, penetration_warning
    integer(c_int32_t) :: edge_edge, adaptive
  end type

  interface
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

    function cdfp_model_set_mixed_mesh(model, nodes, coordinates, elements, types, corners, connectivity, &
        parts, layers) bind(c) result(status)
      import
      type(c_ptr), value :: model
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int64_t), value :: elements
      integer(c_int32_t), intent(in) :: types(*)
      integer(c_int64_t), value :: corners
      integer(c_int32_t), intent(in) :: connectivity(*), parts(*)
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

    function cdfp_model_set_load_callback(model, callback, user_data) bind(c) result(status)
      import
      type(c_ptr), value :: model
      type(c_funptr), value :: callback
      type(c_ptr), value :: user_data
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
  end interface
end module cdfp_c_model
