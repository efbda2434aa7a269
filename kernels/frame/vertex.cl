/* vertex: see vertex_item. */
#include "kernels/gl/vertex.h"

__kernel void vertex(KERNEL_ARGUMENTS(vertex))
{
	const struct vertex_arguments a = KERNEL_STRUCT(vertex);

	if (get_global_id(0) < n)
		vertex_item(&a, (uint32_t)get_global_id(0));
}
