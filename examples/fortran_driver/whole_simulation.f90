!> The same plate by a full simulation of cdfp, with the program's own procedures called in every step: a bed of
!> springs below the plate (load), and a monitor that prints, watches the pellet and ends the run when it
!> leaves. Then the program takes the pellet out of the motion and lets the plate ring.
!>
!>     whole_simulation [cells along the plate's side, a multiple of 10] [time after the impact in s]
module plate_callbacks
  use, intrinsic :: iso_c_binding
  use cdfp
  implicit none
  private
  public :: watch, bed_of_springs, push_back

  !> What the callbacks share with the program; they get its address.
  type, public :: watch
    type(cdfp_simulation) :: simulation
    integer(c_int32_t), allocatable :: pellet_nodes(:)
    integer :: steps_between_rows = 50
    real(c_double), allocatable :: bedded(:)  !< N/m of each node of the mesh, 0 off the bed
    real(c_double), allocatable :: height(:)  !< m, undeformed
  end type

contains

  !> Forces at the nodes that the mesh had at the start; copies made by cracks are left alone.
  subroutine bed_of_springs(load, user_data) bind(c)
    type(cdfp_nodal_load), intent(in) :: load
    type(c_ptr), value :: user_data
    type(watch), pointer :: w
    real(c_double), pointer :: x(:, :), f(:, :)
    integer :: i

    call c_f_pointer(user_data, w)
    call c_f_pointer(load%position, x, [3_c_int64_t, load%nodes])
    call c_f_pointer(load%force, f, [3_c_int64_t, load%nodes])
    do i = 1, size(w%bedded)
      f(3, i) = f(3, i) + w%bedded(i)*max(0.0_c_double, w%height(i) - x(3, i))
    end do
  end subroutine

  !> Not 0, which ends the run, once the pellet goes up.
  integer(c_int32_t) function push_back(simulation, user_data) bind(c)
    type(c_ptr), value :: simulation, user_data
    type(watch), pointer :: w
    type(cdfp_energies) :: now
    real(c_double), pointer :: v(:, :)
    real(c_double) :: speed

    call c_f_pointer(user_data, w)
    push_back = 0
    if (.not. c_associated(simulation)) return
    v => w%simulation%velocities()
    speed = sum(v(3, w%pellet_nodes))/size(w%pellet_nodes)
    if (mod(w%simulation%step_count(), int(w%steps_between_rows, c_int64_t)) == 0) then
      now = w%simulation%energies()
      print '(f9.3, f12.3, f10.5, 2i9)', 1e6_c_double*w%simulation%time(), speed, now%balance, &
        w%simulation%cohesive_count(), w%simulation%broken_count()
    end if
    if (speed > 0) push_back = 1
  end function

end module plate_callbacks

program whole_simulation
  use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_loc, c_null_funptr
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32
  use cdfp
  use plate_scene
  use plate_callbacks
  implicit none

  type(scene) :: s
  type(cdfp_model) :: model
  type(watch), target :: w
  type(cdfp_energies) :: now
  type(c_funptr) :: callback
  real(dp), pointer :: now_moving(:, :)
  real(dp), allocatable :: v(:, :)
  real(dp) :: after
  character(len=1024) :: text
  integer :: cells, steps, i

  cells = 20
  after = 5e-6_dp
  if (command_argument_count() >= 1) then
    call get_command_argument(1, text)
    read (text, *) cells
  end if
  if (command_argument_count() >= 2) then
    call get_command_argument(2, text)
    read (text, *) after
  end if

  call make_scene(cells, s)
  call define_model()
  call w%simulation%create(model)
  callback = c_funloc(push_back)
  call w%simulation%set_monitor(callback, c_loc(w))
  print '(a)', '  time us  pellet m/s   balance  cracked   broken'
  call w%simulation%advance(huge(1), steps)
  print '(a, i0, a, f0.2, a)', 'the pellet turned after ', steps, ' steps, at ', 1e6_dp*w%simulation%time(), ' us'

  now_moving => w%simulation%velocities()
  v = now_moving
  v(:, w%pellet_nodes) = 0
  call w%simulation%set_velocities(v)
  call w%simulation%set_monitor(c_null_funptr)
  call w%simulation%advance_to(w%simulation%time() + after)
  now = w%simulation%energies()
  print '(a, f0.2, a, f0.5, a, i0, a)', 'without it at ', 1e6_dp*w%simulation%time(), ' us: balance ', now%balance, &
    ', ', w%simulation%broken_count(), ' facets broken'

contains

  subroutine define_model()
    integer(int32), allocatable :: in_pellet(:)

    call model%create()
    call model%set_title('A glass plate hit by a pellet')
    call model%set_mixed_mesh(s%x, spread(CDFP_TETRAHEDRON, 1, size(s%parts)), reshape(s%tets, [size(s%tets)]), &
                              s%parts)
    call model%add_elastic_material('glass', material(plate)%density, material(plate)%youngs_modulus, &
                                    material(plate)%poissons_ratio)
    call model%add_elastic_material('steel', material(pellet)%density, material(pellet)%youngs_modulus, &
                                    material(pellet)%poissons_ratio)
    call model%add_cohesive_law('glass', strength, fracture_energy, mode_ratio=mode_ratio, friction=friction)
    call model%add_part('plate', 'glass', cohesive_law='glass')
    call model%add_part('pellet', 'steel')
    call model%add_node_set('clamped', s%clamped)
    call model%add_prescribed_velocity('clamped', [.true., .true., .true.], values=[0.0_dp])
    call model%add_initial_velocity('pellet', [0.0_dp, 0.0_dp, -pellet_speed])
    call model%add_facet_set('faces', s%faces)
    call model%add_contact_surface('faces')
    call model%set_contact(friction=friction)
    call model%set_time(end=1e-3_dp, step_factor=0.6_dp)

    in_pellet = pack(reshape(s%tets, [size(s%tets)]), reshape(spread(s%parts == pellet, 1, 4), [size(s%tets)]))
    w%pellet_nodes = pack([(int(i, int32), i=1, size(s%x, 2))], &
                          [(i >= minval(in_pellet), i=1, size(s%x, 2))])
    w%height = s%x(3, :)
    w%bedded = merge(1e12_dp*(20e-3_dp/cells)**2*1e-1_dp, 0.0_dp, abs(s%x(3, :)) < 1e-9_dp)
    callback = c_funloc(bed_of_springs)
    call model%set_load_callback(callback, c_loc(w))
  end subroutine

end program whole_simulation
