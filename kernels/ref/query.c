/* C twins of kernels/rays/query.cl. */
#include "kernels/rays/query.h"

KERNEL_TWIN(query_all, n)
KERNEL_TWIN(query_distance, n)
KERNEL_TWIN(query_box, n)
KERNEL_TWIN(query_sphere, n)
