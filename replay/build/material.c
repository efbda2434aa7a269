/* Copies the state that a draw reads into a scene's views, materials, units and lights. */
#include "replay/build/material.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "gl_tokens.h"
#include "base/mat4.h"
#include "base/memory.h"
#include "replay/build/intern.h"
#include "replay/build/mesh.h"
#include "replay/build/program.h"
#include "replay/gl/texture/image.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/programs/program.h"
#include "scene/mesa.h"
#include "scene/program.h"

void gls_scissor_of(const struct gls_surface *d, const struct gls_scissor *scissor, int32_t out[4])
{
	int64_t x0 = 0, y0 = 0, x1 = d->width, y1 = d->height;
	const int32_t *rect = scissor->rect;

	if (scissor->enabled) {
		x0 = rect[0] > x0 ? rect[0] : x0;
		y0 = rect[1] > y0 ? rect[1] : y0;
		x1 = (int64_t)rect[0] + rect[2] < x1 ? (int64_t)rect[0] + rect[2] : x1;
		y1 = (int64_t)rect[1] + rect[3] < y1 ? (int64_t)rect[1] + rect[3] : y1;
	}
	out[0] = (int32_t)x0;
	out[1] = (int32_t)y0;
	out[2] = (int32_t)(x1 > x0 ? x1 - x0 : 0);
	out[3] = (int32_t)(y1 > y0 ? y1 - y0 : 0);
}

/*
 * Views with equal viewport rectangles share their eye space (scene.h). A parallel projection has no eye: it shares
 * coordinates only with views that show the same x and y, so that window coordinates are not confused with the world's.
 * Programs use matrices of their own, and GL's say nothing about those.
 */
static uint32_t space_of(struct gls_exec *x, struct gls_frame *f, const struct scene_view *view, int is_programmed)
{
	const float *m = view->projection;
	const int is_parallel = !is_programmed && m[3] == 0 && m[7] == 0 && m[11] == 0;
	const float across[] = { view->viewport[0], view->viewport[1], view->viewport[2], view->viewport[3],
		                 m[0] / m[15], m[4] / m[15], m[8] / m[15], m[12] / m[15],
		                 m[1] / m[15], m[5] / m[15], m[9] / m[15], m[13] / m[15] };
	const uint64_t key = XXH3_64bits(across, is_parallel ? sizeof(across) : sizeof(view->viewport));
	uintptr_t found = (uintptr_t)table_find(&f->spaces, key);

	if (!found) {
		found = f->spaces.n + 1;
		if (table_set(&f->spaces, key, (void *)found))
			gls_fail(x);
	}
	return (uint32_t)(found - 1);
}

/* A view whose eye coordinates are window coordinates, depth included. */
static void fill_window_view(const struct gls_surface *surface, struct scene_view *view)
{
	const float width = (float)surface->width, height = (float)surface->height;
	const float projection[16] = { 2 / width, 0, 0, 0, 0, 2 / height, 0, 0, 0, 0, 2, 0, -1, -1, -1, 1 };

	memcpy(view->projection, projection, 64);
	view->viewport[2] = width;
	view->viewport[3] = height;
	view->depth_range[1] = 1;
}

int gls_frame_is_programmed(const struct gls_state *st, const struct gls_event *e)
{
	return !e->in_window && (st->program || st->a.programs.vertex);
}

uint32_t gls_frame_view(struct gls_exec *x, const struct gls_surface *surface, const struct gls_state *st,
                        const struct gls_event *e)
{
	const struct gls_attribs *a = e->attribs;
	struct gls_frame *f = surface->frame;
	struct scene *s = f->out;
	struct scene_view view;

	memset(&view, 0, sizeof(view));
	if (e->in_window) {
		fill_window_view(surface, &view);
	} else {
		memcpy(view.projection, st->projection.matrices[st->projection.depth], 64);
		memcpy(view.viewport, a->viewport.rect, 16);
		memcpy(view.depth_range, a->viewport.depth_range, 8);
	}
	gls_scissor_of(surface, &a->scissor, view.scissor);
	view.space = space_of(x, f, &view, gls_frame_is_programmed(st, e));
	view.x87 = st->x87;
	return gls_intern(x, &f->views, &s->views, &s->n_views, &f->room.views, &view, sizeof(view));
}

