// Utility routines that user subroutines for Abaqus/Explicit call, in the spelling of gfortran: lower case, a
// trailing underscore, arguments by reference, lengths of strings at the end. Outside a call of a VUMAT they
// do nothing. Nothing that needs a destructor may live where `leave_vumat` is called.

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "user_material/vumat_run.hpp"

using cdfp::vumat_run;
namespace cdfp {
void keep_vumat_utilities() {}
}  // namespace cdfp

using cdfp::VumatHost;
using cdfp::VumatRun;

// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier): names that others chose

namespace {

std::string_view trimmed(const char* text, std::size_t length) {
  std::string_view view(text, length);
  while (!view.empty() && (view.back() == ' ' || view.back() == '\0')) view.remove_suffix(1);
  return view;
}

void give_text(const std::string& from, char* text, std::int32_t* count, std::size_t length) {
  const std::size_t n = std::min(from.size(), length);
  std::copy_n(from.begin(), n, text);
  std::fill_n(text + n, length - n, ' ');
  *count = static_cast<std::int32_t>(n);
}

std::string real_text(const VumatRun& run, const void* reals, std::size_t i) {
  char text[40];
  if (run.host->single_precision) {
    std::snprintf(text, sizeof text, "%.7g", double{static_cast<const float*>(reals)[i]});
  } else {
    std::snprintf(text, sizeof text, "%.9g", static_cast<const double*>(reals)[i]);
  }
  return text;
}

/// %I, %R and %S stand for the next of the integers, reals and strings.
std::string message_text(const VumatRun& run, std::string_view form, const std::int32_t* integers,
                         const void* reals, const char* strings, std::size_t string_length) {
  std::string text;
  std::size_t next_integer = 0, next_real = 0, next_string = 0;
  for (std::size_t i = 0; i < form.size(); ++i) {
    const char kind = form[i] == '%' && i + 1 < form.size() ? form[i + 1] : ' ';
    if (kind == 'I' || kind == 'i') {
      text += std::to_string(integers[next_integer++]);
    } else if (kind == 'R' || kind == 'r') {
      text += real_text(run, reals, next_real++);
    } else if (kind == 'S' || kind == 's') {
      text += trimmed(strings + string_length * next_string++, string_length);
    } else {
      text += form[i];
      continue;
    }
    ++i;
  }
  return text;
}

void take_message(VumatRun& run, std::int32_t kind, std::string_view form, const std::int32_t* integers,
                  const void* reals, const char* strings, std::size_t string_length) {
  const std::string text = message_text(run, form, integers, reals, strings, string_length);
  if (kind <= -2) {
    if (!run.error.empty()) run.error += "; ";
    run.error += text;
  } else {
    run.host->say(text);
  }
}

void leave(const char* why) {
  VumatRun* run = vumat_run();
  if (!run) return;
  if (run->error.empty()) run->error = why;
  cdfp::leave_vumat(*run);
}

void stopped(const char* text, std::size_t length) {
  VumatRun* run = vumat_run();
  if (!run) return;
  if (run->error.empty()) {
    run->error = "the law reached a STOP";
    if (text && length > 0) run->error.append(": ").append(text, length);
  }
  cdfp::leave_vumat(*run);
}

void stopped(int code) {
  VumatRun* run = vumat_run();
  if (!run) return;
  if (run->error.empty()) run->error = "the law reached a STOP with the code " + std::to_string(code);
  cdfp::leave_vumat(*run);
}

/// The array of that number, made anew.
template <class Number>
std::int64_t create(bool local, bool real, const std::int32_t* id, const std::int32_t* count,
                    const Number* initial) {
  VumatRun* run = vumat_run();
  if (!run || *count < 0) return 0;
  VumatHost::Array& array = run->host->make_array(local, real, *id);
  array.count = *count;
  array.words.assign(static_cast<std::size_t>(*count) + 1, 0);
  auto* first = reinterpret_cast<Number*>(array.words.data());
  std::fill_n(first, *count, initial ? *initial : Number{});
  return reinterpret_cast<std::int64_t>(first);
}

std::int64_t create_real(bool local, const std::int32_t* id, const std::int32_t* count, const void* initial) {
  const VumatRun* run = vumat_run();
  if (run && run->host->single_precision)
    return create(local, true, id, count, static_cast<const float*>(initial));
  return create(local, true, id, count, static_cast<const double*>(initial));
}

std::int64_t access(bool local, bool real, const std::int32_t* id) {
  VumatRun* run = vumat_run();
  VumatHost::Array* array = run ? run->host->find_array(local, real, *id) : nullptr;
  return array ? reinterpret_cast<std::int64_t>(array->words.data()) : 0;
}

std::int32_t size(bool local, bool real, const std::int32_t* id) {
  VumatRun* run = vumat_run();
  VumatHost::Array* array = run ? run->host->find_array(local, real, *id) : nullptr;
  return array ? array->count : 0;
}

void remove(bool local, bool real, const std::int32_t* id) {
  if (VumatRun* run = vumat_run()) run->host->delete_array(local, real, *id);
}

int mutex_number(const std::int32_t* id) {
  return *id >= 1 && *id <= VumatHost::kMutexes ? *id - 1 : 0;
}

template <class Number>
void copy_components(const double* from, std::int64_t n, void* to) {
  std::copy_n(from, n, static_cast<Number*>(to));
}

}  // namespace

