// A block of points as a VUMAT's arguments, and its answer back.

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "cdfp/error.hpp"
#include "cdfp/material_library.hpp"
#include "user_material/shared_library.hpp"
#include "user_material/vumat_run.hpp"

namespace cdfp {

namespace {

constexpr std::size_t kNameLength = 80;
constexpr std::int32_t kDirect = 3, kShear = 3;

/// VUMAT's arguments; the first, seventh and tenth are arrays that begin with what the oldest form of the
/// interface has there: nblock, lanneal, dt.
using VumatRoutine = void(const std::int32_t* jblock, const std::int32_t* ndir, const std::int32_t* nshr,
                          const std::int32_t* nstatev, const std::int32_t* nfieldv,
                          const std::int32_t* nprops, const std::int32_t* info, const void* step_time,
                          const void* total_time, const void* steps, const char* cmname, const void* position,
                          const void* length, const void* props, const void* density,
                          const void* strain_increment, const void* spin_increment,
                          const void* temperature_old, const void* stretch_old, const void* gradient_old,
                          const void* field_old, const void* stress_old, const void* state_old,
                          const void* energy_old, const void* dissipated_old, const void* temperature,
                          const void* stretch, const void* gradient, const void* field, void* stress,
                          void* state, void* energy, void* dissipated, std::size_t cmname_length);

/// vexternaldb(lOp, i_Array, niArray, r_Array, nrArray)
using ExternalRoutine = void(const std::int32_t* operation, std::int32_t* integers,
                             const std::int32_t* integer_count, void* reals, const std::int32_t* real_count);
enum External {
  start_analysis = 0,
  start_step = 1,
  setup_increment = 2,
  start_increment = 3,
  end_increment = 4
};

/// Everything that a call needs, in the law's precision. Doubles that the block has are used where they are.
template <class Real>
class Arguments {
 public:
  Arguments(const MaterialPoints& p, const VumatOptions& options, const std::array<char, kNameLength>& name)
      : p_(p),
        n_(static_cast<std::size_t>(p.count)),
        name_(name),
        fields_(static_cast<std::int32_t>(options.fields.size())) {
    jblock_ = {static_cast<std::int32_t>(p.count), p.point + 1, 1, 1};
    info_ = {0, p.point + 1, 1,
             1, 0,           7};  // annealing, point, layer, section point, moduli wanted, first element
    for (std::size_t i = 0; i < n_; ++i) {
      jblock_.push_back(p.elements[i] + 1);
      info_.push_back(p.elements[i] + 1);
    }
    steps_.assign(2 * n_ + 1, Real(0));
    steps_[0] = static_cast<Real>(p.step);
    time_ = static_cast<Real>(p.time);
    temperature_.assign(2 * n_, static_cast<Real>(options.temperature));
    for (const double field : options.fields) field_.insert(field_.end(), n_, static_cast<Real>(field));
    field_.resize(2 * n_ * options.fields.size() + 1);
    std::copy_n(field_.begin(), n_ * options.fields.size(),
                field_.begin() + static_cast<std::ptrdiff_t>(n_ * options.fields.size()));
    if constexpr (!kSame) {
      stress_ = copy(p.stress, 6);
      state_ = copy(p.state, static_cast<std::size_t>(p.state_count));
      energy_ = copy(p.energy, 1);
      dissipated_ = copy(p.dissipated, 1);
    }
  }

  void call(VumatRoutine* routine) {
    routine(jblock_.data(), &kDirect, &kShear, &p_.state_count, &fields_, &p_.property_count, info_.data(),
            &time_, &time_, steps_.data(), name_.data(), in(p_.position, 3), in(p_.length, 1), properties(),
            in(p_.density, 1), in(p_.strain_increment, 6), in(p_.spin_increment, 3), temperature_.data(),
            in(p_.stretch_old, 6), in(p_.gradient_old, 9), field_.data(), in(p_.stress_old, 6),
            in(p_.state_old, static_cast<std::size_t>(p_.state_count)), in(p_.energy_old, 1),
            in(p_.dissipated_old, 1), temperature_.data() + n_, in(p_.stretch, 6), in(p_.gradient, 9),
            field_.data() + n_ * static_cast<std::size_t>(fields_), out(p_.stress, stress_),
            out(p_.state, state_), out(p_.energy, energy_), out(p_.dissipated, dissipated_), kNameLength);
  }

  /// Brings the answer back to the block. A word written behind an array is written behind the block's.
  void take_answer() const {
    if constexpr (!kSame) {
      take(stress_, p_.stress, 6);
      take(state_, p_.state, static_cast<std::size_t>(p_.state_count));
      take(energy_, p_.energy, 1);
      take(dissipated_, p_.dissipated, 1);
    }
  }

 private:
  static constexpr bool kSame = std::is_same_v<Real, double>;
  static constexpr std::size_t kGuards = 4;
  static constexpr std::uint32_t kGuard = 0x7fa5afe0;  // a signalling NaN
  static Real guard() { return std::bit_cast<Real>(kGuard); }

