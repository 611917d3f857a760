// For the Fortran test: how many objects are alive behind the door.
#include "../../fortran_api/c_gate.hpp"

extern "C" std::int64_t live_handles() {
  return cdfp::gate::live_handles();
}
