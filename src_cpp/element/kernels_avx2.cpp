#define CDFP_ISA avx2
#define CDFP_KERNELS kKernelsAvx2
#define CDFP_KERNELS_NAME "avx2"
#include "element/kernels.ipp"
