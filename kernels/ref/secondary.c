/* C twins of kernels/frame/secondary.cl and shadow_packet.cl. */
#include "kernels/frame/path.h"

void shadow_ray_c(const struct shadow_ray_arguments *a, size_t first, size_t last)
{
	struct shadow_kept kept;

	for (size_t i = first; i < last && i < a->n_rays; i++)
		shadow_ray_item(a, (uint32_t)i, 0, &kept);
}

/* Each ray on its own: what neighbours share must not show. */
void shadow_ray_packet_c(const struct shadow_ray_arguments *a, size_t first, size_t last)
{
	shadow_ray_c(a, first * SHADE_PACKET, last * SHADE_PACKET);
}

KERNEL_TWIN(hit_ray, n_rays)
KERNEL_TWIN(ao_ray, n)
KERNEL_TWIN(shadow_sum, n)
KERNEL_TWIN(shadow_start, n)
KERNEL_TWIN(shadow_walk, n)
KERNEL_TWIN(gather_paths, n)
KERNEL_TWIN(leave, n)
KERNEL_TWIN(sky_ray, n)
KERNEL_TWIN(want_lights, n)
KERNEL_TWIN(shade_hit, n)
KERNEL_TWIN(credit, n)
KERNEL_TWIN(ao_shade, n)
