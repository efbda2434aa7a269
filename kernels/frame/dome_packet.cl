/*
 * dome_find_packet, dome_light_packet: kernels/frame/dome.h for CPUs, sixteen fragments at once and to the same bits.
 *
 * dome_light_packet lays the fragments of a tile out as rows first: a pixel's neighbours are its own row and others, moved by some
 * places. Where pixels have several lit fragments, there are several layers of rows.
 */
#include "kernels/frame/dome.h"
#include "kernels/frame/pack_ray.h"
#include "kernels/frame/pack_shade.h"

/* --- Looks around ---------------------------------------------------------------------------------------------------- */

/* Whether packs know the light that fog leaves of a material. */
static inline int knows(__global const struct scene_material *m)
{
	return !m->fog || m->fog_mode == GL_LINEAR;
}

/* The fragments of a work item; those that take no light are done. */
static inline void find_left(const struct dome_find_arguments *a, uint first, struct pack_left *left)
{
	left->first = first;
	left->all = left->packed = 0;
	for (uint i = 0; i < min(SHADE_PACKET, a->n - first); i++) {
		__global const struct geometry *g = &a->tables.geometries[a->fragments[first + i].instance];
		__global const struct scene_material *m = &a->tables.materials[g->material];

		left->material[i] = g->material;
		if (!(a->shaded[first + i].flags & SHADED_THERE) || !(m->surface.hidden & SCENE_DOME_LIT) || g->flags & GEOMETRY_EXPANDED) {
			dome_find_none(a, first + i);
			continue;
		}
		left->all |= (ulong)1 << i;
		if (knows(m) && pack_knows_geometry(g))
			left->packed |= (ulong)1 << i;
	}
}

/* A ray of each of some lanes: its sample's direction turned to the surface. */
WIDE_VECTORS static inline void send_rays(const struct dome_find_arguments *a, const struct pack_list *list, uint lanes, uint sample,
                                          packu part, struct pack_vec o, const struct pack_vec *axes)
{
	__global float *rays = (__global float *)(a->rays + sample * a->n);
	struct pack_vec d;
	packf row[4];

	pack_gather(a->directions + sample * DOME_BLOCK * DOME_BLOCK * 4, part, row);
	d = pack_add(pack_add(pack_scale(axes[0], row[0]), pack_scale(axes[1], row[1])), pack_scale(axes[2], row[2]));
	for (; lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);

		vstore8((float8)(LANE(o.x, float, lane), LANE(o.y, float, lane), LANE(o.z, float, lane), 0, LANE(d.x, float, lane),
		                 LANE(d.y, float, lane), LANE(d.z, float, lane), LANE(row[3], float, lane)), list->item[lane], rays);
	}
}

