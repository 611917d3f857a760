!> A bulk material in Fortran, a VUMAT and a law in C, each through the module `cdfp`: a cube in uniaxial strain
!> against the closed form of the neo-Hookean solid.
!>
!>     fortran_law_test EXAMPLES VUMATS FOLDER
module laws
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: dp => real64
  use cdfp
  implicit none

contains

  !> s = (mu (U^2 - 1) + lambda ln J) / J. properties: lambda, mu; states: J, number of calls
  subroutine neo_hookean(points, user_data) bind(c)
    type(cdfp_material_points), intent(in) :: points
    type(c_ptr), value :: user_data
    type(cdfp_material_block) :: b
    real(dp), pointer :: limit
    real(dp) :: u(3, 3), square(3, 3), j
    integer :: i

    call b%show(points)
    call c_f_pointer(user_data, limit)
    do i = 1, b%count
      u(:, 1) = [b%stretch(i, 1), b%stretch(i, 4), b%stretch(i, 6)]
      u(:, 2) = [b%stretch(i, 4), b%stretch(i, 2), b%stretch(i, 5)]
      u(:, 3) = [b%stretch(i, 6), b%stretch(i, 5), b%stretch(i, 3)]
      square = matmul(u, u)
      j = u(1, 1)*(u(2, 2)*u(3, 3) - u(2, 3)*u(3, 2)) - u(1, 2)*(u(2, 1)*u(3, 3) - u(2, 3)*u(3, 1)) &
        + u(1, 3)*(u(2, 1)*u(3, 2) - u(2, 2)*u(3, 1))
      if (j > limit) then
        call b%fail(i, 'the solid is torn')
        return
      end if
      b%stress(i, 1:3) = (b%properties(2)*([square(1, 1), square(2, 2), square(3, 3)] - 1) &
                          + b%properties(1)*log(j))/j
      b%stress(i, 4:6) = b%properties(2)*[square(1, 2), square(2, 3), square(3, 1)]/j
      b%state(i, 1) = j
      b%state(i, 2) = b%state_old(i, 2) + 1
    end do
  end subroutine

end module laws

