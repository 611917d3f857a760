#define CDFP_ISA baseline
#define CDFP_KERNELS kKernelsBaseline
#define CDFP_KERNELS_NAME "baseline"
#include "element/kernels.ipp"
