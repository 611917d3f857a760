/// The material points of a group of elements whose law is the user's: what is kept of them, and the calls.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "cdfp/model.hpp"
#include "core/archive.hpp"
#include "core/parallel.hpp"
#include "core/vec3.hpp"
#include "element/block.hpp"
#include "element/kernels.hpp"
#include "element/part_plan.hpp"

namespace cdfp {

class UserPoints {
 public:
  /// An undeformed element, in the order of the group's slots.
  struct Element {
    Index number;
    double length;  ///< m: cube root of its volume
    Mat3 axes;      ///< rows: those that its formulation uses
  };
  /// Where a corner of the element in a slot lies now.
  using CornerOf = std::function<const double*(std::size_t slot, int corner)>;

  /// `points`: integration points an element.
  UserPoints(const PartPlan& plan, int points, int corners, std::vector<Element> elements);

  struct Moduli {
    double youngs = 0, poisson = 0;
  };
  /// Calls the law for the first time, at time 0 with a tiny strain, and keeps its state. Returns the
  /// stiffest answer; 0 if none was that of an elastic solid.
  Moduli start(const CornerOf& corner_of);

  /// Calls the law for the step that ends at `time`, and leaves its stress in `state` as Stored keeps it.
  /// `inputs` and `states`: of each block, at its present positions. Throws `Error(diverged)` naming element,
  /// point, material and time when the law fails.
  void advance(const BlockKernel& kernel, double time, double step, const Threads& threads,
               const std::vector<BlockInput>& inputs, Lanes* state);

  /// Slots of the elements that the last step deleted.
  std::vector<std::size_t> take_deleted();

  void archive(Archive& a);

  // Means over an element's points.
  double mean_state(std::size_t slot, int state) const;
  bool is_deleted(std::size_t slot) const { return !gone_.empty() && gone_[slot] != 0; }

  const UserMaterial& law() const { return *plan_.user; }
  std::size_t memory() const { return store_.size() * sizeof(double); }

 private:
  /// What is kept of an integration point of a block's elements, before or after a step.
  struct Kept {
    double *stress, *state, *energy, *dissipated, *stretch, *gradient;
  };
  struct Scratch;

  std::size_t blocks() const { return first_of_block_.size() - 1; }
  int count(std::size_t block) const;
  Kept kept(std::size_t block, int point, int half);
  std::size_t half_size(int count) const;

  void advance_block(const BlockKernel& kernel, std::size_t block, double time, double step,
                     const BlockInput& input, Lanes* state);
  void call(Scratch& scratch, std::size_t block, int point, double time, double step, bool first);
  template <class Corner>
  void place(Scratch& scratch, std::size_t block, int point, Corner&& corner_of) const;
  void freeze_dead(Scratch& scratch, std::size_t block, int point);
  void bury_dead(std::size_t block, int point);
  void list_deleted(std::size_t block, Lanes* state);

  void set_guards(const Kept& kept, int count) const;
  void check_guards(const Kept& kept, std::size_t block, int point, double time) const;
  void check_finite(const Kept& kept, std::size_t block, int point, double time) const;
  void check_shape(const Scratch& scratch, std::size_t block, int point, double time) const;
  [[noreturn]] void fail(std::size_t slot, int point, double time, const std::string& what) const;

  PartPlan plan_;
  int points_, corners_;
  std::vector<Element> elements_;
  std::vector<Lanes> frames_;
  std::vector<std::size_t> first_of_block_;  ///< where each block's points start in `store_`
  std::vector<double> store_;
  int now_ = 0;                      ///< half that holds the last answers
  std::vector<std::uint8_t> alive_;  ///< (slots, points), if a state deletes
  std::vector<std::uint8_t> gone_;   ///< one a slot, if a state deletes
  std::vector<std::size_t> deleted_;
  std::mutex deleted_mutex_;
};

}  // namespace cdfp