static inline void find_lanes(const struct dome_find_arguments *a, const struct pack_list *list, uint lanes)
{
	__global const struct geometry *g = &a->tables.geometries[list->instance[0]];
	struct pack_vec from, axes[3], o;
	struct pack_surface surface;
	packf strength;
	struct pack p;
	packu part;
	uint lit;

	p.material = &a->tables.materials[g->material];
	p.view = &a->views[g->view];
	pack_locate(&a->tables, a->windows, a->width, 1, list, lanes, &p);
	pack_surface(&a->tables, &p, &surface);
	pack_measure(&surface);
	from = pack_view_direction(&p, 1);
	axes[2] = pack_choose(surface.plane, pack_scale(surface.plane, (packf)(-1)), pack_dot(surface.plane, from) > 0.0f);
	o = pack_ray_origin(p.weight, &surface, axes[2], pack_scale(pack_normalize(from), (packf)(-1)));
	strength = pack_fog(&a->tables, &p) * (p.material->lighting ? a->dome.lit : 1.0f);
	pack_basis(axes[2], &axes[0], &axes[1]);
	part = as_uint16(-p.row) % DOME_BLOCK * DOME_BLOCK + as_uint16(p.x) % DOME_BLOCK;
	lit = lanes & pack_bits((pack_dot(axes[2], axes[2]) > 0.0f) & (strength > 0.0f));
	for (uint left = lanes & ~lit; left; left &= left - 1)
		dome_find_item(a, list->item[popcount((left & -left) - 1)]);
	for (uint left = lit; left; left &= left - 1) {
		const uint lane = popcount((left & -left) - 1);
		__global struct dome_place *place = &a->places[list->item[lane]];

		v3_store(place->from, v3(LANE(o.x, float, lane), LANE(o.y, float, lane), LANE(o.z, float, lane)));
		v3_store(place->normal, v3(LANE(axes[2].x, float, lane), LANE(axes[2].y, float, lane), LANE(axes[2].z, float, lane)));
		place->strength = LANE(strength, float, lane);
	}
	for (uint sample = 0; sample < a->samples; sample++)
		send_rays(a, list, lit, sample, part, o, axes);
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

/* --- Light ----------------------------------------------------------------------------------------------------------- */

/* Columns of a tile and those that its blocks reach, with as many left of it. */
#define LEFT DOME_BLOCK
#define COLUMNS (DOME_WIDTH + 2 * DOME_BLOCK)
/* Lit fragments that a pixel may have. */
#define LAYERS 4

/* A tile's fragments: where strength is 0, there is none. */
struct field {
	struct layer {
		float from[3][CAMERA_TILE][COLUMNS], normal[3][CAMERA_TILE][COLUMNS], strength[CAMERA_TILE][COLUMNS];
		float sum[4][CAMERA_TILE][COLUMNS];
		uint item[CAMERA_TILE][COLUMNS];
	} layer[LAYERS];
	uint layers[CAMERA_TILE]; /* of each row */
	uint x, low, bottom, top; /* its first column; its first row; its rows in the rectangle */
	int first[PACK_SIZE];     /* of each column's block, as a column of this */
	uint even;                /* 1: all blocks lie the same about their pixels */
};

/* Sixteen pixels of a row of a layer, of which `item` says the fragments. */
WIDE_VECTORS static inline void load_sixteen(const struct dome_light_arguments *a, uint row, uint column, struct layer *to)
{
	const packu item = *(const pack_loose_uints *)(to->item[row] + column);
	const packi there = item != SCENE_NONE;
	const packu index = select((packu)(0), item, there);
	packf place[4], rest[4], sum[4];

	pack_gather_from((__global const float *)a->places, index * 7, place);
	pack_gather_from((__global const float *)a->places, index * 7 + 3, rest);
	pack_gather(a->sums, index, sum);
	for (uint k = 0; k < 3; k++) {
		*(pack_loose_floats *)(to->from[k][row] + column) = place[k];
		*(pack_loose_floats *)(to->normal[k][row] + column) = rest[k + 1];
	}
	for (uint k = 0; k < 4; k++)
		*(pack_loose_floats *)(to->sum[k][row] + column) = sum[k];
	*(pack_loose_floats *)(to->strength[row] + column) = select((packf)(0), place[3], there);
}

/* The fragments of a pixel that may be lit, a layer each. @return 0: there are too many */
static inline int list_pixel(const struct dome_light_arguments *a, uint begin, uint count, uint row, uint column, struct field *f)
{
	uint n = 0;

	for (uint item = begin; item < begin + count; item++) {
		if (count > 1 && !(a->places[item].strength > 0.0f))
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

/* Those of a row of pixels. @return 0: there are too many */
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

static inline int load_row(const struct dome_light_arguments *a, uint y, struct field *f)
{
	const uint row = y - f->low;

	if (!list_row(a, y, f))
		return 0;
	for (uint i = 0; i < f->layers[row]; i++) {
		load_sixteen(a, row, 0, &f->layer[i]);
		load_sixteen(a, row, COLUMNS - PACK_SIZE, &f->layer[i]);
	}
	return 1;
}

/* Sixteen numbers of a row, from a column of each lane's block on. */
WIDE_VECTORS static inline packf take(const struct field *f, const float *row, uint column)
{
	packf out;

	if (f->even)
		return *(const pack_loose_floats *)(row + LEFT - DOME_BLOCK / 2 + column);
	for (uint lane = 0; lane < PACK_SIZE; lane++)
		LANE(out, float, lane) = row[(uint)f->first[lane] + column];
	return out;
}

WIDE_VECTORS static inline struct pack_vec take_vec(const struct field *f, const float (*rows)[CAMERA_TILE][COLUMNS], uint row, uint column)
{
	return pack_vec(take(f, rows[0][row], column), take(f, rows[1][row], column), take(f, rows[2][row], column));
}

/* Sixteen numbers of a row of the tile itself. */
WIDE_VECTORS static inline packf own(const float *row)
{
	return *(const pack_loose_floats *)(row + LEFT);
}

WIDE_VECTORS static inline struct pack_vec own_vec(const float (*rows)[CAMERA_TILE][COLUMNS], uint row)
{
	return pack_vec(own(rows[0][row]), own(rows[1][row]), own(rows[2][row]));
}

/* As dome_add_block for the pixels of a row of a layer. */
WIDE_VECTORS static inline void add_blocks(const struct field *f, uint row, uint layer, packf *sum)
{
	const struct pack_vec from = own_vec(f->layer[layer].from, row), n = own_vec(f->layer[layer].normal, row);
	const packi first = vload16(0, f->first), column = PACK_LANES + (int)LEFT;
	const uint begin = dome_first(f->low + row, f->bottom, f->top) - f->low, end = min(begin + DOME_BLOCK, f->top - f->low);

	for (uint bx = 0; bx < DOME_BLOCK; bx++) {
		packf part[4] = { 0, 0, 0, 0 };

		for (uint by = begin; by < end; by++)
			for (uint i = 0; i < f->layers[by]; i++) {
				const struct layer *l = &f->layer[i];
				const struct pack_vec apart = pack_sub(take_vec(f, l->from, by, bx), from);
				const packf off = pack_dot(n, apart);
				const packi self = by == row && i == layer ? first + (int)bx == column : (packi)(0);
				const packi same = self | ((take(f, l->strength[by], bx) > 0.0f) &
				                           (pack_dot(n, take_vec(f, l->normal, by, bx)) > 0.9f) &
				                           (off * off <= 0.1f * pack_dot(apart, apart)));

				for (uint k = 0; k < 4; k++)
					part[k] += select((packf)(0), take(f, l->sum[k][by], bx), same);
			}
		for (uint k = 0; k < 4; k++)
			sum[k] += part[k];
	}
}

/* A layer of the pixels of a row. */
WIDE_VECTORS static inline void light_row(const struct dome_light_arguments *a, const struct field *f, uint row, uint layer)
{
	const packf strength = own(f->layer[layer].strength[row]);
	uint lanes = pack_bits(strength > 0.0f);
	packf sum[4] = { 0, 0, 0, 0 }, factor[3], whole;

	if (!lanes)
		return;
	add_blocks(f, row, layer, sum);
	whole = sum[3] * dome_open(&a->dome);
	for (uint c = 0; c < 3; c++)
		factor[c] = sqrt(DOME_LEFT + (1.0f - DOME_LEFT) * sum[c] / whole) * strength + (1.0f - strength);
	for (lanes &= pack_bits(sum[3] > 0.0f); lanes; lanes &= lanes - 1) {
		const uint lane = popcount((lanes & -lanes) - 1);

		dome_apply(&a->shaded[f->layer[layer].item[row][LEFT + lane]],
		           v3(LANE(factor[0], float, lane), LANE(factor[1], float, lane), LANE(factor[2], float, lane)));
	}
}

/* A tile with too many fragments in a pixel. */
static inline void light_one_by_one(const struct dome_light_arguments *a, const struct field *f)
{
	for (uint y = f->bottom; y < f->top; y++)
		for (uint x = max(f->x, (uint)a->rectangle.x0); x < min(f->x + DOME_WIDTH, (uint)a->rectangle.x1); x++) {
			const uint begin = a->first[y * a->width + x], end = begin + a->counts[y * a->width + x];

			for (uint item = begin; item < end; item++)
				dome_light_item(a, item);
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
		alone = load_row(&a, y, &f);
	if (!alone) {
		light_one_by_one(&a, &f);
		return;
	}
	for (uint y = f.bottom; y < f.top; y++)
		for (uint layer = 0; layer < f.layers[y - f.low]; layer++)
			light_row(&a, &f, y - f.low, layer);
}
