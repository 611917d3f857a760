#include "user_material/vumat_run.hpp"

#include <omp.h>

#include <algorithm>

namespace cdfp {

namespace {

thread_local VumatRun* current = nullptr;

constexpr std::size_t kSentences = 20;

}  // namespace

VumatHost::Key VumatHost::key(bool local, bool real, std::int32_t id) {
  return {real, local ? omp_get_thread_num() : -1, id};
}

VumatHost::Array& VumatHost::make_array(bool local, bool real, std::int32_t id) {
  const std::lock_guard<std::mutex> lock(guard_);
  return arrays_[key(local, real, id)];
}

VumatHost::Array* VumatHost::find_array(bool local, bool real, std::int32_t id) {
  const std::lock_guard<std::mutex> lock(guard_);
  const auto found = arrays_.find(key(local, real, id));
  return found == arrays_.end() ? nullptr : &found->second;
}

void VumatHost::delete_array(bool local, bool real, std::int32_t id) {
  const std::lock_guard<std::mutex> lock(guard_);
  arrays_.erase(key(local, real, id));
}

void VumatHost::say(const std::string& sentence) {
  const std::lock_guard<std::mutex> lock(guard_);
  if (std::find(said_.begin(), said_.end(), sentence) != said_.end()) return;
  if (said_.size() < kSentences) {
    said_.push_back(sentence);
  } else {
    ++left_out_;
  }
}

std::vector<std::string> VumatHost::said() {
  const std::lock_guard<std::mutex> lock(guard_);
  std::vector<std::string> all = said_;
  if (left_out_ > 0) all.push_back("and " + std::to_string(left_out_) + " messages more");
  return all;
}

VumatRun* vumat_run() {
  return current;
}

/// Nothing here needs its destructor to run, and no variable changes between setjmp and the jump.
__attribute__((noinline)) bool run_vumat(VumatRun& run, void (*work)(void*), void* data) {
  current = &run;
  // NOLINTNEXTLINE(cert-err52-cpp): Fortran knows no exceptions, and the routine must not return
  if (setjmp(run.back) == 0) {
    work(data);
    current = nullptr;
    return true;
  }
  current = nullptr;
  return false;
}

void leave_vumat(VumatRun& run) {
  for (const int number : run.locks) run.host->mutex(number).unlock();
  run.locks.clear();
  std::longjmp(run.back, 1);  // NOLINT(cert-err52-cpp)
}

}  // namespace cdfp
