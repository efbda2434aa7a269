/*
 * Fragment programs (ARB_fragment_program); instructions.h runs them. Each runs for the four pixels of llvmpipe's quad
 * at once, the fragment and three neighbours, because textures choose their levels by how coordinates change across the
 * quad, however those were computed.
 */
#pragma once

#include "kernels/gl/instructions.h"
#include "kernels/gl/stages.h"
#include "kernels/gl/vertex_program.h"

/* A fragment with a running program. The four are the quad's pixels: x y in the upper row, z w in the lower one. */
struct program_fragment {
	const struct shade_arguments *a;
	struct point p;
	struct point_window window;
	uint32_t own;            /* index of the fragment's own pixel in the quad */
	const struct lit *again; /* as for point_lit_by_planes */
	struct program_run run;
};

static inline uint32_t program_computes(const struct program_fragment *f, uint32_t k)
{
	return f->run.lanes >> k & 1u;
}

/* --- Inputs ------------------------------------------------------------------------------------------------------ */

/* The point of the triangle's plane at pixel `k` of the quad. */
static inline struct point program_neighbour(const struct program_fragment *f, const struct point_quad *quad,
                                             uint32_t k)
{
	struct point p = f->p;

	if (k != f->own)
		point_weights_at(&p, f->window.view, quad->x + (float)(k & 1u), quad->y + (float)(k >> 1u),
		                 f->window.height, p.weight);
	return p;
}

static inline void program_set_by_planes(struct program_fragment *f, uint32_t input, const struct point_planes *planes,
                                         const struct point_quad *quad)
{
	for (uint32_t k = 0u; k < 4u; k++)
		if (program_computes(f, k))
			program_set(&f->run, 4u * input, k,
			            point_planes_at(planes, quad->x + (float)(k & 1u) + quad->middle,
			                            quad->y + (float)(k >> 1u) + quad->middle));
}

/* Texture coordinates of the material's unit i. */
static inline void program_texcoord(struct program_fragment *f, uint32_t unit, uint32_t i,
                                    const struct point_quad *quad)
{
	const struct tables *t = &f->a->tables;
	struct point_planes planes;

	if (!f->window.setup) {
		for (uint32_t k = 0u; k < 4u; k++) {
			const struct point p = program_neighbour(f, quad, k);

			if (program_computes(f, k))
				program_set(&f->run, 4u * (SCENE_INPUT_TEXCOORD + unit), k, point_texcoord(t, &p, i, p.weight));
		}
		return;
	}
	point_texcoord_planes(t, &f->p, i, f->window.setup, &planes);
	program_set_by_planes(f, SCENE_INPUT_TEXCOORD + unit, &planes, quad);
}

static inline void program_texcoords(struct program_fragment *f, uint32_t inputs, const struct point_quad *quad)
{
	for (uint32_t unit = 0u; unit < SCENE_MAX_UNITS; unit++) {
		const uint32_t i = inputs >> (SCENE_INPUT_TEXCOORD + unit) & 1u ?
		                           program_unit(&f->a->tables, f->p.material, unit) :
		                           SCENE_NONE;

		if (i != SCENE_NONE)
			program_texcoord(f, unit, i, quad);
	}
}

static inline void program_position(struct program_fragment *f, const struct point_quad *quad, float depth)
{
	for (uint32_t k = 0u; k < 4u; k++) {
		const struct point p = program_neighbour(f, quad, k);
		const float w = p.vertex[0]->clip[3] * p.weight[0] + p.vertex[1]->clip[3] * p.weight[1] +
		                p.vertex[2]->clip[3] * p.weight[2];

		program_set(&f->run, 4u * SCENE_INPUT_POSITION, k,
		            v4(quad->x + (float)(k & 1u) + 0.5f,
		               (float)f->window.height - (quad->y + (float)(k >> 1u)) - 0.5f, depth, 1.0f / w));
	}
}

/* Colours of slivers and of pixels: interpolated by the fragment's weights. */
static inline void program_colors_by_weights(struct program_fragment *f, const struct lit *lit,
                                             const struct point_quad *quad)
{
	for (uint32_t k = 0u; k < 4u; k++) {
		const struct point p = program_neighbour(f, quad, k);
		struct lit here;

		if (!program_computes(f, k))
			continue;
		here = k == f->own ? *lit : point_lit_from_vertices(&p);
		program_set(&f->run, 4u * SCENE_INPUT_COLOR, k, here.color);
		program_set(&f->run, 4u * SCENE_INPUT_SECONDARY, k, here.secondary);
		program_set(&f->run, 4u * SCENE_INPUT_FOG, k,
		            v4(p.vertex[0]->fog_coord * p.weight[0] + p.vertex[1]->fog_coord * p.weight[1] +
		                       p.vertex[2]->fog_coord * p.weight[2],
		               0.0f, 0.0f, 1.0f));
	}
}

