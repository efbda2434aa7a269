#include "replay/gl/surface/shown.h"

#include <math.h>

#include "base/mat4.h"
#include "gl_tokens.h"
#include "replay/build/material.h"
#include "replay/build/mesh.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/surface/shown_program.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "replay/programs/program.h"
#include "scene/program.h"
#include "scene/release.h"

#define PIXEL_SLACK 0.01f /* tolerance of a corner's position, in pixels */

/* --- Before the draw -------------------------------------------------------------------------------------------- */

/* The texture that a draw may show: unit 0's 2D texture, or the only one that its program samples. */
static const struct gls_texture *texture_of(struct gls_exec *x, struct gls_state *st,
                                            const struct gls_texturing *texturing)
{
	struct program_stage stage;
	uint32_t unit = GLS_MAX_UNITS;

	if (!gls_program_runs_fragments(st, &stage))
		return !st->program && !st->a.programs.vertex && !st->a.programs.fragment && !st->a.programs.ati &&
		                       texturing->units[0].enabled >> GLS_TEXTURE_2D & 1 ?
		               gls_texture_bound(x, st, 0, GLS_TEXTURE_2D) :
		               NULL;
	for (uint32_t u = 0; u < GLS_MAX_UNITS; u++)
		if (program_target(&stage, u)) {
			if (unit < GLS_MAX_UNITS || program_target(&stage, u) != GLS_TEXTURE_2D + 1)
				return NULL;
			unit = u;
		}
	return unit < GLS_MAX_UNITS ? gls_texture_bound(x, st, unit, GLS_TEXTURE_2D) : NULL;
}

struct gls_drawn gls_shown_by_draw(struct gls_exec *x, struct gls_state *st, const struct gls_event *e)
{
	const struct gls_texturing *texturing = &e->attribs->texturing;
	const struct gls_texture *t;

	if (st->draw_framebuffer || !st->share->framebuffers.n || e->rectangle || e->mesh->mesh.kind != SCENE_TRIANGLES ||
	    e->mesh->mesh.primitive_count > 2)
		return (struct gls_drawn){ NULL };
	t = texture_of(x, st, texturing);
	gls_texture_update(x, st, t);
	return gls_texture_drawn(t);
}

struct gls_drawn gls_shown_by_blit(struct gls_exec *x, struct gls_state *st)
{
	if (st->draw_framebuffer || !st->read_framebuffer)
		return (struct gls_drawn){ NULL };
	return gls_framebuffer_drawn(x, st, st->read_framebuffer);
}

/* --- Is the picture shown unchanged? ----------------------------------------------------------------------------- */

static int blends_with_own_alpha(const struct scene_material *m)
{
	return m->blend && (m->blend_src_rgb == GL_DST_ALPHA || m->blend_src_rgb == GL_ONE_MINUS_DST_ALPHA ||
	                    m->blend_src_rgb == GL_SRC_ALPHA_SATURATE || m->blend_dst_rgb == GL_DST_ALPHA ||
	                    m->blend_dst_rgb == GL_ONE_MINUS_DST_ALPHA);
}

/* The depth bits that take effect (struct scene_picture). */
static uint32_t counted(uint32_t depth_bits)
{
	return depth_bits > 24 ? 24 : depth_bits;
}

/* 1 if a program's fragments depend on their window position. */
static int looks_at_places(const struct scene *s, const struct scene_material *m)
{
	const struct scene_program *program = scene_program_of(s, m->fragment_program);

	return program && program->inputs >> SCENE_INPUT_POSITION & 1;
}

/* 1 if an instance has the same colours elsewhere in the window. */
static int moves(const struct scene *s, const struct scene_instance *in, const int32_t rect[4])
{
	const struct scene_material *m = &s->materials[in->material];

	return !in->rectangle && !looks_at_places(s, m) &&
	       (m->polygon_stipple == SCENE_NONE || (rect[0] % 32 == 0 && rect[1] % 32 == 0));
}

/*
 * 1 if events give the same colours in a part of the window as in their object. A window without depth, as toolkits
 * use, gets the object's depth buffer: its own draws do not test depth.
 */
