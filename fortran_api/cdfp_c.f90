!> The C interface of cdfp, one to one: see cdfp/cdfp.h and cdfp/c, which say what each function does. Numbers count
!> from 0 here and strings end with c_null_char; the module `cdfp` is what Fortran programs call. Results are
!> `intent(inout)` since a call that fails leaves them as they are.
module cdfp_c
  use cdfp_c_cohesive
  use cdfp_c_common
  use cdfp_c_contact
  use cdfp_c_material
  use cdfp_c_mesh
  use cdfp_c_model
  use cdfp_c_simulation
  use cdfp_c_topology
  implicit none
  public
end module cdfp_c