/* Colours matching llvmpipe's last bits, as depth may depend on them. Under flat shading (sec. 2.14.7), the last
 * vertex's colours unchanged. */
static inline void program_colors_by_planes(struct program_fragment *f, uint32_t inputs, const struct point_quad *quad)
{
	const int side = point_side(&f->p);

	for (uint32_t input = SCENE_INPUT_COLOR; input <= SCENE_INPUT_FOG; input++) {
		struct vec4 pool[3 + CLIP_MAX_CUTS];
		struct point_planes planes;

		if (!(inputs >> input & 1u))
			continue;
		for (uint32_t k = 0u; k < 3u; k++) {
			GLOBAL const struct shaded_vertex *v = f->p.vertex[k];

			if (input == SCENE_INPUT_FOG)
				pool[k] = v4(v->fog_coord, 0.0f, 0.0f, 0.0f);
			else if (f->again)
				pool[k] = input == SCENE_INPUT_COLOR ? f->again[k].color : f->again[k].secondary;
			else
				pool[k] = v4_load(input == SCENE_INPUT_COLOR ? v->color[side] : v->secondary[side]);
		}
		if (input != SCENE_INPUT_FOG && f->p.material->shade_model == GL_FLAT) {
			for (uint32_t k = 0u; k < 4u; k++)
				program_set(&f->run, 4u * input, k, pool[2]);
			continue;
		}
		point_planes_between(pool, f->window.setup, &planes);
		program_set_by_planes(f, input, &planes, quad);
	}
	f->run.registers[4u * SCENE_INPUT_FOG + 3u] = program_splat(1.0f);
}

/* lit: the fragment's own colours */
static inline void program_inputs(struct program_fragment *f, uint32_t inputs, const struct lit *lit, float depth)
{
	struct point_quad quad;

	quad.x = (float)(f->window.x & ~1u);
	quad.y = (float)((f->window.height - 1u - f->window.row) & ~1u);
	quad.middle = 0.5f - clip_origin(f->window.view);
	program_texcoords(f, inputs, &quad);
	if (inputs >> SCENE_INPUT_POSITION & 1u)
		program_position(f, &quad, depth);
	f->run.registers[4u * SCENE_INPUT_FACE] = program_splat(f->p.front ? 1.0f : 0.0f);
	if (!(inputs & (1u << SCENE_INPUT_COLOR | 1u << SCENE_INPUT_SECONDARY | 1u << SCENE_INPUT_FOG)))
		return;
	if (f->window.setup && !(f->p.geometry->flags & GEOMETRY_PIXELS))
		program_colors_by_planes(f, inputs, &quad);
	else
		program_colors_by_weights(f, lit, &quad);
	if (f->p.material->lighting)
		f->run.registers[4u * SCENE_INPUT_SECONDARY + 3u] = program_splat(1.0f); /* as Mesa's fixed function sets it */
}

/* --- Fragments --------------------------------------------------------------------------------------------------- */

/* point_light_corners for vertices lit by a vertex program. run: storage */
static inline void program_light_corners(const struct shade_arguments *s, const struct point *p,
                                         const struct vec3 *seen, struct program_run *run, struct lit *lit)
{
	const struct program program = program_at(s->programs + (p->material->vertex_program - 1u));
	const uint32_t back = (uint32_t)point_side(p);

	vertex_run(&s->tables, p->geometry, &program, p->number, 3u, seen, run);
	for (uint32_t k = 0u; k < 3u; k++) {
		lit[k].color = vertex_result_color(run, p->material, back ? SCENE_RESULT_BACK_COLOR : SCENE_RESULT_COLOR, k);
		lit[k].secondary = vertex_result_color(run, p->material,
		                                       back ? SCENE_RESULT_BACK_SECONDARY : SCENE_RESULT_SECONDARY, k);
		lit[k].lights = p->vertex[k]->lit[back];
	}
}

/* Find the triangle, weights and colours that `shade` left for a fragment. keeps, kept: as for shade_item. @return 0:
 * no program shades it */
static inline int program_find(const struct shade_arguments *s, uint32_t item, int keeps, struct setup_kept *kept,
                               struct program_fragment *f, struct vec3 *seen, struct lit *lit)
{
	GLOBAL const struct shaded *out = &s->shaded[item];
	const struct fragment from = s->fragments[item];
	GLOBAL const struct geometry *g = &s->tables.geometries[from.instance];
	GLOBAL const struct scene_material *m = &s->tables.materials[g->material];
	const int is_lit = stage_is_lit_by_program(s, m, g->flags);
	GLOBAL const uint32_t *group;
	uint32_t kind = 0u;

