/* compose, add_pass: see kernels/frame/compose.h. */
#include "kernels/frame/compose.h"

__kernel void compose(KERNEL_ARGUMENTS(compose))
{
	const struct compose_arguments a = KERNEL_STRUCT(compose);

	if (get_global_id(0) < n)
		compose_item(&a, (uint32_t)get_global_id(0));
}

__kernel void add_pass(KERNEL_ARGUMENTS(add_pass))
{
	const struct add_pass_arguments a = KERNEL_STRUCT(add_pass);

	if (get_global_id(0) < n)
		add_pass_item(&a, (uint32_t)get_global_id(0));
}
