/// The one exception type that the library throws.
#pragma once

#include <cstdlib>
#include <memory>
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
  /// Stands before a number of an element, a node, a facet ... in what the constructor is given.
  static constexpr char kNumber = '\x1e';

  Error(Status status, const std::string& message)
      : std::runtime_error(numbers_from(0, message)),
        status_(status),
        message_(std::make_shared<const std::string>(message)) {}
  Status status() const { return status_; }
  /// The text of `what`, where elements, nodes, facets ... count from 0, as they count from `first`.
  std::string counted_from(int first) const { return numbers_from(first, *message_); }

 private:
  static std::string numbers_from(int first, const std::string& message) {
    std::string text;
    for (std::size_t at = 0; at < message.size();) {
      if (message[at] != kNumber) {
        text += message[at++];
        continue;
      }
      std::size_t end = at + 2;  // a sign or a digit, then digits
      while (end < message.size() && message[end] >= '0' && message[end] <= '9') ++end;
      text += std::to_string(std::strtoll(message.c_str() + at + 1, nullptr, 10) + first);
      at = end;
    }
    return text;
  }

  Status status_;
  std::shared_ptr<const std::string> message_;  // an error is copied without throwing
};

}  // namespace cdfp
