/* C twins of kernels/frame/resolve.cl. */
#include "kernels/gl/stages.h"

void clear_c(const struct clear_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		pixel_clear(&a->clear, &a->frame[stage_pixel(a->rectangle, a->width, (uint32_t)i)], a->bits);
}

void resolve_c(const struct resolve_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		resolve_item(a, (uint32_t)i);
}

void merge_samples_c(const struct merge_samples_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		pixel_merge(&a->first[i], &a->second[i], &a->third[i], &a->fourth[i], &a->frame[i]);
}
