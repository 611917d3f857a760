#include "element/element_force.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/number_set.hpp"
#include "core/shares.hpp"
#include "element/element_blocks.hpp"
#include "element/one_point.hpp"
#include "element/single_element.hpp"
#include "element/wedge.hpp"
#include "material/stored.hpp"

namespace cdfp {

struct ElementForce::Blocks : ElementBlocks {
  explicit Blocks(const Model& model);

  void run(const Task& task, std::span<const double> position, std::span<double> force,
           std::span<const double> reference);
  bool has_moved(const BlockGroup& group, std::size_t block, std::span<const double> position,
                 std::span<const double> reference) const;
  void list_critical();

  std::vector<StepConstants> steps;         ///< one a group
  std::vector<std::uint64_t> critical_now;  ///< one a block, bit l: element l of the block
  std::vector<std::uint8_t> is_awake;       ///< one a block
  NumberSet critical_set;                   ///< void if no part cracks
  std::vector<Index> critical;
  std::vector<Mat3> critical_stress;
  std::vector<Index> deleted;  ///< by the last step of users' laws

  void remove(BlockGroup& group, std::size_t slot, std::span<const double> position);
  static void clear_stiffness(BlockGroup& group, std::size_t slot);
};

ElementForce::Blocks::Blocks(const Model& model)
    : ElementBlocks(model), steps(groups.size()), critical_now(block_count, 0), is_awake(block_count, 0) {
  if (std::any_of(groups.begin(), groups.end(), [](const BlockGroup& g) { return g.plan.cracks; })) {
    critical_set = NumberSet(static_cast<std::size_t>(element_count()));
  }
}

void ElementForce::Blocks::run(const Task& task, std::span<const double> position, std::span<double> force,
                               std::span<const double> reference) {
  BlockGroup& group = groups[task.group];
  for (auto block = static_cast<std::size_t>(task.first); block < static_cast<std::size_t>(task.last);
       ++block) {
    std::uint8_t& awake = is_awake[group.first_block + block];
    if (awake == 0) {
      // A user's law may have stress before anything moves.
      if (!reference.empty() && !group.user && !has_moved(group, block, position, reference)) continue;
      awake = 1;
    }
    critical_now[group.first_block + block] = group.kernel->add_force(
        group.input(block, position), steps[task.group], group.block_state(block), force.data());
  }
}

bool ElementForce::Blocks::has_moved(const BlockGroup& group, std::size_t block,
                                     std::span<const double> position,
                                     std::span<const double> reference) const {
  const auto corners = static_cast<std::size_t>(group.corners());
  const auto rows = static_cast<std::size_t>((group.count(block) + kLanes - 1) / kLanes);
  const std::int32_t* offsets = group.offsets.data() + block * kBlock * corners;
  for (std::size_t i = 0; i < rows * corners * kLanes; ++i) {
    const double *x = &position[offsets[i]], *x0 = &reference[offsets[i]];
    if (x[0] != x0[0] || x[1] != x0[1] || x[2] != x0[2]) return true;
  }
  return false;
}

/// A deleted element has neither stress nor hourglass stiffness, whose energy is lost, and does not bound the
/// step.
void ElementForce::Blocks::remove(BlockGroup& group, std::size_t slot, std::span<const double> position) {
  using host::Stored;
  const std::size_t row = slot / kLanes, lane = slot % kLanes;
  const double lost = hourglass_density(group, slot, position);
  Lanes* state = &group.state[row * static_cast<std::size_t>(group.kernel->state)];
  for (int point = 0; point < group.kernel->state / Stored::kState; ++point) {
    for (const int k : {Stored::kWork, Stored::kDissipated}) {
      state[point * Stored::kState + k].value[lane] += lost;
    }
  }
  clear_stiffness(group, slot);
  deleted.push_back(group.elements[slot]);
}

void ElementForce::Blocks::clear_stiffness(BlockGroup& group, std::size_t slot) {
  const std::size_t row = slot / kLanes, lane = slot % kLanes;
  Lanes* constants = &group.constants[row * static_cast<std::size_t>(group.kernel->constants)];
  const auto clear_hourglass = [&]<class Shape>(int count) {
    for (int i = 0; i < count; ++i) constants[Shape::kStiffness + i].value[lane] = 0;
  };
  if (group.kind == BlockKind::prism_stored) clear_hourglass.operator()<host::Prism>(3);
  if (group.kind == BlockKind::hexahedron_stored) clear_hourglass.operator()<host::Hexahedron>(3);
  if (group.kind == BlockKind::wedge_stored) clear_hourglass.operator()<host::Wedge>(2);
  for (int k = 0; k < 4; ++k) group.step_terms[4 * row + static_cast<std::size_t>(k)].value[lane] = 0;
}

/// Through a set of bits, so that any number of elements comes out ascending in linear time.
void ElementForce::Blocks::list_critical() {
  critical.clear();
  critical_set.clear();
  for (const BlockGroup& group : groups) {
    if (!group.plan.cracks) continue;
    for (std::size_t block = 0; block < group.blocks(); ++block) {
      for (std::uint64_t bits = critical_now[group.first_block + block]; bits; bits &= bits - 1) {
        critical_set.insert(
            group.elements[block * kBlock + static_cast<std::size_t>(std::countr_zero(bits))]);
      }
    }
  }
  critical_set.list(critical);
}

ElementForce::ElementForce(const Model& model) : blocks_(std::make_unique<Blocks>(model)) {}
ElementForce::~ElementForce() = default;

void ElementForce::add_mass(std::span<double> mass) const {
  for (Index e = 0; e < blocks_->element_count(); ++e) {
    const auto [g, slot] = blocks_->place(e);
    if (g == kNone) continue;
    const BlockGroup& group = blocks_->groups[g];
    const double of_element = cdfp::corner_mass(group, slot);
    const std::int32_t* offsets = group.corner_offsets(slot);
    for (int corner = 0; corner < group.corners(); ++corner) mass[offsets[corner * kLanes] / 3] += of_element;
  }
}

double ElementForce::corner_mass(Index element) const {
  const Blocks::Place place = blocks_->place(element);
  return place.group == kNone ? 0 : cdfp::corner_mass(blocks_->groups[place.group], place.slot);
}

std::span<const Index> ElementForce::first_corners() const {
  return blocks_->first_corner;
}

bool ElementForce::has_user_laws() const {
  return std::any_of(blocks_->groups.begin(), blocks_->groups.end(),
                     [](const BlockGroup& group) { return group.user != nullptr; });
}

std::span<const Index> ElementForce::advance_user_laws(std::span<const double> position, double time,
                                                       double step, const Threads& threads) {
  blocks_->deleted.clear();
  std::vector<BlockInput> inputs;
  for (BlockGroup& group : blocks_->groups) {
    if (!group.user) continue;
    inputs.clear();
    for (std::size_t block = 0; block < group.blocks(); ++block)
      inputs.push_back(group.input(block, position));
    group.user->advance(*group.kernel, time, step, threads, inputs, group.state.data());
    for (const std::size_t slot : group.user->take_deleted()) blocks_->remove(group, slot, position);
  }
  std::sort(blocks_->deleted.begin(), blocks_->deleted.end());
  return blocks_->deleted;
}

ElementForce::Elasticity ElementForce::shown_elasticity(Index part) const {
  for (const BlockGroup& group : blocks_->groups) {
    if (group.part != part) continue;
    const MaterialConstants& m = group.plan.constants.material;
    return {m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu), m.lambda / (2 * (m.lambda + m.mu))};
  }
  return {};
}

