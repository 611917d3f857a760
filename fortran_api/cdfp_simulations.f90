!> A simulation: advance it, look at its state, keep its results.
module cdfp_simulations
  use, intrinsic :: iso_c_binding
  use cdfp_c
  use cdfp_c_material
  use cdfp_handles
  use cdfp_models
  implicit none
  private
  public :: cdfp_simulation, cdfp_recorder, assignment(=)

  !> Numbers count from 1. Views belong to the simulation and hold until its next step; to be read only.
  type :: cdfp_simulation
    type(counted_handle) :: handle
  contains
    procedure :: create
    procedure :: free
    procedure :: step
    procedure :: advance
    procedure :: advance_to
    procedure :: save => save_simulation
    procedure :: restore
    procedure :: set_monitor
    procedure :: set_positions
    procedure :: set_velocities
    procedure :: finished
    procedure :: time
    procedure :: step_size
    procedure :: stable_step
    procedure :: controlling_element
    procedure :: step_count
    procedure :: node_count
    procedure :: positions
    procedure :: velocities
    procedure :: forces
    procedure :: masses
    procedure :: get_stresses
    procedure :: body_count
    procedure :: body
    procedure :: cohesive_count
    procedure :: broken_count
    procedure :: element_field
    procedure :: energies
    procedure :: summary
    procedure :: first_crack
    procedure :: contact_pair_count
    procedure :: get_contact_pair
    procedure :: stage_count
    procedure :: get_stage
    procedure :: warning_count
    procedure :: warning
    procedure :: history
    procedure :: history_column
  end type

  !> Results in a folder.
  type :: cdfp_recorder
    type(counted_handle) :: handle
  contains
    procedure :: create => create_recorder
    procedure :: continue_in
    procedure :: free => free_recorder
    procedure :: snapshot
    procedure :: finish
  end type

  abstract interface
    function ask_nodes(simulation, values, nodes) bind(c) result(status)
      import
      type(c_ptr), value :: simulation
      type(c_ptr), intent(inout) :: values
      integer(c_int64_t), intent(inout) :: nodes
      integer(c_int32_t) :: status
    end function
  end interface

  !> One more owner of the same object.
  interface assignment(=)
    module procedure assign_simulation, assign_recorder
  end interface

