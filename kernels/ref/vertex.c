/* C twin of kernels/frame/vertex.cl. */
#include "kernels/gl/vertex.h"

void vertex_c(const struct vertex_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		vertex_item(a, (uint32_t)i);
}
