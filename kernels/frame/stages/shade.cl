/* shade: see kernels/gl/stages.h. */
#include "kernels/gl/stages.h"

KERNEL_OF(float4) void shade(KERNEL_ARGUMENTS(shade))
{
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct setup_kept kept;

	if (get_global_id(0) < n)
		shade_item(&a, (uint32_t)get_global_id(0), 0, &kept);
}
