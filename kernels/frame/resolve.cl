/* clear, resolve, merge_samples: see kernels/gl/stages.h, kernels/gl/pixel.h. */
#include "kernels/gl/stages.h"

__kernel void clear(struct scene_clear clear, struct camera_rectangle rectangle, uint32_t width, uint32_t bits,
                    uint32_t n, __global struct frame_pixel *frame)
{
	if (get_global_id(0) < n)
		pixel_clear(&clear, &frame[stage_pixel(rectangle, width, (uint32_t)get_global_id(0))], bits);
}

__kernel void resolve(TABLES_ARGUMENTS, __global const struct fragment *fragments,
                      __global struct shaded *shaded, __global const uint32_t *first,
                      __global const uint32_t *counts, struct camera_rectangle rectangle, uint32_t width, uint32_t bits,
                      uint32_t n, __global struct frame_pixel *frame)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		resolve_item(&t, fragments, shaded, first, counts, bits, frame,
		             stage_pixel(rectangle, width, (uint32_t)get_global_id(0)));
}

__kernel void merge_samples(__global const struct frame_pixel *first, __global const struct frame_pixel *second,
                            __global const struct frame_pixel *third, __global const struct frame_pixel *fourth, uint32_t n,
                            __global struct frame_pixel *frame)
{
	const uint32_t i = (uint32_t)get_global_id(0);

	if (i < n)
		pixel_merge(&first[i], &second[i], &third[i], &fourth[i], &frame[i]);
}
