/*
 * occlude_packet, intersect_packet: sixty-four consecutive rays per work item against eight-wide trees, as packets of
 * sixteen that share one stack. If all rays have the same octant, the beam around them first tests eight boxes at a
 * time; the packets then test the boxes that it meets one by one. If only a few rays of a packet remain, each tests
 * eight boxes at once on its own. See kernels/rays/rays.h.
 *
 * kernels/README.md lists what was tried on a processor with AVX-512 and dropped.
 */
#include "kernels/kernels.h"
#include "kernels/rays/rays.h"
#include "kernels/rays/packet.h"
#include "kernels/rays/wide.h"

/*
 * Up to this many rays of a packet continue one by one, each against eight boxes at once: less work than all lanes
 * against each box.
 */
#define PACKET_FEW 2

/* The hits of a packet's rays, at their t_max: the nearest so far. Any-hit queries only store which lanes hit surfaces
 * that have to be sampled; a ray that is stopped gets t_max -infinity. */
struct found {
	packf b1, b2;
	packu instance, primitive;
	packf after, shift; /* within an instance: as in struct walk */
	packu tie;
	uint asking; /* any-hit queries: a bit for each lane */
};

/* The hits that a packet's rays continue behind. */
struct last {
	packf t;
	packu instance, primitive;
};

/* Extract one ray of a packet, as in kernels/rays/walk.h. */
static inline void take_lane(const struct packet *p, uint lane, struct walk *w)
{
#define TAKE(row) w->row = ((const float *)&p->row)[lane]
	TAKE(ox), TAKE(oy), TAKE(oz), TAKE(dx), TAKE(dy), TAKE(dz), TAKE(ix), TAKE(iy), TAKE(iz);
	TAKE(far_ix), TAKE(far_iy), TAKE(far_iz), TAKE(near_x), TAKE(near_y), TAKE(near_z), TAKE(far_x), TAKE(far_y),
		TAKE(far_z);
	TAKE(t_min);
#undef TAKE
	find_rows(w);
	w->hit.t = ((const float *)&p->t_max)[lane];
}

/* The same for a nearest-hit query's hit, and the one that the ray continues behind. */
static inline void take_found(const struct found *f, uint lane, struct walk *w)
{
	w->hit.primitive = ((const uint *)&f->primitive)[lane];
	w->after = ((const float *)&f->after)[lane];
	w->shift = ((const float *)&f->shift)[lane];
	w->tie = ((const uint *)&f->tie)[lane];
}

/*
 * Walk lanes of a packet through a subtree one by one. @return the finished lanes: those of any-hit queries that have a
 * hit that stops them
 */
