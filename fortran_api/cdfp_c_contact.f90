!> The C interface, one to one: contact search and forces on the caller's arrays. See `cdfp_c`.
module cdfp_c_contact
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_ptr
  use cdfp_c_model, only: cdfp_contact_settings
  implicit none
  public

  integer(c_int32_t), parameter :: CDFP_SEARCH_NONE = 0, CDFP_SEARCH_REGULAR = 1, CDFP_SEARCH_ADAPTIVE = 2

  type, bind(c) :: cdfp_touch
    real(c_double) :: weights(5), normal(3), gap, force(3)
    integer(c_int32_t) :: nodes(5), first_count, count, parts(2)
  end type

  type, bind(c) :: cdfp_body_pair
    real(c_double) :: force(3), stored, friction_heat, peak_force, deepest
    integer(c_int32_t) :: parts(2)
  end type

  interface
    function cdfp_contact_search_create(cell_factor, buffer_factor, adaptive, search) bind(c) result(status)
      import
      real(c_double), value :: cell_factor, buffer_factor
      integer(c_int32_t), value :: adaptive
      type(c_ptr), intent(inout) :: search
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_search_free(search) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: search
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_search_regular(search, nodes, position, contact_node_count, contact_nodes, &
        segment_count, segments, edge_count, edges, groups, threads) bind(c) result(status)
      import
      type(c_ptr), value :: search
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*)
      integer(c_int64_t), value :: contact_node_count
      integer(c_int32_t), intent(in) :: contact_nodes(*)
      integer(c_int64_t), value :: segment_count
      integer(c_int32_t), intent(in) :: segments(*)
      integer(c_int64_t), value :: edge_count
      integer(c_int32_t), intent(in) :: edges(*)
      integer(c_int32_t), intent(in), optional :: groups(*)
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_search_adaptive(search, nodes, position, contact_node_count, contact_nodes, &
        segment_count, segments, edge_count, edges, groups, renamed_segment_count, renamed_segments, &
        renamed_edge_count, renamed_edges) bind(c) result(status)
      import
      type(c_ptr), value :: search
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*)
      integer(c_int64_t), value :: contact_node_count
      integer(c_int32_t), intent(in) :: contact_nodes(*)
      integer(c_int64_t), value :: segment_count
      integer(c_int32_t), intent(in) :: segments(*)
      integer(c_int64_t), value :: edge_count
      integer(c_int32_t), intent(in) :: edges(*)
      integer(c_int32_t), intent(in), optional :: groups(*)
      integer(c_int64_t), value :: renamed_segment_count
      integer(c_int32_t), intent(in) :: renamed_segments(*)
      integer(c_int64_t), value :: renamed_edge_count
      integer(c_int32_t), intent(in) :: renamed_edges(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_search_due(search, largest_speed, step, due) bind(c) result(status)
      import
      type(c_ptr), value :: search
      real(c_double), value :: largest_speed, step
      integer(c_int32_t), intent(inout) :: due
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_search_lengths(search, cell, buffer, travel) bind(c) result(status)
      import
      type(c_ptr), value :: search
      real(c_double), intent(inout) :: cell, buffer, travel
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_search_node_segments(search, start, partners, rows) bind(c) result(status)
      import
      type(c_ptr), value :: search
      type(c_ptr), intent(inout) :: start, partners
      integer(c_int64_t), intent(inout) :: rows
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_search_edge_edges(search, start, partners, rows) bind(c) result(status)
      import
      type(c_ptr), value :: search
      type(c_ptr), intent(inout) :: start, partners
      integer(c_int64_t), intent(inout) :: rows
      integer(c_int32_t) :: status
    end function

    function cdfp_project_on_face(point, corners, coordinates, shape, normal, gap, &
        outside) bind(c) result(status)
      import
      real(c_double), intent(in) :: point(3)
      integer(c_int64_t), value :: corners
      real(c_double), intent(in) :: coordinates(*)
      real(c_double), intent(inout) :: shape(*), normal(*), gap, outside
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_settings_default(settings) bind(c) result(status)
      import
      type(cdfp_contact_settings), intent(inout) :: settings
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_create(settings, contact) bind(c) result(status)
      import
      type(cdfp_contact_settings), intent(in) :: settings
      type(c_ptr), intent(inout) :: contact
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_free(contact) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: contact
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_name_part(contact, part, name) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int32_t), value :: part
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_add_segments(contact, count, segments, elements, parts, bulk_modulus, area, &
        volume) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: count
      integer(c_int32_t), intent(in) :: segments(*), elements(*), parts(*)
      real(c_double), intent(in) :: bulk_modulus(*), area(*), volume(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_add_facets(contact, topology, nodes, coordinates, count, facets, elements, parts, &
        part_count, bulk_modulus) bind(c) result(status)
      import
      type(c_ptr), value :: contact, topology
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int64_t), value :: count
      integer(c_int32_t), intent(in) :: facets(*)
      integer(c_int64_t), value :: elements
      integer(c_int32_t), intent(in) :: parts(*)
      integer(c_int64_t), value :: part_count
      real(c_double), intent(in) :: bulk_modulus(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_follow(contact, new_node_count, new_nodes, renumbered_count, &
        renumbered) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: new_node_count
      integer(c_int32_t), intent(in) :: new_nodes(*)
      integer(c_int64_t), value :: renumbered_count
      integer(c_int32_t), intent(in) :: renumbered(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_remove_elements(contact, count, elements) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: count
      integer(c_int32_t), intent(in) :: elements(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_due(contact, nodes, velocity, step, threads, search) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: velocity(*)
      real(c_double), value :: step
      integer(c_int32_t), value :: threads
      integer(c_int32_t), intent(inout) :: search
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_regular_search(contact, nodes, position, groups, threads) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*)
      integer(c_int32_t), intent(in), optional :: groups(*)
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_adaptive_search(contact, nodes, position, groups) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*)
      integer(c_int32_t), intent(in), optional :: groups(*)
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_local_search(contact, nodes, position, threads) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: position(*)
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_add_force(contact, nodes, velocity, mass, force, step, threads) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: nodes
      real(c_double), intent(in) :: velocity(*), mass(*)
      real(c_double), intent(inout) :: force(*)
      real(c_double), value :: step
      integer(c_int32_t), value :: threads
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_counts(contact, nodes, segments, edges, touching) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), intent(inout) :: nodes, segments, edges, touching
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_nodes(contact, nodes, count) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      type(c_ptr), intent(inout) :: nodes
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_node_segments(contact, start, partners, rows) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      type(c_ptr), intent(inout) :: start, partners
      integer(c_int64_t), intent(inout) :: rows
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_edge_edges(contact, start, partners, rows) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      type(c_ptr), intent(inout) :: start, partners
      integer(c_int64_t), intent(inout) :: rows
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_touches(contact, touches, count) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      type(c_ptr), intent(inout) :: touches
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_body_pairs(contact, pairs, count) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      type(c_ptr), intent(inout) :: pairs
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_energies(contact, stored, friction_heat, deepest) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      real(c_double), intent(inout) :: stored, friction_heat, deepest
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_stiffness_over_mass(contact, stiffness_over_mass) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      real(c_double), intent(inout) :: stiffness_over_mass
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_warning_count(contact, count) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function

    function cdfp_contact_warning(contact, warning, text, capacity, length) bind(c) result(status)
      import
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: warning
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function
  end interface
end module cdfp_c_contact