static int is_complete(struct gls_exec *x, struct gls_state *st, unsigned unit, unsigned target)
{
	struct gls_texture *t = gls_texture_bound(x, st, unit, target);

	return t && gls_texture_image_of(x, t, gls_texture_sampler(st, unit, t)->parameters.min_filter);
}

/*
 * The enabled target of highest precedence (sec. 3.8.15): cube map, 3D, rectangle, 2D, 1D. If its texture is not
 * complete, Mesa takes the next one that is.
 */
static int enabled_target(struct gls_exec *x, struct gls_state *st, const struct gls_unit *unit)
{
	static const unsigned order[] = { GLS_TEXTURE_CUBE, GLS_TEXTURE_3D, GLS_TEXTURE_RECTANGLE, GLS_TEXTURE_2D,
	                                  GLS_TEXTURE_1D };
	const int is_alone = !(unit->enabled & (unit->enabled - 1)) || !gls_is_mesa(st);
	int first = -1;

	for (unsigned i = 0; i < sizeof(order) / sizeof(*order); i++) {
		if (!(unit->enabled >> order[i] & 1))
			continue;
		if (is_alone || is_complete(x, st, unit->value.unit, order[i]))
			return (int)order[i];
		first = first < 0 ? (int)order[i] : first;
	}
	return first;
}

uint32_t gls_frame_texture(struct gls_exec *x, struct gls_frame *f, struct gls_texture_image *image)
{
	struct scene *s = f->out;

	image->used_frame = x->frame;
	if (image->slot_frame == f->serial)
		return image->slot;
	if (MEMORY_GROW(s->textures, f->room.textures, s->n_textures + 1)) {
		gls_fail(x);
		return SCENE_NONE;
	}
	atomic_fetch_add(&image->refs, 1);
	s->textures[s->n_textures] = &image->texture;
	image->slot = s->n_textures++;
	image->slot_frame = f->serial;
	return image->slot;
}

static uint32_t pack_swizzle(const uint32_t token[4])
{
	uint32_t packed = 0;

	for (unsigned i = 0; i < 4; i++)
		packed |= (token[i] == GL_ZERO ? 4u : token[i] == GL_ONE ? 5u : token[i] - GL_RED) << 3 * i;
	return packed == (1u << 3 | 2u << 6 | 3u << 9) ? 0 : packed | SCENE_SWIZZLED;
}

/* The matrix used if there are no coordinates: 0, 0, 0, q. */
static const float no_coordinates[16] = { [15] = 1 };

static int blends_smaller(uint32_t min_filter)
{
	return min_filter == GL_LINEAR || min_filter == GL_LINEAR_MIPMAP_NEAREST || min_filter == GL_LINEAR_MIPMAP_LINEAR;
}

/* How coordinates are generated and transformed. */
static void fill_coordinates(const struct gls_unit *unit, const float *matrix, struct scene_unit *out)
{
	for (unsigned i = 0; i < 4; i++)
		out->gen_mode[i] = unit->gen_enabled >> i & 1 ? unit->value.gen_mode[i] : 0;
	memcpy(out->matrix, matrix, 64);
	if (matrix == no_coordinates) /* llvmpipe divides 0 by 0 there, and uses the minification filter */
		out->mag_filter = blends_smaller(out->min_filter) ? GL_LINEAR : GL_NEAREST;
}

