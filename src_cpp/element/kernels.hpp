/// The compiled work on a block, one function for each formulation and law, and one set for each instruction
/// set that the processor may have.
#pragma once

#include <array>

#include "element/block.hpp"

namespace cdfp {

enum class BlockKind : int {
  prism_elastic,
  prism_rate_dependent,
  hexahedron_elastic,
  hexahedron_rate_dependent,
  full_prism_elastic,
  full_prism_rate_dependent,
  full_elastic,
  full_rate_dependent,
  tetrahedron_elastic,
  tetrahedron_rate_dependent,
  prism_stored,
  hexahedron_stored,
  full_prism_stored,
  full_stored,
  tetrahedron_stored,
  wedge_elastic,
  wedge_rate_dependent,
  wedge_stored
};
inline constexpr int kBlockKinds = 18;

struct BlockKernel {
  int corners = 0;    ///< of an element
  int constants = 0;  ///< components an element
  int state = 0;
  /// Subtracts the internal forces from `force` and advances `state`, the block's own. Bit l of the answer:
  /// element l is critical.
  std::uint64_t (*add_force)(const BlockInput& block, const StepConstants& step, Lanes* state,
                             double* force) = nullptr;
  BlockEnergy (*energy)(const BlockInput& block) = nullptr;
  /// Bounds of omega^2 as deformed now, 1/s2, one a lane; `terms`: [row][the four StepTerms]
  /// [lane]. `omega_squared`: aligned as Lanes.
  void (*step_bound)(const BlockInput& block, const SingleLanes* terms, double* omega_squared) = nullptr;
  /// Mean Cauchy stress, Pa, of the elements whose bits are set (and of some beside them):
  /// [row][xx yy zz xy yz xz][lane].
  void (*stress)(const BlockInput& block, std::uint64_t elements, Lanes* stress) = nullptr;

  // Of stored kinds. `frames`: [row][3 x 3][lane], rows are the elements' axes; `points`: one an integration
  // point.
  int points = 0;
  /// Writes what a law is told of the deformation.
  void (*deform)(const BlockInput& block, const Lanes* frames, const UserPointArrays* points) = nullptr;
  /// Turns the law's stress into what `state` keeps, and adds the work done on the points.
  void (*take_stress)(const BlockInput& block, const Lanes* frames, const UserPointArrays* points,
                      Lanes* state) = nullptr;
};

struct Kernels {
  const char* name;
  std::array<BlockKernel, kBlockKinds> kinds;
};

extern const Kernels kKernelsBaseline;
#ifdef CDFP_HAS_X86_VARIANTS
extern const Kernels kKernelsAvx2;
extern const Kernels kKernelsAvx512;
#endif

/// Those of `choose_instruction_set`.
const Kernels& choose_kernels();

}  // namespace cdfp
