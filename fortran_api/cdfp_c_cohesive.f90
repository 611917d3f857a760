!> The C interface, one to one: cohesive elements between the caller's nodes. See `cdfp_c`.
module cdfp_c_cohesive
  use, intrinsic :: iso_c_binding, only: c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
  use cdfp_c_model, only: cdfp_cohesive_law
  implicit none
  public

  type, bind(c) :: cdfp_cohesive_point
    real(c_double) :: strength, reach, largest, dissipated, opening(3), insertion_traction(3)
  end type

  type, bind(c) :: cdfp_cohesive_pair
    real(c_double) :: area, strength, reach, largest, damage, stored, dissipated
    integer(c_int32_t) :: upper, lower
  end type

  interface
    function cdfp_cohesive_law_start(law, count, traction, normal, points) bind(c) result(status)
      import
      type(cdfp_cohesive_law), intent(in) :: law
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: traction(*), normal(*)
      type(cdfp_cohesive_point), intent(inout) :: points(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_law_traction(law, count, opening, normal, points, traction) bind(c) result(status)
      import
      type(cdfp_cohesive_law), intent(in) :: law
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: opening(*), normal(*)
      type(cdfp_cohesive_point), intent(inout) :: points(*)
      real(c_double), intent(inout) :: traction(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_law_mean_traction(law, count, opening, normal, points, &
        traction) bind(c) result(status)
      import
      type(cdfp_cohesive_law), intent(in) :: law
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: opening(*), normal(*)
      type(cdfp_cohesive_point), intent(inout) :: points(*)
      real(c_double), intent(inout) :: traction(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_law_stored(law, count, normal, points, stored) bind(c) result(status)
      import
      type(cdfp_cohesive_law), intent(in) :: law
      integer(c_int64_t), value :: count
      real(c_double), intent(in) :: normal(*)
      type(cdfp_cohesive_point), intent(in) :: points(*)
      real(c_double), intent(inout) :: stored(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_create(first_element, cohesive) bind(c) result(status)
      import
      integer(c_int32_t), value :: first_element
      type(c_ptr), intent(inout) :: cohesive
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_free(cohesive) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: cohesive
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_add_law(cohesive, law, number) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      type(cdfp_cohesive_law), intent(in) :: law
      integer(c_int32_t), intent(inout) :: number
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_add_user_law(cohesive, law, callback, states, user_data, &
        number) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      type(cdfp_cohesive_law), intent(in) :: law
      type(c_funptr), value :: callback
      integer(c_int32_t), value :: states
      type(c_ptr), value :: user_data
      integer(c_int32_t), intent(inout) :: number
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_hold(cohesive, count, nodes, directions) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      integer(c_int64_t), value :: count
      integer(c_int32_t), intent(in) :: nodes(*), directions(3)
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_set_parts(cohesive, topology, nodes, coordinates, elements, parts, part_count, &
        law_of_part, recovery, strength_shares) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive, topology
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int64_t), value :: elements
      integer(c_int32_t), intent(in) :: parts(*)
      integer(c_int64_t), value :: part_count
      integer(c_int32_t), intent(in) :: law_of_part(*)
      integer(c_int32_t), value :: recovery
      real(c_double), intent(in), optional :: strength_shares(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_find_open(cohesive, topology, nodes, position, elements, stress, threads, &
        facets, tractions, count) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive, topology
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*)
      integer(c_int64_t), value :: elements
      real(c_double), intent(in) :: stress(*)
      integer(c_int32_t), value :: threads
      type(c_ptr), intent(inout) :: facets, tractions
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_follow(cohesive, new_node_count, new_nodes, renumbered_count, &
        renumbered) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      integer(c_int64_t), value :: new_node_count
      integer(c_int32_t), intent(in) :: new_nodes(*)
      integer(c_int64_t), value :: renumbered_count
      integer(c_int32_t), intent(in) :: renumbered(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_insert(cohesive, element, law, corners, connectivity, traction, nodes, position, &
        time) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      integer(c_int32_t), value :: element, law
      integer(c_int64_t), value :: corners
      integer(c_int32_t), intent(in) :: connectivity(*)
      real(c_double), intent(in), optional :: traction(*)
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*)
      real(c_double), value :: time
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_add_force(cohesive, nodes, position, velocity, mass, force, step, time, &
        threads) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*), velocity(*), mass(*)
      real(c_double), intent(inout) :: force(*)
      real(c_double), value :: step, time
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_count(cohesive, elements, broken) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      integer(c_int64_t), intent(inout) :: elements, broken
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_broken_now(cohesive, elements, count) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      type(c_ptr), intent(inout) :: elements
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_pairs(cohesive, element, pairs, count) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      integer(c_int32_t), value :: element
      type(cdfp_cohesive_pair), intent(inout) :: pairs(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_energies(cohesive, stored, dissipated, friction, by_law) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      real(c_double), intent(inout) :: stored, dissipated, friction, by_law
      integer(c_int32_t) :: status
    end function

    function cdfp_cohesive_stiffness_over_mass(cohesive, nodes, mass, &
        stiffness_over_mass) bind(c) result(status)
      import
      type(c_ptr), value :: cohesive
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: mass(*)
      real(c_double), intent(inout) :: stiffness_over_mass
      integer(c_int32_t) :: status
    end function
  end interface
end module cdfp_c_cohesive
