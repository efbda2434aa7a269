/* C twins of kernels/frame/stages/shade.cl and shade_packet.cl. */
#include "kernels/gl/stages.h"

KERNEL_TWIN(gather, n)

void shade_c(const struct shade_arguments *a, size_t first, size_t last)
{
	struct setup_kept kept;

	for (size_t i = first; i < last && i < a->n; i++)
		shade_item(a, (uint32_t)i, 0, &kept);
}

/* Each fragment is processed alone, so that caching between neighbours must not be visible. */
void shade_packet_c(const struct shade_arguments *a, size_t first, size_t last)
{
	shade_c(a, first * SHADE_PACKET, last * SHADE_PACKET);
}
