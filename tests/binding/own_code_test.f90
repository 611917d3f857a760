!> The services piece by piece against the native simulation. At the positions and velocities of a full
!> simulation the own code of examples/fortran_driver computes the forces of every step: of its elements, and
!> by the services contact and cohesive forces. All are the same to 1e-12 of the largest force of the run.
!>
!> The services start from the native element forces, which a load callback sees, and stresses: where several
!> facets open at one node in a step the tractions have more than one solution, and rounding would decide
!> between them.
module captured
  use, intrinsic :: iso_c_binding
  use cdfp
  implicit none
  public

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

end module captured

program own_code_test
  use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32
  use captured
  use cdfp
  use plate_scene
  use plate_code
  implicit none

  integer, parameter :: steps = 200
  type(scene) :: s
  type(code) :: own
  type(cdfp_model) :: model
  type(cdfp_simulation) :: native
  type(cdfp_energies) :: energy
  type(c_funptr) :: callback
  real(dp), pointer :: x(:, :), v(:, :), f(:, :), m(:)
  real(dp) :: largest = 0, of_elements = 0, of_services = 0
  real(dp) :: stored, dissipated, rubbed, by_law, springs, heat, deepest
  real(dp) :: of_stress = 0
  real(dp), allocatable :: stress(:, :)
  integer :: i

  call make_scene(10, s)
  call own%set_up(s)
  own%step = 0.6_dp*own%stable_step()
  own%threads = 2
  call define_model()
  call native%create(model)
  allocate (stress(6, size(s%parts)))

  call compute_and_compare(0.5_dp*own%step)
  do i = 1, steps
    v => native%velocities()
    own%v(:, :own%n) = v
    call native%step()
    x => native%positions()
    own%x(:, :own%n) = x(:, :own%n)
    own%time = own%time + own%step
    call compute_and_compare(own%step)
  end do

  print '(4(a, es8.1), 2(a, i0), a)', 'forces up to ', largest, ' N; of elements differ by ', of_elements, &
    ', of services by ', of_services, '; stresses by ', of_stress, ' of the largest; ', &
    own%cohesive%element_count(), ' facets opened, ', own%cohesive%broken_count(), ' broke'
  call check(of_stress <= 1e-11_dp, 'stresses')
  call check(of_elements <= 1e-12_dp*largest, 'forces of elements')
  call check(of_services <= 1e-12_dp*largest, 'forces of contact and cohesive elements')
  call check(own%cohesive%element_count() > 200, 'the plate cracks')
  call check(own%cohesive%broken_count() > 20, 'facets break')
  call check(native%cohesive_count() == own%cohesive%element_count(), 'the same facets open')
  call check(native%broken_count() == own%cohesive%broken_count(), 'the same facets break')
  energy = native%energies()
  call own%cohesive%get_energies(stored, dissipated, rubbed, by_law)
  call own%contact%get_energies(springs, heat, deepest)
  call check(springs > 0 .and. heat > 0 .and. rubbed > 0, 'bodies touch and rub')
  call check(close(dissipated, energy%cohesive_dissipated), 'dissipated energy')
  call check(close(rubbed, energy%cohesive_friction), 'friction of closed faces')
  call check(close(stored, energy%cohesive_stored), 'cohesive energy')
  call check(close(springs, energy%contact_stored), 'contact energy')
  call check(close(heat, energy%contact_friction), 'contact friction')

contains

  subroutine check(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what

    if (.not. holds) error stop what
  end subroutine

  pure logical function close(a, b)
    real(dp), intent(in) :: a, b

    close = abs(a - b) <= 1e-12_dp*max(abs(a), abs(b))
  end function

  subroutine compute_and_compare(kick)
    real(dp), intent(in) :: kick

    f => native%forces()
    m => native%masses()
    largest = max(largest, maxval(abs(f)), maxval(abs(element_forces)))
    call own%internal_force()
    call native%get_stresses(stress)
    of_stress = max(of_stress, maxval(abs(own%stress - stress))/max(maxval(abs(stress)), strength))
    own%stress = stress
    call own%open_facets()
    call check(size(f, 2) == own%n, 'the same nodes')
    call check(all(abs(own%mass(:own%n) - m) <= 1e-15_dp*m), 'masses')
    of_elements = max(of_elements, maxval(abs(own%f(:, :own%n) - element_forces)))

    own%f(:, :own%n) = element_forces
    call own%contact_force(kick)
    call own%cohesive_force(kick)
    of_services = max(of_services, maxval(abs(own%f(:, :own%n) - f)))
  end subroutine

  subroutine define_model()
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
    call model%set_time(end=1.0_dp, fixed_step=own%step)
    call model%set_threads(2)
  end subroutine

end program own_code_test
