/* Turns the events of a surface into a scene (scene/scene.h). */
#include "replay/build/frame.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "base/mat4.h"
#include "base/memory.h"
#include "capture/format/call.h"
#include "replay/build/currents.h"
#include "replay/build/material.h"
#include "replay/build/mesh.h"
#include "replay/gl/texture/image.h"
#include "replay/gl/texture/texformat.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/programs/program.h"
#include "scene/before.h"
#include "scene/release.h"

/* A scene with a reference count: the caller of replay_next_frame and surfaces hold references. */
struct gls_scene {
	struct scene scene; /* must be first */
	atomic_uint refs;
};

uint32_t gls_frame_mesh(struct gls_exec *x, struct gls_frame *f, struct gls_mesh *mesh)
{
	struct scene *s = f->out;

	mesh->used_frame = x->frame;
	if (mesh->slot_frame == f->serial)
		return mesh->slot;
	if (MEMORY_GROW(s->meshes, f->room.meshes, s->n_meshes + 1)) {
		gls_fail(x);
		return SCENE_NONE;
	}
	atomic_fetch_add(&mesh->refs, 1);
	s->meshes[s->n_meshes] = &mesh->mesh;
	mesh->slot = s->n_meshes++;
	mesh->slot_frame = f->serial;
	return mesh->slot;
}

/* st: its programs run the draws; NULL: not draws that programs run */
static int name_draws(const struct gls_exec *x, struct gls_frame *f, const struct gls_state *st, uint32_t command,
                      uint64_t call_number, uint32_t n)
{
	struct scene_draw named = { .call = gls_commands[command].name, .call_number = call_number, .list = x->drawn_list };
	struct scene *s = f->out;
	uint64_t keys[SCENE_DRAW_PROGRAMS];
	const unsigned n_keys = st ? gls_program_current(st, keys) : 0;

	for (unsigned i = 0; i < n_keys; i++)
		named.programs[i] = (struct scene_draw_program){ gls_program_kind(keys[i]), (uint32_t)keys[i] };
	for (uint32_t i = 0; i < n; i++) {
		if (MEMORY_GROW(s->draws, f->room.draws, f->next_draw + 1))
			return ERR_SYSTEM;
		s->draws[f->next_draw++] = named;
	}
	return 0;
}

/* The buffers that a draw with this material reads; bits as in scene_clear. */
static uint32_t looks_at(const struct scene_material *m)
{
	return (m->color_mask ? 1u : 0) | (m->depth_test && m->depth_func != GL_ALWAYS ? 2u : 0) | (m->stencil_test ? 4u : 0);
}

static struct gls_frame *frame_of(struct gls_exec *x, struct gls_surface *surface);

/* 1 if a clear covers the whole surface. */
static int covers(const struct gls_surface *d, const struct scene_clear *clear)
{
	return !clear->scissor[0] && !clear->scissor[1] && (uint32_t)clear->scissor[2] >= d->width &&
	       (uint32_t)clear->scissor[3] >= d->height;
}

/* 1 if a clear replaces all depths. */
static int clears_depth(const struct gls_surface *d, const struct scene_clear *clear)
{
	return covers(d, clear) && (!d->depth_bits || clear->buffers & 2);
}

/* 1 if a clear replaces all depths and colours. */
static int clears_all(const struct gls_surface *d, const struct scene_clear *clear)
{
	return clears_depth(d, clear) && clear->buffers & 1 && (clear->color_mask & 7) == 7 &&
	       (!d->alpha_bits || clear->color_mask & 8);
}

/* 1 if a clear replaces all stencil values. */
static int clears_stencil(const struct gls_surface *d, const struct scene_clear *clear)
{
	return !d->stencil_bits || (clear->buffers & 4 && (clear->stencil_mask & 255) == 255);
}

static int touches_stencil(const struct scene *s, const struct scene_instance *in)
{
	return s->materials[in->material].stencil_test ||
	       (in->rectangle && s->rectangles[in->rectangle - 1].kind == SCENE_STENCIL_PIXELS);
}

static int has_stencil(const struct scene *s)
{
	for (uint32_t i = 0; i < s->n_instances; i++)
		if (touches_stencil(s, &s->instances[i]))
			return 1;
	return 0;
}

static struct gls_frame *make_frame(struct gls_exec *x);
static void free_frame(struct gls_frame *f);

/*
 * Nothing drawn so far is visible any more. Start an empty scene, so that old draws cast no shadows. Draws keep their
 * numbers and names; clears keep their effect on the stencil buffer.
 */
static void forget_drawn(struct gls_exec *x, struct gls_surface *d)
{
	struct gls_frame *old = d->frame, *f = make_frame(x);
	uint32_t first = old->out->n_clears;

	if (!f)
		return;
	/* Nothing read the stencil buffer in between, so only events since its last complete clear matter. */
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
	f->known = old->known;
	f->colored = old->colored;
	d->frame = f;
	free_frame(old);
}