double ElementForce::mean_state(Index element, int state) const {
  const Blocks::Place place = blocks_->place(element);
  const UserPoints* user = place.group == kNone ? nullptr : blocks_->groups[place.group].user.get();
  if (!user || state >= user->law().states) return std::numeric_limits<double>::quiet_NaN();
  return user->mean_state(place.slot, state);
}

void ElementForce::add_force(std::span<const double> position, std::span<double> force, double step,
                             const Threads& threads, std::span<const double> reference) {
  Blocks& b = *blocks_;
  for (std::size_t g = 0; g < b.groups.size(); ++g) {
    const PartPlan& plan = b.groups[g].plan;
    const bool flows = plan.rate_dependent && step > 0;
    b.steps[g] = flows ? StepConstants{1 / step, -std::expm1(-step / plan.smoothing_time)} : StepConstants{};
  }
  if (threads.count() == 1) {
    for (const std::vector<Blocks::Task>& tasks : b.colours) {
      for (const Blocks::Task& task : tasks) b.run(task, position, force, reference);
    }
  } else {
    std::vector<Shares> shares;
    for (const std::vector<Blocks::Task>& tasks : b.colours)
      shares.emplace_back(threads.count()).refill(std::ssize(tasks));
#pragma omp parallel num_threads(threads.count())
    for (std::size_t c = 0; c < b.colours.size(); ++c) {
      const int thread = omp_get_thread_num();
      for (std::int64_t i = shares[c].next(thread); i != Shares::kNothing; i = shares[c].next(thread))
        b.run(b.colours[c][static_cast<std::size_t>(i)], position, force, reference);
#pragma omp barrier
    }
  }
  if (!b.critical_set.is_void()) b.list_critical();
}

