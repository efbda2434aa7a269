/*
 * dome_find_packet, dome_light_packet: kernels/frame/dome/dome.h for CPUs, sixteen fragments at once with bit-identical
 * results. plain_dome: the rays that a plain frame sends (kernels/frame/plain/plain.h).
 *
 * dome_light_packet first lays out the fragments of a tile as rows, so that a pixel's neighbours are its own and other
 * rows at an offset. If pixels have several lit fragments, there are several layers of rows.
 */
#include "kernels/frame/dome/dome.h"
#include "kernels/frame/plain/plain_row.h"

/* --- Looks around ------------------------------------------------------------------------------------------------ */

/* Find the fragments of a work item that receive light; the others are done here. */
static inline void find_left(const struct dome_find_arguments *a, uint first, struct pack_left *left)
{
	left->first = first;
	left->all = left->packed = 0;
	for (uint i = 0; i < min(SHADE_PACKET, a->n - first); i++) {
		__global const struct geometry *g = &a->tables.geometries[a->fragments[first + i].instance];
		__global const struct scene_material *m = &a->tables.materials[g->material];

		left->material[i] = g->material;
		if (!(a->shaded[first + i].flags & SHADED_THERE) || !(m->surface.hidden & SCENE_DOME_LIT) ||
		    g->flags & GEOMETRY_EXPANDED) {
			dome_find_none(a, first + i);
			continue;
		}
		left->all |= (ulong)1 << i;
		if (!pack_refuses_fog(m) && pack_knows_geometry(g))
			left->packed |= (ulong)1 << i;
	}
}

/* Dome data of sixteen fragments. */
struct looks {
	struct vec3_16 o, axes[3]; /* axes[2]: the normal */
	packf strength;             /* 0: receives none */
	packu part;                 /* the lanes' parts of their blocks' directions */
};

/* For fragments of one material that receive the dome's light. height: as for their location */
WIDE_VECTORS static inline void look_around(const struct dome_find_arguments *a, const struct pack *p, uint height,
                                            const struct pack_surface *surface, struct looks *l)
{
	const struct vec3_16 from = pack_view_direction(p, height), back = v3_scale(v3_normalize(from), (packf)(-1));
	const packf strength = pack_fog(&a->tables, p) * (p->material->lighting ? a->dome.lit : 1.0f);

	l->part = as_uint16((int)height - 1 - p->row) % DOME_BLOCK * DOME_BLOCK + as_uint16(p->x) % DOME_BLOCK;
	l->axes[2] = v3_choose(v3_dot(surface->plane, from) > 0.0f, v3_scale(surface->plane, (packf)(-1)), surface->plane);
	l->o = pack_ray_origin(p->weight, surface, l->axes[2], back);
	l->strength = select((packf)(0), strength, (v3_dot(l->axes[2], l->axes[2]) > 0.0f) & (strength > 0.0f));
	sample_basis(l->axes[2], &l->axes[0], &l->axes[1]);
}

/* Directions and lengths of a sample's rays. */
WIDE_VECTORS static inline struct vec3_16 look_along(const struct dome_find_arguments *a, const struct looks *l,
                                                      uint sample, packf *reach)
{
	packf row[4];

	pack_gather(a->directions + sample * DOME_BLOCK * DOME_BLOCK * 4, l->part, row);
	*reach = row[3];
	return v3_add(v3_add(v3_scale(l->axes[0], row[0]), v3_scale(l->axes[1], row[1])),
	                v3_scale(l->axes[2], row[2]));
}

