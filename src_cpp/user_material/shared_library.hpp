/// A shared library that stays loaded as long as this lives.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace cdfp {

class SharedLibrary {
 public:
  /// Throws `Error(io)` naming file, what is missing and the cure.
  explicit SharedLibrary(const std::string& path);

  const std::string& path() const { return path_; }

  /// The first of the symbols that the library has, or null.
  void* find(const std::vector<std::string>& symbols) const;

 private:
  std::string path_;
  std::shared_ptr<void> handle_;
};

}  // namespace cdfp
