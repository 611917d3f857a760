!> Cohesive fracture on a program's own arrays: which facets open, the forces of cohesive elements between the
!> program's nodes, and the law at single points.
module cdfp_cohesives
  use, intrinsic :: iso_c_binding
  use cdfp_c
  use cdfp_handles
  use cdfp_topologies, only: cdfp_topology
  implicit none
  private
  public :: cdfp_cohesive, start_cohesive, cohesive_traction, cohesive_mean_traction, cohesive_stored, assignment(=)

  !> Cohesive elements between the program's nodes, for a time loop of its own by central differences; the
  !> forces are those of a full simulation. In a step: move the nodes, compute all other forces, open facets
  !> (`find_open`; for each of them `insert_cohesive` of the topology, `follow` and `insert`), `add_force`, and
  !> only then change the velocities by step * force / mass.
  !>
  !> Arrays of nodes are (3, n) or (n) and used where they are. A contiguous part of a longer array, such as
  !> x(:, :n), is used in place as well: arrays may have room for nodes to come.
  type :: cdfp_cohesive
    type(counted_handle) :: handle
  contains
    procedure, private :: create_alone
    procedure, private :: create_on_topology
    generic :: create => create_alone, create_on_topology
    procedure :: free
    procedure :: add_law
    procedure :: add_user_law
    procedure :: hold
    procedure :: set_parts
    procedure :: find_open
    procedure :: follow
    procedure :: insert
    procedure :: add_force
    procedure :: element_count
    procedure :: broken_count
    procedure :: get_broken
    procedure :: get_pairs
    procedure :: get_energies
    procedure :: stiffness_over_mass
  end type

  !> One more owner of the same object.
  interface assignment(=)
    module procedure assign
  end interface

