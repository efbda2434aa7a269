/* C twins of kernels/frame/resolve.cl and resolve_packet.cl. */
#include "kernels/gl/stages.h"

KERNEL_TWIN(clear, n)
KERNEL_TWIN(resolve, n)
KERNEL_TWIN(merge_samples, n)

/* One colour after the other. */
void resolve_packet_c(const struct resolve_arguments *a, size_t first, size_t last)
{
	resolve_c(a, first, last);
}
