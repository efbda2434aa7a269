/* compose_packet: see kernels/frame/compose.h. */
#include "kernels/common.h"
#define COMPOSE_LANES COMPOSE_PACKET
#include "kernels/frame/compose.h"

__kernel void compose_packet(TABLES_ARGUMENTS, __global const struct window_vertex *windows,
                             __global const struct frame_pixel *frame, __global const float *sums,
                             struct compose_request request, uint32_t n, __global uint16_t *halves, __global float *floats)
{
	const uint32_t first = (uint32_t)get_global_id(0) * COMPOSE_PACKET;
	struct tables t = TABLES_NAMED;

	if (first < n)
		compose_item(&t, windows, frame, sums, &request, n, halves, floats, first);
}