	if (!stage_is_by_program(s, m, g->flags) || !(out->flags & SHADED_THERE) || out->flags & SHADED_STENCIL ||
	    (s->n_slots && !stage_dimmed(s->visibility, s->n_slots, s->n, item)))
		return 0;
	f->window.x = s->pixels[item] % s->width;
	f->window.row = s->pixels[item] / s->width;
	setup_keep(s, f->window.x, f->window.row, &from, keeps, kept);
	f->a = s;
	f->p = kept->p;
	fragment_weights(from, kept->w_inv[0], kept->w_inv[1], kept->w_inv[2], f->p.weight);
	f->window.view = &s->views[f->p.geometry->view];
	f->window.setup = kept->have_setup ? &kept->setup : (const struct clip_setup *)0;
	f->window.kept = (struct point_kept *)0;
	f->window.height = s->height;
	f->own = (f->window.x & 1u) + 2u * ((s->height - 1u - f->window.row) & 1u);
	stage_seen(s->visibility, s->n_slots, s->n, item, seen);
	if (is_lit && !setup_keeps_seen(seen, keeps, kept))
		program_light_corners(s, &f->p, seen, &f->run, kept->lit);
	else if (!is_lit && s->n_slots)
		setup_keep_lit(&s->tables, seen, keeps, kept);
	f->again = is_lit || s->n_slots ? kept->lit : (const struct lit *)0;
	*lit = stage_lit(&f->p, f->again, &f->window);
	if (f->p.geometry->flags & GEOMETRY_PIXELS) {
		group = stage_pixel_group(&s->tables, &f->p, f->window.x, s->height - 1u - f->window.row, &kind);
		if (kind == SCENE_COLOR_PIXELS || kind == SCENE_FLOAT_PIXELS)
			lit->color = stage_texel_color(group, kind);
	}
	return 1;
}

/* The colour of a fragment from its program. @return 0: it is discarded */
static inline int program_shade(const struct shade_arguments *a, uint32_t item, const struct vec3 *seen,
                                const struct lit *lit, struct program_fragment *f, struct vec4 *color)
{
	const struct program program = program_at(a->programs + (f->p.material->fragment_program - 1u));

	program_begin(&f->run, &program, 1u << f->own, f->p.material->vertex_program ? seen : (const struct vec3 *)0);
	program_inputs(f, program.head->inputs, lit, a->fragments[item].depth);
	program_execute(&a->tables, f->p.material, &program, &f->run);
	program_note_ended(a->programs + (f->p.material->fragment_program - 1u), f->run.ended);
	*color = program_get(&f->run, program_color(&program, a->output), f->own);
	*color = f->p.material->unclamped & 1u ? *color : v4_clamp01(*color);
	if (program.head->sets_depth && !a->n_slots)
		a->shaded[item].depth = clamp01(program_of_four(f->run.registers[SCENE_PROGRAM_DEPTH], f->own));
	return (f->run.wanted & ~f->run.killed) != 0u;
}

/*
 * program: a fragment that `shade` has coloured by fixed function receives its program's colour and depth, or is
 * discarded. If lights of a vertex program are shadowed, the fragment is coloured again without them, whatever shades
 * it. keeps, kept: as for shade_item.
 */
static inline void program_item(const struct shade_arguments *a, uint32_t item, int keeps, struct setup_kept *kept)
{
	GLOBAL struct shaded *out = &a->shaded[item];
	struct vec3 seen[SCENE_MAX_LIGHTS];
	struct program_fragment f;
	struct texturing texturing;
	struct vec4 color;
	struct lit lit;

	if (!program_find(a, item, keeps, kept, &f, seen, &lit))
		return;
	if (!f.p.material->fragment_program) {
		point_texture(&a->tables, &f.p, &f.window, &texturing);
		color = point_finish(&a->tables, &f.p, &texturing, &lit);
	} else if (!program_shade(a, item, seen, &lit, &f, &color)) {
		out->flags = 0u;
		return;
	}
	color = v4(pixel_nudge(color.x), pixel_nudge(color.y), pixel_nudge(color.z), color.w);
	v3_store(out->shadowed, v3(color.x, color.y, color.z));
	if (!stage_is_path(a->transport) && !f.p.material->surface.relit)
		stage_store_direct(out, v3_add(v3(color.x, color.y, color.z), v3_load(f.p.material->surface.emission)));
	if (a->n_slots)
		return;
	color.w *= stage_coverage(&f.p);
	v4_store(out->gl, color);
}
