#include "core/instruction_set.hpp"

#include <cstdlib>
#include <string>

#include "cdfp/error.hpp"

namespace cdfp {

InstructionSet choose_instruction_set() {
  const char* wish = std::getenv("CDFP_ISA");
  const std::string name = wish ? wish : "";
  if (!name.empty() && name != "baseline" && name != "avx2" && name != "avx512") {
    throw Error(Status::bad_argument, "environment variable CDFP_ISA is '" + name +
                                          "'; it may be baseline, avx2 or avx512, or unset for the best");
  }
#ifdef CDFP_HAS_X86_VARIANTS
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  if ((name == "avx2" && !avx2) || (name == "avx512" && !avx512)) {
    throw Error(Status::bad_argument,
                "environment variable CDFP_ISA asks for " + name + ", which this processor lacks; unset it");
  }
  if (avx512 && (name.empty() || name == "avx512")) return InstructionSet::avx512;
  if (avx2 && (name.empty() || name == "avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

}  // namespace cdfp