/* target: -1: none; matrix: the unit's texture matrix.  @return 1 if the unit is textured */
static int fill_unit(struct gls_exec *x, struct gls_frame *f, struct gls_state *st, const struct gls_unit *unit,
                     int target, const float *matrix, struct scene_unit *out)
{
	unsigned u = unit->value.unit;
	struct gls_texture *t = target >= 0 ? gls_texture_bound(x, st, u, (unsigned)target) : NULL;
	const struct gls_texture_parameters *p = t ? &gls_texture_sampler(st, u, t)->parameters : NULL;
	struct gls_texture_image *image = t ? gls_texture_image_of(x, t, p->min_filter) : NULL;
	uint32_t missing;

	if (!image)
		return 0;
	missing = x->feedback.missing ? gls_texture_missing(t) : 0;
	if (missing && x->feedback.supply)
		gls_rewind(x, "a texture has what they drew");
	f->out->shows_earlier |= missing && missing <= x->frame;
	*out = unit->value;
	out->texture = gls_frame_texture(x, f, image);
	out->wrap_s = p->wrap_s;
	out->wrap_t = p->wrap_t;
	out->wrap_r = p->wrap_r;
	out->min_filter = p->min_filter;
	out->mag_filter = p->mag_filter;
	gls_format_border(t->levels[0][t->parameters.base_level].internal_format, p->border_color, out->border_color);
	out->swizzle = pack_swizzle(t->parameters.swizzle);
	out->lod_bias = p->lod_bias + unit->lod_bias;
	out->min_lod = p->min_lod;
	out->max_lod = p->max_lod;
	out->max_anisotropy = p->max_anisotropy;
	out->compare_mode = p->compare_mode;
	out->compare_func = p->compare_func;
	out->depth_mode = t->parameters.depth_mode;
	fill_coordinates(unit, matrix, out);
	return 1;
}

/* Disable a unit for fixed function. */
static void pass_by(struct scene_unit *unit)
{
	unit->env_mode = GL_COMBINE;
	unit->combine_rgb = unit->combine_alpha = GL_REPLACE;
	unit->source_rgb[0] = unit->source_alpha[0] = GL_PREVIOUS;
	unit->operand_rgb[0] = GL_SRC_COLOR;
	unit->operand_alpha[0] = GL_SRC_ALPHA;
}

/*
 * A program samples black from a unit without a complete texture. Where fixed function replaces a program that is not
 * run, the unit is disabled.
 */
static void fill_black(struct gls_exec *x, struct gls_frame *f, const struct gls_unit *unit, const float *matrix,
                       struct scene_unit *out)
{
	static const uint8_t black[4] = { 0, 0, 0, 255 };
	struct gls_texture_image *image = gls_texture_image_find(x, 1, 1, sizeof(black), black);

	*out = unit->value;
	if (!image)
		return;
	out->texture = gls_frame_texture(x, f, image);
	gls_texture_image_release(image);
	out->wrap_s = out->wrap_t = out->wrap_r = GL_REPEAT;
	out->min_filter = out->mag_filter = GL_NEAREST;
	pass_by(out);
	fill_coordinates(unit, matrix, out);
}

/*
 * The matrix of a unit's coordinates. Mesa leaves coordinates that sprites replace to the sprites: if POINT_SPRITE is
 * enabled and something other than a point is drawn, they are all 0, unless a program positions the vertices.
 */
static const float *coordinate_matrix(const struct gls_state *st, const struct gls_event *e, unsigned u,
                                      const struct program_stage *vertices)
{
	if (e->in_window)
		return mat4_identity;
	if (e->attribs->point.sprite && e->attribs->texturing.units[u].value.coord_replace && !vertices &&
	    gls_is_mesa(st))
		return no_coordinates;
	return st->texture[u].matrices[st->texture[u].depth];
}

/*
 * Fill in the units that a draw uses. program: the fragment program; vertices: the vertex program; NULL: none
 * @return number of units
 */
static uint32_t fill_units(struct gls_exec *x, struct gls_frame *f, struct gls_state *st, const struct gls_event *e,
                           const struct program_stage *program, const struct program_stage *vertices,
                           struct scene_unit units[GLS_MAX_UNITS])
{
	uint32_t n = 0;

