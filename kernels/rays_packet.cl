/*
 * occlude_packet, intersect_packet: sixteen consecutive rays a work item against binary trees. See kernels/rays.h.
 */
#include "kernels/rays.h"
#include "kernels/packet.h"

/*
 * Walk one instance's tree with a packet of one octant. Lanes that are hit get their t_max (any: -1, they are done) and
 * *hits.
 */
inline void walk_blas(struct packet *packet, struct packet_hits *hits, int octant, int any, uint instance,
                      __global const struct node2 *nodes, __global const struct triangle *triangles)
{
	struct packet rays = *packet, *p = &rays; /* a copy of its own stays in registers */
	const struct planes planes = octant_planes(octant);
	struct packet_entry stack[BVH_MAX_DEPTH + 1];
	uint depth = 0, child = 0, count = 0;

	for (;;) {
		if (count == 0) {
			__global const struct node2 *node = &nodes[child];
			__global const float *bounds = (__global const float *)node;
			const packf enter0 = packet_enter(p, bounds, planes, 0), enter1 = packet_enter(p, bounds, planes, 1);
			const packi hit0 = enter0 <= packet_leave(p, bounds, planes, 0);
			const packi hit1 = enter1 <= packet_leave(p, bounds, planes, 1);
			const int any0 = any_pack(hit0), any1 = any_pack(hit1);

			if (any0 | any1) {
				/* Where any ray enters side 1 before side 0 and meets it, that goes first; any hit takes any order. */
				const uint first = any ? !any0 : (uint)(any1 & (!any0 | any_pack(hit1 & (enter1 < enter0))));

				if (!any)
					stack[depth].enter = first ? enter0 : enter1;
				stack[depth].child = node->child[!first];
				stack[depth].count = node->count[!first];
				depth += (uint)(any0 & any1);
				child = node->child[first];
				count = node->count[first];
				continue;
			}
		} else {
			for (uint i = 0; i < count; i++) {
				packf t, b1, b2;
				const packi hit = packet_triangle(p, &triangles[child + i], &t, &b1, &b2);

				if (!any_pack(hit))
					continue;
				if (any) {
					p->t_max = select(p->t_max, (packf)(-INFINITY), hit);
					hits->instance = select(hits->instance, (packu)(instance), hit);
				} else {
					const packi closer = hit & ((t < p->t_max) | (hits->instance == SCENE_NONE));

					p->t_max = select(p->t_max, t, closer);
					hits->b1 = select(hits->b1, b1, closer);
					hits->b2 = select(hits->b2, b2, closer);
					hits->instance = select(hits->instance, (packu)(instance), closer);
					hits->primitive = select(hits->primitive, (packu)(triangles[child + i].primitive), closer);
				}
			}
		}
		do {
			if (depth == 0) {
				packet->t_max = p->t_max;
				return;
			}
			depth--;
		} while (any ? !any_pack(p->t_min <= p->t_max) : !any_pack(stack[depth].enter <= p->t_max));
		child = stack[depth].child;
		count = stack[depth].count;
	}
}

/* How far along each ray its walk through an instance starts. */
inline packf far_shift(__global const struct instance *instance, const struct packet *p)
{
	const packf cx = instance->centre[0] - p->ox, cy = instance->centre[1] - p->oy, cz = instance->centre[2] - p->oz;
	const packf length = pack_max(pack_max(fabs(p->dx), fabs(p->dy)), fabs(p->dz));
	const packf shift = fma(cz, p->dz, fma(cy, p->dy, cx * p->dx)) / fma(p->dz, p->dz, fma(p->dy, p->dy, p->dx * p->dx)) -
	                    instance->radius / length;

	return select((packf)(0), shift, (shift * length > RAYS_FAR * instance->radius) & isfinite(shift));
}

inline void walk_instance(struct packet *eye, struct packet_hits *hits, int any, uint index,
                          __global const struct instance *instances, __global const struct node2 *nodes,
                          __global const struct triangle *triangles)
{
	__global const struct instance *instance = &instances[index];
	packi awake = eye->t_min <= eye->t_max, octants, better;
	struct packet p;
	struct packet_hits found;
	packf shift, t_max;

	packet_transform(&p, eye, instance->obj_from_eye);
	shift = far_shift(instance, &p);
	p.ox = fma(shift, p.dx, p.ox), p.oy = fma(shift, p.dy, p.oy), p.oz = fma(shift, p.dz, p.oz);
	packet_prepare(&p);
	p.t_min = eye->t_min - shift;
	t_max = eye->t_max - shift;
	t_max = select(t_max, t_max + 3e-7f * eye->t_max, (shift > 0) & (hits->instance != SCENE_NONE)); /* t + shift decides */
	octants = packet_octants(&p);
	found.b1 = found.b2 = 0;
	found.instance = found.primitive = SCENE_NONE;
	while (any_pack(awake)) {
		int octant;
		const packi lanes = packet_next_octant(octants, &awake, &octant);

		p.t_max = select((packf)(-INFINITY), t_max, lanes);
		walk_blas(&p, &found, octant, any, index, nodes + instance->node2_first, triangles + instance->triangle_first);
		t_max = select(t_max, p.t_max, lanes);
	}
	t_max += shift;
	better = (found.instance != SCENE_NONE) & ((hits->instance == SCENE_NONE) | (t_max < eye->t_max));
	eye->t_max = select(eye->t_max, t_max, better);
	hits->b1 = select(hits->b1, found.b1, better);
	hits->b2 = select(hits->b2, found.b2, better);
	hits->instance = select(hits->instance, found.instance, better);
	hits->primitive = select(hits->primitive, found.primitive, better);
}

