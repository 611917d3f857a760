! What the door costs: a step whose topology, criterion, cohesive elements and contact a Fortran program calls
! piece by piece, against the native step.
!   benchmarks/run.sh door [cells along the plate's side, a multiple of 10]
!
! The scene of examples/fortran_driver. Both do the same work on the same state: in every step the Fortran code
! gets the positions, velocities, element forces and stresses of the native simulation. Its step is counted
! with the native elements and motion (they are the program's own business) and with the services as Fortran
! calls them, growth of its arrays and division of masses included. One thread; medians over the steps.
module door_support
  use, intrinsic :: iso_c_binding
  use cdfp
  implicit none
  real(c_double), allocatable :: element_forces(:, :)
contains
  subroutine capture(load, user_data) bind(c)
    type(cdfp_nodal_load), intent(in) :: load
    type(c_ptr), value :: user_data
    real(c_double), pointer :: f(:, :)

    if (c_associated(user_data)) return
    call c_f_pointer(load%force, f, [3_c_int64_t, load%nodes])
    element_forces = f
  end subroutine
end module

program door
  use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32, int64
  use cdfp
  use door_support
  use plate_code
  use plate_scene
  implicit none

  integer, parameter :: repetitions = 3
  real(dp), parameter :: end_time = 12e-6_dp, most = 1.05_dp
  character(len=32) :: text
  real(dp) :: ratios(repetitions)
  integer :: cells, i

  cells = 20
  if (command_argument_count() >= 1) then
    call get_command_argument(1, text)
    read (text, *) cells
  end if
  print '(a)', '  native step us  of it services us  services by Fortran us  step by Fortran / native'
  do i = 1, repetitions
    call measure(ratios(i))
  end do
  if (median(ratios) <= most) then
    print '(a)', 'door: pass'
  else
    print '(a, f5.3, a)', 'door: short: the step by Fortran takes ', median(ratios), ' of the native one'
  end if

contains

  subroutine measure(ratio)
    real(dp), intent(out) :: ratio
    type(scene) :: s
    type(code) :: own
    type(cdfp_simulation) :: native
    real(dp), pointer :: x(:, :), v(:, :), f(:, :)
    real(dp), allocatable :: stress(:, :), native_step(:), native_services(:), services(:)
    real(dp) :: before(2), after(2), t(2)
    integer :: steps, k

    call make_scene(cells, s)
    call own%set_up(s)
    own%step = 0.6_dp*own%stable_step()
    steps = nint(end_time/own%step)
    allocate (native_step(steps), native_services(steps), services(steps), stress(6, size(s%parts)))
    call define(native, s, own%step)
    call native%get_stresses(own%stress)
    own%f(:, :own%n) = element_forces
    call own%open_facets()
    call own%contact_force(0.5_dp*own%step)
    call own%cohesive_force(0.5_dp*own%step)
    do k = 1, steps
      v => native%velocities()
      own%v(:, :own%n) = v
      before = times_of(native)
      t(1) = now()
      call native%step()
      t(2) = now()
      after = times_of(native)
      native_services(k) = after(1) - before(1)
      native_step(k) = t(2) - t(1) - (after(2) - before(2))

      x => native%positions()
      own%x(:, :own%n) = x(:, :own%n)
      own%time = own%time + own%step
      call native%get_stresses(own%stress)
      own%f(:, :own%n) = element_forces(:, :own%n)
      t(1) = now()
      call own%open_facets()
      t(2) = now()
      services(k) = t(2) - t(1)
      own%f(:, :own%n) = element_forces
      t(1) = now()
      call own%contact_force(own%step)
      call own%cohesive_force(own%step)
      t(2) = now()
      services(k) = services(k) + t(2) - t(1)
      f => native%forces()
      if (maxval(abs(own%f(:, :own%n) - f)) > 1e-12_dp*maxval(abs(f))) error stop 'the two do not do the same'
    end do
    ratio = median((native_step - native_services + services)/native_step)
    print '(f14.1, f18.1, f22.1, f24.3)', 1e6_dp*median(native_step), 1e6_dp*median(native_services), &
      1e6_dp*median(services), ratio
  end subroutine

  !> Seconds so far in the stages that services stand for, and in the capture.
  function times_of(native) result(sums)
    type(cdfp_simulation), intent(in) :: native
    real(dp) :: sums(2), seconds
    character(len=:), allocatable :: name
    integer(int64) :: calls
    integer :: i

    sums = 0
    do i = 1, native%stage_count()
      call native%get_stage(i, name, seconds, calls)
      select case (name)
      case ('criterion', 'insertion', 'surface', 'search_due', 'local_search', 'enforcement', 'traction')
        sums(1) = sums(1) + seconds
      case ('load', 'load_work')
        sums(2) = sums(2) + seconds
      end select
    end do
  end function

  subroutine define(native, s, step)
    type(cdfp_simulation), intent(inout) :: native
    type(scene), intent(in) :: s
    real(dp), intent(in) :: step
    type(cdfp_model) :: model
    type(c_funptr) :: callback

    call model%create()
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
    callback = c_funloc(capture)
    call model%set_load_callback(callback)
    call model%set_time(end=1.0_dp, fixed_step=step)
    call model%set_history_interval(1000000)
    call model%set_threads(1)
    call native%create(model)
  end subroutine

  real(dp) function now()
    integer(int64) :: count, rate

    call system_clock(count, rate)
    now = real(count, dp)/real(rate, dp)
  end function

  pure real(dp) function median(values)
    real(dp), intent(in) :: values(:)
    real(dp) :: sorted(size(values)), moved
    integer :: i, j

    sorted = values
    do i = 2, size(sorted)
      moved = sorted(i)
      do j = i - 1, 1, -1
        if (sorted(j) <= moved) exit
        sorted(j + 1) = sorted(j)
      end do
      sorted(j + 1) = moved
    end do
    median = sorted((size(sorted) + 1)/2)
  end function

end program door
