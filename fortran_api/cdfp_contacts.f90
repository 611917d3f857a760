!> Contact on a program's own arrays: global search, projection on a face, and the whole sequence of search,
!> penalty and friction.
module cdfp_contacts
  use, intrinsic :: iso_c_binding
  use cdfp_c
  use cdfp_handles
  use cdfp_topologies, only: cdfp_topology
  implicit none
  private
  public :: cdfp_contact_search, cdfp_contact, project_on_face, assignment(=)

  !> Candidate pairs node-segment and edge-edge. Nodes, segments and edges count from 1; a triangle's last
  !> corner is 0.
  type :: cdfp_contact_search
    type(counted_handle) :: handle
  contains
    procedure :: create => create_search
    procedure :: free => free_search
    procedure :: regular
    procedure :: adaptive
    procedure :: due
    procedure :: get_lengths
    procedure :: get_node_segments => get_searched_node_segments
    procedure :: get_edge_edges => get_searched_edge_edges
  end type

  !> Search, penalty and friction between segments. In a step, after all forces but the cohesive ones: `search`,
  !> `local_search`, `add_force`. Arrays are those of all nodes of the mesh, (3, n) or (n), and used where they
  !> are; a contiguous part x(:, :n) of a longer array as well.
  type :: cdfp_contact
    type(counted_handle) :: handle
  contains
    procedure :: create
    procedure :: free
    procedure :: name_part
    procedure :: add_segments
    procedure :: add_facets
    procedure :: follow
    procedure :: remove_elements
    procedure :: search_due
    procedure :: regular_search
    procedure :: adaptive_search
    procedure :: search
    procedure :: local_search
    procedure :: add_force
    procedure :: get_counts
    procedure :: get_nodes
    procedure :: get_node_segments
    procedure :: get_edge_edges
    procedure :: get_touches
    procedure :: get_body_pairs
    procedure :: get_energies
    procedure :: stiffness_over_mass
    procedure :: warning_count
    procedure :: warning
  end type

  character(len=*), parameter :: shapes = 'x must be of shape (3, nodes), segments of shape (4, m), edges of &
    &shape (2, e), groups of shape (nodes)'

  abstract interface
    function ask_rows(handle, start, partners, rows) bind(c) result(status)
      import
      type(c_ptr), value :: handle
      type(c_ptr), intent(inout) :: start, partners
      integer(c_int64_t), intent(inout) :: rows
      integer(c_int32_t) :: status
    end function
  end interface

  !> One more owner of the same object.
  interface assignment(=)
    module procedure assign_search, assign_contact
  end interface

