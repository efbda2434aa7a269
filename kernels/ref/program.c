/* C twins of kernels/frame/stages/program.cl. */
#include "kernels/gl/program.h"

void program_c(const struct shade_arguments *a, size_t first, size_t last)
{
	struct setup_kept kept;

	for (size_t i = first; i < last && i < a->n; i++)
		program_item(a, (uint32_t)i, 0, &kept);
}

/* Each fragment is processed alone, so that caching between neighbours must not be visible. */
void program_packet_c(const struct shade_arguments *a, size_t first, size_t last)
{
	program_c(a, first * SHADE_PACKET, last * SHADE_PACKET);
}
