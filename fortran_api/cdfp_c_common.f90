!> The C interface, one to one: status, version and handles. See `cdfp_c`.
module cdfp_c_common
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_int64_t, c_ptr
  implicit none
  public

  integer(c_int32_t), parameter :: &
    CDFP_OK = 0, CDFP_BAD_ARGUMENT = 1, CDFP_BAD_INPUT = 2, CDFP_BAD_MESH = 3, CDFP_BAD_STATE = 4, &
    CDFP_DIVERGED = 5, CDFP_IO = 6, CDFP_UNAVAILABLE = 7, CDFP_INTERNAL = 8

  interface
    function cdfp_last_error(text, capacity, length) bind(c) result(status)
      import
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function

    function cdfp_last_error_from_1(text, capacity, length) bind(c) result(status)
      import
      character(kind=c_char), intent(inout) :: text(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: length
      integer(c_int32_t) :: status
    end function

    function cdfp_version(major, minor, patch) bind(c) result(status)
      import
      integer(c_int32_t), intent(inout) :: major, minor, patch
      integer(c_int32_t) :: status
    end function

    function cdfp_share(handle, copy) bind(c) result(status)
      import
      type(c_ptr), value :: handle
      type(c_ptr), intent(inout) :: copy
      integer(c_int32_t) :: status
    end function

    function cdfp_free(handle) bind(c) result(status)
      import
      type(c_ptr), intent(inout) :: handle
      integer(c_int32_t) :: status
    end function
  end interface
end module cdfp_c_common