static int suits(const struct scene *s, const struct scene *window, const int32_t rect[4])
{
	if (s->needs_previous || s->start || s->output || s->floats || window->floats || (int32_t)s->width != rect[2] ||
	    (int32_t)s->height != rect[3] || s->samples > 1 || window->samples > 1 ||
	    (window->depth_bits && counted(s->depth_bits) != counted(window->depth_bits)))
		return 0;
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_material *m = &s->materials[s->instances[i].material];

		if ((m->stencil_test && s->stencil_bits != window->stencil_bits) ||
		    (blends_with_own_alpha(m) && s->alpha_bits != window->alpha_bits) ||
		    ((rect[0] || rect[1]) && !moves(s, &s->instances[i], rect)))
			return 0;
	}
	return 1;
}

/* 1 if fragments are written unchanged. */
static int passes_through(const struct scene_material *m)
{
	return !m->alpha_test && !m->stencil_test && !m->blend && !m->logic_op && (m->color_mask & 7) == 7 &&
	       !m->clip_plane_mask && m->polygon_stipple == SCENE_NONE && m->polygon_mode_front == GL_FILL &&
	       m->polygon_mode_back == GL_FILL &&
	       (!m->depth_test || m->depth_func == GL_ALWAYS || m->depth_func == GL_LESS || m->depth_func == GL_LEQUAL);
}

/* 1 if a quad's colour leaves texels unchanged. */
static int is_white(const struct scene *s, const struct scene_instance *in, const struct scene_material *m)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const float *color = s->currents[in->current].color;

	if (s->units[m->unit_first].env_mode == GL_REPLACE)
		return 1;
	for (uint32_t v = 0; mesh->color && v < mesh->vertex_count; v++)
		for (int k = 0; k < 3; k++)
			if (mesh->color[4 * v + (uint32_t)k] != 1)
				return 0;
	return mesh->color || (color[0] == 1 && color[1] == 1 && color[2] == 1);
}

/* 1 if fixed function, with a single unit, shows texels unchanged. */
static int shows_fixed(const struct scene *s, const struct scene_instance *in, const struct scene_material *m,
                       struct shown_program *out)
{
	const struct scene_unit *u = &s->units[m->unit_first];

	if (m->program || m->lighting || m->fog || m->color_sum || m->unit_count != 1 ||
	    (u->env_mode != GL_REPLACE && u->env_mode != GL_MODULATE))
		return 0;
	*out = (struct shown_program){ u->unit, { 4 * u->unit, 4 * u->unit + 1 } };
	return is_white(s, in, m);
}

static const struct scene_unit *unit_of(const struct scene *s, const struct scene_material *m, uint32_t unit)
{
	for (uint32_t i = 0; i < m->unit_count; i++)
		if (s->units[m->unit_first + i].unit == unit)
			return &s->units[m->unit_first + i];
	return NULL;
}

/* 1 if fragments have the colours of *unit's texels, at the coordinates stored in `out`. */
static int shows_texels(const struct scene *s, const struct scene_instance *in, const struct scene_material *m,
                        struct shown_program *out, const struct scene_unit **unit)
{
	if (m->fragment_program ? !shown_program_of(s, m, out) : !shows_fixed(s, in, m, out))
		return 0;
	*unit = unit_of(s, m, out->unit);
	return *unit && !(*unit)->swizzle && !(*unit)->compare_mode &&
	       ((*unit)->min_filter == GL_NEAREST || (*unit)->min_filter == GL_LINEAR);
}

/*
 * The position of a vertex in clip coordinates; all: [4 * SCENE_MAX_UNITS], texture coordinates from a vertex program.
 */
static void place_of(const struct scene *s, const struct scene_instance *in, uint32_t v, float clip[4], float *all)
{
	float eye[4];

	if (s->materials[in->material].vertex_program && shown_program_vertex(s, in, v, clip, all))
		return;
	mat4_transform(eye, in->modelview, s->meshes[in->mesh]->position + 4 * (size_t)v);
	mat4_transform(clip, s->views[in->view].projection, eye);
}

/* The texel at a vertex' fixed-function coordinates. @return 0: they are generated, or belong to several units */
static int texel_of(const struct scene *s, const struct scene_instance *in, uint32_t v,
                    const struct shown_program *shown, float texel[2])
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const struct scene_material *m = &s->materials[in->material];
	const uint32_t n = shown->coordinates[0] / 4;
	const struct scene_unit *u = unit_of(s, m, n);
	const float *given = mesh->texcoord[n] ? mesh->texcoord[n] + 4 * (size_t)v : s->currents[in->current].texcoord[n];
	float at[4];

	if (!u || u->gen_mode[0] || u->gen_mode[1] || shown->coordinates[0] != 4 * n || shown->coordinates[1] != 4 * n + 1)
		return 0;
	mat4_transform(at, u->matrix, given);
	for (int k = 0; k < 2; k++)
		texel[k] = m->fragment_program ? at[k] : at[k] / at[3];
	return m->fragment_program || at[3] != 0;
}

