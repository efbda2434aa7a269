/*
 * occlude_wide, intersect_wide: one ray a work item against eight boxes or eight triangles at once. See kernels/rays.h.
 */
#include "kernels/rays.h"
#include "kernels/lanes.h"

/* A ray in the space of the tree it walks; boxes as in kernels/packet.h. */
struct walk {
	float ox, oy, oz, dx, dy, dz;
	float ix, iy, iz, far_ix, far_iy, far_iz, near_x, near_y, near_z, far_x, far_y, far_z;
	uint row_x, row_y, row_z; /* the float of a node8 where the planes met first begin */
	float t_min;
	struct hit hit; /* hit.t: the ray's end so far */
};

/* A subtree to be walked. */
struct entry {
	float enter;
	uint child, count;
};

inline float invert(float d)
{
	return 1.0f / (fabs(d) > 1e-20f ? d : copysign(1e-20f, d));
}

inline void prepare(struct walk *w)
{
	float b;

	w->ix = invert(w->dx), w->iy = invert(w->dy), w->iz = invert(w->dz);
	b = -w->ox * w->ix, w->near_x = b - fabs(b) * 3e-7f, w->far_x = b + fabs(b) * 1.5e-6f;
	b = -w->oy * w->iy, w->near_y = b - fabs(b) * 3e-7f, w->far_y = b + fabs(b) * 1.5e-6f;
	b = -w->oz * w->iz, w->near_z = b - fabs(b) * 3e-7f, w->far_z = b + fabs(b) * 1.5e-6f;
	w->far_ix = w->ix * (1 + 6e-7f), w->far_iy = w->iy * (1 + 6e-7f), w->far_iz = w->iz * (1 + 6e-7f);
	w->row_x = w->ix < 0 ? 24 : 0, w->row_y = w->iy < 0 ? 32 : 8, w->row_z = w->iz < 0 ? 40 : 16;
}

/* Where the ray enters the eight boxes, and which it meets. */
inline uint meet_boxes(const struct walk *w, __global const struct node8 *node, float8 *enter)
{
	__global const float *rows = (__global const float *)node;
	const float8 near_x = fma(vload8(0, rows + w->row_x), w->ix, w->near_x);
	const float8 near_y = fma(vload8(0, rows + w->row_y), w->iy, w->near_y);
	const float8 near_z = fma(vload8(0, rows + w->row_z), w->iz, w->near_z);
	const float8 far_x = fma(vload8(0, rows + (24 - w->row_x)), w->far_ix, w->far_x);
	const float8 far_y = fma(vload8(0, rows + (40 - w->row_y)), w->far_iy, w->far_y);
	const float8 far_z = fma(vload8(0, rows + (56 - w->row_z)), w->far_iz, w->far_z);
	const float8 first = lanes_max(lanes_max(near_x, near_y), lanes_max(near_z, w->t_min));

	*enter = first;
	return lane_bits(first <= lanes_min(lanes_min(far_x, far_y), lanes_min(far_z, w->hit.t)));
}

/* Push what the ray meets, farthest first, so that the nearest is popped next. */
inline uint push_boxes(struct entry *stack, uint depth, uint bits, const float8 *enter, __global const struct node8 *node)
{
	const uint bottom = depth;

	while (bits) {
		const uint lane = popcount((bits & -bits) - 1);
		const float t = ((const float *)enter)[lane];
		uint place = depth++;

		bits &= bits - 1;
		while (place > bottom && stack[place - 1].enter < t) {
			stack[place] = stack[place - 1];
			place--;
		}
		stack[place].enter = t;
		stack[place].child = node->child[lane];
		stack[place].count = node->count[lane];
	}
	return depth;
}

/* Moeller and Trumbore on eight triangles; the nearest hit, the first lane of equals, goes into w->hit. */
inline void try_block(struct walk *w, __global const struct triangle8 *block, uint instance, int any)
{
	const float8 e1x = vload8(0, block->e1[0]), e1y = vload8(0, block->e1[1]), e1z = vload8(0, block->e1[2]);
	const float8 e2x = vload8(0, block->e2[0]), e2y = vload8(0, block->e2[1]), e2z = vload8(0, block->e2[2]);
	const float8 px = fma(w->dy, e2z, -(w->dz * e2y));
	const float8 py = fma(w->dz, e2x, -(w->dx * e2z));
	const float8 pz = fma(w->dx, e2y, -(w->dy * e2x));
	const float8 inverse = 1.0f / fma(e1z, pz, fma(e1y, py, e1x * px));
	const float8 sx = w->ox - vload8(0, block->v0[0]), sy = w->oy - vload8(0, block->v0[1]);
	const float8 sz = w->oz - vload8(0, block->v0[2]);
	const float8 u = fma(sz, pz, fma(sy, py, sx * px)) * inverse;
	const float8 qx = fma(sy, e1z, -(sz * e1y));
	const float8 qy = fma(sz, e1x, -(sx * e1z));
	const float8 qz = fma(sx, e1y, -(sy * e1x));
	const float8 v = fma(w->dz, qz, fma(w->dy, qy, w->dx * qx)) * inverse;
	const float8 t = fma(e2z, qz, fma(e2y, qy, e2x * qx)) * inverse;
	uint bits = lane_bits((u >= -RAYS_EDGE_SLACK) & (v >= -RAYS_EDGE_SLACK) & (u + v <= 1 + RAYS_EDGE_SLACK) &
	                      (t >= w->t_min) & (t <= w->hit.t));

	while (bits) {
		const uint lane = popcount((bits & -bits) - 1);
		const float at = ((const float *)&t)[lane];

		bits &= bits - 1;
		if (at < w->hit.t || w->hit.instance == SCENE_NONE) {
			w->hit.t = at;
			w->hit.b1 = ((const float *)&u)[lane];
			w->hit.b2 = ((const float *)&v)[lane];
			w->hit.instance = instance;
			w->hit.primitive = block->primitive[lane];
			if (any)
				return;
		}
	}
}

inline void walk_blas(struct walk *w, uint instance, int any, __global const struct node8 *nodes,
                      __global const struct triangle8 *triangles)
{
	struct entry stack[RAYS_WIDE_STACK];
	uint depth = 0;

	stack[depth].enter = w->t_min;
	stack[depth].child = stack[depth].count = 0;
	depth++;
	while (depth) {
		const struct entry entry = stack[--depth];

		if (entry.enter > w->hit.t)
			continue;
		if (entry.count == 0) {
			__global const struct node8 *node = &nodes[entry.child];
			float8 enter;
			const uint bits = meet_boxes(w, node, &enter);

			depth = push_boxes(stack, depth, bits, &enter, node);
			continue;
		}
		for (uint i = 0; i < entry.count; i++) {
			try_block(w, &triangles[entry.child + i], instance, any);
			if (any && w->hit.instance != SCENE_NONE)
				return;
		}
	}
}

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
	walk_blas(&w, index, any, nodes + instance->node8_first, triangles + instance->triangle8_first);
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

			depth = push_boxes(stack, depth, bits, &enter, &top[entry.child]);
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
