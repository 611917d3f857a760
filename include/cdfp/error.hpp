/// The one exception type that the library throws.
#pragma once

#include <stdexcept>
#include <string>

namespace cdfp {

/// What went wrong, as the C interface reports it.
enum class Status : int {
  ok = 0,
  bad_argument = 1,  ///< a value, size or name that the caller gave
  bad_input = 2,     ///< a file's contents; the message names file and line
  bad_mesh = 3,      ///< inverted, degenerate or inconsistent elements
  bad_state = 4,     ///< a call that the object cannot take now
  diverged = 5,      ///< NaN, inverted element or runaway energy while stepping
  io = 6,            ///< a file that cannot be opened, read or written
  unavailable = 7,   ///< an optional part that this build lacks
  internal = 8
};

/// The message names what is wrong, where, and the cure.
class Error : public std::runtime_error {
 public:
  Error(Status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  Status status() const { return status_; }

 private:
  Status status_;
};

}  // namespace cdfp
