#define CDFP_ISA baseline
#define CDFP_SEARCH_KERNELS kSearchBaseline
#include "contact/search_kernels.ipp"