contains

  !> Elements have the numbers 1, 2, and so on in the order in which they are inserted.
  subroutine create_alone(this, stat, errmsg)
    class(cdfp_cohesive), intent(inout) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call make(this, 0_c_int32_t, stat, errmsg)
  end subroutine

  !> Elements have the numbers that the topology gives them.
  subroutine create_on_topology(this, topology, stat, errmsg)
    class(cdfp_cohesive), intent(inout) :: this
    type(cdfp_topology), intent(in) :: topology
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: elements, bulk
    integer(c_int32_t) :: status

    bulk = 0
    status = cdfp_topology_element_count(topology%handle%address, elements, bulk)
    if (status == CDFP_OK) then
      call make(this, int(bulk, c_int32_t), stat, errmsg)
    else
      call report(status, stat, errmsg)
    end if
  end subroutine

  subroutine make(this, first_element, stat, errmsg)
    class(cdfp_cohesive), intent(inout) :: this
    integer(c_int32_t), intent(in) :: first_element
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_cohesive_create(first_element, made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free(this)
    class(cdfp_cohesive), intent(inout) :: this

    call this%handle%free()
  end subroutine

  !> `number`: by which elements and parts name the law, from 1 in the order of these calls.
  subroutine add_law(this, law, number, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    type(cdfp_cohesive_law), intent(in) :: law
    integer(c_int32_t), intent(out) :: number
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    number = -1
    call report(cdfp_cohesive_add_law(this%handle%address, law, number), stat, errmsg)
    number = number + 1_c_int32_t
  end subroutine

  !> A law of the program's own: see `set_cohesive_callback` of `cdfp_model`.
  subroutine add_user_law(this, law, callback, number, states, user_data, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    type(cdfp_cohesive_law), intent(in) :: law
    type(c_funptr), intent(in) :: callback
    integer(c_int32_t), intent(out) :: number
    integer(c_int32_t), intent(in), optional :: states
    type(c_ptr), intent(in), optional :: user_data
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: count
    type(c_ptr) :: user

    count = 0
    if (present(states)) count = states
    user = c_null_ptr
    if (present(user_data)) user = user_data
    number = -1
    call report(cdfp_cohesive_add_user_law(this%handle%address, law, callback, count, user, number), stat, &
                errmsg)
    number = number + 1_c_int32_t
  end subroutine

  !> These nodes do not follow forces in the directions that are true: their velocity is prescribed, or a rigid
  !> body carries them. Their copies inherit it.
  subroutine hold(this, nodes, directions, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    integer(c_int32_t), contiguous, intent(in) :: nodes(:)
    logical, intent(in) :: directions(3)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_cohesive_hold(this%handle%address, size(nodes, kind=c_int64_t), nodes - 1_c_int32_t, &
                                   merge(1_c_int32_t, 0_c_int32_t, directions)), stat, errmsg)
  end subroutine

  !> For `find_open`, after all laws were added: part of each bulk element, law of each part (0: does not
  !> crack), `recovery` (CDFP_ELEMENT_MEAN if absent, or CDFP_NODAL) and the share of its law's strength that
  !> each bulk element has. `coordinates` of the undeformed mesh.
  subroutine set_parts(this, topology, coordinates, parts, law_of_part, recovery, strength_shares, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    type(cdfp_topology), intent(in) :: topology
    real(c_double), contiguous, intent(in) :: coordinates(:, :)
    integer(c_int32_t), contiguous, intent(in) :: parts(:), law_of_part(:)
    integer(c_int32_t), intent(in), optional :: recovery
    real(c_double), contiguous, intent(in), optional :: strength_shares(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), allocatable :: shares(:)  ! one that is not allocated is an absent argument
    integer(c_int32_t) :: chosen
    logical :: good

    good = size(coordinates, 1) == 3
    if (present(strength_shares)) then
      good = good .and. size(strength_shares) == size(parts)
      shares = strength_shares
    end if
    if (.not. good) then
      call refuse('set_parts: coordinates must be of shape (3, nodes), with one share for each element', stat, &
                  errmsg)
      return
    end if
    chosen = CDFP_ELEMENT_MEAN
    if (present(recovery)) chosen = recovery
    call report(cdfp_cohesive_set_parts(this%handle%address, topology%handle%address, &
                                        size(coordinates, 2, c_int64_t), coordinates, &
                                        size(parts, kind=c_int64_t), parts - 1_c_int32_t, &
                                        size(law_of_part, kind=c_int64_t), law_of_part - 1_c_int32_t, &
                                        chosen, shares), stat, errmsg)
  end subroutine

  !> Facets between two elements of one part that reach their strength, in ascending order. `stress` (6, bulk
  !> elements): Cauchy, xx yy zz xy yz zx. `facets` (3, n): element, facet, law; `tractions` (3, n).
  subroutine find_open(this, topology, x, stress, facets, tractions, threads, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    type(cdfp_topology), intent(in) :: topology
    real(c_double), contiguous, intent(in) :: x(:, :), stress(:, :)
    integer(c_int32_t), allocatable, intent(out) :: facets(:, :)
    real(c_double), allocatable, intent(out) :: tractions(:, :)
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: facet_data, traction_data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status
    real(c_double), pointer :: view(:, :)

    if (size(x, 1) /= 3 .or. size(stress, 1) /= 6) then
      call refuse('find_open: x must be of shape (3, nodes), stress of shape (6, elements)', stat, errmsg)
      return
    end if
    status = cdfp_cohesive_find_open(this%handle%address, topology%handle%address, size(x, 2, c_int64_t), x, &
                                     size(stress, 2, c_int64_t), stress, threads_or_one(threads), &
                                     facet_data, traction_data, count)
    if (status == CDFP_OK) then
      call copy_rows(facet_data, 3_c_int64_t, count, facets)
      allocate (tractions(3, count))
      if (count > 0) then
        call c_f_pointer(traction_data, view, [3_c_int64_t, count])
        tractions = view
      end if
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> What `insert_cohesive` of the topology has reported, after each insertion and before `insert`.
  subroutine follow(this, new_nodes, renumbered, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    integer(c_int32_t), contiguous, intent(in) :: new_nodes(:, :), renumbered(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(new_nodes, 1) /= 2 .or. size(renumbered, 1) /= 4) then
      call refuse('follow: new_nodes must be of shape (2, n), renumbered of shape (4, n)', stat, errmsg)
      return
    end if
    call report(cdfp_cohesive_follow(this%handle%address, size(new_nodes, 2, c_int64_t), &
                                     new_nodes - 1_c_int32_t, size(renumbered, 2, c_int64_t), &
                                     renumbered - 1_c_int32_t), stat, errmsg)
  end subroutine

  !> The next element: nodes of its upper face, then of its lower face, as `get_nodes` of the topology gives
  !> them (6 or 8). `traction`: what the upper side exerts on the lower one now; absent in bonds.
  subroutine insert(this, element, law, nodes, x, time, traction, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    integer(c_int32_t), intent(in) :: element, law
    integer(c_int32_t), contiguous, intent(in) :: nodes(:)
    real(c_double), contiguous, intent(in) :: x(:, :)
    real(c_double), intent(in) :: time
    real(c_double), intent(in), optional :: traction(3)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(x, 1) /= 3) then
      call refuse('insert: x must be of shape (3, nodes)', stat, errmsg)
      return
    end if
    call report(cdfp_cohesive_insert(this%handle%address, element - 1_c_int32_t, law - 1_c_int32_t, &
                                     size(nodes, kind=c_int64_t), nodes - 1_c_int32_t, traction, &
                                     size(x, 2, c_int64_t), x, time), stat, errmsg)
  end subroutine

  !> Adds to `f`, which holds all other forces of the step. `v`: at the half step that led to `x`. `threads`: 1
  !> if absent, 0: as many as the machine has; results are the same bits for any number.
  subroutine add_force(this, x, v, mass, f, step, time, threads, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :), v(:, :), mass(:)
    real(c_double), contiguous, intent(inout) :: f(:, :)
    real(c_double), intent(in) :: step, time
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (any(shape(x) /= [3, size(mass)]) .or. any(shape(v) /= shape(x)) .or. any(shape(f) /= shape(x))) then
      call refuse('add_force: x, v and f must be of shape (3, nodes), mass of shape (nodes)', stat, errmsg)
      return
    end if
    call report(cdfp_cohesive_add_force(this%handle%address, size(mass, kind=c_int64_t), x, v, mass, f, step, &
                                        time, threads_or_one(threads)), stat, errmsg)
  end subroutine

  function element_count(this, stat, errmsg) result(elements)
    class(cdfp_cohesive), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: elements, broken

    elements = 0
    call report(cdfp_cohesive_count(this%handle%address, elements, broken), stat, errmsg)
  end function

  function broken_count(this, stat, errmsg) result(broken)
    class(cdfp_cohesive), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: elements, broken

    broken = 0
    call report(cdfp_cohesive_count(this%handle%address, elements, broken), stat, errmsg)
  end function

  !> Elements whose faces came free in the last `add_force`, ascending.
  subroutine get_broken(this, elements, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    integer(c_int32_t), allocatable, intent(out) :: elements(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: data
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status

    status = cdfp_cohesive_broken_now(this%handle%address, data, count)
    if (status == CDFP_OK) call copy_numbers(data, count, elements)
    call report(status, stat, errmsg)
  end subroutine

  !> The node pairs of an element after the last `add_force`: damage, opening, energies.
  subroutine get_pairs(this, element, pairs, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    integer(c_int32_t), intent(in) :: element
    type(cdfp_cohesive_pair), allocatable, intent(out) :: pairs(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_cohesive_pair) :: room(4)
    integer(c_int64_t) :: count
    integer(c_int32_t) :: status

    status = cdfp_cohesive_pairs(this%handle%address, element - 1_c_int32_t, room, count)
    if (status == CDFP_OK) then
      pairs = room(:count)
      pairs%upper = pairs%upper + 1_c_int32_t
      pairs%lower = pairs%lower + 1_c_int32_t
    end if
    call report(status, stat, errmsg)
  end subroutine

  !> J: stored, dissipated by the cohesive tractions, friction heat between closed faces, and what the laws say
  !> that the same openings dissipate.
  subroutine get_energies(this, stored, dissipated, friction, by_law, stat, errmsg)
    class(cdfp_cohesive), intent(in) :: this
    real(c_double), intent(out) :: stored, dissipated, friction, by_law
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    stored = 0
    dissipated = 0
    friction = 0
    by_law = 0
    call report(cdfp_cohesive_energies(this%handle%address, stored, dissipated, friction, by_law), stat, errmsg)
  end subroutine

  !> omega^2 in 1/s2 that users' laws add to the elements' for the stable step 2/omega; the others add none.
  function stiffness_over_mass(this, mass, stat, errmsg) result(added)
    class(cdfp_cohesive), intent(in) :: this
    real(c_double), contiguous, intent(in) :: mass(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: added

    added = 0
    call report(cdfp_cohesive_stiffness_over_mass(this%handle%address, size(mass, kind=c_int64_t), mass, &
                                                  added), stat, errmsg)
  end function

  !> Points that carry `traction` on faces with unit normals `normal`, both (3, n), from the lower to the upper
  !> side.
  subroutine start_cohesive(law, traction, normal, points, stat, errmsg)
    type(cdfp_cohesive_law), intent(in) :: law
    real(c_double), contiguous, intent(in) :: traction(:, :), normal(:, :)
    type(cdfp_cohesive_point), contiguous, intent(inout) :: points(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (any(shape(traction) /= [3, size(points)]) .or. any(shape(normal) /= [3, size(points)])) then
      call refuse('start_cohesive: traction and normal must be of shape (3, points)', stat, errmsg)
      return
    end if
    call report(cdfp_cohesive_law_start(law, size(points, kind=c_int64_t), traction, normal, points), stat, &
                errmsg)
  end subroutine

  !> Traction at `opening`, (3, n); the state goes along the straight segment from the last opening.
  subroutine cohesive_traction(law, opening, normal, points, traction, stat, errmsg)
    type(cdfp_cohesive_law), intent(in) :: law
    real(c_double), contiguous, intent(in) :: opening(:, :), normal(:, :)
    type(cdfp_cohesive_point), contiguous, intent(inout) :: points(:)
    real(c_double), contiguous, intent(inout) :: traction(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (any(shape(opening) /= [3, size(points)]) .or. any(shape(normal) /= [3, size(points)]) .or. &
        any(shape(traction) /= [3, size(points)])) then
      call refuse('cohesive_traction: opening, normal and traction must be of shape (3, points)', stat, errmsg)
      return
    end if
    call report(cdfp_cohesive_law_traction(law, size(points, kind=c_int64_t), opening, normal, points, &
                                           traction), stat, errmsg)
  end subroutine

  !> Mean traction over the increment: times the increment it is exactly the change of energy.
  subroutine cohesive_mean_traction(law, opening, normal, points, traction, stat, errmsg)
    type(cdfp_cohesive_law), intent(in) :: law
    real(c_double), contiguous, intent(in) :: opening(:, :), normal(:, :)
    type(cdfp_cohesive_point), contiguous, intent(inout) :: points(:)
    real(c_double), contiguous, intent(inout) :: traction(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (any(shape(opening) /= [3, size(points)]) .or. any(shape(normal) /= [3, size(points)]) .or. &
        any(shape(traction) /= [3, size(points)])) then
      call refuse('cohesive_mean_traction: opening, normal and traction must be of shape (3, points)', stat, &
                  errmsg)
      return
    end if
    call report(cdfp_cohesive_law_mean_traction(law, size(points, kind=c_int64_t), opening, normal, points, &
                                                traction), stat, errmsg)
  end subroutine

  !> J/m2 that each point gives back when it closes.
  subroutine cohesive_stored(law, normal, points, stored, stat, errmsg)
    type(cdfp_cohesive_law), intent(in) :: law
    real(c_double), contiguous, intent(in) :: normal(:, :)
    type(cdfp_cohesive_point), contiguous, intent(in) :: points(:)
    real(c_double), contiguous, intent(inout) :: stored(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (any(shape(normal) /= [3, size(points)]) .or. size(stored) /= size(points)) then
      call refuse('cohesive_stored: normal must be of shape (3, points), stored of shape (points)', stat, errmsg)
      return
    end if
    call report(cdfp_cohesive_law_stored(law, size(points, kind=c_int64_t), normal, points, stored), stat, &
                errmsg)
  end subroutine

  subroutine assign(this, other)
    type(cdfp_cohesive), intent(inout) :: this
    type(cdfp_cohesive), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

end module cdfp_cohesives
