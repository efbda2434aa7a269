/* The scene under construction: what a draw saw is copied here, equal things once (scene.h). */
#include "replay/build/frame.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "base/memory.h"
#include "base/mat4.h"
#include "base/table.h"
#include "capture/format/trace.h"
#include "replay/build/mesh.h"
#include "replay/gl/texture/image.h"
#include "replay/gl/texture/texformat.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"
#include "replay/machine/state.h"
#include "scene/release.h"

struct gls_frame {
	struct scene *out; /* NULL between frames */
	struct { uint32_t instances, materials, units, lights, currents, views, clears, stipples, meshes, textures, draws, rectangles; } room;
	struct table materials, units, lights, currents, views, stipples, spaces; /* hash -> index + 1 */
	uint32_t material, view; /* of the last draw, while its context's state is not dirty */
	const struct gls_state *last;
	uint32_t next_draw, next_primitive;
	uint32_t colored; /* 1: some event may change colours */
	uint32_t cleared; /* buffers wholly cleared so far, bits as in scene_clear */
	uint64_t serial;  /* of the scene: what meshes and images remember their slots by */
	struct gls_picture *snapshot; /* a reference: what the first snapshot_events events make, or NULL */
	uint64_t snapshot_events;
};

/* A scene as this file makes it. Owned by whoever holds a reference: the caller of replay_next_frame, a surface. */
struct gls_scene {
	struct scene scene; /* first */
	atomic_uint refs;
};

static int make_room(void *array, uint32_t *room, uint32_t wanted, size_t size)
{
	if (wanted > *room)
		*room = (uint32_t)memory_grow(array, *room, wanted, size);
	return wanted > *room ? ERR_SYSTEM : 0;
}

/* The index of equal bytes in an array, appending them where they are new; SCENE_NONE: out of memory. */
static uint32_t intern(struct table *t, void *array, uint32_t *n, uint32_t *room, const void *value, size_t size)
{
	uint64_t hash = XXH3_64bits(value, size);
	uint8_t **p = array;
	uintptr_t found;

	for (; (found = (uintptr_t)table_find(t, hash)); hash++)
		if (memcmp(*p + (found - 1) * size, value, size) == 0)
			return (uint32_t)(found - 1);
	if (make_room(array, room, *n + 1, size) || table_set(t, hash, (void *)(uintptr_t)(*n + 1)))
		return SCENE_NONE;
	memcpy(*p + *n * size, value, size);
	return (*n)++;
}

/* The same for a run of values that must lie together; returns the first one's index. */
static uint32_t intern_run(struct table *t, void *array, uint32_t *n, uint32_t *room, const void *values, uint32_t count,
                           size_t size)
{
	uint64_t hash = XXH3_64bits_withSeed(values, count * size, count);
	uint8_t **p = array;
	uintptr_t found;

	if (!count)
		return 0;
	for (; (found = (uintptr_t)table_find(t, hash)); hash++)
		if (*n - (found - 1) >= count && memcmp(*p + (found - 1) * size, values, count * size) == 0)
			return (uint32_t)(found - 1);
	if (make_room(array, room, *n + count, size) || table_set(t, hash, (void *)(uintptr_t)(*n + 1)))
		return SCENE_NONE;
	memcpy(*p + *n * size, values, count * size);
	*n += count;
	return *n - count;
}

/* ---- what a draw saw ---- */

static void fill_scissor(const struct gls_surface *d, const struct gls_scissor *scissor, int32_t out[4])
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

/* Views with equal viewport rectangles share their eye space (scene.h). */
static uint32_t space_of(struct gls_frame *f, const struct scene_view *view)
{
	uint64_t key = XXH3_64bits(view->viewport, sizeof(view->viewport));
	uintptr_t found = (uintptr_t)table_find(&f->spaces, key);

	if (!found) {
		found = f->spaces.n + 1;
		if (table_set(&f->spaces, key, (void *)found))
			return 0;
	}
	return (uint32_t)(found - 1);
}

