/* Draws rectangles of pixels: makes an event of one point, with the pixels as a picture. */
#include "replay/gl/pixels/rectangle.h"

#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/build/frame.h"
#include "replay/build/mesh.h"
#include "replay/gl/surface/draw.h"
#include "replay/gl/texture/image.h"
#include "replay/machine/machine.h"
#include "scene/mesa.h"

/* A mesh with one point. @return a reference; NULL: out of memory (reported) */
static struct gls_mesh *point_at(struct gls_exec *x, float left, float low, float depth)
{
	struct gls_geometry *g = &x->scratch.geometry;
	struct gls_mesh *mesh = NULL;

	gls_geometry_clear(g);
	g->kind = SCENE_POINTS;
	if (gls_geometry_reserve(x, g, 1, 1))
		return NULL;
	memcpy(g->position, (float[4]){ left, low, depth, 1 }, 16);
	g->edge[0] = 1;
	g->n_vertices = 1;
	if (!gls_geometry_cut(x, g, GL_POINTS, 0, 1, NULL, 0)) {
		g->n_draws = 1;
		mesh = gls_geometry_mesh(x, g);
	}
	gls_geometry_clear(g);
	return mesh;
}

/* Draw a rectangle. a: attributes to draw with; modified */
static void draw(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r, struct gls_attribs *a)
{
	const struct scene_rectangle rectangle = { .kind = r->kind, .width = r->width, .height = r->height,
		                                   .zoom = { r->zoom[0], r->zoom[1] }, .from_top = r->from_top };
	const struct gls_current *c = &a->current;
	struct gls_texture_image *image;
	struct gls_mesh *mesh;
	float values[N_GLS_ATTRIBUTES][4];
	/* Mesa 25 adds the current secondary colour to bitmaps, other versions do not. */
	const uint32_t sums = r->kind == SCENE_BITMAP && st->mesa & SCENE_MESA_BITMAP_SUMS;

	if (!x->want || !r->width || !r->height)
		return;
	image = gls_texture_image_find(x, r->width, r->height, r->kind == SCENE_FLOAT_PIXELS ? 16 : 4, r->texels);
	mesh = image ? point_at(x, r->left, r->low, c->raster_position[2]) : NULL;
	memcpy(values, c->attribute, sizeof(values));
	memcpy(values[GLS_ATTR_COLOR], c->raster_color, 16);
	if (!sums)
		memcpy(values[GLS_ATTR_SECONDARY], c->raster_secondary, 16);
	memcpy(values[GLS_ATTR_TEXCOORD], c->raster_texcoord, sizeof(c->raster_texcoord));
	values[GLS_ATTR_FOG_COORD][0] = 0; /* Mesa (22.3.6) uses the fog at the viewer, contrary to sec. 3.10 and 2.13 */
	/* Disable per-vertex operations, which do not apply to a rectangle. */
	a->fog.color_sum &= sums;
	a->lighting.enabled = a->lighting.color_material = 0;
	a->lighting.shade_model = GL_SMOOTH;
	a->fog.coord_source = GL_FOG_COORD;
	a->transform.clip_plane_mask = 0;
	a->point.smooth = a->point.sprite = 0;
	a->multisample.enabled = 0; /* Mesa draws them without multisampling */
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		a->texturing.units[u].gen_enabled = 0;
	st->dirty = GLS_DIRTY_ALL;
	if (mesh)
		gls_draw_event(x, st,
		               &(struct gls_event){ .attribs = a,
		                                    .mesh = mesh,
		                                    .values = (const float(*)[4])values,
		                                    .command = x->command,
		                                    .call_number = x->call->number,
		                                    .rectangle = &rectangle,
		                                    .image = image });
	st->dirty = GLS_DIRTY_ALL;
	gls_mesh_release(mesh);
	gls_texture_image_release(image);
}

void gls_draw_rectangle(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r)
{
	struct gls_attribs a = st->a;

	if (gls_renders(st))
		draw(x, st, r, &a);
}

void gls_draw_depths(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r)
{
	struct gls_attribs a = st->a;

	a.color.mask = 0;
	a.stencil.enabled = 0;
	a.depth.enabled = 1;
	a.depth.func = GL_ALWAYS;
	if (gls_renders(st))
		draw(x, st, r, &a);
}

void gls_copy_rectangle(struct gls_exec *x, struct gls_state *st, const struct gls_rectangle *r, uint32_t color_mask)
{
	struct gls_attribs a = st->a;

	a.color.alpha_test = a.color.blend = a.color.logic_op_enabled = a.color.framebuffer_srgb = 0;
	a.stencil.enabled = a.fog.enabled = 0;
	a.depth.enabled = a.depth.write = r->kind == SCENE_DEPTH_PIXELS;
	a.depth.func = GL_ALWAYS;
	a.stencil.side[0].write_mask = 255;
	a.color.mask = r->kind == SCENE_COLOR_PIXELS || r->kind == SCENE_FLOAT_PIXELS ? color_mask : 0;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		a.texturing.units[u].enabled = 0;
	draw(x, st, r, &a);
}