/* As forget_drawn, if the stencil buffer still has the effect of some draws: these are kept. */
static void forget_colors(struct gls_frame *f)
{
	struct scene *s = f->out;
	uint32_t kept = 0, clear = 0;

	f->next_primitive = 0;
	f->put_end = 0;
	f->last = NULL;
	for (uint32_t i = 0; i < s->n_instances; i++) {
		struct scene_instance *in = &s->instances[kept];

		for (; clear < s->n_clears && s->clears[clear].before_instance <= i; clear++)
			s->clears[clear].before_instance = kept;
		if (!touches_stencil(s, &s->instances[i]))
			continue;
		*in = s->instances[i];
		in->first_primitive = f->next_primitive;
		f->next_primitive += s->meshes[in->mesh]->primitive_count;
		kept++;
	}
	for (; clear < s->n_clears; clear++)
		s->clears[clear].before_instance = kept;
	s->n_instances = kept;
}

/* Turn a frame's last instance into a rectangle. */
static void add_rectangle(struct gls_exec *x, struct gls_frame *f, const struct gls_event *e)
{
	struct scene *s = f->out;
	struct scene_rectangle *r;

	if (MEMORY_GROW(s->rectangles, f->room.rectangles, s->n_rectangles + 1)) {
		gls_fail(x);
		return;
	}
	r = &s->rectangles[s->n_rectangles];
	*r = *e->rectangle;
	r->texture = gls_frame_texture(x, f, e->image);
	s->instances[s->n_instances].rectangle = ++s->n_rectangles;
	f->last = NULL;
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
	if (name_draws(x, f, st, e->command, e->call_number, mesh->n_draws) ||
	    MEMORY_GROW(s->instances, f->room.instances, s->n_instances + 1))
		goto fail;
	if (f->last != st || st->dirty & GLS_DIRTY_VIEW || f->is_programmed != gls_frame_is_programmed(st, e)) {
		f->view = gls_frame_view(x, target->surface, st, e);
		f->is_programmed = gls_frame_is_programmed(st, e);
	}
	if (f->last != st || st->dirty & GLS_DIRTY_MATERIAL || e->attribs->lighting.color_material ||
	    st->a.programs.fragment || st->a.programs.vertex || st->a.programs.ati || st->program)
		f->material = gls_frame_material(x, target, st, e);
	f->last = st;
	instance = &s->instances[s->n_instances];
	memset(instance, 0, sizeof(*instance));
	instance->mesh = gls_frame_mesh(x, f, mesh);
	instance->view = f->view;
	instance->material = f->material;
	if (x->failed)
		goto fail;
	instance->current = gls_frame_current(x, f, &mesh->mesh, &s->materials[f->material], values);
	instance->draw = first_draw;
	instance->given = e->given & (SCENE_HAS_COLOR | SCENE_HAS_SECONDARY);
	instance->first_primitive = f->next_primitive;
	memcpy(instance->modelview, e->in_window ? mat4_identity : st->modelview.matrices[st->modelview.depth], 64);
	f->next_primitive += mesh->mesh.primitive_count;
	if (e->rectangle)
		add_rectangle(x, f, e);
	if (x->failed)
		goto fail;
	s->n_instances++;
	s->kd_tree |= st->kd_tree;
	f->looked |= gls_known_lacks(&f->known, looks_at(&s->materials[f->material]), s->views[f->view].scissor);
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

	memset(&clear, 0, sizeof(clear));
	clear.buffers = buffers;
	clear.color_mask = target->colored ? st->a.color.mask : 0;
	gls_scissor_of(d, &st->a.scissor, clear.scissor);
	gls_color_of(clear.color, st->a.color.clear, d->floats);
	clear.floats = d->floats;
	if (d->srgb && st->a.color.framebuffer_srgb)
		gls_encode_color(clear.color);
	if (!st->a.depth.write) /* write masks apply to Clear as well (sec. 4.2.3) */
		clear.buffers &= ~2u;
	clear.depth = st->a.depth.clear;
	clear.stencil = st->a.stencil.clear;
	clear.stencil_mask = st->a.stencil.side[0].write_mask;
	if (d->frame && !target->colored && !d->frame->colored && clears_depth(d, &clear) && clears_stencil(d, &clear)) {
		gls_frame_drop(d); /* colours still have their initial values */
	} else if (clears_all(d, &clear)) {
		/* nobody reads a framebuffer object's draw numbers: they need not accumulate */
		if (st->draw_framebuffer && clears_stencil(d, &clear))
			gls_frame_drop(d);
		else if (d->frame && d->frame->out->n_instances && (clears_stencil(d, &clear) || !has_stencil(d->frame->out)))
			forget_drawn(x, d);
		else if (d->frame)
			forget_colors(d->frame);
	}
	if (!(f = frame_of(x, d)))
		return;
	s = f->out;
	clear.before_instance = s->n_instances;
	clear.draw = f->next_draw;
	if (name_draws(x, f, NULL, x->command, x->call->number, 1) ||
	    MEMORY_GROW(s->clears, f->room.clears, s->n_clears + 1)) {
		gls_fail(x);
		return;
	}
	s->clears[s->n_clears++] = clear;
	f->colored |= clear.buffers & 1 && clear.color_mask;
	gls_known_clear(&f->known,
	                clear.buffers & (((clear.color_mask & 7) == 7 ? 1u : 0) |
	                                 ((clear.stencil_mask & 255) == 255 ? 6u : 2u)),
	                (const uint32_t[2]){ d->width, d->height }, clear.scissor);
}

