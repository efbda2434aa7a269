/* compose, add_pass: see kernels/frame/compose.h. */
#include "kernels/frame/compose.h"

__kernel void compose(TABLES_ARGUMENTS, __global const struct window_vertex *windows,
                      __global const struct frame_pixel *frame, __global const float *sums, struct compose_request request,
                      uint32_t n, __global uint16_t *halves, __global float *floats)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		compose_item(&t, windows, frame, sums, &request, n, halves, floats, (uint32_t)get_global_id(0));
}

__kernel void add_pass(__global const struct frame_pixel *frame, uint32_t turn, uint32_t first, uint32_t n,
                       __global float *sums)
{
	if (get_global_id(0) < n)
		add_pass_item(frame, turn, first, sums, (uint32_t)get_global_id(0));
}
