/*
 * The current raster position (GL 2.1 sec. 2.13): RasterPos is transformed like a vertex, WindowPos sets window
 * coordinates.
 */
#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/mat4.h"
#include "capture/format/call.h"
#include "kernels/gl/vertex.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"

static void clamp_color(float out[4], struct vec4 c)
{
	const float v[4] = { c.x, c.y, c.z, c.w };

	for (unsigned i = 0; i < 4; i++)
		out[i] = v[i] > 0 ? v[i] < 1 ? v[i] : 1 : 0;
}

/* Colours as for a vertex; always the front ones. */
static void set_colors(struct gls_state *st, struct vec4 eye, struct vec3 normal)
{
	struct gls_current *c = &st->a.current;
	const struct gls_lighting *l = &st->a.lighting;
	struct scene_light lights[GLS_MAX_LIGHTS];
	struct scene_material m = { .lighting = 1, .local_viewer = l->local_viewer, .separate_specular = l->separate_specular,
		                    .front = l->face[0], .color_material = l->color_material ? l->color_material_face : 0,
		                    .color_material_mode = l->color_material_mode };
	struct light_list list = { .first = 0, .count = 0 };
	struct lit lit;

	clamp_color(c->raster_color, v4_load(c->attribute[GLS_ATTR_COLOR]));
	clamp_color(c->raster_secondary, v4_load(c->attribute[GLS_ATTR_SECONDARY]));
	if (!l->enabled)
		return;
	memcpy(m.light_model_ambient, l->model_ambient, 16);
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		if (l->lights[i].enabled)
			lights[list.count++] = l->lights[i].value;
	m.light_count = list.count;
	lit = light_vertex(&m, lights, list, 0, eye, normal, &m.front, v4_load(c->attribute[GLS_ATTR_COLOR]), 0, NULL);
	clamp_color(c->raster_color, lit.color);
	clamp_color(c->raster_secondary, lit.secondary);
}

static void set_texcoords(struct gls_state *st, struct vec4 obj, struct vec4 eye, struct vec3 normal)
{
	struct vec3 u = v3_normalize(v3_scale(v3(eye.x, eye.y, eye.z), eye.w != 0 ? 1 / eye.w : 1));

	for (unsigned i = 0; i < GLS_MAX_UNITS; i++) {
		const struct gls_unit *unit = &st->a.texturing.units[i];
		struct scene_unit gen = unit->value;
		const float *current = st->a.current.attribute[GLS_ATTR_TEXCOORD + i];
		float v[4];

		for (unsigned k = 0; k < 4; k++) {
			gen.gen_mode[k] = unit->gen_enabled >> k & 1 ? gen.gen_mode[k] : 0;
			v[k] = vertex_generate(&gen, k, current[k], obj, eye, u, normal);
		}
		gls_sums(st)->transform(st->a.current.raster_texcoord[i], st->texture[i].matrices[st->texture[i].depth], v);
	}
}

/* Rows of the inverse transpose of the upper 3x3, applied to the current normal. */
static struct vec3 eye_normal(const struct gls_state *st)
{
	float inverse[16];
	const float *n = st->a.current.attribute[GLS_ATTR_NORMAL];

	mat4_invert(inverse, st->modelview.matrices[st->modelview.depth]);
	return v3(inverse[0] * n[0] + inverse[1] * n[1] + inverse[2] * n[2],
	          inverse[4] * n[0] + inverse[5] * n[1] + inverse[6] * n[2],
	          inverse[8] * n[0] + inverse[9] * n[1] + inverse[10] * n[2]);
}

static int is_clipped(const struct gls_state *st, const float eye[4], const float clip[4])
{
	for (unsigned i = 0; i < 3; i++)
		if (!(clip[i] <= clip[3] && clip[i] >= -clip[3]))
			return 1;
	return gls_is_beyond_clip_planes(&st->a, eye) || clip[3] == 0;
}

static void raster_pos(struct gls_state *st, const float obj[4])
{
	struct gls_current *c = &st->a.current;
	const float *rect = st->a.viewport.rect, *range = st->a.viewport.depth_range;
	float eye[4], clip[4], w_inverse;
	struct vec3 normal;

	gls_sums(st)->transform(eye, st->modelview.matrices[st->modelview.depth], obj);
	gls_sums(st)->transform(clip, st->projection.matrices[st->projection.depth], eye);
	c->raster_valid = !is_clipped(st, eye, clip);
	if (!c->raster_valid)
		return;
	/* Operations in Mesa's order (22.3.6, rastpos.c): images are placed at the pixel whose centre is nearest. */
	w_inverse = 1 / clip[3];
	for (unsigned i = 0; i < 2; i++)
		c->raster_position[i] = clip[i] * w_inverse * (0.5f * rect[2 + i]) + (0.5f * rect[2 + i] + rect[i]);
	c->raster_position[2] = clip[2] * w_inverse * (0.5f * (range[1] - range[0])) + 0.5f * (range[1] + range[0]);
	c->raster_position[3] = clip[3];
	normal = eye_normal(st);
	set_colors(st, v4_load(eye), normal);
	set_texcoords(st, v4_load(obj), v4_load(eye), normal);
}

/* Sec. 2.13: without lighting, texture coordinate generation or clipping. */
static void window_pos(struct gls_state *st, const float at[4])
{
	struct gls_current *c = &st->a.current;
	const float *range = st->a.viewport.depth_range;
	float z = at[2] > 0 ? at[2] < 1 ? at[2] : 1 : 0;

	c->raster_position[0] = at[0];
	c->raster_position[1] = at[1];
	c->raster_position[2] = range[0] + z * (range[1] - range[0]);
	c->raster_position[3] = 1;
	c->raster_valid = 1;
	clamp_color(c->raster_color, v4_load(c->attribute[GLS_ATTR_COLOR]));
	clamp_color(c->raster_secondary, v4_load(c->attribute[GLS_ATTR_SECONDARY]));
	memcpy(c->raster_texcoord, c->attribute[GLS_ATTR_TEXCOORD], sizeof(c->raster_texcoord));
}

static void read_place(const struct gls_exec *x, const struct call *c, float out[4])
{
	const unsigned n = gls_commands[x->command].suffix.n;

	out[0] = out[1] = out[2] = 0;
	out[3] = 1;
	if (c->n_args == 1)
		arg_floats(c, 0, out, n);
	else
		for (unsigned i = 0; i < n; i++)
			out[i] = arg_f(c, i);
}

GLS_FAMILY(glRasterPos, STATE)
{
	float at[4];

	read_place(x, c, at);
	raster_pos(st, at);
}

GLS_FAMILY(glWindowPos, STATE)
{
	float at[4];

	read_place(x, c, at);
	window_pos(st, at);
}
