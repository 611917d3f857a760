!> The C interface, one to one: meshes that cdfp makes. See `cdfp_c`.
module cdfp_c_mesh
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_ptr
  implicit none
  public

  integer(c_int32_t), parameter :: CDFP_REGULAR = 0, CDFP_GRADED = 1, CDFP_O_GRID = 2, CDFP_IRREGULAR = 3

  type, bind(c) :: cdfp_laminated_plate
    real(c_double) :: half_width, lower_glass, pvb, upper_glass, support
    integer(c_int32_t) :: lower_layers, pvb_layers, upper_layers, support_layers, columns, layout
    real(c_double) :: impactor_radius, impactor_shaft, impactor_gap, impactor_refinement
  end type

  interface
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
  end interface
end module cdfp_c_mesh
