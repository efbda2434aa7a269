/* Replace the last event of a surface by the events of another one. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "replay/build/frame.h"
#include "replay/build/intern.h"
#include "replay/build/material.h"
#include "replay/build/mesh.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* A scene being appended to another: where its window goes, and the first index of each array. */
struct placed {
	struct gls_frame *into;
	const struct scene *from;
	const int32_t *rect; /* x, y, width, height */
	struct scene first;     /* its counts: the first index of each array */
	uint32_t spaces, draws, primitives;
	uint32_t *meshes, *textures; /* [from->n_meshes], [from->n_textures] */
};

/* @return 0 or ERR_SYSTEM (reported) */
#define APPEND(p, member) \
	gls_append(&(p)->into->out->member, &(p)->into->out->n_##member, &(p)->into->room.member, (p)->from->member, \
	           (p)->from->n_##member, sizeof(*(p)->from->member))

static int place_meshes_and_textures(struct gls_exec *x, struct placed *p)
{
	const struct scene *from = p->from;

	p->meshes = calloc((size_t)from->n_meshes + from->n_textures + 1, sizeof(*p->meshes));
	if (!p->meshes)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	p->textures = p->meshes + from->n_meshes;
	for (uint32_t i = 0; i < from->n_meshes; i++)
		p->meshes[i] = gls_frame_mesh(x, p->into, (struct gls_mesh *)(uintptr_t)from->meshes[i]);
	for (uint32_t i = 0; i < from->n_textures; i++)
		p->textures[i] =
			gls_frame_texture(x, p->into, (struct gls_texture_image *)(uintptr_t)from->textures[i]);
	return x->failed ? ERR_SYSTEM : 0;
}

static int place_materials(const struct placed *p)
{
	struct scene *s = p->into->out;
	const int err = APPEND(p, units) || APPEND(p, lights) || APPEND(p, stipples) || APPEND(p, programs) ||
	                APPEND(p, materials) || APPEND(p, currents);

	for (uint32_t i = p->first.n_units; i < s->n_units && !err; i++)
		s->units[i].texture = p->textures[s->units[i].texture];
	for (uint32_t i = p->first.n_materials; i < s->n_materials && !err; i++) {
		struct scene_material *m = &s->materials[i];

		m->unit_first += p->first.n_units;
		m->light_first += p->first.n_lights;
		m->polygon_stipple += m->polygon_stipple == SCENE_NONE ? 0 : p->first.n_stipples;
		m->fragment_program += m->fragment_program ? p->first.n_programs : 0;
		m->vertex_program += m->vertex_program ? p->first.n_programs : 0;
	}
	return err ? ERR_SYSTEM : 0;
}

/* Clip a scissor rectangle to its window, and move it to the window's place in the surface. */
static void move_scissor(const struct placed *p, int32_t scissor[4])
{
	for (int k = 0; k < 2; k++) {
		const int64_t first = scissor[k] > 0 ? scissor[k] : 0, end = (int64_t)scissor[k] + scissor[k + 2],
			      last = end < p->rect[k + 2] ? end : p->rect[k + 2];

		scissor[k] = (int32_t)first + p->rect[k];
		scissor[k + 2] = last > first ? (int32_t)(last - first) : 0;
	}
}

static int place_views(const struct placed *p)
{
	struct scene *s = p->into->out;
	const int err = APPEND(p, views);

	for (uint32_t i = p->first.n_views; i < s->n_views && !err; i++) {
		const uintptr_t space = s->views[i].space + p->spaces;

		s->views[i].viewport[0] += (float)p->rect[0];
		s->views[i].viewport[1] += (float)p->rect[1];
		move_scissor(p, s->views[i].scissor);
		s->views[i].space = (uint32_t)space;
		/* these keys are used nowhere else, so that no draw of the window finds them */
		if (table_set(&p->into->spaces, ((uint64_t)p->into->serial << 32) + space + 1, (void *)(space + 1)))
			return ERR_SYSTEM;
	}
	return err ? ERR_SYSTEM : 0;
}

static int place_draws(const struct placed *p)
{
	struct gls_frame *f = p->into;
	const uint32_t n = p->from->n_draws;

	if (MEMORY_GROW(f->out->draws, f->room.draws, f->next_draw + n))
		return ERR_SYSTEM;
	memcpy(f->out->draws + f->next_draw, p->from->draws + 1, n * sizeof(*f->out->draws));
	f->next_draw += n;
	return 0;
}

static int place_events(const struct placed *p)
{
	struct scene *s = p->into->out;

	if (APPEND(p, instances) || APPEND(p, clears) || APPEND(p, rectangles))
		return ERR_SYSTEM;
	for (uint32_t i = p->first.n_rectangles; i < s->n_rectangles; i++)
		s->rectangles[i].texture = p->textures[s->rectangles[i].texture];
	for (uint32_t i = p->first.n_instances; i < s->n_instances; i++) {
		struct scene_instance *in = &s->instances[i];

		in->mesh = p->meshes[in->mesh];
		in->material += p->first.n_materials;
		in->view += p->first.n_views;
		in->current += p->first.n_currents;
		in->draw += p->draws;
		in->first_primitive += p->primitives;
		in->rectangle += in->rectangle ? p->first.n_rectangles : 0;
	}
	for (uint32_t i = p->first.n_clears; i < s->n_clears; i++) {
		s->clears[i].before_instance += p->first.n_instances;
		s->clears[i].draw += p->draws;
		move_scissor(p, s->clears[i].scissor);
	}
	p->into->next_primitive += p->from->n_primitives;
	return 0;
}

/*
 * A clear of a rectangle's depth and stencil to the values that a surface's clears left there. If there were none, the
 * depth is 1, as cleared by earlier frames, or, if the context has never used depth, 0, as in Mesa's new windows
 * (22.3.6).
 */
static struct scene_clear cleared(const struct gls_exec *x, const struct scene *s, const int32_t rect[4])
{
	struct scene_clear out = { .scissor = { rect[0], rect[1], rect[2], rect[3] }, .buffers = 6, .stencil_mask = 255,
		                   .depth = x->st && !x->st->depth_used ? 0 : 1 };

	for (uint32_t i = 0; i < s->n_clears; i++) {
		const struct scene_clear *c = &s->clears[i];
		const int32_t *part = c->scissor;

		if (part[0] > rect[0] || part[1] > rect[1] || part[0] + part[2] < rect[0] + rect[2] ||
		    part[1] + part[3] < rect[1] + rect[3])
			continue;
		if (c->buffers & 2)
			out.depth = c->depth;
		if (c->buffers & 4)
			out.stencil = (out.stencil & ~c->stencil_mask) | (c->stencil & c->stencil_mask);
	}
	return out;
}

static int add_clear(struct gls_frame *f, struct scene_clear *clear, const struct scene_draw *name)
{
	struct scene *s = f->out;

	if (MEMORY_GROW(s->clears, f->room.clears, s->n_clears + 1) || MEMORY_GROW(s->draws, f->room.draws, f->next_draw + 1))
		return ERR_SYSTEM;
	clear->before_instance = s->n_instances;
	clear->draw = f->next_draw;
	s->clears[s->n_clears++] = *clear;
	s->draws[f->next_draw++] = *name;
	return 0;
}

int gls_frame_put(struct gls_exec *x, struct gls_surface *surface, const struct scene *drawn, const int32_t rect[4],
                  const float *depth)
{
	struct gls_frame *f = surface->frame;
	struct scene *s = f->out;
	const struct scene_draw name = s->draws[s->instances[s->n_instances - 1].draw];
	struct scene_clear before = cleared(x, s, rect), after = before;
	struct placed p = { .into = f, .from = drawn, .rect = rect };
	int err;

	/* initial depth and stencil values are those of a framebuffer object, not the window's */
	before.depth = 1;
	before.stencil = 0;
	if (depth)
		after.depth = *depth;
	f->next_primitive -= s->meshes[s->instances[--s->n_instances].mesh]->primitive_count;
	err = add_clear(f, &before, &name);
	p.first = *s;
	p.spaces = (uint32_t)f->spaces.n;
	p.draws = f->next_draw - 1;
	p.primitives = f->next_primitive;
	err = err || place_meshes_and_textures(x, &p) || place_materials(&p) || place_views(&p) || place_events(&p) ||
	      place_draws(&p) || add_clear(f, &after, &name);
	free(p.meshes);
	s->kd_tree |= drawn->kd_tree;
	s->shows_earlier |= drawn->shows_earlier;
	f->depth_bits = drawn->depth_bits;
	f->put_end = s->n_instances;
	f->last = NULL;
	f->colored = 1;
	gls_known_clear(&f->known, 1, (const uint32_t[2]){ surface->width, surface->height }, rect);
	return !err;
}
