!> The C interface, one to one: TopS. See `cdfp_c`.
module cdfp_c_topology
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t, c_ptr
  implicit none
  public

  integer(c_int32_t), parameter :: &
    CDFP_HEXAHEDRON = 0, CDFP_TETRAHEDRON = 1, CDFP_WEDGE = 2, CDFP_PYRAMID = 3, &
    CDFP_COHESIVE_QUADRILATERAL = 4, CDFP_COHESIVE_TRIANGLE = 5

  interface
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
end module cdfp_c_topology
