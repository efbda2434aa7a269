/*
 * shade_packet: shade with SHADE_PACKET consecutive fragments of the list a work item, for CPUs. Neighbours mostly lie in the same
 * triangle, whose set-up is found once. kernels/README.md has the figures.
 */
#include "kernels/gl/stages.h"

KERNEL_OF(float4) void shade_packet(KERNEL_ARGUMENTS(shade))
{
	const uint32_t first = (uint32_t)get_global_id(0) * SHADE_PACKET;
	const struct shade_arguments a = KERNEL_STRUCT(shade);
	struct setup_kept kept[SHADE_TRIANGLES];

	for (uint32_t i = 0u; i < SHADE_TRIANGLES; i++)
		kept[i].instance = SCENE_NONE;
	for (uint32_t i = first; i < first + SHADE_PACKET && i < n; i++)
		shade_item(&a, i, 1, &kept[fragments[i].primitive % SHADE_TRIANGLES]);
}
