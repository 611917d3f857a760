!> Impact on a laminated glass plate from a Fortran program: the case of case_quick.toml, to the same bits.
!>
!>     laminated_glass_fortran [columns] [end time in s] [folder]
!>
!> Besides the usual results the folder gets final_state.bin: positions, velocities and forces, (3, nodes)
!> each.
program laminated_glass
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32, int64
  use cdfp
  implicit none

  real(dp), parameter :: snapshot_times(3) = [20e-6_dp, 33e-6_dp, 80e-6_dp]

  ! the program's own model of the plate
  real(dp), allocatable :: coordinates(:, :)
  integer(int32), allocatable :: hexahedra(:, :), parts(:), layers(:), support_bottom(:)
  integer(int32), allocatable :: lower_faces(:, :), upper_faces(:, :), support_top(:, :), head(:, :)

  type(cdfp_model) :: model
  type(cdfp_simulation) :: simulation
  type(cdfp_recorder) :: recorder
  real(dp), pointer :: x(:, :), v(:, :), f(:, :)
  type(cdfp_body_state) :: impactor
  type(cdfp_energies) :: energy
  real(dp) :: end_time
  character(len=1024) :: folder
  integer :: columns, i, unit

  columns = 25
  end_time = 80e-6_dp
  folder = 'out/laminated_glass_fortran'
  call read_arguments()

  call make_plate()
  call define_model()
  call simulation%create(model)
  call recorder%create(simulation, folder)

  print '(a)', '   time us  force N  impactor m/s  balance  inserted   broken'
  do i = 1, size(snapshot_times)
    if (snapshot_times(i) > end_time) exit
    call simulation%advance_to(snapshot_times(i))
    call recorder%snapshot(simulation)
    call show()
  end do
  if (.not. simulation%finished()) then
    call simulation%advance_to(end_time)
    call show()
  end if
  call recorder%finish(simulation)

  x => simulation%positions()
  v => simulation%velocities()
  f => simulation%forces()
  print '(a, es12.4, a)', 'lowest point of the plate ', minval(x(3, :size(coordinates, 2))), ' m'
  print '(a, es12.4, a)', 'largest nodal force       ', sqrt(maxval(sum(f**2, dim=1))), ' N'
  open (newunit=unit, file=trim(folder)//'/final_state.bin', access='stream', form='unformatted', &
        status='replace')
  write (unit) x, v, f
  close (unit)

contains

  subroutine read_arguments()
    character(len=1024) :: text

    if (command_argument_count() >= 1) then
      call get_command_argument(1, text)
      read (text, *) columns
    end if
    if (command_argument_count() >= 2) then
      call get_command_argument(2, text)
      read (text, *) end_time
    end if
    if (command_argument_count() >= 3) call get_command_argument(3, folder)
  end subroutine

  !> The arrays may as well come from the program's own mesh generator.
  subroutine make_plate()
    type(cdfp_laminated_plate) :: plate
    type(cdfp_mesh) :: mesh

    call default_laminated_plate(plate)
    plate%columns = int(columns, int32)
    plate%layout = CDFP_REGULAR
    call mesh%create_laminated_plate(plate)
    call mesh%get_coordinates(coordinates)
    call mesh%get_hexahedra(hexahedra)
    call mesh%get_parts(parts)
    call mesh%get_layers(layers)
    call mesh%get_node_set('support_bottom', support_bottom)
    call mesh%get_facet_set('lower_glass_faces', lower_faces)
    call mesh%get_facet_set('upper_glass_faces', upper_faces)
    call mesh%get_facet_set('support_top', support_top)
    call mesh%get_facet_set('impactor_head', head)
  end subroutine

  subroutine define_model()
    call model%create()
    call model%set_title('Impact on a laminated glass plate, coarse and short')

    call model%set_mesh(coordinates, hexahedra, parts, layers)
    call model%add_node_set('support_bottom', support_bottom)
    call model%add_facet_set('lower_glass_faces', lower_faces)
    call model%add_facet_set('upper_glass_faces', upper_faces)
    call model%add_facet_set('support_top', support_top)
    call model%add_facet_set('impactor_head', head)

    call model%add_elastic_material('glass', density=2500.0_dp, youngs_modulus=74e9_dp, &
                                    poissons_ratio=0.20_dp)
    call model%add_rate_dependent_material('pvb', density=1000.0_dp, poissons_ratio=0.49_dp, &
                                           static_modulus=5.88e6_dp, rate_modulus=29.21e6_dp, &
                                           rate_exponent=0.176_dp, smoothing_time=1e-6_dp)
    call model%add_elastic_material('rubber', density=1200.0_dp, youngs_modulus=0.042e9_dp, &
                                    poissons_ratio=0.49_dp)
    call model%add_rigid_material('steel', density=7850.0_dp, youngs_modulus=210e9_dp, poissons_ratio=0.27_dp)
    call model%add_cohesive_law('glass', strength=60e6_dp, fracture_energy=10.0_dp, mode_ratio=5.0_dp, &
                                shear_ratio=1.0_dp, friction=0.1_dp, internal_friction=4.1_dp)

    call model%add_part('lower_glass', 'glass', formulation=CDFP_FULL, cohesive_law='glass')
    call model%add_part('pvb', 'pvb', formulation=CDFP_FULL)
    call model%add_part('upper_glass', 'glass', formulation=CDFP_FULL, cohesive_law='glass')
    call model%add_part('support', 'rubber', formulation=CDFP_FULL)
    call model%add_part('impactor', 'steel')

    call model%add_rigid_body('impactor', mass=8.875e-3_dp, velocity=[0.0_dp, 0.0_dp, -6.78_dp], &
                              translation_fixed=[.true., .true., .false.], &
                              rotation_fixed=[.true., .true., .true.])
    call model%add_symmetry_plane(axis=1, coordinate=0.0_dp)
    call model%add_symmetry_plane(axis=2, coordinate=0.0_dp)
    call model%add_prescribed_velocity('support_bottom', [.true., .true., .true.], values=[0.0_dp])

    call model%add_contact_surface('lower_glass_faces')
    call model%add_contact_surface('upper_glass_faces')
    call model%add_contact_surface('support_top')
    call model%add_contact_surface('impactor_head')
    call model%set_contact(cell_factor=1.0_dp, buffer_factor=0.4_dp, friction=0.1_dp)

    call model%set_time(end=end_time, fixed_step=6e-8_dp)
  end subroutine

  subroutine show()
    impactor = simulation%body(1)
    energy = simulation%energies()
    print '(f10.3, f9.1, f14.4, f9.5, 2i9)', 1e6_dp*simulation%time(), 4*impactor%contact_force(3), &
      impactor%velocity(3), energy%balance, simulation%cohesive_count(), simulation%broken_count()
  end subroutine

end program laminated_glass
