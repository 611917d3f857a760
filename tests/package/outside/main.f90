program outside
  use cdfp
  use, intrinsic :: iso_fortran_env, only: int32
  implicit none
  type(cdfp_topology) :: topology
  integer(int32) :: hexahedra(8, 2) = reshape([1, 2, 5, 4, 7, 8, 11, 10, 2, 3, 6, 5, 8, 9, 12, 11], [8, 2])

  call topology%create(12, hexahedra)
  if (topology%check() /= '') error stop 'the mesh is wrong'
  print '(i0, a)', size(hexahedra, 2), ' elements from Fortran'
end program
