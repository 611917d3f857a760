!> The cracks of the plate's lower face as an SVG picture.
module crack_picture
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32
  use cdfp
  implicit none
  private
  public :: draw_cracks

contains

  !> Edges of cohesive elements on the face z = 0, the darker the more damaged. `x0`: undeformed, m.
  subroutine draw_cracks(file, topology, cohesive, x0)
    character(len=*), intent(in) :: file
    type(cdfp_topology), intent(in) :: topology
    type(cdfp_cohesive), intent(in) :: cohesive
    real(dp), intent(in) :: x0(:, :)
    type(cdfp_cohesive_pair), allocatable :: pairs(:)
    integer(int32), allocatable :: nodes(:)
    integer(int32) :: e
    integer :: unit, a, b, n

    open (newunit=unit, file=file, action='write', status='replace')
    write (unit, '(a)') '<svg xmlns="http://www.w3.org/2000/svg" width="400" height="400" viewBox="0 0 400 400">', &
      '<rect width="400" height="400" fill="#f4f8fa"/><g stroke="#222" stroke-width="1.6" stroke-linecap="round">'
    do e = int(topology%bulk_count(), int32) + 1_int32, int(topology%element_count(), int32)
      call topology%get_nodes(e, nodes)
      call cohesive%get_pairs(e, pairs)
      n = size(pairs)
      do a = 1, n
        b = mod(a, n) + 1
        if (any(abs(x0(3, nodes([a, b]))) > 1e-9_dp)) cycle
        if (pairs(a)%damage + pairs(b)%damage < 0.02_dp) cycle
        write (unit, '(4(a, f0.1), a, f0.2, a)') '<line x1="', px(1, a), '" y1="', px(2, a), '" x2="', px(1, b), &
          '" y2="', px(2, b), '" opacity="', 0.5_dp*(pairs(a)%damage + pairs(b)%damage), '"/>'
      end do
    end do
    write (unit, '(a)') '</g></svg>'
    close (unit)

  contains

    real(dp) function px(direction, corner)
      integer, intent(in) :: direction, corner

      px = 400*x0(direction, nodes(corner))/20e-3_dp
    end function

  end subroutine

end module crack_picture