	for (unsigned u = 0; u < GLS_MAX_UNITS; u++) {
		const struct gls_unit *unit = &e->attribs->texturing.units[u];
		const float *matrix = coordinate_matrix(st, e, u, vertices);
		const int of_fragments = program && !(program->code->enabled >> u & 1) ?
		                                 (int)program_target(program, u) - 1 :
		                                 enabled_target(x, st, unit);
		const int target = of_fragments >= 0 || !vertices ? of_fragments : (int)program_target(vertices, u) - 1;
		const int counts = target > of_fragments ||
		                   (program &&
		                    (target >= 0 || program->code->inputs >> (SCENE_INPUT_TEXCOORD + u) & 1));

		if (!fill_unit(x, f, st, unit, target, matrix, &units[n])) {
			if (!counts)
				continue;
			fill_black(x, f, unit, matrix, &units[n]);
		}
		if (!program && target > of_fragments)
			pass_by(&units[n]);
		n++;
	}
	return n;
}

/* State values are clamped unless the drawable can hold values outside [0,1] (ARB_color_buffer_float). */
static float clamped(float value, uint32_t unclamped)
{
	return unclamped ? value : value < 0 ? 0 : value > 1 ? 1 : value;
}

void gls_color_of(float out[4], const float color[4], uint32_t unclamped)
{
	for (unsigned i = 0; i < 4; i++)
		out[i] = clamped(color[i], unclamped);
}

/* Bits as scene_material.unclamped. */
static uint32_t unclamped_by(const struct gls_attribs *a, const struct gls_surface *d)
{
	uint32_t fragments = d->floats && a->color.clamp != GL_TRUE;
	uint32_t vertices = a->lighting.clamp == GL_FALSE || (a->lighting.clamp == GL_FIXED_ONLY && d->floats);

	return fragments | vertices << 1;
}

/* which: bit set of lights, 1 << number */
static uint32_t fill_lights(struct gls_exec *x, struct gls_frame *f, const struct gls_lighting *l, uint32_t which,
                            uint32_t *count)
{
	struct scene *s = f->out;
	struct scene_light lights[GLS_MAX_LIGHTS];

	*count = 0;
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		if (which >> i & 1)
			lights[(*count)++] = l->lights[i].value;
	return gls_intern_array(x, &f->lights, &s->lights, &s->n_lights, &f->room.lights, lights, *count, sizeof(lights[0]));
}

static uint32_t enabled_lights(const struct gls_lighting *l)
{
	uint32_t lights = 0;

	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		lights |= (l->lights[i].enabled ? 1u : 0) << i;
	return lights;
}

static uint32_t fill_stipple(struct gls_exec *x, struct gls_frame *f, const struct gls_attribs *a)
{
	struct scene *s = f->out;

	if (!a->polygon.stipple)
		return SCENE_NONE;
	return gls_intern(x, &f->stipples, &s->stipples, &s->n_stipples, &f->room.stipples, a->polygon_stipple,
	              sizeof(a->polygon_stipple));
}

/*
 * color: the current colour, which vertices may override; covered: 1: they do not, and the material's own colour has
 * replaced it (gl/geometry/waiting.h)
 */
static void fill_lighting(const struct gls_lighting *l, const float color[4], int covered, struct scene_material *m)
{
	const int tracks = l->color_material && !covered;

	memcpy(m->light_model_ambient, l->model_ambient, 16);
	m->local_viewer = l->local_viewer;
	m->two_side = l->enabled && l->two_side;
	m->separate_specular = l->separate_specular;
	m->front = l->face[0];
	m->back = l->face[1];
	if (tracks) {
		gls_set_face_colors(&m->front, gls_tracked_colors(l, 0), color);
		gls_set_face_colors(&m->back, gls_tracked_colors(l, 1), color);
	}
	m->color_material = tracks ? l->color_material_face : 0;
	m->color_material_mode = l->color_material_mode;
}

