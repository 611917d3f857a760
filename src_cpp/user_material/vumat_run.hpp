/// What a VUMAT's utility routines reach: the law that runs on this thread.
#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace cdfp {

/// Of one loaded VUMAT.
class VumatHost {
 public:
  static constexpr int kMutexes = 100;

  VumatHost(std::string job_name, std::string out_folder, bool single)
      : job(std::move(job_name)), folder(std::move(out_folder)), single_precision(single) {}

  const std::string job, folder;
  const bool single_precision;

  /// An array that user subroutines share by number; `local`: each thread has its own.
  struct Array {
    std::vector<std::uint64_t> words;
    std::int32_t count = 0;
  };
  Array& make_array(bool local, bool real, std::int32_t id);
  /// Null if there is none.
  Array* find_array(bool local, bool real, std::int32_t id);
  void delete_array(bool local, bool real, std::int32_t id);

  std::recursive_mutex& mutex(int number) { return mutexes_[number]; }

  /// Kept once each, and the first few only.
  void say(const std::string& sentence);
  std::vector<std::string> said();

 private:
  struct Key {
    bool real;
    int thread;  ///< -1: of all
    std::int32_t id;
    auto operator<=>(const Key&) const = default;
  };
  static Key key(bool local, bool real, std::int32_t id);

  std::recursive_mutex mutexes_[kMutexes];
  std::mutex guard_;
  std::map<Key, Array> arrays_;
  std::vector<std::string> said_;
  std::int64_t left_out_ = 0;
};

/// A call that is on its way on this thread.
struct VumatRun {
  VumatHost* host = nullptr;
  std::jmp_buf back;
  std::string error;               ///< by xplb_abqerr; empty: none
  std::vector<int> locks;          ///< mutexes that the law holds
  const double* stress = nullptr;  ///< old stress (count, 6), for vgetvrm
  const double* state = nullptr;   ///< old states (count, states)
  std::int64_t count = 0;
  std::int32_t states = 0;
};

/// Null outside a call.
VumatRun* vumat_run();

/// Runs `work(data)` with `run` as this thread's. False if the law left by xplb_exit or STOP.
bool run_vumat(VumatRun& run, void (*work)(void*), void* data);

/// Back to `run_vumat`; frames in between are dropped.
[[noreturn]] void leave_vumat(VumatRun& run);

/// The utility routines are called by libraries that come later; this has them linked into static programs.
void keep_vumat_utilities();

}  // namespace cdfp
