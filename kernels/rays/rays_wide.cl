/*
 * occlude_wide, intersect_wide: one ray per work item against eight boxes or eight triangles at once. See
 * kernels/rays/rays.h.
 */
#include "kernels/kernels.h"
#include "kernels/rays/rays.h"
#include "kernels/rays/wide.h"

static inline void walk_instance(struct walk *eye, uint index, int any, uint to_lights, __global const uint *opacity,
                                 uint tie, __global const struct instance *instances,
                                 __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	__global const struct instance *instance = &instances[index];
	struct walk w;
	float shift;

	if (any && instance->opacity == OPACITY_PASSES)
		return;
	shift = walk_enter(&w, eye, instance, tie);
	walk_subtree(&w, (uint2)(0, 0), index, any, known_of(instance, any, to_lights, opacity),
	             nodes + instance->node8_first, triangles + instance->triangle8_first);
	walk_leave(eye, &w, shift);
}

static inline struct walk walk_ray(__global const struct ray *ray, int any, uint to_lights,
                                   __global const uint *opacity, __global const struct hit *last,
                                   __global const struct node8 *top, __global const uint *instance_list,
                                   __global const struct instance *instances, __global const struct node8 *nodes,
                                   __global const struct triangle8 *triangles)
{
	struct entry stack[RAYS_WIDE_STACK];
	uint depth = 0;
	struct walk w;

	if (!walk_start(&w, ray, last != 0))
		return w;
	stack[depth].enter = w.t_min;
	stack[depth].child = stack[depth].count = 0;
	depth++;
	while (depth) {
		const struct entry entry = stack[--depth];

		if (entry.enter > walk_end(&w))
			continue;
		if (entry.count == 0) {
			float8 enter;
			const uint bits = meet_boxes(&w, &top[entry.child], &enter);

			depth = push_boxes(stack, depth, bits, &enter, any, &top[entry.child]);
			continue;
		}
		for (uint i = 0; i < entry.count; i++) {
			const uint index = instance_list[entry.child + i];

			walk_instance(&w, index, any, to_lights, opacity, last ? walk_tie(last, index) : 0, instances, nodes,
			              triangles);
			if (any && w.hit.instance != SCENE_NONE)
				return w;
		}
	}
	return w;
}

KERNEL_OF(float8) void occlude_wide(KERNEL_ARGUMENTS(occlude_wide))
{
	const uint i = (uint)get_global_id(0);
	struct walk w;

	if (i >= n_rays)
		return;
	w = walk_ray(&rays[i], 1, to_lights, opacity, 0, top + top_first, instance_list, instances, nodes, triangles);
	occluded[i] = w.hit.instance != SCENE_NONE ? 1 : w.asks * 2;
}

KERNEL_OF(float8) void intersect_wide(KERNEL_ARGUMENTS(intersect_wide))
{
	const uint i = (uint)get_global_id(0);

	if (i < n_rays)
		hits[i] = walk_ray(&rays[i], 0, 0, 0, after ? &last[i] : 0, top + top_first, instance_list, instances, nodes,
		                   triangles)
		                  .hit;
}
