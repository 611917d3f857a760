!> What both programs of this folder simulate: a clamped glass plate hit by an elastic steel pellet, in
!> tetrahedra. Plain arrays, as a research code has them; lengths in m, z upwards.
module plate_scene
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32
  implicit none
  private

  integer(int32), parameter, public :: plate = 1, pellet = 2

  type, public :: elastic
    real(dp) :: density, youngs_modulus, poissons_ratio
  end type
  type(elastic), parameter, public :: material(2) = [ &
    elastic(2500.0_dp, 74e9_dp, 0.20_dp), elastic(7850.0_dp, 210e9_dp, 0.27_dp)]

  real(dp), parameter, public :: strength = 60e6_dp, fracture_energy = 10.0_dp, mode_ratio = 5.0_dp, &
                                 friction = 0.1_dp, pellet_speed = 15.0_dp

  type, public :: scene
    real(dp), allocatable :: x(:, :)             !< (3, nodes)
    integer(int32), allocatable :: tets(:, :)    !< (4, elements)
    integer(int32), allocatable :: parts(:)      !< of elements
    integer(int32), allocatable :: faces(:, :)   !< (2, n): element and local facet, all that lie outside
    integer(int32), allocatable :: clamped(:)    !< nodes along the plate's four edges
  end type

  public :: make_scene

contains

  !> Plate of 20 x 20 x 2 mm, pellet of 4 x 4 x 4 mm a hundredth of a cell above its middle. `cells` over the
  !> plate's side is a multiple of 10.
  subroutine make_scene(cells, s)
    integer, intent(in) :: cells
    type(scene), intent(out) :: s
    real(dp) :: h
    integer :: i

    h = 20e-3_dp/cells
    allocate (s%x(3, 0), s%tets(4, 0), s%parts(0), s%faces(2, 0))
    call add_block([cells, cells, cells/10], h, [0.0_dp, 0.0_dp, 0.0_dp], plate, s)
    s%clamped = pack([(i, i=1, size(s%x, 2))], abs(s%x(1, :) - 10e-3_dp) > 10e-3_dp - 0.1_dp*h .or. &
                     abs(s%x(2, :) - 10e-3_dp) > 10e-3_dp - 0.1_dp*h)
    call add_block([cells, cells, cells]/5, h, [8.0_dp, 8.0_dp, 2.0_dp]*1e-3_dp + [0.3_dp, 0.2_dp, 0.01_dp]*h, &
                   pellet, s)
  end subroutine

  !> A grid of cubes, each of six tetrahedra along the paths from its lowest to its highest corner (Kuhn).
  subroutine add_block(n, h, origin, part, s)
    integer, intent(in) :: n(3)
    real(dp), intent(in) :: h, origin(3)
    integer(int32), intent(in) :: part
    type(scene), intent(inout) :: s
    integer, parameter :: paths(3, 6) = reshape([1, 2, 3, 2, 3, 1, 3, 1, 2, 1, 3, 2, 2, 1, 3, 3, 2, 1], [3, 6])
    real(dp), allocatable :: x(:, :)
    integer(int32), allocatable :: tets(:, :), faces(:, :)
    integer(int32) :: tet(4), first_node, first_element
    integer :: i, j, k, p, step, at(3), count, face_count

    first_node = size(s%x, 2, int32)
    first_element = size(s%tets, 2, int32)
    allocate (x(3, product(n + 1)), tets(4, 6*product(n)), faces(2, 24*product(n)))
    do k = 0, n(3)
      do j = 0, n(2)
        do i = 0, n(1)
          x(:, node(i, j, k)) = origin + h*[i, j, k]
        end do
      end do
    end do
    count = 0
    face_count = 0
    do k = 0, n(3) - 1
      do j = 0, n(2) - 1
        do i = 0, n(1) - 1
          do p = 1, 6
            at = [i, j, k]
            tet(1) = node(at(1), at(2), at(3))
            do step = 1, 3
              at(paths(step, p)) = at(paths(step, p)) + 1
              tet(step + 1) = node(at(1), at(2), at(3))
            end do
            if (p > 3) tet = tet([1, 2, 4, 3])
            count = count + 1
            tets(:, count) = tet
            call add_outer_faces(tet)
          end do
        end do
      end do
    end do
    s%x = reshape([s%x, x], [3, first_node + size(x, 2)])
    s%tets = reshape([s%tets, tets + first_node], [4, first_element + count])
    s%parts = [s%parts, spread(part, 1, count)]
    s%faces = reshape([s%faces, faces(:, :face_count)], [2, size(s%faces, 2) + face_count])

  contains

    pure integer(int32) function node(a, b, c)
      integer, intent(in) :: a, b, c

      node = int(1 + a + (n(1) + 1)*(b + (n(2) + 1)*c), int32)
    end function

    !> Facets whose three corners lie on one outer plane of the block, in the order of cdfp/topology.hpp.
    subroutine add_outer_faces(corners)
      integer(int32), intent(in) :: corners(4)
      integer, parameter :: facets(3, 4) = reshape([1, 3, 2, 1, 2, 4, 2, 3, 4, 3, 1, 4], [3, 4])
      real(dp) :: place(3, 3)
      integer :: f, d

      do f = 1, 4
        place = x(:, corners(facets(:, f)))
        do d = 1, 3
          if (all(abs(place(d, :) - origin(d)) < 0.1_dp*h) .or. &
              all(abs(place(d, :) - origin(d) - n(d)*h) < 0.1_dp*h)) then
            face_count = face_count + 1
            faces(:, face_count) = [first_element + count, f]
          end if
        end do
      end do
    end subroutine

  end subroutine

end module plate_scene