extern "C" {

// ---- messages and stops ----

void xplb_abqerr_(const std::int32_t* kind, const char* form, const std::int32_t* integers, const void* reals,
                  const char* strings, std::size_t form_length, std::size_t string_length) {
  VumatRun* run = vumat_run();
  if (!run) return;
  take_message(*run, *kind, trimmed(form, form_length), integers, reals, strings, string_length);
  if (*kind == -3) cdfp::leave_vumat(*run);
}
void stdb_abqerr_(const std::int32_t* kind, const char* form, const std::int32_t* integers, const void* reals,
                  const char* strings, std::size_t form_length, std::size_t string_length) {
  xplb_abqerr_(kind, form, integers, reals, strings, form_length, string_length);
}
void xplb_exit_() {
  leave("the law called xplb_exit");
}
void xit_() {
  leave("the law called xit");
}

// What STOP and EXIT call, where the linker was told to wrap it.
void __wrap__gfortran_stop_string(const char* text, std::size_t length, bool) {
  stopped(text, length);
}
void __wrap__gfortran_error_stop_string(const char* text, std::size_t length, bool) {
  stopped(text, length);
}
void __wrap__gfortran_stop_numeric(int code, bool) {
  stopped(code);
}
void __wrap__gfortran_error_stop_numeric(int code, bool) {
  stopped(code);
}
void __wrap__gfortran_exit_i4(const std::int32_t* code) {
  stopped(code ? *code : 0);
}
void __wrap__gfortran_exit_i8(const std::int64_t* code) {
  stopped(code ? static_cast<int>(*code) : 0);
}

// ---- the job ----

void vgetjobname_(char* text, std::int32_t* count, std::size_t length) {
  if (const VumatRun* run = vumat_run()) give_text(run->host->job, text, count, length);
}
void getjobname_(char* text, std::int32_t* count, std::size_t length) {
  vgetjobname_(text, count, length);
}
void vgetoutdir_(char* text, std::int32_t* count, std::size_t length) {
  if (const VumatRun* run = vumat_run()) give_text(run->host->folder, text, count, length);
}
void getoutdir_(char* text, std::int32_t* count, std::size_t length) {
  vgetoutdir_(text, count, length);
}
void vgetrank_(std::int32_t* rank) {
  *rank = 0;
}
void getrank_(std::int32_t* rank) {
  *rank = 0;
}
void vgetnumcpus_(std::int32_t* count) {
  *count = 1;
}
void getnumcpus_(std::int32_t* count) {
  *count = 1;
}
std::int32_t getnumthreads_() {
  return omp_get_num_threads();
}
std::int32_t get_thread_id_() {
  return omp_get_thread_num();
}
/// A node or element keeps its number: cdfp has one numbering.
void vgetinternal_(const char*, const std::int32_t* number, const std::int32_t*, std::int32_t* internal,
                   std::int32_t* failed, std::size_t) {
  *internal = *number;
  *failed = 0;
}

/// 'S', the stress at the start of the step, and 'SDV', the states; for any other variable `failed` is 1.
void vgetvrm_(const char* variable, void* reals, std::int32_t*, char*, std::int32_t* failed,
              std::size_t length, std::size_t) {
  const VumatRun* run = vumat_run();
  const std::string_view name = trimmed(variable, length);
  const bool stress = name == "S" || name == "s", state = name == "SDV" || name == "sdv";
  *failed = run && (stress || state) ? 0 : 1;
  if (*failed) return;
  const double* from = stress ? run->stress : run->state;
  const std::int64_t n = run->count * (stress ? 6 : run->states);
  if (run->host->single_precision) {
    copy_components<float>(from, n, reals);
  } else {
    copy_components<double>(from, n, reals);
  }
}

// ---- mutexes ----

void mutexinit_(const std::int32_t*) {}
void mutexlock_(const std::int32_t* id) {
  VumatRun* run = vumat_run();
  if (!run) return;
  run->host->mutex(mutex_number(id)).lock();
  run->locks.push_back(mutex_number(id));
}
void mutexunlock_(const std::int32_t* id) {
  VumatRun* run = vumat_run();
  if (!run) return;
  const auto held = std::find(run->locks.rbegin(), run->locks.rend(), mutex_number(id));
  if (held == run->locks.rend()) return;
  run->locks.erase(std::next(held).base());
  run->host->mutex(mutex_number(id)).unlock();
}

// ---- arrays ----

std::int64_t smaintarraycreate_(const std::int32_t* id, const std::int32_t* count,
                                const std::int32_t* initial) {
  return create(false, false, id, count, initial);
}
std::int64_t smalocalintarraycreate_(const std::int32_t* id, const std::int32_t* count,
                                     const std::int32_t* initial) {
  return create(true, false, id, count, initial);
}
std::int64_t smafloatarraycreate_(const std::int32_t* id, const std::int32_t* count, const void* initial) {
  return create_real(false, id, count, initial);
}
std::int64_t smalocalfloatarraycreate_(const std::int32_t* id, const std::int32_t* count,
                                       const void* initial) {
  return create_real(true, id, count, initial);
}
std::int64_t smarealarraycreatedp_(const std::int32_t* id, const std::int32_t* count, const double* initial) {
  return create(false, true, id, count, initial);
}
std::int64_t smarealarraycreatesp_(const std::int32_t* id, const std::int32_t* count, const float* initial) {
  return create(false, true, id, count, initial);
}

std::int64_t smaintarrayaccess_(const std::int32_t* id) {
  return access(false, false, id);
}
std::int64_t smalocalintarrayaccess_(const std::int32_t* id) {
  return access(true, false, id);
}
std::int64_t smafloatarrayaccess_(const std::int32_t* id) {
  return access(false, true, id);
}
std::int64_t smalocalfloatarrayaccess_(const std::int32_t* id) {
  return access(true, true, id);
}
std::int64_t smarealarrayaccess_(const std::int32_t* id) {
  return access(false, true, id);
}

std::int32_t smaintarraysize_(const std::int32_t* id) {
  return size(false, false, id);
}
std::int32_t smalocalintarraysize_(const std::int32_t* id) {
  return size(true, false, id);
}
std::int32_t smafloatarraysize_(const std::int32_t* id) {
  return size(false, true, id);
}
std::int32_t smalocalfloatarraysize_(const std::int32_t* id) {
  return size(true, true, id);
}
std::int32_t smarealarraysize_(const std::int32_t* id) {
  return size(false, true, id);
}

void smaintarraydelete_(const std::int32_t* id) {
  remove(false, false, id);
}
void smalocalintarraydelete_(const std::int32_t* id) {
  remove(true, false, id);
}
void smafloatarraydelete_(const std::int32_t* id) {
  remove(false, true, id);
}
void smalocalfloatarraydelete_(const std::int32_t* id) {
  remove(true, true, id);
}
void smarealarraydelete_(const std::int32_t* id) {
  remove(false, true, id);
}
}

// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)
