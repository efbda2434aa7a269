/* clear, resolve, merge_samples: see kernels/gl/stages.h, kernels/gl/pixel.h. */
#include "kernels/gl/stages.h"

__kernel void clear(KERNEL_ARGUMENTS(clear))
{
	if (get_global_id(0) < n)
		pixel_clear(&clear, &frame[stage_pixel(rectangle, width, (uint32_t)get_global_id(0))], bits);
}

__kernel void resolve(KERNEL_ARGUMENTS(resolve))
{
	const struct resolve_arguments a = KERNEL_STRUCT(resolve);

	if (get_global_id(0) < n)
		resolve_item(&a, (uint32_t)get_global_id(0));
}

__kernel void merge_samples(KERNEL_ARGUMENTS(merge_samples))
{
	const uint32_t i = (uint32_t)get_global_id(0);

	if (i < n)
		pixel_merge(&first[i], &second[i], &third[i], &fourth[i], &frame[i]);
}