/* Store some lanes' place and rays at their index in the list. */
static inline void store_looks(const struct dome_find_arguments *a, const struct pack_list *list, uint lanes,
                               const struct looks *l)
{
	const uint lit = lanes & pack_bits(l->strength > 0.0f);

	for (uint left = lanes & ~lit; left; left &= left - 1)
		dome_find_none(a, list->item[popcount((left & -left) - 1)]);
	for (uint left = lit; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);

		vstore8((float8)(LANE(l->o.x, const float, lane), LANE(l->o.y, const float, lane), LANE(l->o.z, const float, lane),
		                 LANE(l->strength, const float, lane), LANE(l->axes[2].x, const float, lane),
		                 LANE(l->axes[2].y, const float, lane), LANE(l->axes[2].z, const float, lane), 0),
		        list->item[lane], (__global float *)a->places);
	}
	for (uint sample = 0; sample < a->samples; sample++) {
		packf reach;
		const struct vec3_16 d = look_along(a, l, sample, &reach);

		for (uint left = lit; left; left &= left - 1) {
			const uint lane = popcount((left & -left) - 1);

			vstore8((float8)(LANE(l->o.x, const float, lane), LANE(l->o.y, const float, lane),
			                 LANE(l->o.z, const float, lane), 0, LANE(d.x, const float, lane),
			                 LANE(d.y, const float, lane), LANE(d.z, const float, lane),
			                 LANE(reach, const float, lane)),
			        list->item[lane], (__global float *)(a->rays + sample * a->n));
		}
	}
}

static inline void find_lanes(const struct dome_find_arguments *a, const struct pack_list *list, uint lanes)
{
	__global const struct geometry *g = &a->tables.geometries[list->instance[0]];
	struct pack_surface surface;
	struct looks looks;
	struct pack p;

	p.material = &a->tables.materials[g->material];
	p.view = &a->views[g->view];
	pack_locate(&a->tables, a->windows, a->width, 1, list, lanes, &p);
	pack_surface(&a->tables, &p, &surface);
	pack_measure(&p, &surface);
	look_around(a, &p, 1, &surface, &looks);
	store_looks(a, list, lanes, &looks);
}

KERNEL_OF(float16) void dome_find_packet(KERNEL_ARGUMENTS(dome_find))
{
	const uint first = (uint)get_global_id(0) * SHADE_PACKET;
	const struct dome_find_arguments a = KERNEL_STRUCT(dome_find);
	uint item[PACK_SIZE], lanes;
	struct pack_left left;
	struct pack_list list;

	if (first >= n)
		return;
	find_left(&a, first, &left);
	while (left.all) {
		lanes = pack_next(&left, item);
		for (uint lane = 0; lane < PACK_SIZE && lanes; lane++)
			pack_take(fragments, pixels, item[lane], lane, &list);
		if (lanes)
			find_lanes(&a, &list, lanes);
		else
			dome_find_item(&a, item[0]);
	}
}

/* --- Plain frames ------------------------------------------------------------------------------------------------ */

/* Kept from one fragment to the next. */
struct dome_kept {
	struct pack_kept pack;
	struct setup_kept one;
	struct shadow_kept ray;
};

/* Arguments of dome_find_item for fragments in a->fragments. */
static inline struct dome_find_arguments looks_of(const struct plain_arguments *a)
{
	const struct dome_find_arguments d = {
		.tables = a->tables, .views = a->views, .windows = a->windows, .fragments = a->fragments, .pixels = a->pixels,
		.width = a->width, .shaded = a->shaded, .dome = a->dome, .directions = a->directions, .samples = a->samples,
		.n = a->n, .places = a->places, .rays = a->looks,
	};

	return d;
}

/* For fragments of one material: the rays to lights, sent as in plain, and dome data in their lanes of `looks`. @return
 * the lanes that are done */
