/* C twin of kernels/frame/program.cl. */
#include "kernels/gl/program.h"

void program_c(const struct shade_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		program_item(a, (uint32_t)i);
}
