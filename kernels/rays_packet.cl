/*
 * occlude_packet: sixty-four consecutive rays a work item against eight-wide trees, as packets of sixteen that share one stack.
 * Where all have one octant, boxes are first asked eight at a time against the beam around all rays, those that it meets then one by
 * one by the packets. Where only a few rays of a packet go on, each does on its own against eight boxes at once. See kernels/rays.h.
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

static inline uint lanes_of(ulong lanes, uint k)
{
	return (uint)(lanes >> (RAYS_PER_PACKET * k)) & 0xffffu;
}

static inline ulong lanes_at(uint lanes, uint k)
{
	return (ulong)lanes << (RAYS_PER_PACKET * k);
}

static inline ulong awake_lanes(const struct packet *p)
{
	ulong awake = 0;

	for (uint k = 0; k < RAYS_PACKETS; k++)
		awake |= lanes_at(pack_bits(p[k].t_min <= p[k].t_max), k);
	return awake;
}

static inline uint existing_boxes(__global const struct node8 *node)
{
	return lane_bits(vload8(0, node->lo[0]) <= vload8(0, node->hi[0]));
}

/* A subtree to be walked, and the lanes that meet it. */
struct task {
	uint child, count;
	ulong lanes;
};

/* Packets of which only a few rays are left in a subtree send them through it one by one. @return lanes without these */
static inline ulong walk_few(struct packet *p, const struct task *task, ulong lanes, ulong *awake, __global const struct node8 *nodes,
                      __global const struct triangle8 *triangles)
{
	for (uint k = 0; k < RAYS_PACKETS; k++) {
		const uint few = lanes_of(lanes, k);

		if (few == 0 || popcount(few) > PACKET_FEW)
			continue;
		*awake &= ~lanes_at(walk_lanes(&p[k], few, (uint2)(task->child, task->count), nodes, triangles), k);
		lanes &= ~lanes_at(few, k);
	}
	return lanes;
}

WIDE_VECTORS static inline uint push_node(const struct packet *p, int octant, struct planes planes, const struct beam *beam,
                                   __global const struct node8 *node, ulong lanes, struct task *stack, uint depth)
{
	__global const float *bounds = (__global const float *)node;

	for (uint boxes = octant < 0 ? existing_boxes(node) : beam_meets(beam, node, planes); boxes; boxes &= boxes - 1) {
		const uint box = popcount((boxes & -boxes) - 1);
		ulong meet = 0;

		for (uint k = 0; k < RAYS_PACKETS; k++)
			if (lanes_of(lanes, k))
				meet |= lanes_at(pack_bits(octant < 0 ? packet_meets_any(&p[k], node, box) :
				                                        packet_meets(&p[k], bounds + box, planes)), k);
		stack[depth].child = node->child[box];
		stack[depth].count = node->count[box];
		stack[depth].lanes = meet;
		depth += meet != 0;
	}
	return depth;
}

WIDE_VECTORS static inline void try_blocks(struct packet *p, __global const struct triangle8 *blocks, uint n, ulong lanes)
{
	for (uint k = 0; k < RAYS_PACKETS; k++)
		for (uint i = 0; i < n && lanes_of(lanes, k); i++)
			for (uint lane = 0; lane < 8 && blocks[i].primitive[lane] != SCENE_NONE; lane++)
				p[k].t_max = select(p[k].t_max, (packf)(-INFINITY), packet_triangle(&p[k], &blocks[i], lane));
}

/* Walk one instance's tree with packets, of one octant or of several (-1). Rays that hit get a t_max of -infinity. */
static inline void walk_blas(struct packet *p, int octant, __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	const struct planes planes = octant_planes(octant);
	struct task stack[RAYS_WIDE_STACK], task = { 0, 0, awake_lanes(p) };
	ulong awake = task.lanes;
	struct beam beam;
	uint depth = 0;

	if (octant >= 0)
		beam = beam_around(p, RAYS_PACKETS, octant);
	for (;;) {
		const ulong lanes = walk_few(p, &task, task.lanes & awake, &awake, nodes, triangles);

		if (lanes && task.count == 0) {
			depth = push_node(p, octant, planes, &beam, &nodes[task.child], lanes, stack, depth);
		} else if (lanes) {
			try_blocks(p, &triangles[task.child], task.count, lanes);
			awake = awake_lanes(p);
		}
		if (!awake || depth == 0)
			return;
		task = stack[--depth];
	}
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

/* One instance's tree with the packets of `meets`. */
static inline void walk_instance(struct packet *eye, uint meets, __global const struct instance *instance,
                          __global const struct node8 *all_nodes, __global const struct triangle8 *all_triangles)
{
	__global const struct node8 *nodes = all_nodes + instance->node8_first;
	__global const struct triangle8 *triangles = all_triangles + instance->triangle8_first;
	struct packet p[RAYS_PACKETS];
	packf shift;
	int octant;

	for (uint k = 0; k < RAYS_PACKETS; k++) {
		packet_transform(&p[k], &eye[k], instance->obj_from_eye);
		shift = far_shift(instance, &p[k]);
		p[k].ox = fma(shift, p[k].dx, p[k].ox), p[k].oy = fma(shift, p[k].dy, p[k].oy);
		p[k].oz = fma(shift, p[k].dz, p[k].oz);
		packet_prepare(&p[k]);
		p[k].t_min = meets >> k & 1 ? eye[k].t_min - shift : 1;
		p[k].t_max = meets >> k & 1 ? eye[k].t_max - shift : -INFINITY;
		p[k].t_min = select((packf)(NAN), p[k].t_min, packet_in_range(&p[k])); /* others sleep, and do not spoil the beam */
	}
	octant = packet_octant(p, RAYS_PACKETS);
	if (octant < 0)
		walk_blas(p, -1, nodes, triangles);
	else
		walk_blas(p, octant, nodes, triangles);
	for (uint k = 0; k < RAYS_PACKETS; k++)
		if (meets >> k & 1)
			eye[k].t_max = select(eye[k].t_max, (packf)(-INFINITY), p[k].t_max == -INFINITY);
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
			uint meets = 0;

			for (uint k = 0; k < RAYS_PACKETS; k++)
				meets |= any_pack(packet_meets_any(&eye[k], node, box)) ? 1u << k : 0;
			if (!meets)
				continue;
			if (node->count[box] == 0)
				stack[depth++] = node->child[box];
			for (uint i = 0; i < node->count[box]; i++)
				walk_instance(eye, meets, &instances[instance_list[node->child[box] + i]], nodes, triangles);
		}
	}
}

