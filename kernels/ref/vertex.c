/* C twin of kernels/frame/vertex.cl. */
#include "kernels/gl/vertex.h"
#include "tracer/device/device.h"

extern device_twin vertex_c;

void vertex_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;
	uint32_t height = *(const uint32_t *)args[14], n = *(const uint32_t *)args[15];

	for (size_t i = first; i < last && i < n; i++)
		vertex_item(&t, args[12], args[13], height, (uint32_t)i, (void *)args[16], (void *)args[17],
		            (void *)args[18], (void *)args[19]);
}
