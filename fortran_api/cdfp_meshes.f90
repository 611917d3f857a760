!> Meshes that cdfp makes.
module cdfp_meshes
  use, intrinsic :: iso_c_binding
  use cdfp_c
  use cdfp_handles
  implicit none
  private
  public :: cdfp_mesh, default_laminated_plate, assignment(=)

  !> Numbers of nodes, elements, facets, parts and layers count from 1.
  type :: cdfp_mesh
    type(counted_handle) :: handle
  contains
    procedure :: create_laminated_plate
    procedure :: free
    procedure :: get_coordinates
    procedure :: get_hexahedra
    procedure :: get_parts
    procedure :: get_layers
    procedure :: part_count
    procedure :: part_name
    procedure :: get_node_set
    procedure :: get_facet_set
  end type

  !> One more owner of the same object.
  interface assignment(=)
    module procedure assign
  end interface

contains

  !> The geometry of examples/laminated_glass at the paper's full size.
  subroutine default_laminated_plate(plate)
    type(cdfp_laminated_plate), intent(out) :: plate

    call report(cdfp_laminated_plate_default(plate))
  end subroutine

  subroutine create_laminated_plate(this, plate, stat, errmsg)
    class(cdfp_mesh), intent(inout) :: this
    type(cdfp_laminated_plate), intent(in) :: plate
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_mesh_create_laminated_plate(plate, made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free(this)
    class(cdfp_mesh), intent(inout) :: this

    call this%handle%free()
  end subroutine

  !> (3, nodes), m.
  subroutine get_coordinates(this, coordinates, stat, errmsg)
    class(cdfp_mesh), intent(in) :: this
    real(c_double), allocatable, intent(out) :: coordinates(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: nodes
    integer(c_int32_t) :: status
    real(c_double), pointer :: view(:, :)

    status = cdfp_mesh_coordinates(this%handle%address, data, nodes)
    if (status == CDFP_OK) then
      call c_f_pointer(data, view, [3_c_int64_t, nodes])
      coordinates = view
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> (8, elements).
  subroutine get_hexahedra(this, hexahedra, stat, errmsg)
    class(cdfp_mesh), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: hexahedra(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: elements
    integer(c_int32_t) :: status

    status = cdfp_mesh_hexahedra(this%handle%address, data, elements)
    if (status == CDFP_OK) call copy_rows(data, 8_c_int64_t, elements, hexahedra)
    call report(status, stat, errmsg)
  end subroutine

  !> Part of each element.
  subroutine get_parts(this, parts, stat, errmsg)
    class(cdfp_mesh), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: parts(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: elements
    integer(c_int32_t) :: status

    status = cdfp_mesh_parts(this%handle%address, data, elements)
    if (status == CDFP_OK) call copy_numbers(data, elements, parts)
    call report(status, stat, errmsg)
  end subroutine

  !> Layer of each element through the thickness, from the bottom of its part.
  subroutine get_layers(this, layers, stat, errmsg)
    class(cdfp_mesh), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: layers(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: elements
    integer(c_int32_t) :: status

    status = cdfp_mesh_layers(this%handle%address, data, elements)
    if (status == CDFP_OK) call copy_numbers(data, elements, layers)
    call report(status, stat, errmsg)
  end subroutine

  function part_count(this, stat, errmsg) result(parts)
    class(cdfp_mesh), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: parts
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_mesh_part_count(this%handle%address, count), stat, errmsg)
    parts = int(count)
  end function

  function part_name(this, part, stat, errmsg) result(name)
    class(cdfp_mesh), intent(in) :: this
    integer, intent(in) :: part
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(len=:), allocatable :: name
    character(kind=c_char) :: buffer(1024)
    integer(c_int64_t) :: length

    length = 0
    call report(cdfp_mesh_part_name(this%handle%address, int(part, c_int64_t) - 1, buffer, &
                                    size(buffer, kind=c_int64_t), length), stat, errmsg)
    name = fortran_text(buffer, length)
  end function

  subroutine get_node_set(this, name, nodes, stat, errmsg)
    class(cdfp_mesh), intent(in) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), allocatable, intent(out) :: nodes(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status

    status = cdfp_mesh_node_set(this%handle%address, c_text(name), data, count)
    if (status == CDFP_OK) call copy_numbers(data, count, nodes)
    call report(status, stat, errmsg)
  end subroutine

  !> (2, facets): element and its local facet.
  subroutine get_facet_set(this, name, facets, stat, errmsg)
    class(cdfp_mesh), intent(in) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), allocatable, intent(out) :: facets(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status

    status = cdfp_mesh_facet_set(this%handle%address, c_text(name), data, count)
    if (status == CDFP_OK) call copy_rows(data, 2_c_int64_t, count, facets)
    call report(status, stat, errmsg)
  end subroutine

  subroutine assign(this, other)
    type(cdfp_mesh), intent(inout) :: this
    type(cdfp_mesh), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

end module cdfp_meshes
