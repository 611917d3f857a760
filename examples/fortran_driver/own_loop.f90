!> A program's own explicit code that takes topology, cohesive elements and contact from cdfp piece by piece.
!>
!>     own_loop [cells along the plate's side, a multiple of 10] [end time in s] [picture of the cracks, .svg]
program own_loop
  use, intrinsic :: iso_fortran_env, only: dp => real64, int64
  use cdfp
  use plate_scene
  use plate_code
  use crack_picture
  implicit none

  type(scene) :: s
  type(code) :: c
  real(dp) :: end_time, initial
  character(len=1024) :: text
  integer :: cells, steps, i

  cells = 20
  end_time = 20e-6_dp
  if (command_argument_count() >= 1) then
    call get_command_argument(1, text)
    read (text, *) cells
  end if
  if (command_argument_count() >= 2) then
    call get_command_argument(2, text)
    read (text, *) end_time
  end if

  call make_scene(cells, s)
  call c%set_up(s)
  c%step = 0.6_dp*c%stable_step()
  steps = nint(end_time/c%step)
  print '(i0, a, i0, a, f0.2, a)', size(s%parts), ' tetrahedra, ', steps, ' steps of ', 1e9_dp*c%step, ' ns'
  print '(a)', '  time us  kinetic J  strain J  cohesive J  contact J   balance  cracked   broken  touching'

  call c%forces(0.5_dp*c%step)
  call c%accelerate(0.5_dp*c%step)
  initial = c%kinetic + c%strain
  do i = 1, steps
    call c%drift()
    call c%forces(c%step)
    call c%accelerate(c%step)
    if (mod(i, max(1, steps/10)) == 0) call show()
  end do

  if (command_argument_count() >= 3) then
    call get_command_argument(3, text)
    call draw_cracks(trim(text), c%topology, c%cohesive, c%x0(:, :c%n))
    print '(2a)', 'cracks of the lower face in ', trim(text)
  end if

contains

  subroutine show()
    real(dp) :: stored, dissipated, rubbed, by_law, springs, heat, deepest, all
    integer(int64) :: touching

    call c%cohesive%get_energies(stored, dissipated, rubbed, by_law)
    call c%contact%get_energies(springs, heat, deepest)
    call c%contact%get_counts(touching=touching)
    all = c%kinetic + c%strain + stored + dissipated + rubbed + springs + heat
    print '(f9.3, f11.6, f10.6, f12.6, f11.6, f10.6, 3i9)', 1e6_dp*c%time, c%kinetic, c%strain, &
      stored + dissipated + rubbed, springs + heat, all/initial, c%cohesive%element_count(), &
      c%cohesive%broken_count(), touching
    if (c%contact%warning_count() > 0) print '(a)', c%contact%warning(1)
  end subroutine

end program own_loop