inline void walk_top(struct packet *eye, struct packet_hits *hits, int any, __global const struct node2 *top,
                     __global const uint *instance_list, __global const struct instance *instances,
                     __global const struct node2 *nodes, __global const struct triangle *triangles)
{
	uint stack[BVH_MAX_DEPTH + 1], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node2 *node = &top[stack[--depth]];

		for (uint side = 0; side < 2; side++) {
			if (!any_pack(packet_meets_box(eye, node, side)))
				continue;
			if (node->count[side] == 0)
				stack[depth++] = node->child[side];
			for (uint i = 0; i < node->count[side]; i++)
				walk_instance(eye, hits, any, instance_list[node->child[side] + i], instances, nodes, triangles);
		}
	}
}

/* Rows from sixteen rays; lanes past the end, and rays that hit nothing by definition, sleep. */
inline void load_rays(struct packet *p, __global const struct ray *rays, uint first, uint n)
{
	packf t_min = 1, t_max = -INFINITY, ox = 0, oy = 0, oz = 0, dx = 1, dy = 1, dz = 1;
	packi finite;

	for (uint i = 0; i < RAYS_PER_PACKET && first + i < n; i++) {
		__global const struct ray *ray = &rays[first + i];

		((float *)&ox)[i] = ray->o[0], ((float *)&oy)[i] = ray->o[1], ((float *)&oz)[i] = ray->o[2];
		((float *)&dx)[i] = ray->d[0], ((float *)&dy)[i] = ray->d[1], ((float *)&dz)[i] = ray->d[2];
		((float *)&t_min)[i] = ray->t_min, ((float *)&t_max)[i] = ray->t_max;
	}
	finite = isfinite(ox) & isfinite(oy) & isfinite(oz) & isfinite(dx) & isfinite(dy) & isfinite(dz) & (t_min <= t_max);
	p->ox = select((packf)(0), ox, finite), p->oy = select((packf)(0), oy, finite), p->oz = select((packf)(0), oz, finite);
	p->dx = select((packf)(1), dx, finite), p->dy = select((packf)(1), dy, finite), p->dz = select((packf)(1), dz, finite);
	p->t_min = select((packf)(1), t_min, finite);
	p->t_max = select((packf)(-INFINITY), t_max, finite);
	packet_prepare(p);
}

__kernel void occlude_packet(uint n_rays, __global const struct ray *rays, uint top_first,
                             __global const struct node2 *top, __global const uint *instance_list,
                             __global const struct instance *instances, __global const struct node2 *nodes,
                             __global const struct triangle *triangles, __global uint *occluded)
{
	const uint first = (uint)get_global_id(0) * RAYS_PER_PACKET;
	struct packet p;
	struct packet_hits hits;

	if (first >= n_rays)
		return;
	load_rays(&p, rays, first, n_rays);
	hits.b1 = hits.b2 = 0;
	hits.instance = hits.primitive = SCENE_NONE;
	walk_top(&p, &hits, 1, top + top_first, instance_list, instances, nodes, triangles);
	for (uint i = 0; i < RAYS_PER_PACKET && first + i < n_rays; i++)
		occluded[first + i] = ((const uint *)&hits.instance)[i] != SCENE_NONE;
}

__kernel void intersect_packet(uint n_rays, __global const struct ray *rays, uint top_first,
                               __global const struct node2 *top, __global const uint *instance_list,
                               __global const struct instance *instances, __global const struct node2 *nodes,
                               __global const struct triangle *triangles, __global struct hit *out)
{
	const uint first = (uint)get_global_id(0) * RAYS_PER_PACKET;
	struct packet p;
	struct packet_hits hits;

	if (first >= n_rays)
		return;
	load_rays(&p, rays, first, n_rays);
	hits.b1 = hits.b2 = 0;
	hits.instance = hits.primitive = SCENE_NONE;
	walk_top(&p, &hits, 0, top + top_first, instance_list, instances, nodes, triangles);
	for (uint i = 0; i < RAYS_PER_PACKET && first + i < n_rays; i++) {
		const uint instance = ((const uint *)&hits.instance)[i];
		struct hit h = { instance == SCENE_NONE ? rays[first + i].t_max : ((const float *)&p.t_max)[i],
			         ((const float *)&hits.b1)[i], ((const float *)&hits.b2)[i], instance,
			         ((const uint *)&hits.primitive)[i] };

		out[first + i] = h;
	}
}