static inline uint look_lanes(const struct plain_arguments *a, const struct shade_arguments *s,
                              const struct plain_row *row, uint lanes, struct pack_kept *kept, struct looks *looks)
{
	const struct tables *t = &a->tables;
	__global const struct geometry *g = &t->geometries[row->list.instance[popcount((lanes & -lanes) - 1)]];
	const struct dome_find_arguments d = looks_of(a);
	struct lit_16 here;
	struct pack_surface surface;
	struct looks own;
	struct pack *p = &kept->last;
	packi done;

	p->material = &t->materials[g->material];
	p->view = &a->views[g->view];
	lanes = pack_place(s, &row->list, lanes, 1, kept, p);
	if (!lanes)
		return 0;
	pack_surface(t, p, &surface);
	if (a->n_slots && p->material->surface.relit)
		pack_lit_here(s, &row->list, p, &surface, lanes, &here);
	if (a->n_slots)
		plain_send_rays(a, row, p, &surface, p->material->surface.relit ? here.lights : pack_lights(t, p), lanes);
	else
		pack_measure(p, &surface);
	if (!(p->material->surface.hidden & SCENE_DOME_LIT))
		return lanes;
	look_around(&d, p, a->height, &surface, &own);
	done = pack_mask(lanes);
	looks->o = v3_choose(done, own.o, looks->o);
	for (uint i = 0; i < 3; i++)
		looks->axes[i] = v3_choose(done, own.axes[i], looks->axes[i]);
	looks->strength = select(looks->strength, own.strength, done);
	looks->part = select(looks->part, own.part, done);
	return lanes;
}

/* Transpose four numbers of sixteen records, keeping each four records together. */
WIDE_VECTORS static inline void turn(packf x, packf y, packf z, packf w, packf *out)
{
	out[0] = (packf)(x.s0, y.s0, z.s0, w.s0, x.s1, y.s1, z.s1, w.s1, x.s2, y.s2, z.s2, w.s2, x.s3, y.s3, z.s3, w.s3);
	out[1] = (packf)(x.s4, y.s4, z.s4, w.s4, x.s5, y.s5, z.s5, w.s5, x.s6, y.s6, z.s6, w.s6, x.s7, y.s7, z.s7, w.s7);
	out[2] = (packf)(x.s8, y.s8, z.s8, w.s8, x.s9, y.s9, z.s9, w.s9, x.sa, y.sa, z.sa, w.sa, x.sb, y.sb, z.sb, w.sb);
	out[3] = (packf)(x.sc, y.sc, z.sc, w.sc, x.sd, y.sd, z.sd, w.sd, x.se, y.se, z.se, w.se, x.sf, y.sf, z.sf, w.sf);
}

/* Store sixteen records of eight numbers each, from rows of one number each. */
WIDE_VECTORS static inline void store_records(const packf *row, __global float *to)
{
	packf first[4], last[4];

	turn(row[0], row[1], row[2], row[3], first);
	turn(row[4], row[5], row[6], row[7], last);
	for (uint i = 0; i < 4; i++) {
		*(__global pack_loose_floats *)(to + 32 * i) = (packf)(first[i].s0123, last[i].s0123, first[i].s4567, last[i].s4567);
		*(__global pack_loose_floats *)(to + 32 * i + 16) = (packf)(first[i].s89ab, last[i].s89ab,
		                                                            first[i].scdef, last[i].scdef);
	}
}

/* Store the places and rays of a row. */
WIDE_VECTORS static inline void store_row_of_looks(const struct dome_find_arguments *a, uint base,
                                                   const struct looks *l)
{
	const packi lit = l->strength > 0.0f;
	packf row[8] = { l->o.x, l->o.y, l->o.z, l->strength, l->axes[2].x, l->axes[2].y, l->axes[2].z, 0 };

	store_records(row, (__global float *)(a->places + base));
	for (uint sample = 0; sample < a->samples; sample++) {
		packf reach;
		const struct vec3_16 d = look_along(a, l, sample, &reach);

		row[3] = 0;
		row[4] = select((packf)(0), d.x, lit);
		row[5] = select((packf)(0), d.y, lit);
		row[6] = select((packf)(0), d.z, lit);
		row[7] = select((packf)(-INFINITY), reach, lit);
		store_records(row, (__global float *)(a->rays + sample * a->n + base));
	}
}

