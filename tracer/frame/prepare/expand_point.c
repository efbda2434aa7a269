#include "tracer/frame/prepare/expand_point.h"

#include <math.h>
#include <string.h>

#include "base/err.h"
#include "scene/mesa.h"
#include "tracer/frame/prepare/expand_quad.h"

static void add_smooth_point(const struct expand_input *in, struct expanded *out, const struct expand_end *e,
                             uint32_t draw)
{
	const float *fade = in->material->point_attenuation, size = fmaxf(e->v.size[0], 1);
	int attenuated = fade[0] != 1 || fade[1] != 0 || fade[2] != 0;
	float radius = !attenuated && size <= 2 ? 1 : 0.5f * size,
	      rim = 1 - 2 / radius + 1 / radius / radius; /* inner radius of the rim, squared */

	for (int k = 0; k < 4; k++) {
		float x = k == 1 || k == 2 ? 1 : -1, y = k >= 2 ? 1 : -1;

		expand_add_smooth_corner(in, out, e, e->x + x * radius, e->y + y * radius, (float[4]){ x, y, rim, 0 });
	}
	expand_add_triangles(in, out, draw);
}

static void add_point(const struct expand_input *in, struct expanded *out, const struct expand_end *e, uint32_t draw)
{
	const struct scene_material *m = in->material;
	int32_t rounded = expand_round(in, e->v.size[0] * 256), width = rounded > 256 ? rounded : 256;
	int32_t x = expand_snap(in, e->x) - width / 2, y = expand_snap(in, e->y) - width / 2;
	/* With multisampling, Mesa 22.3 puts a sprite's middle half a pixel off. */
	float off = m->multisample && !(in->mesa & SCENE_MESA_SPRITES) ? 128 / (float)width : 0;

	/* Without sprites and multisampling, points cover whole pixels (sec. 3.3.1). Their width and position are
	 * rounded as in llvmpipe. */
	if (!m->point_sprite && !m->point_smooth && !m->multisample) {
		int32_t pixels = (width + 127) >> 8, middle = pixels & 1 ? 0 : 128;

		x = (((expand_snap(in, e->x) + middle) >> 8) - pixels / 2) * 256;
		y = (((expand_snap(in, e->y) - 1 + middle) >> 8) - pixels / 2) * 256; /* on an edge: the pixel above */
		width = pixels * 256;
	}
	for (int k = 0; k < 4; k++) {
		int right = k == 1 || k == 2, low = k >= 2;
		struct expand_end corner = *e;

		for (uint32_t u = 0; u < m->unit_count && m->point_sprite; u++)
			if (in->units[u].coord_replace)
				memcpy(corner.texcoord[u],
				       (float[4]){ (float)right + off,
				                   m->point_sprite == 2 ? (float)!low - off : (float)low + off, 0, 1 },
				       sizeof(corner.texcoord[u]));
		expand_add_corner(in, out, &corner, x + (right ? width : 0), y + (low ? width : 0));
	}
	expand_add_triangles(in, out, draw);
}

int expand_point(const struct expand_input *in, struct expanded *out, struct expand_end e, float offset, uint32_t draw)
{
	for (int plane = 0; plane < EXPAND_PLANES; plane++) {
		const int is_around = plane >= 2 && plane < EXPAND_VOLUME_PLANES;

		/* The centre of a point must lie in the view (sec. 2.12). */
		if (!(is_around && in->guards) && expand_plane_distance(in, &e, plane) < 0)
			return 0;
	}
	return e.v.clip[3] > 0 ? expand_corner(in, out, e, offset, draw) : 0;
}

int expand_corner(const struct expand_input *in, struct expanded *out, struct expand_end e, float offset, uint32_t draw)
{
	expand_project(in, &e);
	e.z = fminf(fmaxf(e.z + offset, 0), 1);
	if (expand_reserve_quad(in, out))
		return ERR_SYSTEM;
	if (in->material->point_smooth && !in->material->point_sprite)
		add_smooth_point(in, out, &e, draw);
	else
		add_point(in, out, &e, draw);
	return 0;
}

#define FARTHEST 32768.0f /* pixels from a window's corner: twice the largest size of a window */

/*
 * Find the rows or columns of a pixel rectangle near the window, and where they begin and end along its axis. Positions
 * farther away cannot be represented in 1/256 pixel. A single row or column that extends beyond is cut off there.
 */
static void keep_near(float corner, float zoom, uint32_t n, float kept[2], float place[2])
{
	const float low = (-FARTHEST - corner) / zoom, high = (FARTHEST - corner) / zoom;

	kept[0] = fminf(fmaxf(floorf(fminf(low, high)), 0), (float)n);
	kept[1] = fminf(fmaxf(ceilf(fmaxf(low, high)), 0), (float)n);
	for (int i = 0; i < 2; i++)
		place[i] = fminf(fmaxf(corner + kept[i] * zoom, -2 * FARTHEST), 2 * FARTHEST);
}

/* Convert a window position to clip space and back, bit for bit as Mesa does. scale: half the window's size; negative
 * to flip it */
static float through_clip(float place, uint32_t size, float scale)
{
	return fmaf(scale, place / (float)size * 2 - 1, (float)size * 0.5f);
}

int expand_rectangle(const struct expand_input *in, struct expanded *out, uint32_t i, uint32_t draw)
{
	const struct scene_rectangle *r = &in->rectangles[i];
	const float *corner = in->mesh->position + 4 * (size_t)i;
	struct expand_end e = expand_load_end(in, i, 0);
	float column[2], row[2], x[2], y[2];

	if (expand_reserve_quad(in, out))
		return ERR_SYSTEM;
	e.w_inv = 1;
	e.z = fminf(fmaxf(corner[2], 0), 1);
	keep_near(corner[0], r->zoom[0], r->width, column, x);
	keep_near(corner[1], r->zoom[1], r->height, row, y);
	/* Start at the second corner, so that the diagonal runs from there to the last one, as in Mesa; see
	 * stage_texel. */
	for (int k = 1; k < 5; k++) {
		int right = k == 1 || k == 2, high = k == 2 || k == 3;

		expand_add_smooth_corner(in, out, &e, through_clip(x[right], in->width, (float)in->width * 0.5f),
		                         through_clip(y[high], in->height, (float)in->height * -0.5f),
		                         (float[4]){ column[right], row[high], (float)r->texture,
		                                     (float)(r->kind + (r->from_top ? SCENE_FROM_TOP : 0)) });
	}
	expand_add_triangles(in, out, draw);
	return 0;
}
