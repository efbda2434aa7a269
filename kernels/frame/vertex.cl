/* vertex: see vertex_item. */
#include "kernels/gl/vertex.h"

__kernel void vertex(TABLES_ARGUMENTS, __global const struct view *views, __global const uint32_t *owner,
                     uint32_t height, uint32_t n, __global struct shaded_vertex *shaded,
                     __global struct window_vertex *windows, __global float *clips, __global float *coords)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		vertex_item(&t, views, owner, height, (uint32_t)get_global_id(0), shaded, windows, clips, coords);
}
