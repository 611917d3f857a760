#include "c_gate.hpp"
#include "core/numbered.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>
#include <mutex>
#include <new>
#include <unordered_map>

namespace cdfp::gate {

namespace {

struct Table {
  std::mutex mutex;
  std::uintptr_t last = 0;
  std::unordered_map<std::uintptr_t, std::shared_ptr<Kept>> kept;
};

Table& table() {
  static Table live;
  return live;
}

std::uintptr_t number(const void* handle) {
  return reinterpret_cast<std::uintptr_t>(handle);
}

thread_local char error_text[4096] = "";
thread_local char error_from_1[4096] = "";

void* new_handle(std::shared_ptr<Kept> kept) {
  const std::uintptr_t handle = ++table().last;
  table().kept.emplace(handle, std::move(kept));
  return reinterpret_cast<void*>(handle);  // NOLINT(performance-no-int-to-ptr): never followed
}

/// Throws unless the handle lives and is of the kind (any if null). The table is locked by the caller.
std::shared_ptr<Kept> find(const void* handle, const char* kind) {
  const std::string wanted = kind ? kind : "handle";
  if (!handle) refuse("the " + wanted + " is null; make one with the create function first");
  const auto found = table().kept.find(number(handle));
  if (found == table().kept.end()) {
    refuse("the " + wanted + " is not alive: it was freed, or its handle was never set; make a new one");
  }
  if (kind && std::strcmp(found->second->kind, kind) != 0) {
    refuse("the handle stands for a " + std::string(found->second->kind) + ", not for a " + wanted);
  }
  return found->second;
}

}  // namespace

void* keep(const char* kind, std::shared_ptr<void> object) {
  auto kept = std::make_shared<Kept>(Kept{kind, std::move(object)});
  const std::lock_guard lock(table().mutex);
  return new_handle(std::move(kept));
}

void* share(const void* handle) {
  const std::lock_guard lock(table().mutex);
  return new_handle(find(handle, nullptr));
}

void release(const void* handle) {
  std::shared_ptr<Kept> last;  // destroyed after the lock is gone
  const std::lock_guard lock(table().mutex);
  const auto found = table().kept.find(number(handle));
  if (found == table().kept.end()) return;
  last = std::move(found->second);
  table().kept.erase(found);
}

std::int64_t live_handles() {
  const std::lock_guard lock(table().mutex);
  return static_cast<std::int64_t>(table().kept.size());
}

Lease::Lease(const void* handle, const char* kind, bool change) : change_(change) {
  const std::lock_guard lock(table().mutex);
  kept_ = find(handle, kind);
  if (kept_->changing || (change && kept_->looking > 0)) {
    throw Error(Status::bad_state, "the " + std::string(kind) +
                                       " is in use by another call; use it from one thread at a time and not "
                                       "from a callback that it made");
  }
  if (change) {
    kept_->changing = true;
  } else {
    ++kept_->looking;
  }
}

Lease::~Lease() {
  const std::lock_guard lock(table().mutex);
  if (change_) {
    kept_->changing = false;
  } else {
    --kept_->looking;
  }
}

std::int32_t remember(Status status, const char* function, const char* message,
                      const char* counted_from_1) noexcept {
  std::snprintf(error_text, sizeof error_text, "%s: %s", function, message);
  std::snprintf(error_from_1, sizeof error_from_1, "%s: %s", function,
                counted_from_1 ? counted_from_1 : message);
  return static_cast<std::int32_t>(status);
}

namespace {

std::int32_t remember_error(const Error& error, const char* function) noexcept {
  try {
    return remember(error.status(), function, error.what(), error.counted_from(1).c_str());
  } catch (const std::exception&) {
    return remember(error.status(), function, error.what());
  }
}

}  // namespace

std::int32_t remember_exception(const char* function) noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return remember_error(error, function);
  } catch (const std::bad_alloc&) {
    return remember(Status::internal, function, "out of memory; take a smaller model");
  } catch (const std::exception& error) {
    return remember(Status::internal, function, error.what());
  } catch (...) {
    return remember(Status::internal, function, "an exception of unknown type");
  }
}

void refuse(const std::string& message) {
  throw Error(Status::bad_argument, message);
}

void need(const void* argument, const char* name) {
  if (!argument) refuse(std::string("argument '") + name + "' is null; pass the address of a variable");
}

std::size_t size_of(std::int64_t count, const char* name) {
  if (count < 0) refuse(std::string("argument '") + name + "' is negative (" + std::to_string(count) + ")");
  if (count > std::numeric_limits<Index>::max()) {
    refuse(std::string("argument '") + name + "' is " + std::to_string(count) +
           "; entities have 32-bit numbers, so that at most 2147483647 are possible");
  }
  return static_cast<std::size_t>(count);
}

void need_array(const void* array, std::int64_t count, const char* name) {
  if (!array && count > 0) {
    refuse(std::string("argument '") + name + "' is null but " + std::to_string(count) +
           " entries are announced; pass the array");
  }
}

void need_number(std::int64_t number, std::int64_t count, const char* what) {
  if (number >= 0 && number < count) return;
  refuse("there is no " + std::string(what) + " " + numbered(number) + "; there are " +
         std::to_string(count) + ", counted from " + numbered(0));
}

std::string name_of(const char* string, const char* argument) {
  need(string, argument);
  if (!*string) refuse(std::string("argument '") + argument + "' is empty; give a name");
  return string;
}

void copy_text(std::string_view from, char* text, std::int64_t capacity, std::int64_t* length) {
  need(length, "length");
  need_array(text, capacity, "text");
  *length = static_cast<std::int64_t>(from.size());
  if (capacity <= 0) return;
  const std::size_t kept = std::min(from.size(), static_cast<std::size_t>(capacity) - 1);
  std::copy_n(from.data(), kept, text);
  text[kept] = '\0';
}

}  // namespace cdfp::gate

using namespace cdfp::gate;

int32_t cdfp_last_error(char* text, int64_t capacity, int64_t* length) {
  if (!length || (!text && capacity > 0)) return CDFP_BAD_ARGUMENT;
  copy_text(error_text, text, capacity, length);
  return CDFP_OK;
}

int32_t cdfp_last_error_from_1(char* text, int64_t capacity, int64_t* length) {
  if (!length || (!text && capacity > 0)) return CDFP_BAD_ARGUMENT;
  copy_text(error_from_1, text, capacity, length);
  return CDFP_OK;
}

int32_t cdfp_version(int32_t* major, int32_t* minor, int32_t* patch) {
  return guarded(__func__, [&] {
    need(major, "major");
    need(minor, "minor");
    need(patch, "patch");
    *major = CDFP_VERSION_MAJOR;
    *minor = CDFP_VERSION_MINOR;
    *patch = CDFP_VERSION_PATCH;
  });
}

int32_t cdfp_share(const void* handle, void** copy) {
  return guarded(__func__, [&] {
    need(copy, "copy");
    *copy = share(handle);
  });
}

int32_t cdfp_free(void** handle) {
  return free_handle(__func__, handle);
}
