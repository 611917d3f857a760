#include "contact/search_kernels.hpp"
#include "core/instruction_set.hpp"

namespace cdfp {

const SearchKernels& choose_search_kernels() {
  switch (choose_instruction_set()) {
#ifdef CDFP_HAS_X86_VARIANTS
    case InstructionSet::avx512:
      return kSearchAvx512;
    case InstructionSet::avx2:
      return kSearchAvx2;
#endif
    default:
      return kSearchBaseline;
  }
}

}  // namespace cdfp