  /// With guards behind it.
  std::vector<Real> copy(const double* from, std::size_t components) const {
    std::vector<Real> values((components + kGuards) * n_, guard());
    std::transform(from, from + components * n_, values.begin(),
                   [](double v) { return static_cast<Real>(v); });
    return values;
  }
  const void* in(const double* from, std::size_t components) {
    if constexpr (kSame) {
      return from;
    } else {
      std::vector<Real>& values = copies_.emplace_back(components * n_ + 1);
      std::transform(from, from + components * n_, values.begin(),
                     [](double v) { return static_cast<Real>(v); });
      return values.data();
    }
  }
  const void* properties() {
    if constexpr (kSame) {
      return p_.properties;
    } else {
      std::vector<Real>& values = copies_.emplace_back(static_cast<std::size_t>(p_.property_count) + 1);
      std::transform(p_.properties, p_.properties + p_.property_count, values.begin(),
                     [](double v) { return static_cast<Real>(v); });
      return values.data();
    }
  }
  static void* out([[maybe_unused]] double* block, [[maybe_unused]] std::vector<Real>& own) {
    if constexpr (kSame) {
      return block;
    } else {
      return own.data();
    }
  }
  void take(const std::vector<Real>& from, double* to, std::size_t components) const {
    std::copy_n(from.begin(), components * n_, to);
    for (std::size_t i = components * n_; i < from.size(); ++i) {
      if (std::bit_cast<std::uint32_t>(from[i]) != kGuard) to[components * n_] = 0;
    }
  }

  const MaterialPoints& p_;
  std::size_t n_;
  std::array<char, kNameLength> name_;
  std::int32_t fields_;
  std::vector<std::int32_t> jblock_, info_;
  Real time_ = 0;
  std::vector<Real> steps_, temperature_, field_, stress_, state_, energy_, dissipated_;
  std::vector<std::vector<Real>> copies_;
};

class Vumat {
 public:
  Vumat(const std::string& library, VumatOptions options)
      : library_(library),
        options_(std::move(options)),
        host_(options_.job, options_.folder, options_.single_precision) {
    routine_ = reinterpret_cast<VumatRoutine*>(library_.find({"vumat_", "vumat", "VUMAT"}));
    if (!routine_) {
      throw Error(Status::io,
                  "library '" + library +
                      "' has no subroutine VUMAT (symbol vumat_); compile a source that defines it, by "
                      "cdfp build-material, or take law = \"library\" for a law of another form");
    }
    external_ = reinterpret_cast<ExternalRoutine*>(library_.find({"vexternaldb_"}));
    name_.fill(' ');
    for (std::size_t i = 0; i < std::min(kNameLength, options_.name.size()); ++i) {
      name_[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(options_.name[i])));
    }
  }

  std::vector<std::string> said() { return host_.said(); }

  void operator()(const MaterialPoints& p, bool thread_safe) {
    static std::mutex one_at_a_time;
    std::unique_lock<std::mutex> lock(one_at_a_time, std::defer_lock);
    if (!thread_safe) lock.lock();
    if (options_.single_precision) {
      run<float>(p);
    } else {
      run<double>(p);
    }
  }

 private:
  template <class Real>
  void run(const MaterialPoints& p) {
    VumatRun call{};
    call.host = &host_;
    call.stress = p.stress_old;
    call.state = p.state_old;
    call.count = p.count;
    call.states = p.state_count;
    if (external_) tell_external<Real>(call, p);
    Arguments<Real> arguments(p, options_, name_);
    struct Work {
      Arguments<Real>* arguments;
      VumatRoutine* routine;
    } work{&arguments, routine_};
    const auto once = [](void* data) {
      const auto* w = static_cast<Work*>(data);
      w->arguments->call(w->routine);
    };
    const bool returned = run_vumat(call, once, &work);
    if (!returned || !call.error.empty()) throw std::runtime_error(call.error);
    for (const int number : call.locks) host_.mutex(number).unlock();
    arguments.take_answer();
  }

  /// The calls that a database of the user's gets, when the first block of a time comes.
  template <class Real>
  void tell_external(VumatRun& call, const MaterialPoints& p) {
    const std::lock_guard<std::mutex> lock(external_mutex_);
    if (!started_) {
      tell<Real>(call, start_analysis, 0, p.step);
      tell<Real>(call, start_step, 0, p.step);
      started_ = true;
    }
    if (p.time <= last_time_) return;
    if (last_time_ > 0) tell<Real>(call, end_increment, last_time_, p.step);
    ++increment_;
    tell<Real>(call, setup_increment, p.time, p.step);
    tell<Real>(call, start_increment, p.time, p.step);
    last_time_ = p.time;
  }
  template <class Real>
  void tell(VumatRun& call, std::int32_t operation, double time, double step) {
    struct Work {
      ExternalRoutine* routine;
      std::int32_t operation;
      std::int32_t integers[8];  // nodes, elements, step, increment, status, write restart
      Real reals[4];             // total time, step time, step
    } work{external_,
           operation,
           {0, 0, 1, increment_},
           {static_cast<Real>(time), static_cast<Real>(time), static_cast<Real>(step)}};
    const auto once = [](void* data) {
      auto* w = static_cast<Work*>(data);
      const std::int32_t integer_count = 6, real_count = 3;
      w->routine(&w->operation, w->integers, &integer_count, w->reals, &real_count);
    };
    if (!run_vumat(call, once, &work)) throw std::runtime_error(call.error);
  }

  SharedLibrary library_;
  VumatOptions options_;
  VumatHost host_;
  VumatRoutine* routine_ = nullptr;
  ExternalRoutine* external_ = nullptr;
  std::array<char, kNameLength> name_{};
  std::mutex external_mutex_;
  bool started_ = false;
  double last_time_ = 0;
  std::int32_t increment_ = 0;
};

}  // namespace

void load_vumat(const std::string& library, const VumatOptions& options, UserMaterial& material) {
  keep_vumat_utilities();
  const auto vumat = std::make_shared<Vumat>(library, options);
  material.callback = [vumat, safe = material.thread_safe](const MaterialPoints& p) { (*vumat)(p, safe); };
  material.warnings = [vumat] { return vumat->said(); };
}

}  // namespace cdfp
