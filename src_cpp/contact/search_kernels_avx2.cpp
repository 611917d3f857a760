#define CDFP_ISA avx2
#define CDFP_SEARCH_KERNELS kSearchAvx2
#include "contact/search_kernels.ipp"