static inline void look_alone(const struct plain_arguments *a, const struct shade_arguments *s,
                              const struct plain_row *row, uint lane, struct dome_kept *kept)
{
	const struct shadow_ray_arguments r = plain_rays(a);
	const struct dome_find_arguments d = looks_of(a);
	const uint item = row->base + lane;

	a->fragments[item] = plain_fragment(a, row->x + lane, row->y);
	a->pixels[item] = row->list.pixel[lane];
	shade_item(s, item, 0, &kept->one);
	for (uint slot = 0; slot < a->n_slots; slot++)
		shadow_ray_item(&r, slot * a->n + item, 0, &kept->ray);
	dome_find_item(&d, item);
}

static inline void look_row(const struct plain_arguments *a, const struct shade_arguments *s,
                            const struct plain_row *row, uint lanes, struct dome_kept *kept)
{
	const struct dome_find_arguments d = looks_of(a);
	uint material, alone = 0;
	struct looks looks;

	looks.o = looks.axes[0] = looks.axes[1] = looks.axes[2] = v3_16(0, 0, 0);
	looks.strength = 0;
	looks.part = 0;
	for (uint left = a->n_slots ? ~lanes & 0xffffu : 0; left; left &= left - 1)
		for (uint slot = 0; slot < a->n_slots; slot++)
			stage_no_ray(&a->rays[slot * a->n + row->base + popcount((left & -left) - 1)]);
	while (lanes) {
		const uint bit = lanes & -lanes, same = pack_same_kind(&a->tables, &row->list, lanes, &material);
		uint done = 0;

		if (same & bit && plain_knows(s, &a->tables.materials[material]))
			done = look_lanes(a, s, row, same, &kept->pack, &looks);
		alone |= bit & ~done;
		lanes &= ~(done | bit);
	}
	store_row_of_looks(&d, row->base, &looks);
	for (; alone; alone &= alone - 1)
		look_alone(a, s, row, popcount((alone & -alone) - 1), kept);
}

KERNEL_OF(float16) void plain_dome(KERNEL_ARGUMENTS(plain))
{
	const struct plain_arguments a = KERNEL_STRUCT(plain);
	const struct shade_arguments s = plain_shading(&a, 0);
	const uint item = (uint)get_global_id(0);
	struct dome_kept kept;
	struct plain_row row;

	if (item >= plain_blocks(width, request.height) || blocks[item] == SCENE_NONE)
		return;
	pack_keep_nothing(&kept.pack);
	for (uint k = 0; k < PLAIN_ROWS; k++) {
		const uint lanes = plain_load_row(&a, 0, item, k, &row);

		look_row(&a, &s, &row, lanes, &kept);
	}
}

/* --- Light ------------------------------------------------------------------------------------------------------- */

/* Columns of a tile and those that its blocks reach, with an equal margin on the left. */
#define LEFT DOME_BLOCK
#define COLUMNS (DOME_WIDTH + 2 * DOME_BLOCK)
/* Maximum number of lit fragments per pixel. */
#define LAYERS 4

/* A tile's fragments. strength is 0 where there is none. */
struct field {
	struct layer {
		float from[3][CAMERA_TILE][COLUMNS], normal[3][CAMERA_TILE][COLUMNS], strength[CAMERA_TILE][COLUMNS];
		float sum[4][CAMERA_TILE][COLUMNS];
		uint item[CAMERA_TILE][COLUMNS];
	} layer[LAYERS];
	uint layers[CAMERA_TILE]; /* number of layers of each row */
	uint x, low, bottom, top; /* its first column; its first row; its rows within the rectangle */
	int first[PACK_SIZE];     /* first column of each column's block, relative to this field */
	uint even;                /* 1: all blocks have the same position relative to their pixels */
};

/* Load sixteen pixels of a row of a layer. item: their fragments */
WIDE_VECTORS static inline void load_sixteen(const struct dome_light_arguments *a, uint row, uint column,
                                             struct layer *to)
{
	const packu item = *(const pack_loose_uints *)(to->item[row] + column);
	const packi there = item != SCENE_NONE;
	const packu index = select((packu)(0), item, there);
	packf place[4], rest[4], sum[4];