/* A corner's window position, and its distance from its texel. @return 0: it is clipped */
static int corner_at(const struct scene *s, const struct scene_instance *in, uint32_t v,
                     const struct shown_program *shown, const struct scene_texture *t, float out[2], float off[2])
{
	const float size[2] = { (float)t->width, (float)t->height }, *viewport = s->views[in->view].viewport;
	float clip[4], texel[2], all[4 * SCENE_MAX_UNITS];

	place_of(s, in, v, clip, all);
	if (!(clip[3] > 0) || clip[2] < -clip[3] || clip[2] >= clip[3])
		return 0;
	for (int k = 0; k < 2 && s->materials[in->material].vertex_program; k++)
		texel[k] = all[shown->coordinates[k]];
	if (!s->materials[in->material].vertex_program && !texel_of(s, in, v, shown, texel))
		return 0;
	for (int k = 0; k < 2; k++) {
		out[k] = viewport[k] + (clip[k] / clip[3] * 0.5f + 0.5f) * viewport[k + 2];
		if (out[k] < viewport[k] - PIXEL_SLACK || out[k] > viewport[k] + viewport[k + 2] + PIXEL_SLACK)
			return 0;
		off[k] = out[k] - texel[k] * size[k];
	}
	return 1;
}

/* 1 if a part of the window is inside the view and entirely within the scissor. */
static int is_left_whole(const struct scene *s, const struct scene_view *view, const int32_t rect[4])
{
	const int32_t *scissor = view->scissor;

	return rect[0] >= scissor[0] && rect[1] >= scissor[1] && rect[0] + rect[2] <= scissor[0] + scissor[2] &&
	       rect[1] + rect[3] <= scissor[1] + scissor[3] && rect[0] + rect[2] <= (int32_t)s->width &&
	       rect[1] + rect[3] <= (int32_t)s->height;
}

/* A triangle's area in pixels; 0 if it is not drawn, or maps texels to other pixels than `rect` says. */
static float shown_area(const struct scene *s, const struct scene_instance *in, const uint32_t index[3],
                        const struct shown_program *shown, const struct scene_texture *t, const int32_t rect[4])
{
	const struct scene_material *m = &s->materials[in->material];
	float corner[3][2], off[2], twice;

	for (uint32_t c = 0; c < 3; c++) {
		if (!corner_at(s, in, index[c], shown, t, corner[c], off))
			return 0;
		for (int k = 0; k < 2; k++)
			if (fabsf(off[k] - (float)rect[k]) >= PIXEL_SLACK || corner[c][k] < (float)rect[k] - PIXEL_SLACK ||
			    corner[c][k] > (float)(rect[k] + rect[k + 2]) + PIXEL_SLACK)
				return 0;
	}
	twice = (corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
	        (corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]);
	if (m->cull_face && m->cull_face != ((twice > 0) == (m->front_face == GL_CCW) ? GL_BACK : GL_FRONT))
		return 0;
	return 0.5f * fabsf(twice);
}

/* 1 if triangles map every texel to its pixel, over the whole part of the window that `rect` receives. */
static int is_whole_quad(const struct scene *s, const struct scene_instance *in, const struct shown_program *shown,
                         const struct scene_texture *t, int32_t rect[4])
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	float area = 0, corner[2], off[2];

	if (t->floats || !mesh->primitive_count || !corner_at(s, in, mesh->index[0], shown, t, corner, off) ||
	    !(fabsf(off[0]) < (float)s->width) || !(fabsf(off[1]) < (float)s->height))
		return 0;
	rect[0] = (int32_t)lrintf(off[0]);
	rect[1] = (int32_t)lrintf(off[1]);
	rect[2] = (int32_t)t->width;
	rect[3] = (int32_t)t->height;
	for (uint32_t p = 0; p < mesh->primitive_count; p++)
		area += shown_area(s, in, mesh->index + 3 * (size_t)p, shown, t, rect);
	return is_left_whole(s, &s->views[in->view], rect) && fabsf(area - (float)t->width * (float)t->height) < 1;
}