INLINED uint walk_lanes(struct packet *p, struct found *found, int any, struct known known, uint lanes, uint2 start,
                        __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	uint done = 0;

	while (lanes) {
		const uint lane = popcount((lanes & -lanes) - 1);
		struct walk w;

		lanes &= lanes - 1;
		take_lane(p, lane, &w);
		w.hit.instance = w.hit.primitive = SCENE_NONE;
		if (!any)
			take_found(found, lane, &w);
		w.asks = 0;
		walk_subtree(&w, start, 0, any, known, nodes, triangles);
		if (any && w.asks)
			found->asking |= 1u << lane;
		if (w.hit.instance == SCENE_NONE)
			continue;
		((float *)&p->t_max)[lane] = any ? -INFINITY : w.hit.t;
		done |= any ? 1u << lane : 0;
		if (!any) {
			((float *)&found->b1)[lane] = w.hit.b1, ((float *)&found->b2)[lane] = w.hit.b2;
			((uint *)&found->primitive)[lane] = w.hit.primitive;
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

/* The lanes, out of a set, that meet a box. octant -1: there are several. */
WIDE_VECTORS INLINED ulong lanes_meet(const struct packet *p, int octant, struct planes planes,
                                     __global const struct node8 *node, uint box, ulong lanes)
{
	__global const float *bounds = (__global const float *)node;
	ulong meet = 0;

	for (uint k = 0; k < RAYS_PACKETS; k++)
		if (lanes_of(lanes, k)) {
			const packf end = packet_end(&p[k]);

			meet |= lanes_at(pack_bits(octant < 0 ? packet_meets_any(&p[k], end, node, box) :
			                                        packet_meets(&p[k], end, bounds + box, planes)), k);
		}
	return meet;
}

/* A child of a node and the lanes that meet its box or, for nearest-hit queries, that meet the node: the box is tested
 * when the task is popped, as there may be nearer hits by then. */
struct task {
	uint2 child; /* a node (y: 0) or a leaf of y blocks; at the top, a leaf of y instances */
	uint node, box;
	ulong lanes;
};

/* Push the children of a node that are in `boxes` and that lanes meet. The nearest along a direction goes last, so that
 * it is popped first; any-hit queries use any order. */
WIDE_VECTORS INLINED uint push_children(struct task *stack, uint depth, const struct packet *p, int any, int octant,
                                        struct planes planes, uint boxes, __global const struct node8 *all, uint index,
                                        ulong lanes, const float *towards)
{
	__global const struct node8 *node = &all[index];
	const uint bottom = depth;
	float8 far = 0;

	if (!any)
		far = (vload8(0, node->lo[0]) + vload8(0, node->hi[0])) * towards[0] +
		      (vload8(0, node->lo[1]) + vload8(0, node->hi[1])) * towards[1] +
		      (vload8(0, node->lo[2]) + vload8(0, node->hi[2])) * towards[2];
	for (; boxes; boxes &= boxes - 1) {
		const uint box = popcount((boxes & -boxes) - 1);
		const ulong meet = any ? lanes_meet(p, octant, planes, node, box, lanes) : lanes;
		uint place = depth;

		for (; !any && place > bottom && ((const float *)&far)[stack[place - 1].box] < ((const float *)&far)[box]; place--)
			stack[place] = stack[place - 1];
		stack[place].child = (uint2)(node->child[box], node->count[box]);
		if (!any) {
			stack[place].node = index;
			stack[place].box = box;
		}
		stack[place].lanes = meet;
		depth += meet != 0;
	}
	return depth;
}

/* Mean direction of the rays. */
static inline void mean_direction(const struct packet *p, float towards[3])
{
	packf x = 0, y = 0, z = 0;

	for (uint k = 0; k < RAYS_PACKETS; k++) {
		const packi awake = p[k].t_min <= p[k].t_max;

		x += select((packf)(0), p[k].dx, awake), y += select((packf)(0), p[k].dy, awake),
			z += select((packf)(0), p[k].dz, awake);
	}
	towards[0] = sum_of(x), towards[1] = sum_of(y), towards[2] = sum_of(z);
}

/* Packets with only a few rays left in a subtree walk them through it one by one. @return lanes without these; finished
 * ones are no longer awake */
INLINED ulong walk_few(struct packet *p, struct found *found, int any, struct known known, uint2 start, ulong lanes,
                       ulong *awake, __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	for (uint k = 0; k < RAYS_PACKETS; k++) {
		const uint few = lanes_of(lanes, k);

		if (few == 0 || popcount(few) > PACKET_FEW)
			continue;
		*awake &= ~lanes_at(walk_lanes(&p[k], &found[k], any, known, few, start, nodes, triangles), k);
		lanes &= ~lanes_at(few, k);
	}
	return lanes;
}

/* The lanes, out of those that hit a primitive, that it stops. found->asking receives those that have to sample it. */
static inline packi stopped_lanes(struct found *found, struct known k, uint word, packi hit, const packf *b1,
                                  const packf *b2)
{
	uint stopped = 0, lanes = pack_bits(hit);

	if ((word & 3) == OPACITY_STOPS)
		return hit;
	if ((word & 3) == OPACITY_ASK) {
		found->asking |= lanes;
		return 0;
	}
	for (; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1), bit = lanes & -lanes;
		const uint does = opacity_at(k.words, k.opacity, word, ((const float *)b1)[lane], ((const float *)b2)[lane]);

		stopped |= does == OPACITY_STOPS ? bit : 0;
		found->asking |= does == OPACITY_ASK ? bit : 0;
	}
	return lanes_pack(stopped);
}

WIDE_VECTORS INLINED void try_blocks(struct packet *p, struct found *found, int any, struct known known,
                                     __global const struct triangle8 *blocks, uint n, ulong lanes)
{
	for (uint k = 0; k < RAYS_PACKETS; k++)
		for (uint i = 0; i < n && lanes_of(lanes, k); i++)
			for (uint lane = 0; lane < 8 && blocks[i].primitive[lane] != SCENE_NONE; lane++) {
				const packu primitive = blocks[i].primitive[lane];
				const uint word = any ? opacity_word(known.words, known.opacity, blocks[i].primitive[lane]) : 0;
				const uint passes = known.passes | opacity_sides(word, known.to_lights);
				packf t, b1, b2, t_eye;
				packi hit;

				if ((word & 3) == OPACITY_PASSES || passes == (INSTANCE_PASS_COUNTER | INSTANCE_PASS_CLOCKWISE))
					continue;
				hit = packet_triangle(&p[k], lanes_of(lanes, k), passes, &blocks[i], lane, &t, &b1, &b2);
				if (any) {
					hit = stopped_lanes(&found[k], known, word, hit, &b1, &b2);
					p[k].t_max = select(p[k].t_max, (packf)(-INFINITY), hit);
					continue;
				}
				hit &= (t < p[k].t_max) | (primitive < found[k].primitive);
				if (!any_pack(hit))
					continue;
				t_eye = t + found[k].shift;
				hit &= (t_eye > found[k].after) | ((t_eye == found[k].after) & (primitive >= found[k].tie));
				p[k].t_max = select(p[k].t_max, t, hit);
				found[k].b1 = select(found[k].b1, b1, hit), found[k].b2 = select(found[k].b2, b2, hit);
				found[k].primitive = select(found[k].primitive, primitive, hit);
			}
}

/* Walk one instance's tree with packets, of one octant or of several (-1). */
INLINED void walk_blas(struct packet *p, struct found *found, int any, struct known known, int octant,
                       __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	const struct planes planes = octant_planes(octant);
	struct task stack[RAYS_WIDE_STACK];
	ulong awake = awake_lanes(p), lanes = awake;
	uint2 at = 0; /* a node (y: 0) or a leaf of y blocks */
	struct beam beam;
	float towards[3];
	uint depth = 0;

	if (octant >= 0)
		beam = beam_around(p, RAYS_PACKETS, octant);
	if (!any)
		mean_direction(p, towards);
	for (;;) {
		lanes = walk_few(p, found, any, known, at, lanes, &awake, nodes, triangles);
		if (lanes && at.y == 0)
			depth = push_children(stack, depth, p, any, octant, planes,
			                      octant < 0 ? existing_boxes(&nodes[at.x]) : beam_meets(&beam, &nodes[at.x], planes), nodes,
			                      at.x,
			                      lanes, towards);
		else if (lanes)
			try_blocks(p, found, any, known, &triangles[at.x], at.y, lanes);
		if (any && lanes && at.y)
			awake = awake_lanes(p);
		do {
			if (!awake || depth == 0)
				return;
			depth--;
			lanes = stack[depth].lanes & awake;
			if (!any && lanes)
				lanes &= lanes_meet(p, octant, planes, &nodes[stack[depth].node], stack[depth].box, lanes);
		} while (!lanes);
		at = stack[depth].child;
	}
}

/* Distance along each ray where its walk through an instance starts. */
static inline packf far_shift(__global const struct instance *instance, const struct packet *p)
{
	const packf cx = instance->centre[0] - p->ox, cy = instance->centre[1] - p->oy, cz = instance->centre[2] - p->oz;
	const packf length = pack_max(pack_max(fabs(p->dx), fabs(p->dy)), fabs(p->dz));
	const packf shift = fma(cz, p->dz, fma(cy, p->dy, cx * p->dx)) / fma(p->dz, p->dz, fma(p->dy, p->dy, p->dx * p->dx)) -
	                    instance->radius / length;

	return select((packf)(0), shift, (shift * length > RAYS_FAR * instance->radius) & isfinite(shift));
}

/* Start in an instance without hits. last: what the rays continue behind, or NULL */
static inline void enter_instance(struct found *found, packf shift, const struct last *last, uint index)
{
	found->primitive = SCENE_NONE;
	found->shift = shift;
	found->after = last ? last->t : -INFINITY;
	found->tie = 0;
	if (last)
		found->tie = select(select((packu)(SCENE_NONE), last->primitive + 1, last->instance == index), (packu)(0),
		                    last->instance < index);
}

/* Return to eye space with an instance's hits that are nearer, or as near and of a lower instance. */
static inline void leave_instance(struct packet *eye, struct found *eye_found, const struct packet *p,
                                  const struct found *found, packf shift, uint index)
{
	const packf t = p->t_max + shift;
	const packi nearer = (found->primitive != SCENE_NONE) &
	                     ((eye_found->instance == SCENE_NONE) | (t < eye->t_max) |
	                      ((t == eye->t_max) & (index < eye_found->instance)));

	eye->t_max = select(eye->t_max, t, nearer);
	eye_found->b1 = select(eye_found->b1, found->b1, nearer), eye_found->b2 = select(eye_found->b2, found->b2, nearer);
	eye_found->instance = select(eye_found->instance, (packu)(index), nearer);
	eye_found->primitive = select(eye_found->primitive, found->primitive, nearer);
}

/* Walk one instance's tree with the lanes of `meets`. */
INLINED void walk_instance(struct packet *eye, struct found *eye_found, const struct last *last, int any,
                           uint to_lights, __global const uint *opacity, ulong meets, uint index,
                           __global const struct instance *instances, __global const struct node8 *all_nodes,
                           __global const struct triangle8 *all_triangles)
{
	__global const struct instance *instance = &instances[index];
	__global const struct node8 *nodes = all_nodes + instance->node8_first;
	__global const struct triangle8 *triangles = all_triangles + instance->triangle8_first;
	struct found found[RAYS_PACKETS];
	struct packet p[RAYS_PACKETS];
	packf shift[RAYS_PACKETS];
	const struct known known = known_of(instance, any, to_lights, opacity);
	int octant;

	if (known.opacity == OPACITY_PASSES)
		return;
	for (uint k = 0; k < RAYS_PACKETS; k++) {
		const int met = lanes_of(meets, k) != 0;

		packet_transform(&p[k], &eye[k], instance->obj_from_eye);
		shift[k] = far_shift(instance, &p[k]);
		p[k].ox = fma(shift[k], p[k].dx, p[k].ox), p[k].oy = fma(shift[k], p[k].dy, p[k].oy);
		p[k].oz = fma(shift[k], p[k].dz, p[k].oz);
		packet_prepare(&p[k]);
		p[k].t_min = met ? eye[k].t_min - shift[k] : 1;
		p[k].t_max = met ? eye[k].t_max - shift[k] : -INFINITY;
		p[k].t_min = select((packf)(NAN), p[k].t_min, packet_in_range(&p[k])); /* asleep; not in the beam */
		found[k].asking = 0;
		if (any)
			continue;
		enter_instance(&found[k], shift[k], last ? &last[k] : 0, index);
		/* t + shift decides */
		p[k].t_max += select((packf)(0), 3e-7f * eye[k].t_max, (shift[k] > 0) & (eye_found[k].instance != SCENE_NONE));
	}
	octant = packet_octant(p, RAYS_PACKETS);
	if (octant < 0)
		walk_blas(p, found, any, known, -1, nodes, triangles);
	else
		walk_blas(p, found, any, known, octant, nodes, triangles);
	for (uint k = 0; k < RAYS_PACKETS; k++)
		if (!any) {
			leave_instance(&eye[k], &eye_found[k], &p[k], &found[k], shift[k], index);
		} else if (lanes_of(meets, k)) {
			eye[k].t_max = select(eye[k].t_max, (packf)(-INFINITY), p[k].t_max == -INFINITY);
			eye_found[k].asking |= found[k].asking;
		}
}

INLINED void walk_top(struct packet *eye, struct found *found, const struct last *last, int any, uint to_lights,
                      __global const uint *opacity, __global const struct node8 *top,
                      __global const uint *instance_list, __global const struct instance *instances,
                      __global const struct node8 *nodes, __global const struct triangle8 *triangles)
{
	const struct planes planes = octant_planes(0);
	struct task stack[RAYS_WIDE_STACK];
	ulong awake = awake_lanes(eye);
	float towards[3];
	uint depth;

	if (!any)
		mean_direction(eye, towards);
	depth = push_children(stack, 0, eye, any, -1, planes, existing_boxes(top), top, 0, awake, towards);
	while (depth && awake) {
		const struct task task = stack[--depth];
		const ulong left = task.lanes & awake;
		const ulong lanes = any ? left : left & lanes_meet(eye, -1, planes, &top[task.node], task.box, left);

		if (lanes && task.child.y == 0)
			depth = push_children(stack, depth, eye, any, -1, planes, existing_boxes(&top[task.child.x]),
			                      top, task.child.x, lanes, towards);
		for (uint i = 0; i < task.child.y && lanes; i++)
			walk_instance(eye, found, last, any, to_lights, opacity, lanes, instance_list[task.child.x + i], instances,
			              nodes, triangles);
		if (any)
			awake = awake_lanes(eye);
	}
}

/* Transpose rows of four numbers of sixteen rays, where each row holds rays 0 to 3, 4 to 7 and so on. */
static inline void turn(float16 a, float16 b, float16 c, float16 d, packf *x, packf *y, packf *z, packf *w)
{
	*x = (packf)(a.s048c, b.s048c, c.s048c, d.s048c), *y = (packf)(a.s159d, b.s159d, c.s159d, d.s159d);
	*z = (packf)(a.s26ae, b.s26ae, c.s26ae, d.s26ae), *w = (packf)(a.s37bf, b.s37bf, c.s37bf, d.s37bf);
}

/* Load rows from sixteen rays. Lanes past the end, and rays that hit nothing by definition, sleep. @return a bit for
 * each awake lane */
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

static inline ulong load_packets(struct packet *p, __global const struct ray *rays, uint first, uint n)
{
	ulong lanes = 0;

	for (uint k = 0; k < RAYS_PACKETS; k++)
		lanes |= lanes_at(load_rays(&p[k], rays, first + k * RAYS_PER_PACKET, n), k);
	for (uint i = 0; i < RAYS_PER_ITEM; i += 2) /* prefetch the next item's rays; two fill a cache line */
		PREFETCH(&rays[first + RAYS_PER_ITEM + i]);
	return lanes;
}

KERNEL_OF(float16) void occlude_packet(KERNEL_ARGUMENTS(occlude_wide))
{
	const uint first = (uint)get_global_id(0) * RAYS_PER_ITEM;
	struct packet p[RAYS_PACKETS];
	struct found found[RAYS_PACKETS];
	ulong lanes, asking = 0;

	if (first >= n_rays)
		return;
	lanes = load_packets(p, rays, first, n_rays);
	for (uint k = 0; k < RAYS_PACKETS; k++)
		found[k].asking = 0;
	if (lanes)
		walk_top(p, found, 0, 1, to_lights, opacity, top + top_first, instance_list, instances, nodes, triangles);
	for (uint k = 0; k < RAYS_PACKETS; k++) {
		lanes &= ~lanes_at(pack_bits(p[k].t_max != -INFINITY), k);
		asking |= lanes_at(found[k].asking, k);
	}
	asking &= ~lanes;
	for (uint i = 0; i < RAYS_PER_ITEM && first + i < n_rays; i++)
		occluded[first + i] = ((uint)(lanes >> i) & 1u) | ((uint)(asking >> i) & 1u) << 1;
}

/* Load the hits that sixteen rays continue behind. */
static inline void load_last(struct packet *p, struct last *last, __global const struct hit *hits, uint first, uint n)
{
	last->t = p->t_min;
	p->t_min = fma(fabs(p->t_min), -RAYS_END_SLACK, p->t_min); /* walk_begin */
	last->instance = last->primitive = SCENE_NONE;
	for (uint lane = 0; lane < RAYS_PER_PACKET && first + lane < n; lane++) {
		((uint *)&last->instance)[lane] = hits[first + lane].instance;
		((uint *)&last->primitive)[lane] = hits[first + lane].primitive;
	}
}

KERNEL_OF(float16) void intersect_packet(KERNEL_ARGUMENTS(intersect_wide))
{
	const uint first = (uint)get_global_id(0) * RAYS_PER_ITEM;
	struct packet p[RAYS_PACKETS];
	struct found found[RAYS_PACKETS];
	struct last behind[RAYS_PACKETS];

	if (first >= n_rays)
		return;
	load_packets(p, rays, first, n_rays);
	for (uint k = 0; k < RAYS_PACKETS && after; k++)
		load_last(&p[k], &behind[k], last, first + k * RAYS_PER_PACKET, n_rays);
	for (uint k = 0; k < RAYS_PACKETS; k++) {
		found[k].b1 = found[k].b2 = 0;
		found[k].instance = found[k].primitive = SCENE_NONE;
	}
	walk_top(p, found, after ? behind : 0, 0, 0, 0, top + top_first, instance_list, instances, nodes, triangles);
	for (uint i = 0; i < RAYS_PER_ITEM && first + i < n_rays; i++) {
		const struct found *f = &found[i / RAYS_PER_PACKET];
		const uint lane = i % RAYS_PER_PACKET;
		struct hit hit;

		hit.instance = ((const uint *)&f->instance)[lane];
		hit.t = hit.instance == SCENE_NONE ? rays[first + i].t_max : ((const float *)&p[i / RAYS_PER_PACKET].t_max)[lane];
		hit.b1 = ((const float *)&f->b1)[lane], hit.b2 = ((const float *)&f->b2)[lane];
		hit.primitive = ((const uint *)&f->primitive)[lane];
		hits[first + i] = hit;
	}
}
