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

void hit_ray_c(const struct hit_ray_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n_rays; i++)
		hit_ray_item(a, (uint32_t)i);
}

void ao_ray_c(const struct ao_ray_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		ao_ray_item(a, (uint32_t)i);
}

void shadow_sum_c(const struct shadow_sum_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		shadow_sum_item(a, (uint32_t)i);
}

void shadow_start_c(const struct shadow_start_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		shadow_start_item(a, (uint32_t)i);
}

void shadow_walk_c(const struct shadow_walk_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		shadow_walk_item(a, (uint32_t)i);
}

void gather_paths_c(const struct gather_paths_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		gather_paths_item(a, (uint32_t)i);
}

void leave_c(const struct leave_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		leave_item(a, (uint32_t)i);
}

void sky_ray_c(const struct sky_ray_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		sky_ray_item(a, (uint32_t)i);
}

void want_lights_c(const struct want_lights_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		want_lights_item(a, (uint32_t)i);
}

void shade_hit_c(const struct shade_hit_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		shade_hit_item(a, (uint32_t)i);
}

void credit_c(const struct credit_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		credit_item(a, (uint32_t)i);
}

void ao_shade_c(const struct ao_shade_arguments *a, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < a->n; i++)
		ao_shade_item(a, (uint32_t)i);
}
