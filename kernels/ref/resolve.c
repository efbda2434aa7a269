/* C twins of kernels/frame/stages/resolve.cl and resolve_packet.cl. */
#include "kernels/gl/stages.h"

KERNEL_TWIN(clear, n)
KERNEL_TWIN(resolve, n)
KERNEL_TWIN(merge_samples, n)

/* One colour after the other. */
void resolve_packet_c(const struct resolve_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++) {
		const struct stage_row row = stage_open_row(a, (uint32_t)i);

		for (uint32_t pixel = row.first; pixel < row.end; pixel++)
			stage_resolve(a, pixel);
	}
}