static void fill_fragment_state(const struct gls_attribs *a, const struct gls_target *target, struct scene_material *m)
{
	const struct gls_surface *d = target->surface;
	const struct gls_color_buffer *b = &a->color;

	m->alpha_test = a->color.alpha_test;
	m->alpha_func = b->alpha_func;
	m->alpha_ref = clamped(b->alpha_ref, unclamped_by(a, d) & 1);
	m->stencil_test = a->stencil.enabled && d->stencil_bits;
	m->stencil_front = a->stencil.side[0];
	m->stencil_back = a->stencil.side[1];
	m->depth_test = a->depth.enabled && d->depth_bits;
	m->depth_func = a->depth.func;
	m->depth_write = a->depth.write;
	m->blend = b->blend;
	m->blend_equation_rgb = b->equation_rgb;
	m->blend_equation_alpha = b->equation_alpha;
	m->blend_src_rgb = b->src_rgb;
	m->blend_dst_rgb = b->dst_rgb;
	m->blend_src_alpha = b->src_alpha;
	m->blend_dst_alpha = b->dst_alpha;
	gls_color_of(m->blend_color, b->blend_color, d->floats);
	m->logic_op = b->logic_op_enabled && !d->floats ? b->logic_op : 0;
	m->color_mask = target->colored ? b->mask : 0;
	m->floats = d->floats;
	m->srgb = b->framebuffer_srgb && d->srgb;
	m->unclamped = unclamped_by(a, d);
}

static void fill_raster_state(const struct gls_attribs *a, int is_mesa, struct scene_material *m)
{
	m->cull_face = a->polygon.cull ? a->polygon.cull_face : 0;
	m->front_face = a->polygon.front_face;
	m->polygon_mode_front = a->polygon.mode[0];
	m->polygon_mode_back = a->polygon.mode[1];
	m->polygon_offset = (a->polygon.offset_point ? 1u : 0) | (a->polygon.offset_line ? 2u : 0) |
	                    (a->polygon.offset_fill ? 4u : 0);
	/* llvmpipe's triangle setup checks none of the three enables */
	if (m->polygon_offset && is_mesa && !gls_draws_by_stages(a))
		m->polygon_offset |= 4;
	m->polygon_offset_factor = a->polygon.offset_factor;
	m->polygon_offset_units = a->polygon.offset_units;
	m->line_stipple = a->line.stipple ? a->line.stipple_factor << 16 | a->line.stipple_pattern : 0;
	m->line_width = a->line.width;
	m->line_smooth = a->line.smooth;
	m->point_size = a->point.size;
	m->point_smooth = a->point.smooth;
	m->polygon_smooth = a->polygon.smooth;
	m->point_sprite = !a->point.sprite ? 0 : a->point.sprite_origin == GL_LOWER_LEFT ? 2 : 1;
	memcpy(m->point_attenuation, a->point.attenuation, sizeof(m->point_attenuation));
	m->point_size_min = a->point.size_min;
	m->point_size_max = a->point.size_max;
	m->point_fade_threshold = a->point.fade_threshold;
	m->clip_plane_mask = a->transform.clip_plane_mask;
	for (unsigned i = 0; i < GLS_MAX_CLIP_PLANES; i++)
		if (m->clip_plane_mask >> i & 1)
			memcpy(m->clip_plane_eye[i], a->transform.clip_plane_eye[i], 16);
}

/*
 * Multisampling (sec. 3.2.1) replaces smoothing. GL does not say which samples SAMPLE_COVERAGE keeps; Mesa keeps the
 * first ones (st_update_sample_state).
 */
static void fill_multisample(const struct gls_multisample *a, const struct gls_surface *d, struct scene_material *m)
{
	if (!a->enabled || d->samples <= 1)
		return;
	m->multisample = 1;
	m->line_smooth = m->point_smooth = m->polygon_smooth = 0;
	m->alpha_to_coverage = a->alpha_to_coverage;
	m->alpha_to_one = a->alpha_to_one;
	if (a->coverage) {
		uint32_t kept = (1u << (uint32_t)(a->coverage_value * SCENE_SAMPLES)) - 1;

		m->samples_off = (a->coverage_invert ? kept : ~kept) & ((1u << SCENE_SAMPLES) - 1);
	}
}

