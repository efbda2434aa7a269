/* gather, shade: see kernels/gl/stages.h. */
#include "kernels/gl/stages.h"

__kernel void gather(__global const struct fragment *sparse, __global const uint32_t *counts, uint32_t slots,
                     __global const uint32_t *first, __global struct fragment *list, __global uint32_t *pixels,
                     __global uint32_t *after, struct camera_rectangle rectangle, uint32_t width, uint32_t n)
{
	if (get_global_id(0) < n)
		gather_item(sparse, counts, slots, first, list, pixels, after,
		            stage_pixel(rectangle, width, (uint32_t)get_global_id(0)));
}

__kernel void shade(TABLES_ARGUMENTS, __global const struct view *views, __global const struct window_vertex *windows,
                    __global struct fragment *fragments, __global const uint32_t *pixels, uint32_t width,
                    uint32_t height, uint32_t bits, __global const float *arriving, uint32_t n_slots, uint32_t transport,
                    uint32_t n, __global struct shaded *shaded)
{
	struct tables t = TABLES_NAMED;
	struct stage_kept kept;

	if (get_global_id(0) < n)
		shade_item(&t, views, windows, fragments, pixels, width, height, bits, arriving, n_slots, transport, n,
		           shaded, (uint32_t)get_global_id(0), 0, &kept);
}
