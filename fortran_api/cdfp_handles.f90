!> What the types of module `cdfp` stand on: counted handles, status and message, strings, numbers.
module cdfp_handles
  use, intrinsic :: iso_c_binding
  use cdfp_c
  implicit none
  private
  public :: counted_handle, report, refuse, c_text, fortran_text, copy_numbers, copy_rows, threads_or_one

  !> One owner of an object, which goes with its last owner: by `free`, when the owner's variable ceases to
  !> exist, or when it is made to own another. `share` makes one more owner.
  !>
  !> A copy that the compiler makes by itself (a component of a type of the user's, an element of an array) is
  !> no owner: it names the object for as long as the original owner holds it. Owners know each other from
  !> copies by the place where they were made, so that whatever a compiler finalizes, only owners give back.
  type :: counted_handle
    type(c_ptr) :: address = c_null_ptr
    type(c_ptr), private :: home = c_null_ptr
  contains
    procedure :: own
    procedure :: share
    procedure :: free
    final :: finalize
  end type

contains

  !> Takes over what a create function has made.
  subroutine own(this, address)
    class(counted_handle), intent(inout), target :: this
    type(c_ptr), intent(in) :: address

    call finalize(this)
    this%address = address
    this%home = c_loc(this%address)
  end subroutine

  subroutine share(this, other)
    class(counted_handle), intent(inout) :: this
    type(counted_handle), intent(in) :: other
    type(c_ptr) :: copy
    integer(c_int32_t) :: status

    copy = c_null_ptr
    if (c_associated(other%address)) status = cdfp_share(other%address, copy)
    call this%own(copy)
  end subroutine

  !> May be called twice.
  subroutine free(this)
    class(counted_handle), intent(inout) :: this
    integer(c_int32_t) :: status

    status = cdfp_free(this%address)
  end subroutine

  impure elemental subroutine finalize(this)
    type(counted_handle), intent(inout), target :: this

    if (c_associated(this%home, c_loc(this%address))) call this%free()
    this%home = c_null_ptr
  end subroutine

  !> Hands a status on as the standard's own statements do: `stat` is set if present; on an error `errmsg` is
  !> set if present, and without `stat` the program stops with the message.
  subroutine report(status, stat, errmsg)
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (status == CDFP_OK) then
      if (present(stat)) stat = CDFP_OK
    else
      call hand_on(status, last_error(), stat, errmsg)
    end if
  end subroutine

  !> Reports arguments that are refused before they reach the C interface.
  subroutine refuse(message, stat, errmsg)
    character(len=*), intent(in) :: message
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    call hand_on(CDFP_BAD_ARGUMENT, message, stat, errmsg)
  end subroutine

  subroutine hand_on(status, message, stat, errmsg)
    integer(c_int32_t), intent(in) :: status
    character(len=*), intent(in) :: message
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg

    if (present(errmsg)) errmsg = message
    if (present(stat)) then
      stat = int(status)
    else
      error stop message
    end if
  end subroutine

  function last_error() result(text)
    character(len=:), allocatable :: text
    character(kind=c_char) :: buffer(4096)
    integer(c_int64_t) :: length
    integer(c_int32_t) :: status

    status = cdfp_last_error_from_1(buffer, size(buffer, kind=c_int64_t), length)
    text = fortran_text(buffer, length)
  end function

  !> Without trailing blanks, ended by a null.
  pure function c_text(text) result(c)
    character(len=*), intent(in) :: text
    character(kind=c_char, len=:), allocatable :: c

    c = trim(text)//c_null_char
  end function

  !> The first `length` characters, or all but the null that the buffer ends with.
  pure function fortran_text(buffer, length) result(text)
    character(kind=c_char), intent(in) :: buffer(:)
    integer(c_int64_t), intent(in) :: length
    character(len=:), allocatable :: text
    integer :: i

    allocate (character(len=min(int(length), size(buffer) - 1)) :: text)
    do i = 1, len(text)
      text(i:i) = buffer(i)
    end do
  end function

  pure function threads_or_one(threads) result(count)
    integer, intent(in), optional :: threads
    integer(c_int32_t) :: count

    count = 1
    if (present(threads)) count = int(threads, c_int32_t)
  end function

  !> A C array of numbers that count from 0 as numbers that count from 1.
  subroutine copy_numbers(data, count, numbers)
    type(c_ptr), intent(in) :: data
    integer(c_int64_t), intent(in) :: count
    integer(c_int32_t), allocatable, intent(out) :: numbers(:)
    integer(c_int32_t), pointer :: view(:)

    if (count == 0) then
      allocate (numbers(0))
      return
    end if
    call c_f_pointer(data, view, [count])
    numbers = view + 1_c_int32_t
  end subroutine

  subroutine copy_rows(data, length, count, rows)
    type(c_ptr), intent(in) :: data
    integer(c_int64_t), intent(in) :: length, count
    integer(c_int32_t), allocatable, intent(out) :: rows(:, :)
    integer(c_int32_t), pointer :: view(:, :)

    if (count == 0) then
      allocate (rows(length, 0))
      return
    end if
    call c_f_pointer(data, view, [length, count])
    rows = view + 1_c_int32_t
  end subroutine

end module cdfp_handles