	pack_gather_from((__global const float *)a->places, index * 8, place);
	pack_gather_from((__global const float *)a->places, index * 8 + 3, rest);
	pack_gather(a->sums, index, sum);
	for (uint k = 0; k < 3; k++) {
		*(pack_loose_floats *)(to->from[k][row] + column) = place[k];
		*(pack_loose_floats *)(to->normal[k][row] + column) = rest[k + 1];
	}
	for (uint k = 0; k < 4; k++)
		*(pack_loose_floats *)(to->sum[k][row] + column) = sum[k];
	*(pack_loose_floats *)(to->strength[row] + column) = select((packf)(0), place[3], there);
}

/* List the fragments of a pixel that may be lit, one per layer. @return 0: there are too many */
static inline int list_pixel(const struct dome_light_arguments *a, uint begin, uint count, uint row, uint column,
                             struct field *f)
{
	uint n = 0;

	for (uint item = begin; item < begin + count; item++) {
		if (!(a->places[item].strength > 0.0f))
			continue;
		if (n == LAYERS)
			return 0;
		for (uint i = 0; i < COLUMNS && n == f->layers[row]; i++)
			f->layer[n].item[row][i] = SCENE_NONE;
		f->layer[n++].item[row][column] = item;
		f->layers[row] = max(f->layers[row], n);
	}
	return 1;
}

/* List those of a row of pixels. @return 0: there are too many */
static inline int list_row(const struct dome_light_arguments *a, uint y, struct field *f)
{
	const int left = (int)f->x - (int)LEFT;
	const uint begin = (uint)max(a->rectangle.x0 - left, 0), end = (uint)min(a->rectangle.x1 - left, (int)COLUMNS);
	int few = 1;

	f->layers[y - f->low] = 0;
	for (uint column = begin; column < end && few; column++) {
		const uint pixel = y * a->width + (uint)(left + (int)column);

		few = list_pixel(a, a->first[pixel], a->counts[pixel], y - f->low, column, f);
	}
	return few;
}

/* List those of a row of a plain frame's pixels, which have at most one: sixteen columns of the field. */
WIDE_VECTORS static inline void list_plain_row(const struct dome_light_arguments *a, uint y, uint column,
                                               struct field *f)
{
	const uint own = plain_base(plain_place(a->blocks, a->width, f->x, y), y);
	const uint before = f->x ? plain_base(plain_place(a->blocks, a->width, f->x - 1, y), y) : SCENE_NONE;
	const uint after = f->x + DOME_WIDTH < a->width ?
	                           plain_base(plain_place(a->blocks, a->width, f->x + DOME_WIDTH, y), y) :
	                           SCENE_NONE;
	const packi x = (int)f->x - (int)LEFT + (int)column + PACK_LANES;
	const packu base = select(select((packu)(own), (packu)(before), x < (int)f->x), (packu)(after),
	                          x >= (int)(f->x + DOME_WIDTH));

	*(pack_loose_uints *)(f->layer[0].item[y - f->low] +
	                      column) = select((packu)(SCENE_NONE), base + as_uint16(x) % PLAIN_WIDTH,
	                                       (x >= a->rectangle.x0) & (x < a->rectangle.x1) & (base != SCENE_NONE));
}

/* @return 0: there are too many */
static inline int fill_row(const struct dome_light_arguments *a, uint y, struct field *f)
{
	const uint row = y - f->low;

	if (a->in_blocks) {
		list_plain_row(a, y, 0, f);
		list_plain_row(a, y, COLUMNS - PACK_SIZE, f);
		f->layers[row] = 1;
	} else if (!list_row(a, y, f)) {
		return 0;
	}
	for (uint i = 0; i < f->layers[row]; i++) {
		load_sixteen(a, row, 0, &f->layer[i]);
		load_sixteen(a, row, COLUMNS - PACK_SIZE, &f->layer[i]);
	}
	if (a->in_blocks)
		f->layers[row] = any_pack((*(const pack_loose_floats *)f->layer[0].strength[row] > 0.0f) |
		                          (*(const pack_loose_floats *)(f->layer[0].strength[row] + COLUMNS -
		                                                        PACK_SIZE) > 0.0f)) ?
		                         1 :
		                         0;
	return 1;
}