/* ---- beginning and end of a frame ---- */

static void free_frame(struct gls_frame *f)
{
	struct table *tables[] = { &f->materials, &f->units,    &f->lights,   &f->currents,
		                   &f->views,     &f->stipples, &f->programs, &f->spaces };

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
	scene_before_free(&s->before);
	free(s->instances);
	free(s->materials);
	free(s->units);
	free(s->lights);
	free(s->currents);
	free(s->views);
	free(s->clears);
	free(s->stipples);
	free(s->rectangles);
	free(s->programs);
	free(s->meshes);
	free(s->textures);
	free(s->draws);
	free(s);
}

/*
 * Serial numbers are unique across state machines: a replay that goes back uses another machine with the same supplier
 * (picture_recall).
 */
static uint64_t next_serial(void)
{
	static atomic_ullong last;

	return atomic_fetch_add(&last, 1) + 1;
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
	f->serial = next_serial();
	if (MEMORY_GROW(f->out->draws, f->room.draws, 1u))
		goto fail;
	f->out->draws[0] = (struct scene_draw){ .call = "" };
	return f;
fail:
	free(scene);
	if (f)
		free_frame(f);
	gls_out_of_memory(x, sizeof(*f));
	return NULL;
}

/* The frame of a surface; NULL: out of memory. */
static struct gls_frame *frame_of(struct gls_exec *x, struct gls_surface *surface)
{
	if (!surface->frame)
		surface->frame = make_frame(x);
	return surface->frame;
}

/* Fill in the frame, surface and counts of the scene so far. */
static void describe(struct gls_exec *x, const struct gls_surface *surface, struct gls_frame *f)
{
	struct scene *s = f->out;

	s->frame = x->frame;
	s->time_ns = x->time_ns;
	s->serial = f->serial;
	s->n_primitives = f->next_primitive;
	s->n_draws = f->next_draw - 1;
	s->width = surface->width;
	s->height = surface->height;
	s->depth_bits = surface->depth_bits ? surface->depth_bits : f->depth_bits;
	s->stencil_bits = surface->stencil_bits;
	s->alpha_bits = surface->alpha_bits;
	s->samples = surface->samples;
	s->floats = surface->floats;
	s->mesa = x->st ? x->st->mesa : 0;
	s->samples_from_below = surface->samples_from_below;
	s->needs_previous = f->looked || !(f->known.whole & 1);
	s->is_first = !surface->picture && !surface->before && !surface->skipped;
	s->keeps_depth = surface->depth_bits && x->st && x->st->depth_used && !(f->known.whole & 2);
}

struct scene *gls_frame_scene(struct gls_exec *x, struct gls_surface *surface)
{
	if (!frame_of(x, surface))
		return NULL;
	describe(x, surface, surface->frame);
	return surface->frame->out;
}

uint32_t gls_frame_looked(const struct gls_surface *surface)
{
	return surface->frame->looked;
}

void gls_frame_all_known(struct gls_surface *surface)
{
	surface->frame->out->needs_previous = 0;
	surface->frame->looked = 0;
	surface->frame->known.whole |= 1;
}

void gls_frame_renew(struct gls_surface *surface)
{
	surface->frame->serial = next_serial();
}

uint64_t gls_frame_events(const struct gls_surface *surface)
{
	const struct gls_frame *f = surface->frame;

	return f ? (uint64_t)f->out->n_instances + f->out->n_clears : 0;
}

const struct gls_picture *gls_frame_snapshot(const struct gls_surface *surface, const struct gls_area *area)
{
	const struct gls_frame *f = surface->frame;

	return f->snapshot && f->snapshot_events == gls_frame_events(surface) &&
	                       (!f->snapshot_in_part || gls_frame_knows(surface, area)) ?
	               f->snapshot :
	               NULL;
}

void gls_frame_keep_snapshot(struct gls_surface *surface, struct gls_picture *p, int in_part)
{
	struct gls_frame *f = surface->frame;

	gls_picture_release(f->snapshot);
	f->snapshot = p;
	f->snapshot_events = gls_frame_events(surface);
	f->snapshot_in_part = in_part;
}

/* Tests of draws may have read anywhere; colours matter only where they are read. */
int gls_frame_knows(const struct gls_surface *surface, const struct gls_area *area)
{
	const struct gls_frame *f = surface->frame;

	return area && !(f->looked & 6) && !gls_known_lacks(&f->known, area->buffers, area->rect);
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
