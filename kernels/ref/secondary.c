/* C twins of kernels/frame/secondary.cl and shadow_packet.cl. */
#include "kernels/frame/secondary.h"
#include "tracer/device/device.h"

extern device_twin shadow_ray_c, shadow_ray_packet_c, hit_ray_c, ao_ray_c, shadow_sum_c, shadow_start_c, shadow_walk_c,
	gather_paths_c, leave_c, sky_ray_c, want_lights_c, shade_hit_c, credit_c, ao_shade_c;

static uint32_t number(const void *arg)
{
	return *(const uint32_t *)arg;
}

static float real(const void *arg)
{
	return *(const float *)arg;
}

void shadow_ray_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;
	struct stage_kept_plane kept;

	for (size_t i = first; i < last && i < number(args[20]); i++)
		shadow_ray_item(&t, args[12], args[13], args[14], args[15], number(args[16]), args[17], number(args[18]),
		                number(args[19]), (void *)args[21], (uint32_t)i, 0, &kept);
}

/* Each ray on its own: what neighbours share must not show. */
void shadow_ray_packet_c(const void *const *args, size_t first, size_t last)
{
	shadow_ray_c(args, first * SHADE_PACKET, last * SHADE_PACKET);
}

void hit_ray_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;

	for (size_t i = first; i < last && i < number(args[19]); i++)
		hit_ray_item(&t, args[12], args[13], args[14], args[15], args[16], number(args[17]), number(args[18]),
		             (void *)args[20], (uint32_t)i);
}

void ao_ray_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;

	for (size_t i = first; i < last && i < number(args[20]); i++)
		ao_ray_item(&t, args[12], args[13], args[14], args[15], number(args[16]), args[17], number(args[18]),
		            real(args[19]), (void *)args[21], (uint32_t)i);
}

void shadow_sum_c(const void *const *args, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < number(args[3]); i++)
		shadow_sum_item(args[0], real(args[1]), number(args[2]), (void *)args[4], (uint32_t)i);
}

void shadow_start_c(const void *const *args, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < number(args[4]); i++)
		shadow_start_item(args[0], args[1], args[2], real(args[3]), (void *)args[5], (void *)args[6], (uint32_t)i);
}

void shadow_walk_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;

	for (size_t i = first; i < last && i < number(args[15]); i++)
		shadow_walk_item(&t, args[12], args[13], args[14], (void *)args[16], (void *)args[17], (void *)args[18],
		                 (void *)args[19], (uint32_t)i);
}

void gather_paths_c(const void *const *args, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < number(args[5]); i++)
		gather_paths_item(args[0], args[1], args[2], args[3], number(args[4]), (void *)args[6], (void *)args[7],
		                  (uint32_t)i);
}

void leave_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;

	for (size_t i = first; i < last && i < number(args[19]); i++)
		leave_item(&t, args[12], args[13], args[14], args[15], number(args[16]), number(args[17]), number(args[18]),
		           (void *)args[20], (void *)args[21], (void *)args[22], (void *)args[23], (uint32_t)i);
}

void sky_ray_c(const void *const *args, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < number(args[2]); i++)
		sky_ray_item(args[0], args[1], (void *)args[3], (uint32_t)i);
}

void want_lights_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;

	for (size_t i = first; i < last && i < number(args[15]); i++)
		want_lights_item(&t, args[12], args[13], number(args[14]), (void *)args[16], (uint32_t)i);
}

void shade_hit_c(const void *const *args, size_t first, size_t last)
{
	struct tables t = TABLES_NAMED;

	for (size_t i = first; i < last && i < number(args[24]); i++)
		shade_hit_item(&t, args[12], args[13], number(args[14]), args[15], args[16], args[17], args[18],
		               number(args[19]), number(args[20]), number(args[21]), number(args[22]), args[23],
		               number(args[24]), (void *)args[25], (void *)args[26], (void *)args[27], (void *)args[28],
		               (uint32_t)i);
}

void credit_c(const void *const *args, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < number(args[2]); i++)
		credit_item(args[0], args[1], number(args[2]), (void *)args[3], (uint32_t)i);
}

void ao_shade_c(const void *const *args, size_t first, size_t last)
{
	for (size_t i = first; i < last && i < number(args[2]); i++)
		ao_shade_item(args[0], number(args[1]), (void *)args[3], (uint32_t)i);
}