contains

  !> Cell and buffer over the mean segment length (1.0 and 0.4 if absent); `adaptive`: whether `adaptive` will
  !> be called (true).
  subroutine create_search(this, cell_factor, buffer_factor, adaptive, stat, errmsg)
    class(cdfp_contact_search), intent(inout) :: this
    real(c_double), intent(in), optional :: cell_factor, buffer_factor
    logical, intent(in), optional :: adaptive
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_contact_settings) :: settings
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_contact_settings_default(settings)
    if (present(cell_factor)) settings%cell_factor = cell_factor
    if (present(buffer_factor)) settings%buffer_factor = buffer_factor
    if (present(adaptive)) settings%adaptive = merge(1_c_int32_t, 0_c_int32_t, adaptive)
    status = cdfp_contact_search_create(settings%cell_factor, settings%buffer_factor, settings%adaptive, made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free_search(this)
    class(cdfp_contact_search), intent(inout) :: this

    call this%handle%free()
  end subroutine

  !> All candidate pairs. `nodes`: contact nodes; `segments` (4, m); `edges` (2, e); `groups` (nodes of the
  !> mesh): entities of one group > 0 do not pair.
  subroutine regular(this, x, nodes, segments, edges, groups, threads, stat, errmsg)
    class(cdfp_contact_search), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :)
    integer(c_int32_t), contiguous, intent(in) :: nodes(:), segments(:, :), edges(:, :)
    integer(c_int32_t), intent(in), optional :: groups(:)
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: group_numbers(:)

    if (.not. shapes_agree(x, segments, edges, groups)) then
      call refuse('regular: '//shapes, stat, errmsg)
      return
    end if
    call count_from_0(groups, group_numbers)
    call report(cdfp_contact_search_regular(this%handle%address, size(x, 2, c_int64_t), x, &
                                            size(nodes, kind=c_int64_t), nodes - 1_c_int32_t, &
                                            size(segments, 2, c_int64_t), segments - 1_c_int32_t, &
                                            size(edges, 2, c_int64_t), edges - 1_c_int32_t, &
                                            group_numbers, threads_or_one(threads)), stat, errmsg)
  end subroutine

  !> Adds the pairs of what was appended to the arrays since the last search, and of old segments and edges that
  !> name other nodes at the same place.
  subroutine adaptive(this, x, nodes, segments, edges, groups, renamed_segments, renamed_edges, stat, errmsg)
    class(cdfp_contact_search), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :)
    integer(c_int32_t), contiguous, intent(in) :: nodes(:), segments(:, :), edges(:, :)
    integer(c_int32_t), intent(in), optional :: groups(:), renamed_segments(:), renamed_edges(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: group_numbers(:)
    integer(c_int32_t), allocatable :: segment_names(:), edge_names(:)

    if (.not. shapes_agree(x, segments, edges, groups)) then
      call refuse('adaptive: '//shapes, stat, errmsg)
      return
    end if
    allocate (segment_names(0), edge_names(0))
    if (present(renamed_segments)) segment_names = renamed_segments - 1_c_int32_t
    if (present(renamed_edges)) edge_names = renamed_edges - 1_c_int32_t
    call count_from_0(groups, group_numbers)
    call report(cdfp_contact_search_adaptive(this%handle%address, size(x, 2, c_int64_t), x, &
                                             size(nodes, kind=c_int64_t), nodes - 1_c_int32_t, &
                                             size(segments, 2, c_int64_t), segments - 1_c_int32_t, &
                                             size(edges, 2, c_int64_t), edges - 1_c_int32_t, &
                                             group_numbers, &
                                             size(segment_names, kind=c_int64_t), segment_names, &
                                             size(edge_names, kind=c_int64_t), edge_names), stat, errmsg)
  end subroutine

  !> Once a step: whether entities may have moved so far that a regular search is due.
  function due(this, largest_speed, step, stat, errmsg) result(answer)
    class(cdfp_contact_search), intent(in) :: this
    real(c_double), intent(in) :: largest_speed, step
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    logical :: answer
    integer(c_int32_t) :: flag

    flag = 0
    call report(cdfp_contact_search_due(this%handle%address, largest_speed, step, flag), stat, errmsg)
    answer = flag /= 0
  end function

  !> m: cell length, buffer, bound on the relative movement since the last regular search.
  subroutine get_lengths(this, cell, buffer, travel, stat, errmsg)
    class(cdfp_contact_search), intent(in) :: this
    real(c_double), intent(out) :: cell, buffer, travel
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    cell = 0
    buffer = 0
    travel = 0
    call report(cdfp_contact_search_lengths(this%handle%address, cell, buffer, travel), stat, errmsg)
  end subroutine

  !> Pairs as compressed rows: the segments that contact node `nodes(r)` pairs with are
  !> partners(start(r):start(r + 1) - 1), ascending.
  subroutine get_searched_node_segments(this, start, partners, stat, errmsg)
    class(cdfp_contact_search), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: start(:), partners(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call get_rows(cdfp_contact_search_node_segments, this%handle%address, start, partners, stat, errmsg)
  end subroutine

  !> The same for edges: the row is the smaller edge of each pair.
  subroutine get_searched_edge_edges(this, start, partners, stat, errmsg)
    class(cdfp_contact_search), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: start(:), partners(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call get_rows(cdfp_contact_search_edge_edges, this%handle%address, start, partners, stat, errmsg)
  end subroutine

  subroutine get_rows(ask, address, start, partners, stat, errmsg)
    procedure(ask_rows) :: ask
    type(c_ptr), intent(in) :: address
    integer(c_int32_t), allocatable, intent(out) :: start(:), partners(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: start_data, partner_data
    integer(c_int64_t) :: rows
    integer(c_int32_t) :: status

    status = ask(address, start_data, partner_data, rows)
    if (status == CDFP_OK) then
      call copy_numbers(start_data, rows + 1, start)
      call copy_numbers(partner_data, int(start(size(start)), c_int64_t) - 1, partners)
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> The point of a face closest to `point`. `corners` (3, 3) or (3, 4) in outward order; `weights`: shape
  !> functions of the corners there; `normal`: unit, outward; `gap`: negative behind the face; `outside`: how
  !> far past the face's border.
  subroutine project_on_face(point, corners, weights, normal, gap, outside, stat, errmsg)
    real(c_double), intent(in) :: point(3)
    real(c_double), contiguous, intent(in) :: corners(:, :)
    real(c_double), intent(out) :: weights(4), normal(3), gap, outside
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    weights = 0
    normal = 0
    gap = 0
    outside = 0
    if (size(corners, 1) /= 3) then
      call refuse('project_on_face: corners must be of shape (3, 3) or (3, 4)', stat, errmsg)
      return
    end if
    call report(cdfp_project_on_face(point, size(corners, 2, c_int64_t), corners, weights, normal, gap, &
                                     outside), stat, errmsg)
  end subroutine

  !> What is absent is as in a model: see `cdfp_contact_settings` in cdfp/c/model.h.
  subroutine create(this, cell_factor, buffer_factor, penalty_factor, friction, depth_limit, edge_edge, &
                    adaptive, penetration_warning, stat, errmsg)
    class(cdfp_contact), intent(inout) :: this
    real(c_double), intent(in), optional :: cell_factor, buffer_factor, penalty_factor, friction, depth_limit
    real(c_double), intent(in), optional :: penetration_warning
    logical, intent(in), optional :: edge_edge, adaptive
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_contact_settings) :: settings
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_contact_settings_default(settings)
    if (present(cell_factor)) settings%cell_factor = cell_factor
    if (present(buffer_factor)) settings%buffer_factor = buffer_factor
    if (present(penalty_factor)) settings%penalty_factor = penalty_factor
    if (present(friction)) settings%friction = friction
    if (present(depth_limit)) settings%depth_limit = depth_limit
    if (present(penetration_warning)) settings%penetration_warning = penetration_warning
    if (present(edge_edge)) settings%edge_edge = merge(1_c_int32_t, 0_c_int32_t, edge_edge)
    if (present(adaptive)) settings%adaptive = merge(1_c_int32_t, 0_c_int32_t, adaptive)
    status = cdfp_contact_create(settings, made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free(this)
    class(cdfp_contact), intent(inout) :: this

    call this%handle%free()
  end subroutine

  !> For messages.
  subroutine name_part(this, part, name, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer, intent(in) :: part
    character(len=*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_contact_name_part(this%handle%address, int(part, c_int32_t) - 1_c_int32_t, c_text(name)), &
                stat, errmsg)
  end subroutine

  !> `segments` (4, m): corners in outward order, 0 last in a triangle; `elements` that own them; `parts`;
  !> `bulk_modulus` in Pa; `area` in m2; `volume` of the element in m3.
  subroutine add_segments(this, segments, elements, parts, bulk_modulus, area, volume, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer(c_int32_t), contiguous, intent(in) :: segments(:, :), elements(:), parts(:)
    real(c_double), contiguous, intent(in) :: bulk_modulus(:), area(:), volume(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(segments, 1) /= 4 .or. &
        any([size(elements), size(parts), size(bulk_modulus), size(area), size(volume)] /= &
            size(segments, 2))) then
      call refuse('add_segments: segments must be of shape (4, n), all others of shape (n)', stat, errmsg)
      return
    end if
    call report(cdfp_contact_add_segments(this%handle%address, size(segments, 2, c_int64_t), &
                                          segments - 1_c_int32_t, elements - 1_c_int32_t, &
                                          parts - 1_c_int32_t, bulk_modulus, area, volume), stat, errmsg)
  end subroutine

  !> Facets (2, n) of a topology as segments, at the start or when the faces of a crack came free. `coordinates`
  !> of the undeformed mesh, for nodes as they are numbered now; `parts` of the bulk elements; `bulk_modulus` of
  !> the parts.
  subroutine add_facets(this, topology, coordinates, facets, parts, bulk_modulus, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    type(cdfp_topology), intent(in) :: topology
    real(c_double), contiguous, intent(in) :: coordinates(:, :)
    integer(c_int32_t), contiguous, intent(in) :: facets(:, :), parts(:)
    real(c_double), contiguous, intent(in) :: bulk_modulus(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(coordinates, 1) /= 3 .or. size(facets, 1) /= 2) then
      call refuse('add_facets: coordinates must be of shape (3, nodes), facets of shape (2, n)', stat, errmsg)
      return
    end if
    call report(cdfp_contact_add_facets(this%handle%address, topology%handle%address, &
                                        size(coordinates, 2, c_int64_t), coordinates, &
                                        size(facets, 2, c_int64_t), facets - 1_c_int32_t, &
                                        size(parts, kind=c_int64_t), parts - 1_c_int32_t, &
                                        size(bulk_modulus, kind=c_int64_t), bulk_modulus), stat, errmsg)
  end subroutine

  !> What `insert_cohesive` of the topology has reported, after each insertion.
  subroutine follow(this, new_nodes, renumbered, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer(c_int32_t), contiguous, intent(in) :: new_nodes(:, :), renumbered(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(new_nodes, 1) /= 2 .or. size(renumbered, 1) /= 4) then
      call refuse('follow: new_nodes must be of shape (2, n), renumbered of shape (4, n)', stat, errmsg)
      return
    end if
    call report(cdfp_contact_follow(this%handle%address, size(new_nodes, 2, c_int64_t), &
                                    new_nodes - 1_c_int32_t, size(renumbered, 2, c_int64_t), &
                                    renumbered - 1_c_int32_t), stat, errmsg)
  end subroutine

  !> Elements that are no more: their segments and edges leave, and what touches them is let go. The faces of
  !> neighbours that are free now come by `add_facets`.
  subroutine remove_elements(this, elements, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer(c_int32_t), intent(in) :: elements(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_contact_remove_elements(this%handle%address, size(elements, kind=c_int64_t), &
                                             elements - 1_c_int32_t), stat, errmsg)
  end subroutine

  !> Once a step: CDFP_SEARCH_NONE, CDFP_SEARCH_REGULAR or CDFP_SEARCH_ADAPTIVE. `v` led to the positions.
  function search_due(this, v, step, threads, stat, errmsg) result(kind)
    class(cdfp_contact), intent(in) :: this
    real(c_double), contiguous, intent(in) :: v(:, :)
    real(c_double), intent(in) :: step
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: kind

    kind = CDFP_SEARCH_NONE
    if (size(v, 1) /= 3) then
      call refuse('search_due: v must be of shape (3, nodes)', stat, errmsg)
      return
    end if
    call report(cdfp_contact_due(this%handle%address, size(v, 2, c_int64_t), v, step, &
                                 threads_or_one(threads), kind), stat, errmsg)
  end function

  !> `groups` (nodes): rigid body of each node or 0.
  subroutine regular_search(this, x, groups, threads, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :)
    integer(c_int32_t), intent(in), optional :: groups(:)
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: group_numbers(:)

    if (.not. groups_agree(x, groups)) then
      call refuse('regular_search: x must be of shape (3, nodes), groups of shape (nodes)', stat, errmsg)
      return
    end if
    call count_from_0(groups, group_numbers)
    call report(cdfp_contact_regular_search(this%handle%address, size(x, 2, c_int64_t), x, &
                                            group_numbers, threads_or_one(threads)), stat, errmsg)
  end subroutine

  subroutine adaptive_search(this, x, groups, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :)
    integer(c_int32_t), intent(in), optional :: groups(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: group_numbers(:)

    if (.not. groups_agree(x, groups)) then
      call refuse('adaptive_search: x must be of shape (3, nodes), groups of shape (nodes)', stat, errmsg)
      return
    end if
    call count_from_0(groups, group_numbers)
    call report(cdfp_contact_adaptive_search(this%handle%address, size(x, 2, c_int64_t), x, &
                                             group_numbers), stat, errmsg)
  end subroutine

  !> The search that is due, if one is.
  subroutine search(this, x, v, step, groups, threads, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :), v(:, :)
    real(c_double), intent(in) :: step
    integer(c_int32_t), intent(in), optional :: groups(:)
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    select case (this%search_due(v, step, threads, stat, errmsg))
    case (CDFP_SEARCH_REGULAR)
      call this%regular_search(x, groups, threads, stat, errmsg)
    case (CDFP_SEARCH_ADAPTIVE)
      call this%adaptive_search(x, groups, stat, errmsg)
    end select
  end subroutine

  !> Which candidates touch.
  subroutine local_search(this, x, threads, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :)
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(x, 1) /= 3) then
      call refuse('local_search: x must be of shape (3, nodes)', stat, errmsg)
      return
    end if
    call report(cdfp_contact_local_search(this%handle%address, size(x, 2, c_int64_t), x, &
                                          threads_or_one(threads)), stat, errmsg)
  end subroutine

  !> Adds to `f`. `threads`: 1 if absent, 0: as many as the machine has; results are the same bits for any
  !> number.
  subroutine add_force(this, v, mass, f, step, threads, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    real(c_double), contiguous, intent(in) :: v(:, :), mass(:)
    real(c_double), contiguous, intent(inout) :: f(:, :)
    real(c_double), intent(in) :: step
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (any(shape(v) /= [3, size(mass)]) .or. any(shape(f) /= [3, size(mass)])) then
      call refuse('add_force: v and f must be of shape (3, nodes), mass of shape (nodes)', stat, errmsg)
      return
    end if
    call report(cdfp_contact_add_force(this%handle%address, size(mass, kind=c_int64_t), v, mass, f, step, &
                                       threads_or_one(threads)), stat, errmsg)
  end subroutine

  !> Contact nodes, segments, edges, and pairs that touch.
  subroutine get_counts(this, nodes, segments, edges, touching, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer(c_int64_t), intent(out), optional :: nodes, segments, edges, touching
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: counts(4)

    counts = 0
    call report(cdfp_contact_counts(this%handle%address, counts(1), counts(2), counts(3), counts(4)), stat, &
                errmsg)
    if (present(nodes)) nodes = counts(1)
    if (present(segments)) segments = counts(2)
    if (present(edges)) edges = counts(3)
    if (present(touching)) touching = counts(4)
  end subroutine

  !> The contact nodes: rows of `get_node_segments`.
  subroutine get_nodes(this, nodes, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: nodes(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status

    status = cdfp_contact_nodes(this%handle%address, data, count)
    if (status == CDFP_OK) call copy_numbers(data, count, nodes)
    call report(status, stat, errmsg)
  end subroutine

  !> Candidate pairs as compressed rows: see `cdfp_contact_search`.
  subroutine get_node_segments(this, start, partners, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: start(:), partners(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call get_rows(cdfp_contact_node_segments, this%handle%address, start, partners, stat, errmsg)
  end subroutine

  subroutine get_edge_edges(this, start, partners, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: start(:), partners(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call get_rows(cdfp_contact_edge_edges, this%handle%address, start, partners, stat, errmsg)
  end subroutine

  !> The pairs that touch, with their forces at the last `add_force`: on the first `first_count` nodes by their
  !> weights, the opposite on the others by theirs.
  subroutine get_touches(this, touches, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    type(cdfp_touch), allocatable, intent(out) :: touches(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_touch), pointer :: view(:)
    type(c_ptr) :: data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status
    integer :: i

    status = cdfp_contact_touches(this%handle%address, data, count)
    if (status == CDFP_OK) then
      allocate (touches(count))
      if (count > 0) then
        call c_f_pointer(data, view, [count])
        touches = view
      end if
      do i = 1, size(touches)
        touches(i)%nodes = touches(i)%nodes + 1_c_int32_t
        touches(i)%parts = touches(i)%parts + 1_c_int32_t
      end do
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> Two parts that have touched, or one that touched itself, in the order in which they first did.
  subroutine get_body_pairs(this, pairs, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    type(cdfp_body_pair), allocatable, intent(out) :: pairs(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_body_pair), pointer :: view(:)
    type(c_ptr) :: data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status
    integer :: i

    status = cdfp_contact_body_pairs(this%handle%address, data, count)
    if (status == CDFP_OK) then
      allocate (pairs(count))
      if (count > 0) then
        call c_f_pointer(data, view, [count])
        pairs = view
      end if
      do i = 1, size(pairs)
        pairs(i)%parts = pairs(i)%parts + 1_c_int32_t
      end do
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> J stored in springs, J of friction heat so far, m of the deepest penetration so far.
  subroutine get_energies(this, stored, friction_heat, deepest, stat, errmsg)
    class(cdfp_contact), intent(in) :: this
    real(c_double), intent(out) :: stored, friction_heat, deepest
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    stored = 0
    friction_heat = 0
    deepest = 0
    call report(cdfp_contact_energies(this%handle%address, stored, friction_heat, deepest), stat, errmsg)
  end subroutine

  !> omega^2 in 1/s2 that the contact springs add to the elements' for the stable step 2/omega.
  function stiffness_over_mass(this, stat, errmsg) result(added)
    class(cdfp_contact), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: added

    added = 0
    call report(cdfp_contact_stiffness_over_mass(this%handle%address, added), stat, errmsg)
  end function

  function warning_count(this, stat, errmsg) result(warnings)
    class(cdfp_contact), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: warnings
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_contact_warning_count(this%handle%address, count), stat, errmsg)
    warnings = int(count)
  end function

  function warning(this, number, stat, errmsg) result(text)
    class(cdfp_contact), intent(in) :: this
    integer, intent(in) :: number
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(len=:), allocatable :: text
    character(kind=c_char) :: buffer(4096)
    integer(c_int64_t) :: length

    length = 0
    call report(cdfp_contact_warning(this%handle%address, int(number, c_int64_t) - 1, buffer, &
                                     size(buffer, kind=c_int64_t), length), stat, errmsg)
    text = fortran_text(buffer, length)
  end function

  pure logical function shapes_agree(x, segments, edges, groups)
    real(c_double), intent(in) :: x(:, :)
    integer(c_int32_t), intent(in) :: segments(:, :), edges(:, :)
    integer(c_int32_t), intent(in), optional :: groups(:)

    shapes_agree = size(segments, 1) == 4 .and. size(edges, 1) == 2 .and. groups_agree(x, groups)
  end function

  pure logical function groups_agree(x, groups)
    real(c_double), intent(in) :: x(:, :)
    integer(c_int32_t), intent(in), optional :: groups(:)

    groups_agree = size(x, 1) == 3
    if (present(groups)) groups_agree = groups_agree .and. size(groups) == size(x, 2)
  end function

  !> Not allocated if absent, which makes it an absent argument.
  pure subroutine count_from_0(numbers, less)
    integer(c_int32_t), intent(in), optional :: numbers(:)
    integer(c_int32_t), allocatable, intent(out) :: less(:)

    if (present(numbers)) less = numbers - 1_c_int32_t
  end subroutine

  subroutine assign_search(this, other)
    type(cdfp_contact_search), intent(inout) :: this
    type(cdfp_contact_search), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

  subroutine assign_contact(this, other)
    type(cdfp_contact), intent(inout) :: this
    type(cdfp_contact), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

end module cdfp_contacts
