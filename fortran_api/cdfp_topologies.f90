!> TopS on the caller's connectivity.
module cdfp_topologies
  use, intrinsic :: iso_c_binding
  use cdfp_c
  use cdfp_handles
  implicit none
  private
  public :: cdfp_topology, assignment(=)

  !> Numbers of nodes, elements, local facets, edges and corners count from 1; 0 is "none". Local facets and
  !> edges come in the order of cdfp/topology.hpp.
  type :: cdfp_topology
    type(counted_handle) :: handle
  contains
    procedure, private :: create_of_hexahedra
    procedure, private :: create_of_types
    generic :: create => create_of_hexahedra, create_of_types
    procedure :: free
    procedure :: node_count
    procedure :: element_count
    procedure :: bulk_count
    procedure :: element_type
    procedure :: get_nodes
    procedure :: facet_count
    procedure :: get_mate
    procedure :: edge_count
    procedure :: get_facet_nodes
    procedure :: get_edge_nodes
    procedure :: get_elements_around_edge
    procedure :: get_elements_around_node
    procedure :: insert_cohesive
    procedure :: check
  end type

  integer(c_int64_t), parameter :: usual_count = 64  ! of elements around an edge or a node

  !> One more owner of the same object.
  interface assignment(=)
    module procedure assign
  end interface

