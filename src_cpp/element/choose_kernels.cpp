#include <cstdlib>
#include <string>

#include "cdfp/error.hpp"
#include "element/kernels.hpp"

namespace cdfp {

const Kernels& choose_kernels() {
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
  if (avx512 && (name.empty() || name == "avx512")) return kKernelsAvx512;
  if (avx2 && (name.empty() || name == "avx2")) return kKernelsAvx2;
#endif
  return kKernelsBaseline;
}

}  // namespace cdfp
