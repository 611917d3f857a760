#include "core/instruction_set.hpp"
#include "element/kernels.hpp"

namespace cdfp {

const Kernels& choose_kernels() {
  switch (choose_instruction_set()) {
#ifdef CDFP_HAS_X86_VARIANTS
    case InstructionSet::avx512:
      return kKernelsAvx512;
    case InstructionSet::avx2:
      return kKernelsAvx2;
#endif
    default:
      return kKernelsBaseline;
  }
}

}  // namespace cdfp