/* Rows of four numbers of sixteen rays, which stand together in each: of rays 0 to 3, 4 to 7 and so on. */
static inline void turn(float16 a, float16 b, float16 c, float16 d, packf *x, packf *y, packf *z, packf *w)
{
	*x = (packf)(a.s048c, b.s048c, c.s048c, d.s048c), *y = (packf)(a.s159d, b.s159d, c.s159d, d.s159d);
	*z = (packf)(a.s26ae, b.s26ae, c.s26ae, d.s26ae), *w = (packf)(a.s37bf, b.s37bf, c.s37bf, d.s37bf);
}

/* Rows from sixteen rays; lanes past the end, and rays that hit nothing by definition, sleep. @return a bit for each awake */
static inline uint load_rays(struct packet *p, __global const struct ray *rays, uint first, uint n)
{
	const float8 asleep = (float8)(0, 0, 0, 1, 1, 1, 1, -INFINITY);
	packf t_min, t_max, ox, oy, oz, dx, dy, dz;
	float16 two[8];
	packi finite;

	for (uint i = 0; i < 8; i++) {
		const uint ray = first + 2 * i;

		two[i] = (float16)(asleep, asleep);
		if (ray + 1 < n)
			two[i] = vload16(0, (__global const float *)(rays + ray));
		else if (ray < n)
			two[i].lo = vload8(0, (__global const float *)(rays + ray));
	}
	turn((float16)(two[0].lo.lo, two[0].hi.lo, two[1].lo.lo, two[1].hi.lo),
	     (float16)(two[2].lo.lo, two[2].hi.lo, two[3].lo.lo, two[3].hi.lo),
	     (float16)(two[4].lo.lo, two[4].hi.lo, two[5].lo.lo, two[5].hi.lo),
	     (float16)(two[6].lo.lo, two[6].hi.lo, two[7].lo.lo, two[7].hi.lo), &ox, &oy, &oz, &t_min);
	turn((float16)(two[0].lo.hi, two[0].hi.hi, two[1].lo.hi, two[1].hi.hi),
	     (float16)(two[2].lo.hi, two[2].hi.hi, two[3].lo.hi, two[3].hi.hi),
	     (float16)(two[4].lo.hi, two[4].hi.hi, two[5].lo.hi, two[5].hi.hi),
	     (float16)(two[6].lo.hi, two[6].hi.hi, two[7].lo.hi, two[7].hi.hi), &dx, &dy, &dz, &t_max);
	finite = isfinite(ox) & isfinite(oy) & isfinite(oz) & isfinite(dx) & isfinite(dy) & isfinite(dz) & (t_min <= t_max);
	p->ox = select((packf)(0), ox, finite), p->oy = select((packf)(0), oy, finite), p->oz = select((packf)(0), oz, finite);
	p->dx = select((packf)(1), dx, finite), p->dy = select((packf)(1), dy, finite), p->dz = select((packf)(1), dz, finite);
	packet_prepare(p);
	finite &= packet_in_range(p);
	p->t_min = select((packf)(1), t_min, finite);
	p->t_max = select((packf)(-INFINITY), t_max, finite);
	return pack_bits(finite);
}

__kernel void occlude_packet(uint n_rays, __global const struct ray *rays, uint top_first,
                             __global const struct node8 *top, __global const uint *instance_list,
                             __global const struct instance *instances, __global const struct node8 *nodes,
                             __global const struct triangle8 *triangles, __global uint *occluded)
{
	const uint first = (uint)get_global_id(0) * RAYS_PER_ITEM;
	struct packet p[RAYS_PACKETS];
	ulong lanes = 0;

	if (first >= n_rays)
		return;
	for (uint k = 0; k < RAYS_PACKETS; k++)
		lanes |= lanes_at(load_rays(&p[k], rays, first + k * RAYS_PER_PACKET, n_rays), k);
	for (uint i = 0; i < RAYS_PER_ITEM; i += 2) /* the next item's; two fill a line */
		LANES_PREFETCH(&rays[first + RAYS_PER_ITEM + i]);
	walk_top(p, top + top_first, instance_list, instances, nodes, triangles);
	for (uint k = 0; k < RAYS_PACKETS; k++)
		lanes &= ~lanes_at(pack_bits(p[k].t_max != -INFINITY), k);
	for (uint i = 0; i < RAYS_PER_ITEM && first + i < n_rays; i++)
		occluded[first + i] = (uint)(lanes >> i) & 1u;
}
