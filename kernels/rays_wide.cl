/*
 * occlude_wide, intersect_wide: one ray a work item against eight boxes or eight triangles at once. See kernels/rays.h.
 */
#include "kernels/rays.h"
#include "kernels/wide.h"

/* How far along the ray its walk through an instance starts. */
inline float far_shift(__global const struct instance *instance, const struct walk *w)
{
	const float cx = instance->centre[0] - w->ox, cy = instance->centre[1] - w->oy, cz = instance->centre[2] - w->oz;
	const float length = fmax(fmax(fabs(w->dx), fabs(w->dy)), fabs(w->dz));
	const float shift = fma(cz, w->dz, fma(cy, w->dy, cx * w->dx)) / fma(w->dz, w->dz, fma(w->dy, w->dy, w->dx * w->dx)) -
	                    instance->radius / length;

	return shift * length > RAYS_FAR * instance->radius && isfinite(shift) ? shift : 0;
}

inline void walk_instance(struct walk *eye, uint index, int any, __global const struct instance *instances,
                          __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	__global const struct instance *instance = &instances[index];
	__global const float *m = instance->obj_from_eye;
	struct walk w;
	float shift;

	w.ox = fma(m[2], eye->oz, fma(m[1], eye->oy, fma(m[0], eye->ox, m[3])));
	w.oy = fma(m[6], eye->oz, fma(m[5], eye->oy, fma(m[4], eye->ox, m[7])));
	w.oz = fma(m[10], eye->oz, fma(m[9], eye->oy, fma(m[8], eye->ox, m[11])));
	w.dx = fma(m[2], eye->dz, fma(m[1], eye->dy, m[0] * eye->dx));
	w.dy = fma(m[6], eye->dz, fma(m[5], eye->dy, m[4] * eye->dx));
	w.dz = fma(m[10], eye->dz, fma(m[9], eye->dy, m[8] * eye->dx));
	shift = far_shift(instance, &w);
	w.ox = fma(shift, w.dx, w.ox), w.oy = fma(shift, w.dy, w.oy), w.oz = fma(shift, w.dz, w.oz);
	w.t_min = eye->t_min - shift;
	w.hit.t = eye->hit.t - shift;
	if (shift > 0 && eye->hit.instance != SCENE_NONE)
		w.hit.t += 3e-7f * eye->hit.t; /* t + shift decides */
	w.hit.b1 = w.hit.b2 = 0;
	w.hit.instance = w.hit.primitive = SCENE_NONE;
	prepare(&w);
	walk_subtree(&w, (uint2)(0, 0), index, any, nodes + instance->node8_first, triangles + instance->triangle8_first);
	w.hit.t += shift;
	if (w.hit.instance != SCENE_NONE && (eye->hit.instance == SCENE_NONE || w.hit.t < eye->hit.t))
		eye->hit = w.hit;
}

inline struct hit walk_ray(__global const struct ray *ray, int any, __global const struct node8 *top,
                           __global const uint *instance_list, __global const struct instance *instances,
                           __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	struct entry stack[RAYS_WIDE_STACK];
	uint depth = 0;
	struct walk w;

	w.ox = ray->o[0], w.oy = ray->o[1], w.oz = ray->o[2];
	w.dx = ray->d[0], w.dy = ray->d[1], w.dz = ray->d[2];
	w.t_min = ray->t_min;
	w.hit.t = ray->t_max;
	w.hit.b1 = w.hit.b2 = 0;
	w.hit.instance = w.hit.primitive = SCENE_NONE;
	if (!(w.t_min <= w.hit.t) || !isfinite(w.ox) || !isfinite(w.oy) || !isfinite(w.oz) || !isfinite(w.dx) ||
	    !isfinite(w.dy) || !isfinite(w.dz))
		return w.hit;
	prepare(&w);
	stack[depth].enter = w.t_min;
	stack[depth].child = stack[depth].count = 0;
	depth++;
	while (depth) {
		const struct entry entry = stack[--depth];

		if (entry.enter > w.hit.t)
			continue;
		if (entry.count == 0) {
			float8 enter;
			const uint bits = meet_boxes(&w, &top[entry.child], &enter);

			depth = push_boxes(stack, depth, bits, &enter, any, &top[entry.child]);
			continue;
		}
		for (uint i = 0; i < entry.count; i++) {
			walk_instance(&w, instance_list[entry.child + i], any, instances, nodes, triangles);
			if (any && w.hit.instance != SCENE_NONE)
				return w.hit;
		}
	}
	return w.hit;
}

__kernel void occlude_wide(uint n_rays, __global const struct ray *rays, uint top_first,
                           __global const struct node8 *top, __global const uint *instance_list,
                           __global const struct instance *instances, __global const struct node8 *nodes,
                           __global const struct triangle8 *triangles, __global uint *occluded)
{
	const uint i = (uint)get_global_id(0);

	if (i < n_rays)
		occluded[i] = walk_ray(&rays[i], 1, top + top_first, instance_list, instances, nodes, triangles).instance !=
		              SCENE_NONE;
}

__kernel void intersect_wide(uint n_rays, __global const struct ray *rays, uint top_first,
                             __global const struct node8 *top, __global const uint *instance_list,
                             __global const struct instance *instances, __global const struct node8 *nodes,
                             __global const struct triangle8 *triangles, __global struct hit *hits)
{
	const uint i = (uint)get_global_id(0);

	if (i < n_rays)
		hits[i] = walk_ray(&rays[i], 0, top + top_first, instance_list, instances, nodes, triangles);
}