/* The state that a vertex program replaces. */
static void fill_vertex_stage(const struct gls_state *st, const struct program_code *code, struct scene_material *m)
{
	static const float attenuation[3] = { 1, 0, 0 };

	m->lighting = 0;
	m->two_side = st->a.programs.two_side;
	m->program_normals = code->inputs >> SCENE_VERTEX_NORMAL & 1;
	memcpy(m->point_attenuation, attenuation, sizeof(attenuation));
}

/* 1 if waiting material parameters override the colour that COLOR_MATERIAL makes them follow. */
static int covers_color(const struct gls_state *st, const struct gls_event *e)
{
	return st->waiting.covers && !(st->mesa & SCENE_MESA_TRACKS_COLORS) && !st->waiting.colored && !e->mesh->mesh.color;
}

uint32_t gls_frame_material(struct gls_exec *x, const struct gls_target *target, struct gls_state *st,
                            const struct gls_event *e)
{
	struct gls_frame *f = target->surface->frame;
	struct scene *s = f->out;
	const struct gls_attribs *a = e->attribs;
	const uint32_t unclamped = unclamped_by(a, target->surface);
	struct program_stage vertices, fragments;
	uint32_t lights;
	const int runs_fragments = gls_program_runs_fragments(st, &fragments);
	const int runs_vertices = !e->rectangle && !e->in_window && gls_program_runs_vertices(st, &vertices);
	struct scene_unit units[GLS_MAX_UNITS];
	struct scene_material m;

	memset(&m, 0, sizeof(m));
	m.lighting = a->lighting.enabled;
	fill_lighting(&a->lighting, e->values[GLS_ATTR_COLOR], covers_color(st, e), &m);
	if (runs_vertices)
		fill_vertex_stage(st, vertices.code, &m);
	lights = runs_vertices ? program_lights(vertices.code) | (runs_fragments ? program_lights(fragments.code) : 0) :
	                         m.lighting ? enabled_lights(&a->lighting) : 0;
	if (lights)
		m.light_first = fill_lights(x, f, &a->lighting, lights, &m.light_count);
	m.normalize = a->transform.normalize;
	m.rescale_normal = a->transform.rescale_normal;
	m.shade_model = a->lighting.shade_model;
	m.first_provokes = a->lighting.first_provokes;
	m.unit_count = fill_units(x, f, st, e, runs_fragments ? &fragments : NULL, runs_vertices ? &vertices : NULL, units);
	for (unsigned i = 0; i < m.unit_count; i++)
		gls_color_of(units[i].env_color, units[i].env_color, unclamped & 1);
	m.unit_first = gls_intern_array(x, &f->units, &s->units, &s->n_units, &f->room.units, units, m.unit_count,
	                                sizeof(units[0]));
	m.color_sum = a->fog.color_sum;
	m.fog = a->fog.enabled;
	m.fog_mode = a->fog.mode;
	m.fog_coord_source = a->fog.coord_source == GL_FOG_COORD ? GL_FOG_COORD : a->fog.distance_mode;
	m.fog_density = a->fog.density;
	m.fog_start = a->fog.start;
	m.fog_end = a->fog.end;
	gls_color_of(m.fog_color, a->fog.color, unclamped & 1);
	fill_raster_state(a, gls_is_mesa(st), &m);
	m.polygon_stipple = fill_stipple(x, f, a);
	fill_fragment_state(a, target, &m);
	fill_multisample(&a->multisample, target->surface, &m);
	m.surface = st->surface;
	m.program = runs_fragments || st->program || st->a.programs.vertex || st->a.programs.fragment;
	if (runs_fragments) {
		if (!st->program && !(st->mesa & SCENE_MESA_FLAT_PROGRAMS))
			m.shade_model = GL_SMOOTH;
		m.fragment_program = gls_program_build(x, f, st, a, &fragments, lights);
	}
	if (runs_vertices) {
		m.vertex_program = gls_program_build(x, f, st, a, &vertices, lights);
		m.clip_by_program = m.clip_plane_mask && !m.two_side && vertices.code->outputs >> SCENE_RESULT_CLIP_VERTEX & 1;
	}
	return gls_intern(x, &f->materials, &s->materials, &s->n_materials, &f->room.materials, &m, sizeof(m));
}