contains

  !> Checks the model and builds what it needs. The model may be changed, used again or freed afterwards.
  subroutine create(this, model, stat, errmsg)
    class(cdfp_simulation), intent(inout) :: this
    type(cdfp_model), intent(in) :: model
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_simulation_create(model%handle%address, made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free(this)
    class(cdfp_simulation), intent(inout) :: this

    call this%handle%free()
  end subroutine

  subroutine step(this, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_simulation_step(this%handle%address), stat, errmsg)
  end subroutine

  !> As many steps as are left, at most `steps`.
  subroutine advance(this, steps, done, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(in) :: steps
    integer, intent(out), optional :: done
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_simulation_advance(this%handle%address, int(steps, c_int64_t), count), stat, errmsg)
    if (present(done)) done = int(count)
  end subroutine

  !> Steps until half a step from `time` or nearer, or the end.
  subroutine advance_to(this, time, done, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    real(c_double), intent(in) :: time
    integer, intent(out), optional :: done
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_simulation_advance_to(this%handle%address, time, count), stat, errmsg)
    if (present(done)) done = int(count)
  end subroutine

  !> Writes all that the next step needs into a file, which takes its place when it is whole.
  subroutine save_simulation(this, path, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_simulation_save(this%handle%address, c_text(path)), stat, errmsg)
  end subroutine

  !> Goes on from there, in a simulation that was built from the same model and not stepped yet: it takes the
  !> same steps to the bit, with any number of threads. Title, threads, time and output of the model may be
  !> others. What your procedures keep for themselves is theirs to bring back.
  subroutine restore(this, path, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_simulation_restore(this%handle%address, c_text(path)), stat, errmsg)
  end subroutine

  !> `callback` is `c_funloc` of a `bind(c)` function with an `integer(c_int32_t)` result and the arguments
  !> `type(c_ptr), value :: simulation` and `type(c_ptr), value :: user_data`. It is called after every step; a
  !> result that is not 0 ends the call that steps. It may look at the simulation and change its state, by
  !> `user_data` or a variable of its module, but not step it. `c_null_funptr`: none.
  subroutine set_monitor(this, callback, user_data, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    type(c_funptr), intent(in) :: callback
    type(c_ptr), intent(in), optional :: user_data
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: user

    user = c_null_ptr
    if (present(user_data)) user = user_data
    call report(cdfp_simulation_set_monitor(this%handle%address, callback, user), stat, errmsg)
  end subroutine

  !> (3, nodes), m. Nodes of rigid bodies and directions that are prescribed keep what they have; the energy
  !> that the change brings is external work; contact is searched anew.
  subroutine set_positions(this, x, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    real(c_double), contiguous, intent(in) :: x(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(x, 1) /= 3) then
      call refuse('set_positions: x must be of shape (3, nodes)', stat, errmsg)
      return
    end if
    call report(cdfp_simulation_set_positions(this%handle%address, size(x, 2, c_int64_t), x), stat, errmsg)
  end subroutine

  !> (3, nodes), half a step ahead of the positions, m/s.
  subroutine set_velocities(this, v, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    real(c_double), contiguous, intent(in) :: v(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(v, 1) /= 3) then
      call refuse('set_velocities: v must be of shape (3, nodes)', stat, errmsg)
      return
    end if
    call report(cdfp_simulation_set_velocities(this%handle%address, size(v, 2, c_int64_t), v), stat, errmsg)
  end subroutine

  function finished(this, stat, errmsg) result(answer)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    logical :: answer
    integer(c_int32_t) :: flag

    flag = 1
    call report(cdfp_simulation_finished(this%handle%address, flag), stat, errmsg)
    answer = flag /= 0
  end function

  function time(this, stat, errmsg) result(seconds)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: seconds

    seconds = 0
    call report(cdfp_simulation_time(this%handle%address, seconds), stat, errmsg)
  end function

  function step_size(this, stat, errmsg) result(seconds)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: seconds

    seconds = 0
    call report(cdfp_simulation_step_size(this%handle%address, seconds), stat, errmsg)
  end function

  function stable_step(this, stat, errmsg) result(seconds)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: seconds

    seconds = 0
    call report(cdfp_simulation_stable_step(this%handle%address, seconds), stat, errmsg)
  end function

  !> The element that the stable step belongs to, 0 if none.
  function controlling_element(this, stat, errmsg) result(element)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: element

    element = -1
    call report(cdfp_simulation_controlling_element(this%handle%address, element), stat, errmsg)
    element = element + 1_c_int32_t
  end function

  function step_count(this, stat, errmsg) result(steps)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: steps

    steps = 0
    call report(cdfp_simulation_step_count(this%handle%address, steps), stat, errmsg)
  end function

  function node_count(this, stat, errmsg) result(nodes)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: nodes

    nodes = 0
    call report(cdfp_simulation_node_count(this%handle%address, nodes), stat, errmsg)
  end function

  !> (3, nodes), m.
  function positions(this, stat, errmsg) result(x)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), pointer :: x(:, :)

    x => vectors(cdfp_simulation_positions, this, stat, errmsg)
  end function

  !> (3, nodes), half a step ahead of the positions, m/s.
  function velocities(this, stat, errmsg) result(v)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), pointer :: v(:, :)

    v => vectors(cdfp_simulation_velocities, this, stat, errmsg)
  end function

  !> (3, nodes), all nodal forces of the last step, N.
  function forces(this, stat, errmsg) result(f)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), pointer :: f(:, :)

    f => vectors(cdfp_simulation_forces, this, stat, errmsg)
  end function

  !> Lumped, kg.
  function masses(this, stat, errmsg) result(m)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), pointer :: m(:)
    type(c_ptr) :: data
    integer(c_int64_t) :: nodes
    integer(c_int32_t) :: status

    nullify (m)
    status = cdfp_simulation_masses(this%handle%address, data, nodes)
    if (status == CDFP_OK) call c_f_pointer(data, m, [nodes])
    call report(status, stat, errmsg)
  end function

  !> Cauchy stress, mean over each element, into `stress` (6, elements): xx yy zz xy yz zx, Pa.
  subroutine get_stresses(this, stress, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    real(c_double), contiguous, intent(inout) :: stress(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (size(stress, 1) /= 6) then
      call refuse('get_stresses: stress must be of shape (6, elements)', stat, errmsg)
      return
    end if
    call report(cdfp_simulation_get_stresses(this%handle%address, size(stress, 2, c_int64_t), stress), stat, &
                errmsg)
  end subroutine

  function vectors(ask, this, stat, errmsg) result(view)
    procedure(ask_nodes) :: ask
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), pointer :: view(:, :)
    type(c_ptr) :: data
    integer(c_int64_t) :: nodes
    integer(c_int32_t) :: status

    nullify (view)
    status = ask(this%handle%address, data, nodes)
    if (status == CDFP_OK) call c_f_pointer(data, view, [3_c_int64_t, nodes])
    call report(status, stat, errmsg)
  end function

  function body_count(this, stat, errmsg) result(bodies)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: bodies
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_simulation_body_count(this%handle%address, count), stat, errmsg)
    bodies = int(count)
  end function

  !> Rigid bodies in the order of `add_rigid_body`.
  function body(this, number, stat, errmsg) result(state)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(in) :: number
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_body_state) :: state

    call report(cdfp_simulation_body(this%handle%address, int(number, c_int64_t) - 1, state), stat, errmsg)
  end function

  function cohesive_count(this, stat, errmsg) result(inserted)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: inserted, broken

    inserted = 0
    call report(cdfp_simulation_cohesive_count(this%handle%address, inserted, broken), stat, errmsg)
  end function

  function broken_count(this, stat, errmsg) result(broken)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: inserted, broken

    broken = 0
    call report(cdfp_simulation_cohesive_count(this%handle%address, inserted, broken), stat, errmsg)
  end function

  !> A number of each element, in `values` of their count: 'von_mises' or 'max_principal' (Pa), or with users'
  !> materials a state by its name, 'stress_xx' and the like, 'deleted'. NaN where an element has none.
  subroutine element_field(this, name, values, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    character(len=*), intent(in) :: name
    real(c_double), contiguous, intent(inout) :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_simulation_element_field(this%handle%address, c_text(name), size(values, kind=c_int64_t), &
                                              values), stat, errmsg)
  end subroutine

  function energies(this, stat, errmsg) result(now)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_energies) :: now

    call report(cdfp_simulation_energies(this%handle%address, now), stat, errmsg)
  end function

  function summary(this, stat, errmsg) result(now)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(cdfp_summary) :: now
    integer(c_int32_t) :: status

    status = cdfp_simulation_summary(this%handle%address, now)
    if (status == CDFP_OK) now%dt_element = now%dt_element + 1
    call report(status, stat, errmsg)
  end function

  !> Of a part that may crack: `time` is NaN and `layer` 0 while it has not; `position` is the centre of the
  !> facet in the undeformed mesh.
  subroutine first_crack(this, part, time, layer, position, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    character(len=*), intent(in) :: part
    real(c_double), intent(out) :: time
    integer, intent(out) :: layer
    real(c_double), intent(out) :: position(3)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: number

    number = -1
    call report(cdfp_simulation_first_crack(this%handle%address, c_text(part), time, number, position), &
                stat, errmsg)
    layer = int(number) + 1
  end subroutine

  !> Pairs of parts that have touched, in the order in which they first did.
  function contact_pair_count(this, stat, errmsg) result(pairs)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: pairs
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_simulation_contact_pair_count(this%handle%address, count), stat, errmsg)
    pairs = int(count)
  end function

  !> Names of the two parts (the same twice for one that touched itself), force and energies between them.
  subroutine get_contact_pair(this, number, first, second, values, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(in) :: number
    character(len=:), allocatable, intent(out) :: first, second
    type(cdfp_contact_pair), intent(out) :: values
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char) :: buffer(1024)
    integer(c_int64_t) :: pair, length(2)
    integer(c_int32_t) :: status

    pair = int(number, c_int64_t) - 1
    length = 0
    first = ''
    second = ''
    status = cdfp_simulation_contact_pair(this%handle%address, pair, values)
    if (status == CDFP_OK) status = cdfp_simulation_contact_pair_part(this%handle%address, pair, 0_c_int32_t, &
                                    buffer, size(buffer, kind=c_int64_t), length(1))
    if (status == CDFP_OK) first = fortran_text(buffer, length(1))
    if (status == CDFP_OK) status = cdfp_simulation_contact_pair_part(this%handle%address, pair, 1_c_int32_t, &
                                    buffer, size(buffer, kind=c_int64_t), length(2))
    if (status == CDFP_OK) second = fortran_text(buffer, length(2))
    call report(status, stat, errmsg)
  end subroutine

  !> Stages of the step, such as "traction".
  function stage_count(this, stat, errmsg) result(stages)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: stages
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_simulation_stage_count(this%handle%address, count), stat, errmsg)
    stages = int(count)
  end function

  !> Wall time (s) and calls so far.
  subroutine get_stage(this, number, name, seconds, calls, stat, errmsg)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(in) :: number
    character(len=:), allocatable, intent(out) :: name
    real(c_double), intent(out) :: seconds
    integer(c_int64_t), intent(out) :: calls
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char) :: buffer(256)
    integer(c_int64_t) :: length

    length = 0
    seconds = 0
    calls = 0
    call report(cdfp_simulation_stage(this%handle%address, int(number, c_int64_t) - 1, seconds, calls, buffer, &
                                      size(buffer, kind=c_int64_t), length), stat, errmsg)
    name = fortran_text(buffer, length)
  end subroutine

  function warning_count(this, stat, errmsg) result(warnings)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer :: warnings
    integer(c_int64_t) :: count

    count = 0
    call report(cdfp_simulation_warning_count(this%handle%address, count), stat, errmsg)
    warnings = int(count)
  end function

  function warning(this, number, stat, errmsg) result(text)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(in) :: number
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(len=:), allocatable :: text
    character(kind=c_char) :: buffer(4096)
    integer(c_int64_t) :: length

    length = 0
    call report(cdfp_simulation_warning(this%handle%address, int(number, c_int64_t) - 1, buffer, &
                                        size(buffer, kind=c_int64_t), length), stat, errmsg)
    text = fortran_text(buffer, length)
  end function

  !> (columns, rows).
  function history(this, stat, errmsg) result(values)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: data
    integer(c_int64_t) :: rows, columns
    integer(c_int32_t) :: status

    nullify (values)
    status = cdfp_simulation_history(this%handle%address, data, rows, columns)
    if (status == CDFP_OK) call c_f_pointer(data, values, [columns, rows])
    call report(status, stat, errmsg)
  end function

  !> Name with its unit, such as "time_s".
  function history_column(this, column, stat, errmsg) result(name)
    class(cdfp_simulation), intent(in) :: this
    integer, intent(in) :: column
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(len=:), allocatable :: name
    character(kind=c_char) :: buffer(1024)
    integer(c_int64_t) :: length

    length = 0
    call report(cdfp_simulation_history_column(this%handle%address, int(column, c_int64_t) - 1, buffer, &
                                               size(buffer, kind=c_int64_t), length), stat, errmsg)
    name = fortran_text(buffer, length)
  end function

  !> Makes the folder and removes from it what an earlier run left.
  subroutine create_recorder(this, simulation, folder, stat, errmsg)
    class(cdfp_recorder), intent(inout) :: this
    type(cdfp_simulation), intent(in) :: simulation
    character(len=*), intent(in) :: folder
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_recorder_create(simulation%handle%address, c_text(folder), made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  !> For a simulation that was restored: keeps what the run up to then has left in the folder.
  subroutine continue_in(this, simulation, folder, stat, errmsg)
    class(cdfp_recorder), intent(inout) :: this
    type(cdfp_simulation), intent(in) :: simulation
    character(len=*), intent(in) :: folder
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: made
    integer(c_int32_t) :: status

    made = c_null_ptr
    status = cdfp_recorder_continue(simulation%handle%address, c_text(folder), made)
    call this%handle%own(made)
    call report(status, stat, errmsg)
  end subroutine

  subroutine free_recorder(this)
    class(cdfp_recorder), intent(inout) :: this

    call this%handle%free()
  end subroutine

  !> The state now as a snapshot for ParaView, and the history so far.
  subroutine snapshot(this, simulation, stat, errmsg)
    class(cdfp_recorder), intent(in) :: this
    type(cdfp_simulation), intent(in) :: simulation
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_recorder_snapshot(this%handle%address, simulation%handle%address), stat, errmsg)
  end subroutine

  !> history.csv, results.h5, summary.json and the pictures.
  subroutine finish(this, simulation, stat, errmsg)
    class(cdfp_recorder), intent(in) :: this
    type(cdfp_simulation), intent(in) :: simulation
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call report(cdfp_recorder_finish(this%handle%address, simulation%handle%address), stat, errmsg)
  end subroutine

  subroutine assign_simulation(this, other)
    type(cdfp_simulation), intent(inout) :: this
    type(cdfp_simulation), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

  subroutine assign_recorder(this, other)
    type(cdfp_recorder), intent(inout) :: this
    type(cdfp_recorder), intent(in) :: other

    call this%handle%share(other%handle)
  end subroutine

end module cdfp_simulations
