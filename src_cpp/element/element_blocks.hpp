/// The elements of a model sorted into blocks, with all that is kept of them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cdfp/model.hpp"
#include "core/parallel.hpp"
#include "element/block.hpp"
#include "element/geometry.hpp"
#include "element/kernels.hpp"
#include "element/part_plan.hpp"
#include "element/user_points.hpp"

namespace cdfp {

/// All elements of one part and kind. An element's slot is its number in here: slot / kBlock is its block,
/// slot / kLanes its row, slot % kLanes its lane. Arrays are [row][component][lane].
struct BlockGroup {
  BlockKind kind;
  const BlockKernel* kernel;
  Index part;
  PartPlan plan;
  std::size_t first_block;      ///< among the blocks of all groups
  std::vector<Index> elements;  ///< of each slot; lanes of the last block may be idle
  std::vector<Lanes> constants, state;
  std::vector<SingleLanes> step_terms;  ///< four a row, rounded up
  std::vector<std::int32_t> offsets;    ///< [row][corner][lane], 3 * node
  std::unique_ptr<UserPoints> user;     ///< of a user's law

  int corners() const { return kernel->corners; }

  std::size_t blocks() const { return (elements.size() + kBlock - 1) / kBlock; }
  int count(std::size_t block) const {
    return static_cast<int>(std::min<std::size_t>(kBlock, elements.size() - block * kBlock));
  }
  BlockInput input(std::size_t block, std::span<const double> position) const {
    return {constants.data() + block * kRows * static_cast<std::size_t>(kernel->constants),
            offsets.data() + block * kBlock * static_cast<std::size_t>(corners()),
            state.data() + block * kRows * static_cast<std::size_t>(kernel->state),
            count(block),
            &plan.constants,
            position.data()};
  }
  Lanes* block_state(std::size_t block) {
    return state.data() + block * kRows * static_cast<std::size_t>(kernel->state);
  }
  std::int32_t* corner_offsets(std::size_t slot) {
    return offsets.data() + slot / kLanes * static_cast<std::size_t>(corners()) * kLanes + slot % kLanes;
  }
  const std::int32_t* corner_offsets(std::size_t slot) const {
    return const_cast<BlockGroup*>(this)->corner_offsets(slot);
  }
};

struct ElementBlocks {
  struct Place {
    std::int32_t group;  ///< kNone: of a rigid part
    std::size_t slot;
  };
  /// Neighbouring blocks that one thread works on in turn, so that their shared nodes stay in its cache.
  struct Task {
    std::int32_t group;
    std::int32_t first, last;  ///< blocks
  };

  explicit ElementBlocks(const Model& model);

  Index element_count() const { return static_cast<Index>(slots_.size()); }
  Place place(Index element) const;

  const Kernels& kernels = choose_kernels();
  std::vector<BlockGroup> groups;
  std::vector<Index> first_corner;         ///< of each element in the mesh's connectivity, and the end
  std::vector<std::vector<Task>> colours;  ///< tasks of one colour share no node
  std::size_t block_count = 0;
  std::size_t part_count = 0;

 private:
  void sort_into_groups(const Model& model, const Threads& threads);
  void start_user_law(BlockGroup& group, const Mesh& mesh);
  void fill(BlockGroup& group, const Mesh& mesh, const Threads& threads) const;
  void tighten_step_terms(const Mesh& mesh);
  void colour_tasks(const Mesh& mesh);

  std::vector<Index> slots_;  ///< of each element, counted through all blocks of all groups; kNone: rigid
  std::size_t blocks_a_task_ = 1;
};

}  // namespace cdfp