std::span<const Index> ElementForce::critical_elements() const {
  return blocks_->critical;
}

std::span<const Mat3> ElementForce::last_critical_stresses() const {
  return blocks_->critical_stress;
}

std::span<const Mat3> ElementForce::critical_stresses(std::span<const double> position,
                                                      const Threads& threads) {
  Blocks& b = *blocks_;
  b.critical_stress.resize(b.critical.size());
  if (b.critical.empty()) return {};
  for (const BlockGroup& group : b.groups) {
    if (!group.plan.cracks) continue;
    threads.deal_ranges(
        static_cast<std::int64_t>(group.blocks()), 8, [&](std::int64_t begin, std::int64_t end) {
          std::array<Lanes, 6 * kRows> stress;
          for (auto block = static_cast<std::size_t>(begin); block < static_cast<std::size_t>(end); ++block) {
            const std::uint64_t elements = b.critical_now[group.first_block + block];
            if (elements == 0) continue;
            group.kernel->stress(group.input(block, position), elements, stress.data());
            for (std::uint64_t bits = elements; bits; bits &= bits - 1) {
              const auto slot = static_cast<std::size_t>(std::countr_zero(bits));
              const auto s = [&](std::size_t k) {
                return stress[6 * (slot / kLanes) + k].value[slot % kLanes];
              };
              b.critical_stress[b.critical_set.place(group.elements[block * kBlock + slot])] = {
                  {Vec3{s(0), s(3), s(5)}, Vec3{s(3), s(1), s(4)}, Vec3{s(5), s(4), s(2)}}};
            }
          }
        });
  }
  return b.critical_stress;
}

void ElementForce::set_least_strength(Index part, double strength) {
  for (BlockGroup& group : blocks_->groups) {
    if (group.part == part && group.plan.cracks) cdfp::set_least_strength(group.plan, strength);
  }
}

Mat3 ElementForce::stress(Index element, std::span<const double> position) const {
  const Blocks::Place place = blocks_->place(element);
  if (place.group == kNone) return {};
  return element_stress(blocks_->groups[place.group], place.slot, position);
}

void ElementForce::corner_force(Index element, std::span<const double> position,
                                std::span<double> force) const {
  const Blocks::Place place = blocks_->place(element);
  if (place.group == kNone) {
    std::fill(force.begin(), force.end(), 0.0);
    return;
  }
  element_force(blocks_->groups[place.group], place.slot, position, force);
}

void ElementForce::replace_node(Index element, Index corner, Index node) {
  const auto [group, slot] = blocks_->place(element);
  if (group != kNone) blocks_->groups[group].corner_offsets(slot)[corner * kLanes] = 3 * node;
}

