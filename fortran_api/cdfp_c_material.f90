!> Users' bulk materials in the C interface: see cdfp_c, cdfp/c/material.h and cdfp/material.h.
module cdfp_c_material
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  implicit none
  public

  type, bind(c) :: cdfp_material_points
    integer(c_int64_t) :: count
    integer(c_int32_t) :: point, start, state_count, property_count
    real(c_double) :: time, step
    type(c_ptr) :: properties, elements, position, length, density, strain_increment, spin_increment
    type(c_ptr) :: stretch_old, stretch, gradient_old, gradient, rotation
    type(c_ptr) :: stress_old, state_old, energy_old, dissipated_old
    type(c_ptr) :: stress, state, energy, dissipated, stiffness, failed, message
    integer(c_int64_t) :: message_capacity
  end type

  type, bind(c) :: cdfp_user_material
    real(c_double) :: density, youngs_modulus, poissons_ratio
    type(c_ptr) :: properties
    integer(c_int64_t) :: property_count
    integer(c_int32_t) :: states, deletion_state, thread_safe
  end type

  type, bind(c) :: cdfp_vumat
    real(c_double) :: temperature
    type(c_ptr) :: fields
    integer(c_int64_t) :: field_count
    integer(c_int32_t) :: single_precision
  end type

  interface
    function cdfp_user_material_default(material) bind(c) result(status)
      import
      type(cdfp_user_material), intent(inout) :: material
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_user_material(model, name, material, callback, user_data) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      type(cdfp_user_material), intent(in) :: material
      type(c_funptr), value :: callback
      type(c_ptr), value :: user_data
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_library_material(model, name, material, library, function) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      type(cdfp_user_material), intent(in) :: material
      character(kind=c_char), intent(in) :: library(*), function(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_vumat_default(vumat) bind(c) result(status)
      import
      type(cdfp_vumat), intent(inout) :: vumat
      integer(c_int32_t) :: status
    end function

    function cdfp_model_add_vumat_material(model, name, material, vumat, library) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: name(*)
      type(cdfp_user_material), intent(in) :: material
      type(cdfp_vumat), intent(in) :: vumat
      character(kind=c_char), intent(in) :: library(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_model_set_state_name(model, material, state, name) bind(c) result(status)
      import
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: material(*)
      integer(c_int32_t), value :: state
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_build_material(source, library, single_precision) bind(c) result(status)
      import
      character(kind=c_char), intent(in) :: source(*), library(*)
      integer(c_int32_t), value :: single_precision
      integer(c_int32_t) :: status
    end function

    function cdfp_simulation_element_field(simulation, name, elements, values) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: elements
      real(c_double), intent(inout) :: values(*)
      integer(c_int32_t) :: status
    end function
  end interface
end module cdfp_c_material
