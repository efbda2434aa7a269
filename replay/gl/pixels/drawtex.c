/* OES_draw_texture: a rectangle of the window, textured with the crop rectangles of the bound textures. */
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/build/mesh.h"
#include "replay/gl/surface/draw.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/geometry.h"
#include "replay/machine/machine.h"

/* Disable the per-vertex operations, which do not apply to this rectangle. */
static void change_attributes(struct gls_attribs *a)
{
	a->lighting.enabled = a->lighting.color_material = 0;
	a->lighting.shade_model = GL_SMOOTH;
	a->fog.coord_source = GL_FOG_COORD;
	a->transform.clip_plane_mask = 0;
	a->polygon.cull = a->polygon.stipple = a->polygon.smooth = a->polygon.offset_fill = 0;
	a->polygon.mode[0] = a->polygon.mode[1] = GL_FILL;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		a->texturing.units[u].gen_enabled = 0;
}

/* The 2D texture of a unit, and its first level; NULL if it is not enabled or has no texels. */
static const struct gls_level *level_of(struct gls_exec *x, struct gls_state *st, unsigned unit,
                                        const struct gls_texture **out)
{
	const struct gls_texture *t = st->a.texturing.units[unit].enabled >> GLS_TEXTURE_2D & 1 ?
	                                      gls_texture_bound(x, st, unit, GLS_TEXTURE_2D) :
	                                      NULL;
	const struct gls_level *l = t && t->parameters.base_level < GLS_MAX_LEVELS ?
	                                    &t->levels[0][t->parameters.base_level] :
	                                    NULL;

	*out = t;
	return l && l->width && l->height ? l : NULL;
}

/* Set the texture coordinates of corner (right, top) for each unit with a 2D texture that has texels. */
static void set_coordinates(struct gls_exec *x, struct gls_state *st, struct gls_geometry *g, int right, int top)
{
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++) {
		const struct gls_texture *t;
		const struct gls_level *l = level_of(x, st, u, &t);
		const int32_t *crop;
		float *out;

		if (!l || !(g->varying >> (GLS_ATTR_TEXCOORD + u) & 1))
			continue;
		crop = t->parameters.crop;
		out = g->attribute[GLS_ATTR_TEXCOORD + u] + 4 * (size_t)g->n_vertices;
		out[0] = (float)(crop[0] + (right ? crop[2] : 0)) / (float)l->width;
		out[1] = (float)(crop[1] + (top ? crop[3] : 0)) / (float)l->height;
		out[2] = 0;
		out[3] = 1;
	}
}

/* Bits 1 << attribute of the texture coordinates that a rectangle has. */
static uint32_t textured_units(struct gls_exec *x, struct gls_state *st)
{
	uint32_t bits = 0;

	for (unsigned u = 0; u < GLS_MAX_UNITS; u++) {
		const struct gls_texture *t;

		if (level_of(x, st, u, &t))
			bits |= 1u << (GLS_ATTR_TEXCOORD + u);
	}
	return bits;
}

/* Make the mesh of a rectangle. rect: window x, y and depth, width, height. @return a reference; NULL: out of memory
 * (reported) */
static struct gls_mesh *make_rectangle(struct gls_exec *x, struct gls_state *st, const float rect[5])
{
	struct gls_geometry *g = &x->scratch.geometry;
	struct gls_mesh *mesh = NULL;

	gls_geometry_clear(g);
	g->kind = SCENE_TRIANGLES;
	g->varying = textured_units(x, st);
	if (gls_geometry_reserve(x, g, 4, 2))
		return NULL;
	for (int corner = 0; corner < 4; corner++) {
		const int right = corner == 1 || corner == 2, top = corner >= 2;

		memcpy(g->position + 4 * (size_t)g->n_vertices,
		       (float[4]){ rect[0] + (right ? rect[3] : 0), rect[1] + (top ? rect[4] : 0), rect[2], 1 }, 16);
		set_coordinates(x, st, g, right, top);
		g->edge[g->n_vertices++] = 1;
	}
	if (!gls_geometry_cut(x, g, GL_TRIANGLE_FAN, 0, 4, NULL, 0)) {
		g->n_draws = 1;
		mesh = gls_geometry_mesh(x, g);
	}
	gls_geometry_clear(g);
	return mesh;
}

GLS_FAMILY(glDrawTex, STATE)
{
	struct gls_attribs a = st->a;
	const float *range = a.viewport.depth_range;
	struct gls_mesh *mesh;
	float rect[5] = { 0 };

	for (unsigned i = 0; i < 5 && !gls_commands[x->command].suffix.array; i++)
		rect[i] = arg_f(c, i);
	if (gls_commands[x->command].suffix.array)
		arg_floats(c, 0, rect, 5);
	if (gls_refuses(x, st, rect[3] <= 0 || rect[4] <= 0, GL_INVALID_VALUE) || !gls_is_drawn(x, st))
		return;
	rect[2] = range[0] + (rect[2] < 0 ? 0 : rect[2] > 1 ? 1 : rect[2]) * (range[1] - range[0]);
	change_attributes(&a);
	mesh = make_rectangle(x, st, rect);
	st->dirty = GLS_DIRTY_ALL;
	if (mesh)
		gls_draw_event(x, st,
		               &(struct gls_event){ .attribs = &a,
		                                    .mesh = mesh,
		                                    .values = (const float(*)[4])a.current.attribute,
		                                    .command = x->command,
		                                    .call_number = x->call->number,
		                                    .in_window = 1 });
	st->dirty = GLS_DIRTY_ALL;
	gls_mesh_release(mesh);
}
