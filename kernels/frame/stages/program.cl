/* program: see kernels/gl/program.h. Frames without programs do not compile this. */
#include "kernels/gl/program.h"

__kernel void program(KERNEL_ARGUMENTS(shade))
{
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct setup_kept kept;

	if (get_global_id(0) < n)
		program_item(&a, (uint32_t)get_global_id(0), 0, &kept);
}
