/*
 * occlude_packet: sixteen consecutive rays a work item against eight-wide trees, box by box; where only a few of them go on,
 * each of these on its own against eight boxes at once. See kernels/rays.h.
 */
#include "kernels/rays.h"
#include "kernels/packet.h"
#include "kernels/wide.h"

/* Rays that go on one by one, against eight boxes at once: less work than all lanes against each box. */
#define PACKET_FEW 2

/* Lanes of a packet down a subtree one by one. @return those that hit; their t_max is -infinity now */
static inline uint walk_lanes(struct packet *p, uint lanes, uint2 start, __global const struct node8 *nodes,
                       __global const struct triangle8 *triangles)
{
	uint done = 0;

	while (lanes) {
		const uint lane = popcount((lanes & -lanes) - 1);
		struct walk w;

		lanes &= lanes - 1;
		w.ox = ((const float *)&p->ox)[lane], w.oy = ((const float *)&p->oy)[lane], w.oz = ((const float *)&p->oz)[lane];
		w.dx = ((const float *)&p->dx)[lane], w.dy = ((const float *)&p->dy)[lane], w.dz = ((const float *)&p->dz)[lane];
		w.t_min = ((const float *)&p->t_min)[lane];
		w.hit.t = ((const float *)&p->t_max)[lane];
		w.hit.instance = w.hit.primitive = SCENE_NONE;
		prepare(&w);
		walk_subtree(&w, start, 0, 1, nodes, triangles);
		if (w.hit.instance != SCENE_NONE) {
			((float *)&p->t_max)[lane] = -INFINITY;
			done |= 1u << lane;
		}
	}
	return done;
}

/* Walk one instance's tree with a packet, of one octant or of several (-1). Rays that hit get a t_max of -infinity. */
WIDE_VECTORS static inline void walk_blas(struct packet *packet, int octant, __global const struct node8 *nodes,
                                   __global const struct triangle8 *triangles)
{
	struct packet rays = *packet, *p = &rays; /* a copy of its own stays in registers */
	const struct planes planes = octant_planes(octant);
	uint4 stack[RAYS_WIDE_STACK], entry = (uint4)(0, 0, 0xffff, 0); /* child, count, lanes that meet it */
	uint depth = 0, awake = pack_bits(p->t_min <= p->t_max);

	for (;;) {
		const uint lanes = entry.z & awake;

		if (popcount(lanes) <= PACKET_FEW) {
			awake &= ~walk_lanes(p, lanes, entry.xy, nodes, triangles);
		} else if (entry.y == 0) {
			__global const struct node8 *node = &nodes[entry.x];
			__global const float *bounds = (__global const float *)node;

			for (uint box = 0; box < 8 && node->lo[0][box] <= node->hi[0][box]; box++) {
				const uint meet = pack_bits(octant < 0 ? packet_meets_any(p, node, box) :
				                                         packet_meets(p, bounds + box, planes));

				stack[depth] = (uint4)(node->child[box], node->count[box], meet, 0);
				depth += meet != 0;
			}
		} else {
			for (uint i = 0; i < entry.y; i++) {
				__global const struct triangle8 *block = &triangles[entry.x + i];

				for (uint lane = 0; lane < 8 && block->primitive[lane] != SCENE_NONE; lane++)
					p->t_max = select(p->t_max, (packf)(-INFINITY), packet_triangle(p, block, lane));
			}
			awake = pack_bits(p->t_min <= p->t_max);
		}
		if (!awake || depth == 0)
			break;
		entry = stack[--depth];
	}
	packet->t_max = p->t_max;
}

/* How far along each ray its walk through an instance starts. */
static inline packf far_shift(__global const struct instance *instance, const struct packet *p)
{
	const packf cx = instance->centre[0] - p->ox, cy = instance->centre[1] - p->oy, cz = instance->centre[2] - p->oz;
	const packf length = pack_max(pack_max(fabs(p->dx), fabs(p->dy)), fabs(p->dz));
	const packf shift = fma(cz, p->dz, fma(cy, p->dy, cx * p->dx)) / fma(p->dz, p->dz, fma(p->dy, p->dy, p->dx * p->dx)) -
	                    instance->radius / length;

	return select((packf)(0), shift, (shift * length > RAYS_FAR * instance->radius) & isfinite(shift));
}