contains

  !> `hexahedra` (8, elements).
  subroutine create_of_hexahedra(this, nodes, hexahedra, stat, errmsg)
    class(cdfp_topology), intent(inout) :: this
    integer, intent(in) :: nodes
    integer(c_int32_t), contiguous, intent(in) :: hexahedra(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    if (size(hexahedra, 1) /= 8) then
      call refuse('cdfp_topology: hexahedra must be of shape (8, elements)', stat, errmsg)
      return
    end if
    made = c_null_ptr
    status = cdfp_topology_create(int(nodes, c_int64_t), size(hexahedra, 2, c_int64_t), &
                                  corners=size(hexahedra, kind=c_int64_t), &
                                  connectivity=hexahedra - 1_c_int32_t, topology=made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  !> `types`: CDFP_HEXAHEDRON and the like; `connectivity`: the corners of all elements one after the other.
  subroutine create_of_types(this, nodes, types, connectivity, stat, errmsg)
    class(cdfp_topology), intent(inout) :: this
    integer, intent(in) :: nodes
    integer(c_int32_t), contiguous, intent(in) :: types(:)
    integer(c_int32_t), contiguous, intent(in) :: connectivity(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_topology_create(int(nodes, c_int64_t), size(types, kind=c_int64_t), types, &
                                  size(connectivity, kind=c_int64_t), connectivity - 1_c_int32_t, made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free(this)
    class(cdfp_topology), intent(inout) :: this

    call this%handle%free()
  end subroutine

  function node_count(this, stat, errmsg) result(nodes)
    class(cdfp_topology), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: nodes

    nodes = 0
    call report(cdfp_topology_node_count(this%handle%address, nodes), stat, errmsg)
  end function

  !> Bulk elements, which come first, and cohesive elements.
  function element_count(this, stat, errmsg) result(elements)
    class(cdfp_topology), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: elements, bulk

    elements = 0
    call report(cdfp_topology_element_count(this%handle%address, elements, bulk), stat, errmsg)
  end function

  function bulk_count(this, stat, errmsg) result(bulk)
    class(cdfp_topology), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: elements, bulk

    bulk = 0
    call report(cdfp_topology_element_count(this%handle%address, elements, bulk), stat, errmsg)
  end function

  function element_type(this, element, stat, errmsg) result(type)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: type

    type = -1
    call report(cdfp_topology_element_type(this%handle%address, element - 1_c_int32_t, type), stat, errmsg)
  end function

  !> Corners of an element now.
  subroutine get_nodes(this, element, nodes, stat, errmsg)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element
    integer(c_int32_t), allocatable, intent(out) :: nodes(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status
    integer(c_int32_t), pointer :: view(:)

    status = cdfp_topology_element_nodes(this%handle%address, element - 1_c_int32_t, data, count)
    if (status == CDFP_OK) then
      call c_f_pointer(data, view, [count])
      nodes = view + 1_c_int32_t
    end if
    call report(status, stat, errmsg)
  end subroutine

  function facet_count(this, element, stat, errmsg) result(facets)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: facets
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_topology_facet_count(this%handle%address, element - 1_c_int32_t, count), stat, errmsg)
    facets = int(count)
  end function

  function edge_count(this, element, stat, errmsg) result(edges)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: edges
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_topology_edge_count(this%handle%address, element - 1_c_int32_t, count), stat, errmsg)
    edges = int(count)
  end function

  !> The facet on the other side, of a cohesive element if one stands between: 0 and 0 at the boundary. Facet
  !> 1 of a cohesive element is its upper face, facet 2 its lower face.
  subroutine get_mate(this, element, facet, mate_element, mate_facet, stat, errmsg)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element, facet
    integer(c_int32_t), intent(out) :: mate_element, mate_facet
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: other(2)

    other = -1
    call report(cdfp_topology_mate(this%handle%address, element - 1_c_int32_t, facet - 1_c_int32_t, &
                                   other(1), other(2)), stat, errmsg)
    mate_element = other(1) + 1_c_int32_t
    mate_facet = other(2) + 1_c_int32_t
  end subroutine

  !> Corners of a facet in outward order.
  subroutine get_facet_nodes(this, element, facet, nodes, stat, errmsg)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element, facet
    integer(c_int32_t), allocatable, intent(out) :: nodes(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: corners(4), status
    integer(c_int64_t) :: count

    status = cdfp_topology_facet_nodes(this%handle%address, element - 1_c_int32_t, facet - 1_c_int32_t, &
                                       corners, count)
    if (status == CDFP_OK) nodes = corners(:count) + 1_c_int32_t
    call report(status, stat, errmsg)
  end subroutine

  subroutine get_edge_nodes(this, element, edge, nodes, stat, errmsg)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element, edge
    integer(c_int32_t), intent(out) :: nodes(2)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: ends(2)

    ends = -1
    call report(cdfp_topology_edge_nodes(this%handle%address, element - 1_c_int32_t, edge - 1_c_int32_t, &
                                         ends), stat, errmsg)
    nodes = ends + 1_c_int32_t
  end subroutine

  !> (2, n): element and its local edge, in cyclic order around the edge.
  subroutine get_elements_around_edge(this, element, edge, uses, stat, errmsg)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element, edge
    integer(c_int32_t), allocatable, intent(out) :: uses(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: room, count
    integer(c_int32_t) :: status

    room = usual_count
    do
      allocate (uses(2, room))
      status = cdfp_topology_elements_around_edge(this%handle%address, element - 1_c_int32_t, &
                                                  edge - 1_c_int32_t, room, uses, count)
      if (status /= CDFP_OK .or. count <= room) exit
      deallocate (uses)
      room = count
    end do
    if (status == CDFP_OK) then
      uses = uses(:, :count) + 1_c_int32_t
    else
      deallocate (uses)
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> (2, n): element and its corner, in ascending order of elements.
  subroutine get_elements_around_node(this, node, uses, stat, errmsg)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: node
    integer(c_int32_t), allocatable, intent(out) :: uses(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: room, count
    integer(c_int32_t) :: status

    room = usual_count
    do
      allocate (uses(2, room))
      status = cdfp_topology_elements_around_node(this%handle%address, node - 1_c_int32_t, &
                                                  room, uses, count)
      if (status /= CDFP_OK .or. count <= room) exit
      deallocate (uses)
      room = count
    end do
    if (status == CDFP_OK) then
      uses = uses(:, :count) + 1_c_int32_t
    else
      deallocate (uses)
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> Inserts a cohesive element at an inner facet between two bulk elements. `new_nodes` (2, n): new node and
  !> the node that it copies, in the order of their numbers. `renumbered` (4, n): element, corner, old node,
  !> new node for every corner that changed.
  subroutine insert_cohesive(this, element, facet, cohesive_element, new_nodes, renumbered, stat, errmsg)
    class(cdfp_topology), intent(in) :: this
    integer(c_int32_t), intent(in) :: element, facet
    integer(c_int32_t), intent(out) :: cohesive_element
    integer(c_int32_t), allocatable, intent(out) :: new_nodes(:, :), renumbered(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: nodes_data, corners_data
    integer(c_int64_t) :: nodes, corners
    integer(c_int32_t) :: status

    cohesive_element = -1
    status = cdfp_topology_insert_cohesive(this%handle%address, element - 1_c_int32_t, facet - 1_c_int32_t, &
                                           cohesive_element, nodes_data, nodes, corners_data, corners)
    cohesive_element = cohesive_element + 1_c_int32_t
    if (status == CDFP_OK) then
      call copy_rows(nodes_data, 2_c_int64_t, nodes, new_nodes)
      call copy_rows(corners_data, 4_c_int64_t, corners, renumbered)
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> The first relation that does not hold, or an empty string.
  function check(this, stat, errmsg) result(text)
    class(cdfp_topology), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(len=:), allocatable :: text
    character(kind=c_char) :: buffer(4096)
    integer(c_int64_t) :: length

    length = 0
    call report(cdfp_topology_check(this%handle%address, buffer, size(buffer, kind=c_int64_t), length), &
                stat, errmsg)
    text = fortran_text(buffer, length)
  end function

  subroutine assign(this, other)
    type(cdfp_topology), intent(inout) :: this
    type(cdfp_topology), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

end module cdfp_topologies