program fortran_law_test
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32, error_unit
  use cdfp
  use laws
  implicit none

  real(dp), parameter :: coordinates(3, 8) = reshape([real(dp) :: &
    0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], [3, 8])
  real(dp), parameter :: lambda = 3e6_dp, mu = 1e6_dp, speed = 2, density = 1000
  integer :: failures = 0, stat
  character(len=300) :: message
  character(len=500) :: examples, vumats, folder

  call get_command_argument(1, examples)
  call get_command_argument(2, vumats)
  call get_command_argument(3, folder)
  call execute_command_line('mkdir -p "'//trim(folder)//'"')
  call own_law()
  call outside_laws()
  if (failures > 0) error stop 'fortran_law_test failed'

contains

  subroutine check(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what

    if (holds) return
    failures = failures + 1
    write (error_unit, '(2a)') 'failed: ', what
  end subroutine

  !> A unit cube that is drawn out in x; its material is to be added as 'rubber'.
  subroutine cube(model)
    type(cdfp_model), intent(inout) :: model

    call model%create()
    call model%set_mesh(coordinates, reshape([integer(int32) :: 1, 2, 3, 4, 5, 6, 7, 8], [8, 1]), [1_int32])
    call model%add_part('cube', 'rubber', formulation=CDFP_FULL)
    call model%add_node_set('low', [1_int32, 4_int32, 5_int32, 8_int32])
    call model%add_node_set('high', [2_int32, 3_int32, 6_int32, 7_int32])
    call model%add_prescribed_velocity('low', [.true., .true., .true.], [0.0_dp])
    call model%add_prescribed_velocity('high', [.true., .false., .false.], [speed])
    call model%add_prescribed_velocity('high', [.false., .true., .true.], [0.0_dp])
    call model%set_time(end=0.1_dp, fixed_step=1e-4_dp)
    call model%set_threads(1)
  end subroutine

  pure real(dp) function axial(stretch)
    real(dp), intent(in) :: stretch

    axial = (mu*(stretch**2 - 1) + lambda*log(stretch))/stretch
  end function

  subroutine check_stress(simulation, what)
    type(cdfp_simulation), intent(in) :: simulation
    character(len=*), intent(in) :: what
    real(dp) :: stress(1), stretch

    stretch = 1 + speed*simulation%time()
    call simulation%element_field('stress_xx', stress)
    call check(abs(stress(1) - axial(stretch)) < 1e-9_dp*mu, what)
  end subroutine

  subroutine own_law()
    type(cdfp_model) :: model
    type(cdfp_simulation) :: simulation
    real(dp), target :: limit
    real(dp) :: field(1)
    type(c_funptr) :: law
    integer :: done

    law = c_funloc(neo_hookean)
    limit = 1.15_dp
    call cube(model)
    call model%add_user_material('rubber', density, law, states=2, properties=[lambda, mu], &
                                 user_data=c_loc(limit))
    call model%set_state_name('rubber', 2, 'calls')
    call simulation%create(model)
    call simulation%advance(500)
    call check_stress(simulation, 'stress of a law in Fortran')
    call simulation%element_field('calls', field)
    call check(nint(field(1)) == 501, 'one call at the start and one a step')
    call simulation%element_field('state_1', field)
    call check(abs(field(1) - (1 + speed*simulation%time())) < 1e-12_dp, 'the state is J')
    call simulation%advance(1000, done, stat, message)
    call check(stat == CDFP_DIVERGED, 'a law that gives up ends the step')
    call check(index(message, "material 'rubber', element 1 (part 'cube'), point 1") > 0 .and. &
               index(message, 'the solid is torn') > 0, trim(message))
    call check(abs(simulation%time() - 0.075_dp) < 2e-4_dp, 'time stands where the law gave up')
    call simulation%element_field('strain', field, stat, message)
    call check(stat == CDFP_BAD_ARGUMENT .and. index(message, "there are 'von_mises'") > 0 .and. &
               index(message, "'calls'") > 0, trim(message))
    call model%set_state_name('rubber', 3, 'more', stat, message)
    call check(stat == CDFP_BAD_ARGUMENT, 'a state that is not there has no name')
    call model%set_state_name('iron', 1, 'x', stat, message)
    call check(stat == CDFP_BAD_ARGUMENT .and. index(message, "no user's material 'iron'") > 0, trim(message))
  end subroutine

  subroutine outside_laws()
    type(cdfp_model) :: model
    type(cdfp_simulation) :: simulation
    real(dp) :: field(1)

    call build_material(trim(vumats)//'/neo_hookean.f90', trim(folder)//'/vumat.so')
    call cube(model)
    call model%add_vumat_material('rubber', density, trim(folder)//'/vumat.so', states=1, &
                                  properties=[lambda, mu], temperature=300.0_dp, fields=[1.0_dp, 2.0_dp])
    call simulation%create(model)
    call simulation%advance(500)
    call check_stress(simulation, 'stress of a VUMAT')

    call build_material(trim(examples)//'/neo_hookean.c', trim(folder)//'/law.so')
    call cube(model)
    call model%add_library_material('rubber', density, trim(folder)//'/law.so', 'neo_hookean', states=1, &
                                    properties=[mu, lambda/(2*(lambda + mu))], thread_safe=.true.)
    call simulation%create(model)
    call simulation%advance(500)
    call check_stress(simulation, 'stress of a law in C')
    call simulation%element_field('state_1', field)
    call check(field(1) > 0, 'its energy')

    call model%add_library_material('other', density, trim(folder)//'/law.so', 'old_hookean', stat=stat, &
                                    errmsg=message)
    call check(stat == CDFP_IO .and. index(message, "no function 'old_hookean'") > 0, trim(message))
    call build_material(trim(examples)//'/case.toml', trim(folder)//'/x.so', stat=stat, errmsg=message)
    call check(stat == CDFP_BAD_ARGUMENT .and. index(message, 'tells no language') > 0, trim(message))
  end subroutine

end program fortran_law_test