static inline void walk_instance(struct packet *eye, __global const struct instance *instance, __global const struct node8 *all_nodes,
                          __global const struct triangle8 *all_triangles)
{
	__global const struct node8 *nodes = all_nodes + instance->node8_first;
	__global const struct triangle8 *triangles = all_triangles + instance->triangle8_first;
	struct packet p;
	packf shift;
	int octant;

	packet_transform(&p, eye, instance->obj_from_eye);
	shift = far_shift(instance, &p);
	p.ox = fma(shift, p.dx, p.ox), p.oy = fma(shift, p.dy, p.oy), p.oz = fma(shift, p.dz, p.oz);
	packet_prepare(&p);
	p.t_min = eye->t_min - shift;
	p.t_max = eye->t_max - shift;
	octant = packet_octant(&p);
	if (octant < 0)
		walk_blas(&p, -1, nodes, triangles);
	else
		walk_blas(&p, octant, nodes, triangles);
	eye->t_max = select(eye->t_max, (packf)(-INFINITY), p.t_max == -INFINITY);
}

static inline void walk_top(struct packet *eye, __global const struct node8 *top, __global const uint *instance_list,
                     __global const struct instance *instances, __global const struct node8 *nodes,
                     __global const struct triangle8 *triangles)
{
	uint stack[RAYS_WIDE_STACK], depth = 0;

	stack[depth++] = 0;
	while (depth) {
		__global const struct node8 *node = &top[stack[--depth]];

		for (uint box = 0; box < 8 && node->lo[0][box] <= node->hi[0][box]; box++) {
			if (!any_pack(packet_meets_any(eye, node, box)))
				continue;
			if (node->count[box] == 0)
				stack[depth++] = node->child[box];
			for (uint i = 0; i < node->count[box]; i++)
				walk_instance(eye, &instances[instance_list[node->child[box] + i]], nodes, triangles);
		}
	}
}

/* Rows from sixteen rays; lanes past the end, and rays that hit nothing by definition, sleep. @return a bit for each awake */
static inline uint load_rays(struct packet *p, __global const struct ray *rays, uint first, uint n)
{
	packf t_min = 1, t_max = -INFINITY, ox = 0, oy = 0, oz = 0, dx = 1, dy = 1, dz = 1;
	packi finite;

	for (uint i = 0; i < RAYS_PER_PACKET && first + i < n; i++) {
		const float8 ray = vload8(first + i, (__global const float *)rays);

		((float *)&ox)[i] = ray.s0, ((float *)&oy)[i] = ray.s1, ((float *)&oz)[i] = ray.s2, ((float *)&t_min)[i] = ray.s3;
		((float *)&dx)[i] = ray.s4, ((float *)&dy)[i] = ray.s5, ((float *)&dz)[i] = ray.s6, ((float *)&t_max)[i] = ray.s7;
	}
	finite = isfinite(ox) & isfinite(oy) & isfinite(oz) & isfinite(dx) & isfinite(dy) & isfinite(dz) & (t_min <= t_max);
	p->ox = select((packf)(0), ox, finite), p->oy = select((packf)(0), oy, finite), p->oz = select((packf)(0), oz, finite);
	p->dx = select((packf)(1), dx, finite), p->dy = select((packf)(1), dy, finite), p->dz = select((packf)(1), dz, finite);
	p->t_min = select((packf)(1), t_min, finite);
	p->t_max = select((packf)(-INFINITY), t_max, finite);
	packet_prepare(p);
	return pack_bits(finite);
}

__kernel void occlude_packet(uint n_rays, __global const struct ray *rays, uint top_first,
                             __global const struct node8 *top, __global const uint *instance_list,
                             __global const struct instance *instances, __global const struct node8 *nodes,
                             __global const struct triangle8 *triangles, __global uint *occluded)
{
	const uint first = (uint)get_global_id(0) * RAYS_PER_PACKET;
	struct packet p;
	uint lanes;

	if (first >= n_rays)
		return;
	lanes = load_rays(&p, rays, first, n_rays);
	walk_top(&p, top + top_first, instance_list, instances, nodes, triangles);
	lanes &= pack_bits(p.t_max == -INFINITY);
	for (uint i = 0; i < RAYS_PER_PACKET && first + i < n_rays; i++)
		occluded[first + i] = lanes >> i & 1u;
}
