#include "element/user_points.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>

#include "cdfp/error.hpp"
#include "core/numbered.hpp"
#include "material/stored.hpp"

namespace cdfp {

namespace {

/// Strain of the first call: both of volume and of shape, far below any yield, and large enough for single
/// precision.
constexpr double kTinyStrain[6] = {1e-5, -0.3e-5, 0.5e-5, 0.4e-5, -0.2e-5, 0.3e-5};
constexpr double kSoundSpeed = 5000;  ///< m/s, that the step of the first call is for
constexpr int kTensor = 6, kGradient = 9, kVector = 3;

// Words after what a law may write: one component after stress and energies, several after the states.
constexpr std::uint64_t kGuard = 0x7ff4dead5afe0000;  // a signalling NaN that no arithmetic makes
constexpr int kGuardsOfStress = 1, kGuardsOfStates = 4, kGuardsOfEnergy = 1;
constexpr std::size_t kPadding = 8;

constexpr const char* kComponents[6] = {"11", "22", "33", "12", "23", "31"};

bool all_guards(const double* first, std::size_t n) {
  return std::all_of(first, first + n, [](double d) { return std::bit_cast<std::uint64_t>(d) == kGuard; });
}

double norm_of(const double* a, std::size_t stride) {
  double sum = 0;
  for (std::size_t k = 0; k < 6; ++k) sum += (k < 3 ? 1 : 2) * a[k * stride] * a[k * stride];
  return std::sqrt(sum);
}

void set_identity(double* components, std::size_t n) {
  for (std::size_t i = 0; i < 3 * n; ++i) components[i] = 1;
}

}  // namespace

/// What a block's calls need for their length alone.
struct UserPoints::Scratch {
  explicit Scratch(int points, int count) : n(static_cast<std::size_t>(count)) {
    values.assign(static_cast<std::size_t>(points) * kPerPoint * n + kPadding, 0.0);
  }
  double* at(int point, int component) {
    return values.data() +
           (static_cast<std::size_t>(point) * kPerPoint + static_cast<std::size_t>(component)) * n;
  }
  const double* at(int point, int component) const {
    return const_cast<Scratch*>(this)->at(point, component);
  }

  static constexpr int kRotation = 0, kStrain = 9, kSpin = 15, kDensity = 18, kStiffness = 19, kPosition = 20;
  static constexpr int kLength = 23;
  static constexpr std::size_t kPerPoint = 24;

