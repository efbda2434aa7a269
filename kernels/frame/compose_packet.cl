/* compose_packet: see kernels/frame/compose.h. */
#include "kernels/common.h"
#define COMPOSE_LANES COMPOSE_PACKET
#include "kernels/frame/compose.h"

__kernel void compose_packet(KERNEL_ARGUMENTS(compose))
{
	const uint32_t first = (uint32_t)get_global_id(0) * COMPOSE_PACKET;
	const struct compose_arguments a = KERNEL_STRUCT(compose);

	if (first < n)
		compose_item(&a, first);
}
