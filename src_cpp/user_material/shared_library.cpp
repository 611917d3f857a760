#include "user_material/shared_library.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "cdfp/error.hpp"

namespace cdfp {

namespace {

/// Libraries look for the utility routines among what was loaded for all to see. A program that loaded cdfp
/// for itself alone (a plug-in, a script) gets it shown.
void show_this_library() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&show_this_library), &info) == 0 || !info.dli_fname) return;
  if (void* self = dlopen(info.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL)) dlclose(self);
}

}  // namespace

SharedLibrary::SharedLibrary(const std::string& path) : path_(path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw Error(Status::io, "there is no library '" + path +
                                "'; give its path, or the source and let cdfp build-material compile it");
  }
  show_this_library();
  const std::string absolute = std::filesystem::absolute(path).string();
  void* handle = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    const char* why = dlerror();
    const std::string reason = why ? why : "no reason given";
    const bool missing = reason.find("undefined symbol") != std::string::npos;
    throw Error(Status::io, "library '" + path + "' cannot be loaded: " + reason +
                                (missing ? "; it calls a routine that neither it nor cdfp has: compile that "
                                           "routine into it"
                                         : "; it must be a shared library for this machine"));
  }
  handle_ = std::shared_ptr<void>(handle, dlclose);
}

void* SharedLibrary::find(const std::vector<std::string>& symbols) const {
  for (const std::string& symbol : symbols) {
    if (void* found = dlsym(handle_.get(), symbol.c_str())) return found;
  }
  return nullptr;
}

}  // namespace cdfp