  std::size_t n;
  std::vector<double> values;
};

UserPoints::UserPoints(const PartPlan& plan, int points, int corners, std::vector<Element> elements)
    : plan_(plan), points_(points), corners_(corners), elements_(std::move(elements)) {
  const std::size_t slots = elements_.size();
  const std::size_t block_count = (slots + kBlock - 1) / kBlock;
  frames_.resize(block_count * kRows * 9);
  for (std::size_t slot = 0; slot < block_count * kBlock; ++slot) {
    const Mat3& axes = elements_[std::min(slot, slots - 1)].axes;
    for (std::size_t i = 0; i < 9; ++i) {
      frames_[slot / kLanes * 9 + i].value[slot % kLanes] =
          axes(static_cast<int>(i / 3), static_cast<int>(i % 3));
    }
  }
  first_of_block_.push_back(0);
  for (std::size_t block = 0; block < block_count; ++block) {
    const auto here = static_cast<int>(std::min<std::size_t>(kBlock, slots - block * kBlock));
    first_of_block_.push_back(first_of_block_.back() +
                              2 * half_size(here) * static_cast<std::size_t>(points_));
  }
  store_.assign(first_of_block_.back() + kPadding, 0.0);
  for (std::size_t block = 0; block < block_count; ++block) {
    const auto n = static_cast<std::size_t>(count(block));
    for (int point = 0; point < points_; ++point) {
      for (int half = 0; half < 2; ++half) {
        const Kept k = kept(block, point, half);
        set_guards(k, count(block));
        set_identity(k.stretch, n);
        set_identity(k.gradient, n);
        if (law().deletion_state >= 0) {
          std::fill_n(k.state + static_cast<std::size_t>(law().deletion_state) * n, n, 1.0);
        }
      }
    }
  }
  if (law().deletion_state >= 0) {
    alive_.assign(slots * static_cast<std::size_t>(points_), 1);
    gone_.assign(slots, 0);
  }
}

int UserPoints::count(std::size_t block) const {
  return static_cast<int>(std::min<std::size_t>(kBlock, elements_.size() - block * kBlock));
}

std::size_t UserPoints::half_size(int count) const {
  const int components =
      kTensor + kGuardsOfStress + law().states + kGuardsOfStates + 2 + kGuardsOfEnergy + kTensor + kGradient;
  return static_cast<std::size_t>(components) * static_cast<std::size_t>(count);
}

UserPoints::Kept UserPoints::kept(std::size_t block, int point, int half) {
  const auto n = static_cast<std::size_t>(count(block));
  double* at =
      store_.data() + first_of_block_[block] +
      (2 * static_cast<std::size_t>(point) + static_cast<std::size_t>(half)) * half_size(count(block));
  const auto next = [&](int components) {
    double* first = at;
    at += static_cast<std::size_t>(components) * n;
    return first;
  };
  Kept k{};
  k.stress = next(kTensor + kGuardsOfStress);
  k.state = next(law().states + kGuardsOfStates);
  k.energy = next(1);
  k.dissipated = next(1 + kGuardsOfEnergy);
  k.stretch = next(kTensor);
  k.gradient = next(kGradient);
  return k;
}

void UserPoints::set_guards(const Kept& k, int count) const {
  const auto n = static_cast<std::size_t>(count);
  const auto guard = std::bit_cast<double>(kGuard);
  std::fill_n(k.stress + kTensor * n, kGuardsOfStress * n, guard);
  std::fill_n(k.state + static_cast<std::size_t>(law().states) * n, kGuardsOfStates * n, guard);
  std::fill_n(k.dissipated + n, kGuardsOfEnergy * n, guard);
}

void UserPoints::fail(std::size_t slot, int point, double time, const std::string& what) const {
  char when[64];
  std::snprintf(when, sizeof when, " at time %.6g us", 1e6 * time);
  throw Error(Status::diverged, "material '" + plan_.material + "', element " +
                                    numbered(elements_[slot].number) + " (part '" + plan_.part +
                                    "'), point " + numbered(point) + when + ": " + what);
}

void UserPoints::check_guards(const Kept& k, std::size_t block, int point, double time) const {
  const auto n = static_cast<std::size_t>(count(block));
  const auto states = static_cast<std::size_t>(law().states);
  const std::string where = ", in a block that starts with this element; ";
  if (!all_guards(k.state + states * n, kGuardsOfStates * n)) {
    fail(block * kBlock, point, time,
         "the law wrote past its " + std::to_string(states) + " state variables" + where +
             "declare as many as it uses");
  }
  if (!all_guards(k.stress + kTensor * n, kGuardsOfStress * n) ||
      !all_guards(k.dissipated + n, kGuardsOfEnergy * n)) {
    fail(block * kBlock, point, time,
         "the law wrote past the end of its stresses or energies" + where +
             "check its array bounds: (count, 6) and (count)");
  }
}

void UserPoints::check_finite(const Kept& k, std::size_t block, int point, double time) const {
  const auto n = static_cast<std::size_t>(count(block));
  const auto check = [&](const double* values, std::size_t components, auto&& name) {
    for (std::size_t i = 0; i < components * n; ++i) {
      if (std::isfinite(values[i])) continue;
      fail(
          block * kBlock + i % n, point, time,
          "the law gave a number that is not finite: " + name(i / n) +
              "; check it for divisions by zero, roots and logarithms of negative numbers, and that it fills "
              "the whole block");
    }
  };
  check(k.stress, kTensor, [](std::size_t c) { return std::string("stress ") + kComponents[c]; });
  check(k.state, static_cast<std::size_t>(law().states),
        [](std::size_t c) { return "state " + std::to_string(c + 1); });
  check(k.energy, 1, [](std::size_t) { return std::string("internal energy"); });
  check(k.dissipated, 1, [](std::size_t) { return std::string("dissipated energy"); });
}

void UserPoints::check_shape(const Scratch& scratch, std::size_t block, int point, double time) const {
  const double* density = scratch.at(point, Scratch::kDensity);
  for (std::size_t i = 0; i < scratch.n; ++i) {
    if (!(density[i] > 0) || !std::isfinite(density[i])) {
      fail(block * kBlock + i, point, time,
           "the element is inverted or its nodes are not finite; take a smaller step or a stiffer law");
    }
  }
}

template <class Corner>
void UserPoints::place(Scratch& scratch, std::size_t block, int point, Corner&& corner_of) const {
  const double at = points_ > 1 ? 1 / std::sqrt(3.0) : 0;
  const double place[3] = {point & 1 ? at : -at, point & 2 ? at : -at, point & 4 ? at : -at};
  static constexpr int kSigns[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                       {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  double weight[8];
  for (int c = 0; c < corners_; ++c) {
    weight[c] = 1.0 / corners_;
    for (int axis = 0; axis < 3 && corners_ == 8; ++axis) weight[c] *= 1 + kSigns[c][axis] * place[axis];
    if (corners_ == 6) weight[c] *= 1 + (c < 3 ? -1 : 1) * (point == 0 ? -at : at);
  }
  for (std::size_t i = 0; i < scratch.n; ++i) {
    const std::size_t slot = block * kBlock + i;
    Vec3 x;
    for (int c = 0; c < corners_; ++c) x += weight[c] * Vec3::load(corner_of(slot, c));
    for (int d = 0; d < 3; ++d) scratch.at(point, Scratch::kPosition + d)[i] = x[d];
    scratch.at(point, Scratch::kLength)[i] = elements_[slot].length;
  }
}

/// The law's answer for the step from half `now_` to the other one.
void UserPoints::call(Scratch& scratch, std::size_t block, int point, double time, double step, bool first) {
  const Kept old = kept(block, point, now_), next = kept(block, point, 1 - now_);
  const std::size_t n = scratch.n, states = static_cast<std::size_t>(law().states);
  std::copy_n(old.stress, kTensor * n, next.stress);
  std::copy_n(old.state, states * n, next.state);
  std::copy_n(old.energy, n, next.energy);
  std::copy_n(old.dissipated, n, next.dissipated);
  std::array<std::int32_t, kBlock> numbers{};
  for (std::size_t i = 0; i < n; ++i) numbers[i] = elements_[block * kBlock + i].number;
  std::int64_t failed = -1;
  std::array<char, 512> message{};

  MaterialPoints points{};
  points.count = static_cast<std::int64_t>(n);
  points.point = point;
  points.start = first;
  points.state_count = law().states;
  points.property_count = static_cast<std::int32_t>(law().properties.size());
  points.time = time;
  points.step = step;
  points.properties = law().properties.data();
  points.elements = numbers.data();
  points.position = scratch.at(point, Scratch::kPosition);
  points.length = scratch.at(point, Scratch::kLength);
  points.density = scratch.at(point, Scratch::kDensity);
  points.strain_increment = scratch.at(point, Scratch::kStrain);
  points.spin_increment = scratch.at(point, Scratch::kSpin);
  points.stretch_old = old.stretch;
  points.stretch = next.stretch;
  points.gradient_old = old.gradient;
  points.gradient = next.gradient;
  points.rotation = scratch.at(point, Scratch::kRotation);
  points.stress_old = old.stress;
  points.state_old = old.state;
  points.energy_old = old.energy;
  points.dissipated_old = old.dissipated;
  points.stress = next.stress;
  points.state = next.state;
  points.energy = next.energy;
  points.dissipated = next.dissipated;
  points.stiffness = scratch.at(point, Scratch::kStiffness);
  points.failed = &failed;
  points.message = message.data();
  points.message_capacity = static_cast<std::int64_t>(message.size());
  try {
    law().callback(points);
  } catch (const std::exception& error) {
    fail(block * kBlock, point, time,
         std::string(error.what()) + " (in a block that starts with this element)");
  }
  check_guards(next, block, point, time);
  if (failed >= 0) {
    message.back() = '\0';
    const std::size_t lane = std::min(static_cast<std::size_t>(failed), n - 1);
    fail(block * kBlock + lane, point, time,
         message.front() ? message.data() : "the law gave up without a message");
  }
  check_finite(next, block, point, time);
}

UserPoints::Moduli UserPoints::start(const CornerOf& corner_of) {
  double least = std::numeric_limits<double>::infinity();
  for (const Element& e : elements_) least = std::min(least, e.length);
  const double step = least / kSoundSpeed;
  double bulk = 0, shear = 0;
  const double trace = kTinyStrain[0] + kTinyStrain[1] + kTinyStrain[2];
  double deviator[6];
  for (int k = 0; k < 6; ++k) deviator[k] = kTinyStrain[k] - (k < 3 ? trace / 3 : 0);
  for (std::size_t block = 0; block < blocks(); ++block) {
    Scratch scratch(points_, count(block));
    const std::size_t n = scratch.n;
    for (int point = 0; point < points_; ++point) {
      place(scratch, block, point, corner_of);
      const Kept old = kept(block, point, now_), next = kept(block, point, 1 - now_);
      set_identity(scratch.at(point, Scratch::kRotation), n);
      for (std::size_t k = 0; k < kTensor; ++k) {
        std::fill_n(scratch.at(point, Scratch::kStrain) + k * n, n, kTinyStrain[k]);
        std::fill_n(next.stretch + k * n, n, (k < 3) + kTinyStrain[k]);
        std::fill_n(next.gradient + k * n, n, (k < 3) + kTinyStrain[k]);
      }
      for (std::size_t k = 3; k < kTensor; ++k) std::fill_n(next.gradient + (k + 3) * n, n, kTinyStrain[k]);
      std::fill_n(scratch.at(point, Scratch::kDensity), n, law().density / (1 + trace));
      call(scratch, block, point, 0, step, true);
      for (std::size_t i = 0; i < n; ++i) {
        const double* s = next.stress + i;
        const double mean = (s[0] + s[n] + s[2 * n]) / 3;
        double shape[6];
        for (std::size_t k = 0; k < 6; ++k) shape[k] = s[k * n] - (k < 3 ? mean : 0);
        bulk = std::max(bulk, mean / trace);
        shear = std::max(shear, norm_of(shape, 1) / norm_of(deviator, 1) / 2);
      }
      std::copy_n(next.state, static_cast<std::size_t>(law().states) * n, old.state);
      if (law().deletion_state >= 0) {
        std::fill_n(old.state + static_cast<std::size_t>(law().deletion_state) * n, n, 1.0);
      }
      std::fill_n(next.gradient, kGradient * n, 0.0);
      set_identity(next.gradient, n);
    }
  }
  if (!(bulk > 0) || !(shear > 0)) return {};
  return {9 * bulk * shear / (3 * bulk + shear),
          std::clamp((3 * bulk - 2 * shear) / (6 * bulk + 2 * shear), -0.99, 0.4999)};
}

/// Points that were deleted stand still and answer nothing.
void UserPoints::freeze_dead(Scratch& scratch, std::size_t block, int point) {
  const Kept old = kept(block, point, now_), next = kept(block, point, 1 - now_);
  const std::size_t n = scratch.n;
  const auto clear = [&](int first, std::size_t components, std::size_t i) {
    for (std::size_t k = 0; k < components; ++k) scratch.at(point, first)[k * n + i] = 0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (alive_[(block * kBlock + i) * static_cast<std::size_t>(points_) + static_cast<std::size_t>(point)])
      continue;
    for (std::size_t k = 0; k < kTensor; ++k) next.stretch[k * n + i] = old.stretch[k * n + i];
    for (std::size_t k = 0; k < kGradient; ++k) next.gradient[k * n + i] = old.gradient[k * n + i];
    clear(Scratch::kStrain, kTensor, i);
    clear(Scratch::kSpin, kVector, i);
    clear(Scratch::kRotation, kGradient, i);
    for (int d = 0; d < 3; ++d) scratch.at(point, Scratch::kRotation + d)[i] = 1;
    scratch.at(point, Scratch::kDensity)[i] = law().density;
  }
}

void UserPoints::bury_dead(std::size_t block, int point) {
  const Kept old = kept(block, point, now_), next = kept(block, point, 1 - now_);
  const auto n = static_cast<std::size_t>(count(block));
  for (std::size_t i = 0; i < n; ++i) {
    std::uint8_t& alive =
        alive_[(block * kBlock + i) * static_cast<std::size_t>(points_) + static_cast<std::size_t>(point)];
    if (alive && next.state[static_cast<std::size_t>(law().deletion_state) * n + i] != 0) continue;
    if (!alive) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(law().states); ++k) {
        next.state[k * n + i] = old.state[k * n + i];
      }
      next.energy[i] = old.energy[i];
      next.dissipated[i] = old.dissipated[i];
    }
    alive = 0;
    for (std::size_t k = 0; k < kTensor; ++k) next.stress[k * n + i] = 0;
  }
}

/// What is left of the energy of deleted points has gone with them.
void UserPoints::list_deleted(std::size_t block, Lanes* state) {
  using host::Stored;
  for (int i = 0; i < count(block); ++i) {
    const std::size_t slot = block * kBlock + static_cast<std::size_t>(i);
    bool any_alive = false;
    for (int point = 0; point < points_; ++point) {
      const bool alive =
          alive_[slot * static_cast<std::size_t>(points_) + static_cast<std::size_t>(point)] != 0;
      any_alive = any_alive || alive;
      if (alive) continue;
      Lanes* here = state + (i / kLanes * points_ + point) * Stored::kState;
      here[Stored::kDissipated].value[i % kLanes] = here[Stored::kWork].value[i % kLanes];
    }
    if (any_alive || gone_[slot]) continue;
    gone_[slot] = 1;
    const std::lock_guard<std::mutex> lock(deleted_mutex_);
    deleted_.push_back(slot);
  }
}

void UserPoints::advance_block(const BlockKernel& kernel, std::size_t block, double time, double step,
                               const BlockInput& input, Lanes* state) {
  Scratch scratch(points_, count(block));
  std::array<UserPointArrays, 8> arrays{};
  for (int point = 0; point < points_; ++point) {
    const Kept old = kept(block, point, now_), next = kept(block, point, 1 - now_);
    arrays[static_cast<std::size_t>(point)] = {old.stretch,
                                               next.stretch,
                                               next.gradient,
                                               scratch.at(point, Scratch::kRotation),
                                               scratch.at(point, Scratch::kStrain),
                                               scratch.at(point, Scratch::kSpin),
                                               scratch.at(point, Scratch::kDensity),
                                               next.stress,
                                               next.dissipated,
                                               scratch.at(point, Scratch::kStiffness)};
  }
  const Lanes* frames = &frames_[block * kRows * 9];
  kernel.deform(input, frames, arrays.data());
  const auto corner_of = [&](std::size_t slot, int corner) {
    const std::size_t lane = slot % kBlock;
    return input.position + input.offsets[(lane / kLanes * static_cast<std::size_t>(corners_) +
                                           static_cast<std::size_t>(corner)) *
                                              kLanes +
                                          lane % kLanes];
  };
  for (int point = 0; point < points_; ++point) {
    if (!alive_.empty()) freeze_dead(scratch, block, point);
    check_shape(scratch, block, point, time);
    place(scratch, block, point, corner_of);
    call(scratch, block, point, time, step, false);
    if (!alive_.empty()) bury_dead(block, point);
  }
  kernel.take_stress(input, frames, arrays.data(), state);
  if (!alive_.empty()) list_deleted(block, state);
}

void UserPoints::advance(const BlockKernel& kernel, double time, double step, const Threads& threads,
                         const std::vector<BlockInput>& inputs, Lanes* state) {
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t failed_block = blocks();
  const auto work = [&](std::int64_t b) {
    const auto block = static_cast<std::size_t>(b);
    try {
      advance_block(kernel, block, time, step, inputs[block],
                    state + block * kRows * static_cast<std::size_t>(kernel.state));
    } catch (const std::exception&) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (block < failed_block) failed_block = block, failure = std::current_exception();
    }
  };
  const auto n = static_cast<std::int64_t>(blocks());
  if (law().thread_safe) {
    threads.for_each(n, work);
  } else {
    for (std::int64_t b = 0; b < n && !failure; ++b) work(b);
  }
  if (failure) std::rethrow_exception(failure);
  now_ = 1 - now_;
}

void UserPoints::archive(Archive& a) {
  a.require_same("user_points.store", store_.size());
  a("user_points.values", store_);
  a("user_points.half", now_);
  a("user_points.alive", alive_);
  a("user_points.gone", gone_);
}

std::vector<std::size_t> UserPoints::take_deleted() {
  std::vector<std::size_t> slots;
  slots.swap(deleted_);
  std::sort(slots.begin(), slots.end());
  return slots;
}

double UserPoints::mean_state(std::size_t slot, int state) const {
  const std::size_t block = slot / kBlock, n = static_cast<std::size_t>(count(block));
  double sum = 0;
  for (int point = 0; point < points_; ++point) {
    const Kept k = const_cast<UserPoints*>(this)->kept(block, point, now_);
    sum += k.state[static_cast<std::size_t>(state) * n + slot % kBlock];
  }
  return sum / points_;
}

}  // namespace cdfp