StepBounds ElementForce::stable_steps(std::span<const double> position, const Threads& threads,
                                      std::span<const double> springs) const {
  const Blocks& b = *blocks_;
  struct Highest {
    double omega_squared = 0;
    Index element = kNone;

    /// A value that is not a number stays.
    void take(double value, Index of) {
      if (!(value <= omega_squared) && !std::isnan(omega_squared)) omega_squared = value, element = of;
    }
    StepBound bound() const { return {2 / std::sqrt(omega_squared), element}; }
  };
  struct Both {
    Highest alone, with_springs;
  };
  std::vector<Both> of_block(b.block_count);
  for (const BlockGroup& group : b.groups) {
    threads.for_each(static_cast<std::int64_t>(group.blocks()), [&](std::int64_t i) {
      const auto block = static_cast<std::size_t>(i);
      alignas(Lanes) double omega_squared[kBlock];
      group.kernel->step_bound(group.input(block, position), &group.step_terms[4 * kRows * block],
                               omega_squared);
      Both& highest = of_block[group.first_block + block];
      for (int lane = 0; lane < group.count(block); ++lane) {
        const std::size_t slot = block * kBlock + static_cast<std::size_t>(lane);
        double stiffest = 0;
        if (!springs.empty()) {
          const std::int32_t* offsets = group.corner_offsets(slot);
          for (int corner = 0; corner < group.corners(); ++corner) {
            stiffest = std::max(stiffest, springs[offsets[corner * kLanes] / 3]);
          }
        }
        highest.alone.take(omega_squared[lane], group.elements[slot]);
        highest.with_springs.take(omega_squared[lane] + stiffest, group.elements[slot]);
      }
    });
  }
  Both highest;
  for (const Both& h : of_block) {
    highest.alone.take(h.alone.omega_squared, h.alone.element);
    highest.with_springs.take(h.with_springs.omega_squared, h.with_springs.element);
  }
  return {highest.alone.bound(), highest.with_springs.bound()};
}

std::vector<PartEnergy> ElementForce::energies(std::span<const double> position,
                                               const Threads& threads) const {
  const Blocks& b = *blocks_;
  std::vector<PartEnergy> parts(b.part_count);
  std::vector<BlockEnergy> of_block;
  for (const BlockGroup& group : b.groups) {
    of_block.resize(group.blocks());
    threads.for_each(static_cast<std::int64_t>(group.blocks()), [&](std::int64_t block) {
      of_block[block] = group.kernel->energy(group.input(static_cast<std::size_t>(block), position));
    });
    PartEnergy& part = parts[group.part];
    for (const BlockEnergy& energy : of_block) {
      part.strain += energy.strain;
      part.hourglass += energy.hourglass;
      part.dissipated += energy.dissipated;
    }
  }
  return parts;
}

Index ElementForce::first_inverted(std::span<const double> position) const {
  for (Index e = 0; e < blocks_->element_count(); ++e) {
    const Blocks::Place place = blocks_->place(e);
    if (place.group == kNone) continue;
    const double volume = element_volume(blocks_->groups[place.group], place.slot, position);
    if (!(volume > 0) || !std::isfinite(volume)) return e;
  }
  return kNone;
}

void ElementForce::archive(Archive& a) {
  Blocks& b = *blocks_;
  for (BlockGroup& group : b.groups) {
    a.require_same("elements.components", group.state.size());
    a("elements.state", group.state);
    if (!group.user) continue;
    group.user->archive(a);
    for (std::size_t slot = 0; a.reads() && slot < group.elements.size(); ++slot) {
      if (group.user->is_deleted(slot)) Blocks::clear_stiffness(group, slot);
    }
  }
  a.require_same("elements.blocks", b.block_count);
  a("elements.awake", b.is_awake);
  a("elements.critical", b.critical_now);
  a("elements.critical_stress", b.critical_stress);
  if (a.reads() && !b.critical_set.is_void()) b.list_critical();
}

std::size_t ElementForce::memory() const {
  const Blocks& b = *blocks_;
  const auto count = static_cast<std::size_t>(b.element_count());
  std::size_t bytes = 2 * count * sizeof(Index);  // slots and first corners
  for (const BlockGroup& group : b.groups) {
    bytes += group.elements.size() * sizeof(Index) + group.offsets.size() * sizeof(std::int32_t);
    bytes += (group.constants.size() + group.state.size()) * sizeof(Lanes);
    bytes += group.step_terms.size() * sizeof(SingleLanes);
    if (group.user) bytes += group.user->memory();
  }
  return count == 0 ? 0 : bytes / count;
}

}  // namespace cdfp