/* Sixteen numbers of a row, starting at a column of each lane's block. */
WIDE_VECTORS static inline packf take(const struct field *f, const float *row, uint column)
{
	packf out;

	if (f->even)
		return *(const pack_loose_floats *)(row + LEFT - DOME_BLOCK / 2 + column);
	for (uint lane = 0; lane < PACK_SIZE; lane++)
		LANE(out, float, lane) = row[(uint)f->first[lane] + column];
	return out;
}

WIDE_VECTORS static inline struct vec3_16 take_vec(const struct field *f, const float (*rows)[CAMERA_TILE][COLUMNS],
                                                    uint row, uint column)
{
	return v3_16(take(f, rows[0][row], column), take(f, rows[1][row], column), take(f, rows[2][row], column));
}

/* Sixteen numbers of the tile's own pixels in a row. */
WIDE_VECTORS static inline packf own(const float *row)
{
	return *(const pack_loose_floats *)(row + LEFT);
}

WIDE_VECTORS static inline struct vec3_16 own_vec(const float (*rows)[CAMERA_TILE][COLUMNS], uint row)
{
	return v3_16(own(rows[0][row]), own(rows[1][row]), own(rows[2][row]));
}

/* dome_add_block for the pixels of a row of a layer. */
WIDE_VECTORS static inline void add_blocks(const struct field *f, uint row, uint layer, packf *sum)
{
	packf alike[4] = { 0, 0, 0, 0 };
	packi few;
	const struct vec3_16 from = own_vec(f->layer[layer].from, row), n = own_vec(f->layer[layer].normal, row);
	const packi first = vload16(0, f->first), column = PACK_LANES + (int)LEFT;
	const uint begin = dome_first(f->low + row, f->bottom, f->top) - f->low,
		   end = min(begin + DOME_BLOCK, f->top - f->low);

	for (uint bx = 0; bx < DOME_BLOCK; bx++) {
		packf part[4] = { 0, 0, 0, 0 }, others[4] = { 0, 0, 0, 0 };

		for (uint by = begin; by < end; by++)
			for (uint i = 0; i < f->layers[by]; i++) {
				const struct layer *l = &f->layer[i];
				const struct vec3_16 apart = v3_sub(take_vec(f, l->from, by, bx), from);
				const packf off = v3_dot(n, apart);
				const packi self = by == row && i == layer ? first + (int)bx == column : (packi)(0);
				const packi faces = self | ((take(f, l->strength[by], bx) > 0.0f) &
				                            (v3_dot(n, take_vec(f, l->normal, by, bx)) > 0.9f));
				const packi same = faces & (self | (off * off <= 0.1f * v3_dot(apart, apart)));

				for (uint k = 0; k < 4; k++) {
					const packf light = take(f, l->sum[k][by], bx);

					others[k] += select((packf)(0), light, faces);
					part[k] += select((packf)(0), light, same);
				}
			}
		for (uint k = 0; k < 4; k++) {
			sum[k] += part[k];
			alike[k] += others[k];
		}
	}
	few = sum[3] <= DOME_OWN * ((float)(DOME_BLOCK * DOME_BLOCK) * own(f->layer[layer].sum[3][row]));
	for (uint k = 0; k < 4; k++)
		sum[k] = select(sum[k], alike[k], few);
}

/* Store the factors of a row of a plain frame's pixels where plain_shadow reads them. */
WIDE_VECTORS static inline void store_row(const struct dome_light_arguments *a, const struct field *f, uint row,
                                          const packf *factor)
{
	const uint item = plain_base(plain_place(a->blocks, a->width, f->x, f->low + row), f->low + row);

	for (uint c = 0; c < 3 && item != SCENE_NONE; c++)
		*(__global pack_loose_floats *)(a->factors + c * a->n + item) = factor[c];
}

