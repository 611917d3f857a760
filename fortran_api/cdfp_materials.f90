!> For laws of bulk materials in Fortran.
module cdfp_materials
  use, intrinsic :: iso_c_binding
  use cdfp_c_material
  use cdfp_handles
  implicit none
  private
  public :: cdfp_material_block, build_material

  !> A block of points as arrays (points) or (points, components), the simulation's own: what
  !> `type(cdfp_material_points)` points to. They hold until the law returns; what the law may change is stress,
  !> state, energy, dissipated and stiffness. Elements and points count from 1. See cdfp/material.h.
  type :: cdfp_material_block
    integer :: count = 0, point = 0
    logical :: start = .false.  !< the first call, at time 0
    real(c_double) :: time = 0, step = 0
    integer(c_int32_t), allocatable :: elements(:)
    real(c_double), pointer :: properties(:) => null(), length(:) => null(), density(:) => null()
    real(c_double), pointer :: position(:, :) => null()
    real(c_double), pointer :: strain_increment(:, :) => null(), spin_increment(:, :) => null()
    real(c_double), pointer :: stretch_old(:, :) => null(), stretch(:, :) => null()
    real(c_double), pointer :: gradient_old(:, :) => null(), gradient(:, :) => null(), rotation(:, :) => null()
    real(c_double), pointer :: stress_old(:, :) => null(), state_old(:, :) => null()
    real(c_double), pointer :: energy_old(:) => null(), dissipated_old(:) => null()
    real(c_double), pointer :: stress(:, :) => null(), state(:, :) => null()
    real(c_double), pointer :: energy(:) => null(), dissipated(:) => null(), stiffness(:) => null()
    type(c_ptr), private :: failed = c_null_ptr, message = c_null_ptr
    integer(c_int64_t), private :: capacity = 0
  contains
    procedure :: show
    procedure :: fail
  end type

contains

  !> To be called first in a law.
  subroutine show(this, points)
    class(cdfp_material_block), intent(inout) :: this
    type(cdfp_material_points), intent(in) :: points
    integer(c_int32_t), pointer :: from_0(:)
    integer :: n

    n = int(points%count)
    this%count = n
    this%point = points%point + 1
    this%start = points%start /= 0
    this%time = points%time
    this%step = points%step
    call c_f_pointer(points%elements, from_0, [n])
    this%elements = from_0 + 1_c_int32_t
    call c_f_pointer(points%properties, this%properties, [points%property_count])
    call c_f_pointer(points%length, this%length, [n])
    call c_f_pointer(points%density, this%density, [n])
    call c_f_pointer(points%position, this%position, [n, 3])
    call c_f_pointer(points%strain_increment, this%strain_increment, [n, 6])
    call c_f_pointer(points%spin_increment, this%spin_increment, [n, 3])
    call c_f_pointer(points%stretch_old, this%stretch_old, [n, 6])
    call c_f_pointer(points%stretch, this%stretch, [n, 6])
    call c_f_pointer(points%gradient_old, this%gradient_old, [n, 9])
    call c_f_pointer(points%gradient, this%gradient, [n, 9])
    call c_f_pointer(points%rotation, this%rotation, [n, 9])
    call c_f_pointer(points%stress_old, this%stress_old, [n, 6])
    call c_f_pointer(points%state_old, this%state_old, [n, int(points%state_count)])
    call c_f_pointer(points%energy_old, this%energy_old, [n])
    call c_f_pointer(points%dissipated_old, this%dissipated_old, [n])
    call c_f_pointer(points%stress, this%stress, [n, 6])
    call c_f_pointer(points%state, this%state, [n, int(points%state_count)])
    call c_f_pointer(points%energy, this%energy, [n])
    call c_f_pointer(points%dissipated, this%dissipated, [n])
    call c_f_pointer(points%stiffness, this%stiffness, [n])
    this%failed = points%failed
    this%message = points%message
    this%capacity = points%message_capacity
  end subroutine

  !> The law gives up at point `i` of the block: the step fails with this message.
  subroutine fail(this, i, message)
    class(cdfp_material_block), intent(in) :: this
    integer, intent(in) :: i
    character(len=*), intent(in) :: message
    integer(c_int64_t), pointer :: failed
    character(kind=c_char), pointer :: text(:)
    integer :: k, length

    call c_f_pointer(this%failed, failed)
    call c_f_pointer(this%message, text, [this%capacity])
    length = min(len_trim(message), int(this%capacity) - 1)
    do k = 1, length
      text(k) = message(k:k)
    end do
    text(length + 1) = c_null_char
    failed = i - 1
  end subroutine

  !> Compiles a source (Fortran, C or C++) to a shared library, as `cdfp build-material` does.
  subroutine build_material(source, library, single_precision, stat, errmsg)
    character(len=*), intent(in) :: source, library
    logical, intent(in), optional :: single_precision
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: single

    single = 0
    if (present(single_precision)) single = merge(1_c_int32_t, 0_c_int32_t, single_precision)
    call report(cdfp_build_material(c_text(source), c_text(library), single), stat, errmsg)
  end subroutine

end module cdfp_materials
