#define CDFP_ISA avx512
#define CDFP_KERNELS kKernelsAvx512
#define CDFP_KERNELS_NAME "avx512"
#include "element/kernels.ipp"