/* Light one layer of a row's pixels. */
WIDE_VECTORS static inline void light_row(const struct dome_light_arguments *a, const struct field *f, uint row,
                                          uint layer)
{
	packf strength = own(f->layer[layer].strength[row]);
	uint lanes = pack_bits(strength > 0.0f);
	packf sum[4] = { 0, 0, 0, 0 }, factor[3], whole, enough;

	if (!lanes && !a->in_blocks)
		return;
	add_blocks(f, row, layer, sum);
	whole = sum[3] * dome_open(&a->dome);
	enough = DOME_ENOUGH * ((float)(DOME_BLOCK * DOME_BLOCK) * own(f->layer[layer].sum[3][row]));
	strength = select(strength, strength * (sum[3] / enough), sum[3] < enough);
	for (uint c = 0; c < 3; c++)
		factor[c] = sqrt(DOME_LEFT + (1.0f - DOME_LEFT) * sum[c] / whole) * strength + (1.0f - strength);
	lanes &= pack_bits(sum[3] > 0.0f);
	for (uint c = 0; c < 3; c++)
		factor[c] = select((packf)(1), factor[c], pack_mask(lanes));
	if (a->in_blocks)
		store_row(a, f, row, factor);
	for (lanes = a->in_blocks ? 0 : lanes; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);

		dome_apply(&a->shaded[f->layer[layer].item[row][LEFT + lane]],
		           v3(LANE(factor[0], float, lane), LANE(factor[1], float, lane), LANE(factor[2], float, lane)));
	}
}

/* A row that receives no light. */
static inline void leave_row(const struct dome_light_arguments *a, const struct field *f, uint row)
{
	const packf none[3] = { 1, 1, 1 };

	if (a->in_blocks)
		store_row(a, f, row, none);
}

/* For a tile with too many fragments in some pixel. */
static inline void light_one_by_one(const struct dome_light_arguments *a, const struct field *f)
{
	for (uint y = f->bottom; y < f->top; y++)
		for (uint x = max(f->x, (uint)a->rectangle.x0); x < min(f->x + DOME_WIDTH, (uint)a->rectangle.x1); x++) {
			uint count;
			const uint begin = dome_items(a, x, y, &count);

			for (uint item = begin; item < begin + count; item++)
				dome_light_at(a, item, x, y);
		}
}

KERNEL_OF(float16) void dome_light_packet(KERNEL_ARGUMENTS(dome_light))
{
	const struct dome_light_arguments a = KERNEL_STRUCT(dome_light);
	const uint tile = (uint)get_global_id(0), columns = dome_columns(width);
	struct field f;
	int alone = 1;

	f.x = tile % columns * DOME_WIDTH;
	f.low = tile / columns * CAMERA_TILE;
	dome_rows(&a, f.low, &f.bottom, &f.top);
	if (f.bottom >= f.top || (int)f.x >= rectangle.x1 || (int)(f.x + DOME_WIDTH) <= rectangle.x0)
		return;
	f.even = 1;
	for (uint lane = 0; lane < PACK_SIZE; lane++) {
		const uint first = dome_first(f.x + lane, (uint)rectangle.x0, (uint)rectangle.x1);

		f.first[lane] = (int)min(first + LEFT - f.x, COLUMNS - DOME_BLOCK);
		f.even &= f.first[lane] == (int)(lane + LEFT - DOME_BLOCK / 2);
	}
	for (uint y = f.bottom; y < f.top && alone; y++)
		alone = fill_row(&a, y, &f);
	if (!alone) {
		light_one_by_one(&a, &f);
		return;
	}
	for (uint y = f.bottom; y < f.top; y++) {
		if (f.layers[y - f.low] == 0)
			leave_row(&a, &f, y - f.low);
		for (uint layer = 0; layer < f.layers[y - f.low]; layer++)
			light_row(&a, &f, y - f.low, layer);
	}
}
