#define CDFP_ISA avx512
#define CDFP_SEARCH_KERNELS kSearchAvx512
#include "contact/search_kernels.ipp"
