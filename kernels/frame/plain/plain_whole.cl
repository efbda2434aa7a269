/*
 * plain_whole: see kernels/frame/plain/plain.h. A tile's fragments go straight from the camera's storage to the planes,
 * so no record of a pixel leaves the work item.
 */
#include "kernels/camera/tile_walk.h"
#include "kernels/frame/plain/plain_show.h"

/* Adjacent blocks of a tile that make up a row of sixteen pixels. */
#define ROW_BLOCKS (int)(PACK_SIZE / BLOCK)

/* Fragments of four rows of sixteen pixels. */
struct four_rows {
	packu order[BLOCK], instance[BLOCK], primitive[BLOCK], b1[BLOCK], b2[BLOCK], depth[BLOCK];
};

/* Take those of four adjacent blocks. */
WIDE_VECTORS static inline void take_rows(const struct camera_pack *p, struct four_rows *to)
{
	packf depth[ROW_BLOCKS];

	for (int i = 0; i < ROW_BLOCKS; i++)
		depth[i] = pack_min(p[i].depth, (packf)(1));
	tile_quarters(p[0].order, p[1].order, p[2].order, p[3].order, to->order);
	tile_quarters(p[0].instance, p[1].instance, p[2].instance, p[3].instance, to->instance);
	tile_quarters(p[0].primitive, p[1].primitive, p[2].primitive, p[3].primitive, to->primitive);
	tile_quarters(as_uint16(p[0].b1), as_uint16(p[1].b1), as_uint16(p[2].b1), as_uint16(p[3].b1), to->b1);
	tile_quarters(as_uint16(p[0].b2), as_uint16(p[1].b2), as_uint16(p[2].b2), as_uint16(p[3].b2), to->b2);
	tile_quarters(as_uint16(depth[0]), as_uint16(depth[1]), as_uint16(depth[2]), as_uint16(depth[3]), to->depth);
}

/* Row i of the four, in plain's format. x, y: in the band. @return a bit for each pixel that has a fragment */
WIDE_VECTORS static inline uint load_taken(const struct plain_arguments *a, const struct four_rows *from, int i, uint x,
                                           uint y, struct plain_row *row)
{
	row->x = x;
	row->y = y;
	row->base = y * a->width + x;
	row->dimmed = 0;
	*(pack_loose_uints *)row->list.item = row->base + as_uint16(PACK_LANES);
	*(pack_loose_uints *)row->list.pixel = a->first_pixel + row->base + as_uint16(PACK_LANES);
	*(pack_loose_uints *)row->list.instance = from->instance[i];
	*(pack_loose_uints *)row->list.primitive = from->primitive[i];
	*(pack_loose_uints *)row->list.b1 = from->b1[i];
	*(pack_loose_uints *)row->list.b2 = from->b2[i];
	*(pack_loose_uints *)row->list.depth = from->depth[i];
	return pack_bits(from->order[i] != SCENE_NONE);
}

/* Kept from row to row of a tile. */
struct tile_kept {
	struct plain_kept plain;
	struct plain_empty empty;
};

/* Show four rows of sixteen pixels, starting at block x, y of the tile. */
static inline void show_rows(const struct plain_arguments *a, const struct shade_arguments *s, const struct tile *t,
                             int is_seen, int x, int y, struct tile_kept *kept)
{
	const uint left = (uint)(t->x + BLOCK * x), low = (uint)(t->y + BLOCK * y) - a->first_pixel / a->width;
	struct four_rows rows;
	struct shown_row row;

	if (is_seen)
		take_rows(&t->packs[y][x], &rows);
	for (int i = 0; i < BLOCK && low + (uint)i < a->request.height && left < a->width; i++) {
		const struct pack_planes to = pack_planes_of(&a->request, a->halves, a->floats, left, low + (uint)i);
		const uint lanes = is_seen ? load_taken(a, &rows, i, left, low + (uint)i, &row.at) : 0;

		plain_show_row(a, s, &row, lanes, 0, &to, &kept->plain, &kept->empty);
	}
}

KERNEL_OF(float16) void plain_whole(KERNEL_ARGUMENTS(plain_whole))
{
	const struct camera_packet_arguments camera = KERNEL_STRUCT(camera_packet);
	const struct plain_arguments a = {
		.tables = KERNEL_STRUCT(tables), .views = views, .windows = window, .width = width, .height = height,
		.first_pixel = first_pixel, .bits = bits, .cleared = cleared, .request = request, .n = width * request.height,
		.fragments = alone, .pixels = pixels, .shaded = shaded, .halves = halves, .floats = floats,
	};
	const struct camera_rectangle band = { 0, (int)(first_pixel / width), (int)width,
		                               (int)(first_pixel / width + request.height) };
	const struct shade_arguments s = plain_shading(&a, 0);
	const uint item = (uint)get_global_id(0);
	struct tile_kept kept;
	struct tile t;
	int is_seen;

	if (item >= camera_packet_items(band))
		return;
	t.x = camera_packet_x(band, item);
	t.y = camera_packet_y(band, item);
	is_seen = t.x < rectangle.x1 && t.x + CAMERA_TILE > rectangle.x0 && t.y < rectangle.y1 &&
	          t.y + CAMERA_TILE > rectangle.y0;
	if (is_seen) {
		tile_draw(&camera, &t);
		is_seen = t.is_drawn;
	}
	pack_keep_nothing(&kept.plain.pack);
	kept.plain.encoded.known = 0;
	kept.empty.at = SCENE_NONE;
	for (int y = 0; y < TILE_BLOCKS; y++)
		for (int x = 0; x < TILE_BLOCKS; x += ROW_BLOCKS)
			show_rows(&a, &s, &t, is_seen, x, y, &kept);
}
