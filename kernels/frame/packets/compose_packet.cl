/* compose_packet: compose for sixteen pixels of a row at once, for CPUs (kernels/frame/pack/pack_compose.h). */
#include "kernels/frame/pack/pack_compose.h"

#define PIXEL_WORDS 31 /* words in struct frame_pixel */

/*
 * Transpose the pixels' values from records to rows. list: receives their surfaces. @return a bit for each pixel that
 * has one
 */
WIDE_VECTORS static inline uint load_pixels(__global const struct frame_pixel *first, packu place,
                                            struct pack_pixels *p, struct pack_list *list)
{
	__global const float *words = (__global const float *)first;
	packf row[32];
	packi drawn;

	place *= PIXEL_WORDS;
	for (uint i = 0; i < 7; i++)
		pack_gather_from(words, place + 4 * i, row + 4 * i);
	pack_gather_from(words, place + 27, row + 27);
	for (int i = 0; i < 3; i++) {
		p->gl[i] = row[i];
		p->shadowed[i] = row[4 + i];
		p->direct[i] = row[7 + i];
		p->mirrored[i] = row[10 + i];
		p->beauty[i] = row[13 + i];
		p->normal[i] = p->position[i] = 0.0f;
	}
	p->gl[3] = row[3];
	p->depth = row[17];
	p->id = convert_float16(as_uint16(row[19]));
	p->layers = convert_float16(as_uint16(row[29]));
	drawn = (as_uint16(row[19]) != 0) | ((as_uint16(row[30]) & PIXEL_BEFORE) != 0);
	p->drawn = select((packf)(0), (packf)(1), drawn);
	for (int i = 0; i < 3; i++)
		p->albedo[i] = select((packf)(0), row[26 + i], drawn);
	vstore16(as_uint16(row[21]), 0, list->instance);
	vstore16(as_uint16(row[22]), 0, list->primitive);
	vstore16((packu)(0), 0, list->pixel);
	vstore16(row[23], 0, list->b1);
	vstore16(row[24], 0, list->b2);
	vstore16(row[25], 0, list->depth);
	return pack_bits(as_uint16(row[20]) != SCENE_NONE);
}

/* Add the sums that add_pass made of the other passes. */
WIDE_VECTORS static inline void add_sums(__global const float *sums, packu place, float n_passes, struct pack_pixels *p)
{
	packf row[PASS_PARTS];

	for (uint i = 0; i < PASS_PARTS; i += 4)
		pack_gather_from(sums, place * PASS_PARTS + i, row + i);
	for (int i = 0; i < 3; i++) {
		p->shadowed[i] = (row[i] + p->shadowed[i]) / n_passes;
		p->direct[i] = (row[3 + i] + p->direct[i]) / n_passes;
		p->mirrored[i] = (row[6 + i] + p->mirrored[i]) / n_passes;
		p->beauty[i] = (row[9 + i] + p->beauty[i]) / n_passes;
	}
}

/* Positions of some lanes' surfaces. */
static inline void find_surfaces(const struct compose_arguments *a, const struct pack_list *list, uint lanes,
                                 struct pack_pixels *pixels)
{
	const struct tables *t = &a->tables;
	uint material;

	while (lanes) {
		const uint bit = lanes & -lanes, lane = popcount(bit - 1), same = pack_same_kind(t, list, lanes, &material);
		struct pack_surface surface;
		struct fragment f;
		struct pack p;

		if (same & bit) {
			p.material = &t->materials[material];
			pack_locate(t, a->windows, 1, 1, list, same, &p);
			pack_surface(t, &p, &surface);
			pack_put_surface(t, &p, &surface, pack_mask(same), pixels);
			lanes &= ~same;
			continue;
		}
		f.order = 0;
		f.instance = list->instance[lane];
		f.primitive = list->primitive[lane];
		f.b1 = list->b1[lane];
		f.b2 = list->b2[lane];
		f.depth = list->depth[lane];
		pack_put_one(t, a->windows, &f, lane, pixels);
		lanes &= ~bit;
	}
}

/* drawn: 0 if the row's pixels still equal a->cleared */
static inline void compose_drawn_row(const struct compose_arguments *a, uint x, uint y, uint drawn,
                                     const struct pack_planes *to)
{
	/* Lanes beyond the end of the row repeat its last pixel. */
	const packu place = y * a->request.width + min(x + as_uint16(PACK_LANES), a->request.width - 1);
	struct pack_pixels pixels;
	struct pack_encoded encoded;
	struct pack_list list;
	const uint lanes = load_pixels(drawn ? a->frame : a->cleared, drawn ? place : (packu)(0), &pixels, &list);

	if (a->request.n_passes > 1)
		add_sums(a->sums, a->first_pixel + place, (float)a->request.n_passes, &pixels);
	if (pack_wants_surface(&a->request))
		find_surfaces(a, &list, lanes, &pixels);
	encoded.known = 0;
	pack_compose(&pixels, 0, to, &encoded);
}

KERNEL_OF(float16) void compose_packet(KERNEL_ARGUMENTS(compose))
{
	const struct compose_arguments a = KERNEL_STRUCT(compose);
	const uint columns = frame_columns(request.width), column = (uint)get_global_id(0) % columns, x = column * FRAME_ROW;
	const uint first = (uint)get_global_id(0) / columns * COMPOSE_ROWS, end = min(first + COMPOSE_ROWS, request.height);
	uint empty = SCENE_NONE; /* index in the planes of a row that nothing was drawn to */

	for (uint y = first; y < end; y++) {
		const struct pack_planes to = pack_planes_of(&a.request, halves, floats, x, y);
		const uint is_drawn = drawn[y * columns + column];

		if (is_drawn || empty == SCENE_NONE)
			compose_drawn_row(&a, x, y, is_drawn, &to);
		else
			pack_compose_again(empty, &to);
		if (!is_drawn && to.n == PACK_SIZE && request.n_passes == 1)
			empty = to.at;
	}
}