static uint32_t find_view(const struct gls_surface *surface, const struct gls_state *st, const struct gls_attribs *a)
{
	struct gls_frame *f = surface->frame;
	struct scene *s = f->out;
	struct scene_view view;

	memset(&view, 0, sizeof(view));
	memcpy(view.projection, st->projection.matrices[st->projection.depth], 64);
	memcpy(view.viewport, a->viewport.rect, 16);
	memcpy(view.depth_range, a->viewport.depth_range, 8);
	fill_scissor(surface, &a->scissor, view.scissor);
	view.space = space_of(f, &view);
	return intern(&f->views, &s->views, &s->n_views, &f->room.views, &view, sizeof(view));
}

/* The enabled target of highest precedence (sec. 3.8.15): cube map, 3D, rectangle, 2D, 1D. */
static int enabled_target(const struct gls_unit *unit)
{
	static const unsigned order[] = { GLS_TEXTURE_CUBE, GLS_TEXTURE_3D, GLS_TEXTURE_RECTANGLE, GLS_TEXTURE_2D,
	                                  GLS_TEXTURE_1D };

	for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS; i++)
		if (unit->enabled >> order[i] & 1)
			return (int)order[i];
	return -1;
}

static uint32_t texture_slot(struct gls_exec *x, struct gls_frame *f, struct gls_texture_image *image)
{
	struct scene *s = f->out;

	image->used_frame = x->frame;
	if (image->slot_frame == f->serial)
		return image->slot;
	if (MEMORY_GROW(s->textures, f->room.textures, s->n_textures + 1))
		return SCENE_NONE;
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

/* @return 1 where the unit textures */
static int fill_unit(struct gls_exec *x, struct gls_frame *f, struct gls_state *st, const struct gls_unit *unit, struct scene_unit *out)
{
	unsigned u = unit->value.unit;
	int target = enabled_target(unit);
	struct gls_texture *t = target >= 0 ? gls_texture_bound(x, st, u, (unsigned)target) : NULL;
	const struct gls_texture_parameters *p = t ? &gls_texture_sampler(st, u, t)->parameters : NULL;
	struct gls_texture_image *image = t ? gls_texture_image_of(x, t, p->min_filter) : NULL;
	uint32_t missing;

	if (!image)
		return 0;
	missing = x->feedback.missing ? gls_texture_missing(t) : 0;
	if (missing && x->feedback.supply)
		x->feedback.rewind = 1;
	f->out->shows_earlier |= missing && missing <= x->frame;
	*out = unit->value;
	out->texture = texture_slot(x, f, image);
	if (out->texture == SCENE_NONE)
		return 0;
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
	for (unsigned i = 0; i < 4; i++)
		out->gen_mode[i] = unit->gen_enabled >> i & 1 ? unit->value.gen_mode[i] : 0;
	memcpy(out->matrix, st->texture[u].matrices[st->texture[u].depth], 64);
	return 1;
}

/* Numbers of the state are clamped for drawables that could hold no others (ARB_color_buffer_float). */
static float clamped(float value, uint32_t unclamped)
{
	return unclamped ? value : value < 0 ? 0 : value > 1 ? 1 : value;
}

static void put_color(float out[4], const float color[4], uint32_t unclamped)
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

static uint32_t fill_lights(struct gls_frame *f, const struct gls_lighting *l, uint32_t *count)
{
	struct scene *s = f->out;
	struct scene_light lights[GLS_MAX_LIGHTS];

	*count = 0;
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		if (l->lights[i].enabled)
			lights[(*count)++] = l->lights[i].value;
	return intern_run(&f->lights, &s->lights, &s->n_lights, &f->room.lights, lights, *count, sizeof(lights[0]));
}

static uint32_t fill_stipple(struct gls_frame *f, const struct gls_attribs *a)
{
	struct scene *s = f->out;

	if (!a->polygon.stipple)
		return SCENE_NONE;
	return intern(&f->stipples, &s->stipples, &s->n_stipples, &f->room.stipples, a->polygon_stipple,
	              sizeof(a->polygon_stipple));
}

static void fill_lighting(const struct gls_lighting *l, const float color[4], struct scene_material *m)
{
	memcpy(m->light_model_ambient, l->model_ambient, 16);
	m->local_viewer = l->local_viewer;
	m->two_side = l->two_side;
	m->separate_specular = l->separate_specular;
	m->front = l->face[0];
	m->back = l->face[1];
	if (l->color_material) {
		gls_track_color(l, 0, color, &m->front);
		gls_track_color(l, 1, color, &m->back);
	}
	m->color_material = l->color_material ? l->color_material_face : 0;
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
	put_color(m->blend_color, b->blend_color, d->floats);
	m->logic_op = b->logic_op_enabled && !d->floats ? b->logic_op : 0;
	m->color_mask = target->colored ? b->mask : 0;
	m->floats = d->floats;
	m->unclamped = unclamped_by(a, d);
}

static void fill_raster_state(const struct gls_attribs *a, struct scene_material *m)
{
	m->cull_face = a->polygon.cull ? a->polygon.cull_face : 0;
	m->front_face = a->polygon.front_face;
	m->polygon_mode_front = a->polygon.mode[0];
	m->polygon_mode_back = a->polygon.mode[1];
	m->polygon_offset = (a->polygon.offset_point ? 1u : 0) | (a->polygon.offset_line ? 2u : 0) |
	                    (a->polygon.offset_fill ? 4u : 0);
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
 * Multisampling (sec. 3.2.1) takes smoothing's place. Which samples a SAMPLE_COVERAGE of so much leaves is open; Mesa takes the first
 * ones (st_update_sample_state).
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

static uint32_t find_material(struct gls_exec *x, const struct gls_target *target, struct gls_state *st, const struct gls_event *e)
{
	struct gls_frame *f = target->surface->frame;
	struct scene *s = f->out;
	const struct gls_attribs *a = e->attribs;
	const uint32_t unclamped = unclamped_by(a, target->surface);
	struct scene_unit units[GLS_MAX_UNITS];
	struct scene_material m;

	memset(&m, 0, sizeof(m));
	m.lighting = a->lighting.enabled;
	fill_lighting(&a->lighting, e->values[GLS_ATTR_COLOR], &m);
	if (m.lighting)
		m.light_first = fill_lights(f, &a->lighting, &m.light_count);
	m.normalize = a->transform.normalize;
	m.rescale_normal = a->transform.rescale_normal;
	m.shade_model = a->lighting.shade_model;
	m.first_provokes = a->lighting.first_provokes;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		m.unit_count += (uint32_t)fill_unit(x, f, st, &a->texturing.units[u], &units[m.unit_count]);
	for (unsigned i = 0; i < m.unit_count; i++)
		put_color(units[i].env_color, units[i].env_color, unclamped & 1);
	m.unit_first = intern_run(&f->units, &s->units, &s->n_units, &f->room.units, units, m.unit_count, sizeof(units[0]));
	m.color_sum = a->fog.color_sum;
	m.fog = a->fog.enabled;
	m.fog_mode = a->fog.mode;
	m.fog_coord_source = a->fog.coord_source;
	m.fog_density = a->fog.density;
	m.fog_start = a->fog.start;
	m.fog_end = a->fog.end;
	put_color(m.fog_color, a->fog.color, unclamped & 1);
	fill_raster_state(a, &m);
	m.polygon_stipple = fill_stipple(f, a);
	fill_fragment_state(a, target, &m);
	fill_multisample(&a->multisample, target->surface, &m);
	m.surface = st->surface;
	m.program = st->program || st->arb_vertex_enabled || st->arb_fragment_enabled;
	return intern(&f->materials, &s->materials, &s->n_materials, &f->room.materials, &m, sizeof(m));
}

/* Attributes that the mesh gives, and those that nothing looks at, are set to GL's initial values: equal ones meet. */
static uint32_t find_current(struct gls_frame *f, const struct scene_mesh *mesh, const struct scene_material *m,
                             const float (*values)[4])
{
	struct scene *s = f->out;
	struct scene_current current;
	uint32_t given = mesh->attributes, textured = 0;

	memset(&current, 0, sizeof(current));
	for (uint32_t i = 0; i < m->unit_count; i++)
		textured |= 1u << s->units[m->unit_first + i].unit;
	for (unsigned i = 0; i < 4; i++) {
		current.color[i] = given & SCENE_HAS_COLOR ? 1 : values[GLS_ATTR_COLOR][i];
		current.secondary[i] = given & SCENE_HAS_SECONDARY ? i == 3 : values[GLS_ATTR_SECONDARY][i];
		current.normal[i] = i < 3 ? (given & SCENE_HAS_NORMAL ? i == 2 : values[GLS_ATTR_NORMAL][i]) : 0;
		for (unsigned u = 0; u < SCENE_MAX_UNITS; u++)
			current.texcoord[u][i] = given >> (GLS_ATTR_TEXCOORD + u) & 1 || !(textured >> u & 1)
			                             ? i == 3 : values[GLS_ATTR_TEXCOORD + u][i];
	}
	current.fog_coord = given & SCENE_HAS_FOG_COORD ? 0 : values[GLS_ATTR_FOG_COORD][0];
	return intern(&f->currents, &s->currents, &s->n_currents, &f->room.currents, &current, sizeof(current));
}

static uint32_t mesh_slot(struct gls_exec *x, struct gls_frame *f, struct gls_mesh *mesh)
{
	struct scene *s = f->out;

	mesh->used_frame = x->frame;
	if (mesh->slot_frame == f->serial)
		return mesh->slot;
	if (MEMORY_GROW(s->meshes, f->room.meshes, s->n_meshes + 1))
		return SCENE_NONE;
	atomic_fetch_add(&mesh->refs, 1);
	s->meshes[s->n_meshes] = &mesh->mesh;
	mesh->slot = s->n_meshes++;
	mesh->slot_frame = f->serial;
	return mesh->slot;
}

static int name_draws(const struct gls_exec *x, struct gls_frame *f, uint32_t command, uint64_t call_number, uint32_t n)
{
	struct scene *s = f->out;

	for (uint32_t i = 0; i < n; i++) {
		if (MEMORY_GROW(s->draws, f->room.draws, f->next_draw + 1))
			return ERR_SYSTEM;
		s->draws[f->next_draw++] = (struct scene_draw){ gls_commands[command].name, call_number, x->drawn_list };
	}
	return 0;
}

/* Buffers whose contents a draw of this material lets through or compares with; bits as in scene_clear. */
static uint32_t looks_at(const struct scene_material *m)
{
	return (m->color_mask ? 1u : 0) | (m->depth_test && m->depth_func != GL_ALWAYS ? 2u : 0) | (m->stencil_test ? 4u : 0);
}

static struct gls_frame *frame_of(struct gls_exec *x, struct gls_surface *surface);

/* 1 where a clear's scissor leaves nothing out. */
static int covers(const struct gls_surface *d, const struct scene_clear *clear)
{
	return !clear->scissor[0] && !clear->scissor[1] && (uint32_t)clear->scissor[2] >= d->width &&
	       (uint32_t)clear->scissor[3] >= d->height;
}

/* 1 where it leaves nothing of the depths that a surface held. */
static int clears_depth(const struct gls_surface *d, const struct scene_clear *clear)
{
	return covers(d, clear) && (!d->depth_bits || clear->buffers & 2);
}

/* 1 where it leaves nothing of the colours either. */
static int clears_all(const struct gls_surface *d, const struct scene_clear *clear)
{
	return clears_depth(d, clear) && clear->buffers & 1 && (clear->color_mask & 7) == 7 && (!d->alpha_bits || clear->color_mask & 8);
}

/* 1 where it leaves nothing of their stencil either. */
static int clears_stencil(const struct gls_surface *d, const struct scene_clear *clear)
{
	return !d->stencil_bits || (clear->buffers & 4 && (clear->stencil_mask & 255) == 255);
}

static int touches_stencil(const struct scene *s)
{
	for (uint32_t i = 0; i < s->n_instances; i++) {
		uint32_t rectangle = s->instances[i].rectangle;

		if (s->materials[s->instances[i].material].stencil_test ||
		    (rectangle && s->rectangles[rectangle - 1].kind == SCENE_STENCIL_PIXELS))
			return 1;
	}
	return 0;
}

static struct gls_frame *make_frame(struct gls_exec *x);
static void free_frame(struct gls_frame *f);

/*
 * Nothing shows any more of what was drawn: begin with an empty scene, so that it casts no shadows either. Draws keep their
 * numbers and names, and clears what they did to the stencil buffer.
 */
static void forget_drawn(struct gls_exec *x, struct gls_surface *d)
{
	struct gls_frame *old = d->frame, *f = make_frame(x);
	uint32_t first = old->out->n_clears;

	if (!f)
		return;
	/* Nothing looked at the stencil buffer in between: what counts is from the last clear of all of it on. */
	while (first > 0 && !(covers(d, &old->out->clears[--first]) && clears_stencil(d, &old->out->clears[first])))
		;
	for (uint32_t i = first; i < old->out->n_clears; i++) {
		struct scene_clear clear = old->out->clears[i];

		clear.before_instance = 0;
		clear.buffers &= 4;
		if (!clear.buffers)
			continue;
		if (MEMORY_GROW(f->out->clears, f->room.clears, f->out->n_clears + 1)) {
			gls_fail(x);
			break;
		}
		f->out->clears[f->out->n_clears++] = clear;
	}
	free(f->out->draws);
	f->out->draws = old->out->draws;
	f->room.draws = old->room.draws;
	old->out->draws = NULL;
	f->next_draw = old->next_draw;
	f->cleared = old->cleared;
	f->colored = old->colored;
	d->frame = f;
	free_frame(old);
}

/* Make a frame's last instance a rectangle. @return 0: out of memory */
static int add_rectangle(struct gls_exec *x, struct gls_frame *f, const struct gls_event *e)
{
	struct scene *s = f->out;
	struct scene_rectangle *r;

	if (MEMORY_GROW(s->rectangles, f->room.rectangles, s->n_rectangles + 1))
		return 0;
	r = &s->rectangles[s->n_rectangles];
	*r = *e->rectangle;
	r->texture = texture_slot(x, f, e->image);
	s->instances[s->n_instances].rectangle = ++s->n_rectangles;
	f->last = NULL;
	return 1;
}

int gls_frame_add(struct gls_exec *x, const struct gls_target *target, struct gls_state *st, const struct gls_event *e)
{
	const float (*values)[4] = e->values;
	struct gls_mesh *mesh = e->mesh;
	struct gls_frame *f = frame_of(x, target->surface);
	struct scene_instance *instance;
	struct scene *s;
	uint32_t first_draw;

	if (!f)
		return 0;
	s = f->out;
	first_draw = f->next_draw;
	if (name_draws(x, f, e->command, e->call_number, mesh->n_draws) ||
	    MEMORY_GROW(s->instances, f->room.instances, s->n_instances + 1))
		goto fail;
	if (f->last != st || st->dirty & GLS_DIRTY_VIEW)
		f->view = find_view(target->surface, st, e->attribs);
	if (f->last != st || st->dirty & GLS_DIRTY_MATERIAL || e->attribs->lighting.color_material)
		f->material = find_material(x, target, st, e);
	f->last = st;
	instance = &s->instances[s->n_instances];
	memset(instance, 0, sizeof(*instance));
	instance->mesh = mesh_slot(x, f, mesh);
	instance->view = f->view;
	instance->material = f->material;
	if (instance->mesh == SCENE_NONE || instance->view == SCENE_NONE || instance->material == SCENE_NONE)
		goto fail;
	instance->current = find_current(f, &mesh->mesh, &s->materials[f->material], values);
	if (instance->current == SCENE_NONE)
		goto fail;
	instance->draw = first_draw;
	instance->first_primitive = f->next_primitive;
	memcpy(instance->modelview, st->modelview.matrices[st->modelview.depth], 64);
	f->next_primitive += mesh->mesh.primitive_count;
	if (e->rectangle && !add_rectangle(x, f, e))
		goto fail;
	s->n_instances++;
	s->kd_tree |= st->kd_tree;
	s->needs_previous |= looks_at(&s->materials[f->material]) & ~f->cleared ? 1u : 0;
	f->colored |= target->colored != 0;
	return 1;
fail:
	f->last = NULL;
	gls_fail(x);
	return 0;
}

void gls_frame_pass(struct gls_surface *surface)
{
	if (surface->frame)
		surface->frame->last = NULL;
}

void gls_frame_clear(struct gls_exec *x, const struct gls_target *target, const struct gls_state *st, uint32_t buffers)
{
	struct gls_surface *d = target->surface;
	struct gls_frame *f;
	struct scene_clear clear;
	struct scene *s;
	int whole;

	memset(&clear, 0, sizeof(clear));
	clear.buffers = buffers;
	clear.color_mask = target->colored ? st->a.color.mask : 0;
	fill_scissor(d, &st->a.scissor, clear.scissor);
	put_color(clear.color, st->a.color.clear, d->floats);
	clear.floats = d->floats;
	if (!st->a.depth.write) /* masks count for Clear too (sec. 4.2.3) */
		clear.buffers &= ~2u;
	clear.depth = st->a.depth.clear;
	clear.stencil = st->a.stencil.clear;
	clear.stencil_mask = st->a.stencil.side[0].write_mask;
	if (d->frame && !target->colored && !d->frame->colored && clears_depth(d, &clear) && clears_stencil(d, &clear)) {
		gls_frame_drop(d); /* colours are still those that it began with */
	} else if (clears_all(d, &clear)) {
		if (st->draw_framebuffer && clears_stencil(d, &clear)) /* nobody looks at its draw numbers: they need not pile up */
			gls_frame_drop(d);
		else if (d->frame && d->frame->out->n_instances && (clears_stencil(d, &clear) || !touches_stencil(d->frame->out)))
			forget_drawn(x, d);
	}
	if (!(f = frame_of(x, d)))
		return;
	s = f->out;
	clear.before_instance = s->n_instances;
	clear.draw = f->next_draw;
	if (name_draws(x, f, x->command, x->call->number, 1) ||
	    MEMORY_GROW(s->clears, f->room.clears, s->n_clears + 1)) {
		gls_fail(x);
		return;
	}
	s->clears[s->n_clears++] = clear;
	f->colored |= clear.buffers & 1 && clear.color_mask;
	whole = (uint32_t)clear.scissor[2] >= d->width && (uint32_t)clear.scissor[3] >= d->height;
	if (whole && (clear.color_mask & 7) == 7)
		f->cleared |= clear.buffers & 1;
	if (whole)
		f->cleared |= clear.buffers & ((clear.stencil_mask & 255) == 255 ? 6u : 2u);
}

/* ---- a frame's beginning and end ---- */

static void free_frame(struct gls_frame *f)
{
	struct table *tables[] = { &f->materials, &f->units, &f->lights, &f->currents, &f->views, &f->stipples, &f->spaces };

	for (size_t i = 0; i < sizeof(tables) / sizeof(tables[0]); i++)
		table_free(tables[i]);
	scene_release(&f->out);
	gls_picture_release(f->snapshot);
	free(f);
}

static void release_reference(struct scene *s)
{
	if (atomic_fetch_sub(&((struct gls_scene *)s)->refs, 1) != 1)
		return;
	for (uint32_t i = 0; i < s->n_meshes; i++)
		gls_mesh_release((struct gls_mesh *)(uintptr_t)s->meshes[i]);
	for (uint32_t i = 0; i < s->n_textures; i++)
		gls_texture_image_release((struct gls_texture_image *)(uintptr_t)s->textures[i]);
	gls_picture_release((struct gls_picture *)(uintptr_t)s->start);
	free(s->instances);
	free(s->materials);
	free(s->units);
	free(s->lights);
	free(s->currents);
	free(s->views);
	free(s->clears);
	free(s->stipples);
	free(s->rectangles);
	free(s->meshes);
	free(s->textures);
	free(s->draws);
	free(s);
}

static struct gls_frame *make_frame(struct gls_exec *x)
{
	struct gls_frame *f = calloc(1, sizeof(*f));
	struct gls_scene *scene = calloc(1, sizeof(*scene));

	if (!f || !scene)
		goto fail;
	atomic_init(&scene->refs, 1);
	scene->scene.release = release_reference;
	f->out = &scene->scene;
	scene = NULL;
	f->next_draw = 1;
	f->serial = ++x->serial;
	if (MEMORY_GROW(f->out->draws, f->room.draws, 1u))
		goto fail;
	f->out->draws[0] = (struct scene_draw){ "", 0, 0 };
	return f;
fail:
	free(scene);
	if (f)
		free_frame(f);
	gls_out_of_memory(x, sizeof(*f));
	return NULL;
}

/* The events of a surface; NULL: out of memory. */
static struct gls_frame *frame_of(struct gls_exec *x, struct gls_surface *surface)
{
	if (!surface->frame)
		surface->frame = make_frame(x);
	return surface->frame;
}

/* What the scene so far is a scene of. */
static void describe(struct gls_exec *x, const struct gls_surface *surface, struct gls_frame *f)
{
	struct scene *s = f->out;

	s->frame = x->frame;
	s->serial = f->serial;
	s->n_primitives = f->next_primitive;
	s->n_draws = f->next_draw - 1;
	s->width = surface->width;
	s->height = surface->height;
	s->depth_bits = surface->depth_bits;
	s->stencil_bits = surface->stencil_bits;
	s->alpha_bits = surface->alpha_bits;
	s->samples = surface->samples;
	s->floats = surface->floats;
	s->samples_from_below = surface->samples_from_below;
	if (!(f->cleared & 1))
		s->needs_previous = 1;
}

struct scene *gls_frame_scene(struct gls_exec *x, struct gls_surface *surface)
{
	if (!frame_of(x, surface))
		return NULL;
	describe(x, surface, surface->frame);
	return surface->frame->out;
}

void gls_frame_all_known(struct gls_surface *surface)
{
	surface->frame->out->needs_previous = 0;
	surface->frame->cleared |= 1;
}

void gls_frame_renew(struct gls_exec *x, struct gls_surface *surface)
{
	surface->frame->serial = ++x->serial;
}

uint64_t gls_frame_events(const struct gls_surface *surface)
{
	const struct gls_frame *f = surface->frame;

	return f ? (uint64_t)f->out->n_instances + f->out->n_clears : 0;
}

struct gls_picture **gls_frame_snapshot(struct gls_surface *surface, uint64_t **events)
{
	*events = &surface->frame->snapshot_events;
	return &surface->frame->snapshot;
}

struct scene *gls_frame_take(struct gls_exec *x, struct gls_surface *surface)
{
	struct scene *s = gls_frame_scene(x, surface);

	if (!s)
		return NULL;
	surface->frame->out = NULL;
	gls_frame_drop(surface);
	return s;
}

void gls_frame_drop(struct gls_surface *surface)
{
	if (surface->frame)
		free_frame(surface->frame);
	surface->frame = NULL;
}

struct scene *gls_scene_reference(struct scene *s)
{
	atomic_fetch_add(&((struct gls_scene *)s)->refs, 1);
	return s;
}