/* The depth that a quad leaves, if it is constant. @return 0: it is not */
static int left_depth(const struct scene *s, const struct scene_instance *in, float *depth)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const struct scene_view *view = &s->views[in->view];
	int same = 1;

	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		float clip[4], all[4 * SCENE_MAX_UNITS], z;

		place_of(s, in, v, clip, all);
		z = view->depth_range[0] + (clip[2] / clip[3] * 0.5f + 0.5f) * (view->depth_range[1] - view->depth_range[0]);
		same &= v == 0 || z == *depth;
		*depth = z;
	}
	return same;
}

/* 1 if a blit maps a whole picture, of this size, to the part of the window that `rect` receives. */
static int is_whole_rectangle(const struct scene *s, const struct scene_instance *in, uint32_t width, uint32_t height,
                              int32_t rect[4])
{
	const struct scene_rectangle *r = &s->rectangles[in->rectangle - 1];
	const float *corner = s->meshes[in->mesh]->position;

	if (!(corner[0] >= 0 && corner[0] < (float)s->width && corner[1] >= 0 && corner[1] < (float)s->height))
		return 0; /* and no number outside a pixel's range */
	rect[0] = (int32_t)corner[0];
	rect[1] = (int32_t)corner[1];
	rect[2] = (int32_t)r->width;
	rect[3] = (int32_t)r->height;
	return r->kind == SCENE_COLOR_PIXELS && r->width == width && r->height == height && r->zoom[0] == 1 &&
	       r->zoom[1] == 1 && corner[0] == (float)rect[0] && corner[1] == (float)rect[1] &&
	       is_left_whole(s, &s->views[in->view], rect);
}

/* 1 if draws before the last may have left depth or stencil values in the window. */
static int has_depths(const struct gls_frame *window)
{
	const struct scene *s = window->out;

	for (uint32_t i = window->put_end; i + 1 < s->n_instances; i++) {
		const struct scene_material *m = &s->materials[s->instances[i].material];

		if ((m->depth_test && m->depth_write) || m->stencil_test || s->instances[i].rectangle)
			return 1;
	}
	return 0;
}

static int is_lit(const struct scene *s)
{
	for (uint32_t i = 0; i < s->n_instances; i++)
		if (s->materials[s->instances[i].material].lighting)
			return 1;
	return 0;
}

/* --- After the draw --------------------------------------------------------------------------------------------- */

/* The surface that the context draws to, if that is only a window's back buffer. */
static struct gls_surface *window_of(struct gls_exec *x, struct gls_state *st)
{
	struct gls_target targets[2];

	return gls_targets_of(x, st, targets) == 1 && targets[0].colored ? targets[0].surface : NULL;
}

void gls_shown_end(struct gls_exec *x, struct gls_state *st, struct gls_drawn drawn)
{
	struct gls_surface *window = drawn.scene || drawn.width ? window_of(x, st) : NULL;
	struct scene *s = window && window->frame ? gls_frame_scene(x, window) : NULL;
	const struct scene_instance *in = s && s->n_instances ? &s->instances[s->n_instances - 1] : NULL;
	const struct scene_material *m = in ? &s->materials[in->material] : NULL;
	const int leaves_depth = m && m->depth_test && m->depth_write;
	const struct scene_unit *unit = NULL;
	struct shown_program shown = { 0 };
	int32_t rect[4] = { 0 };
	float depth = 1;
	const uint32_t width = drawn.scene ? drawn.scene->width : drawn.width;
	const uint32_t height = drawn.scene ? drawn.scene->height : drawn.height;
	int is_shown = m && (in->rectangle ? is_whole_rectangle(s, in, width, height, rect) :
	                                     passes_through(m) && shows_texels(s, in, m, &shown, &unit) &&
	                                             is_whole_quad(s, in, &shown, s->textures[unit->texture], rect));

	is_shown = is_shown && (!drawn.scene || suits(drawn.scene, s, rect)) && !has_depths(window->frame) &&
	           (!m->depth_test || s->n_instances == 1) && (!leaves_depth || left_depth(s, in, &depth));
	if (is_shown && !drawn.scene)
		gls_rewind(x, "a texture has what they drew");
	else if (is_shown && x->feedback.keeps_targets)
		s->untraced_draw = is_lit(drawn.scene) ? in->draw : s->untraced_draw;
	else if (is_shown && !gls_frame_put(x, window, drawn.scene, rect, leaves_depth ? &depth : NULL))
		gls_fail(x);
	scene_release(&drawn.scene);
}
