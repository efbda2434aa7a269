#include "look/between/mixed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "base/memory.h"
#include "look/between/pose.h"
#include "look/draws/matrix.h"
#include "scene/program.h"

#define STAYS 1e-4 /* tolerance for a light that moves like static things, relative to its distance */

/* Interpolate n numbers in place. Equal ones, and results that are not finite, stay the base's. */
static void mix(float *base, const float *other, size_t n, float share)
{
	for (size_t i = 0; i < n; i++) {
		const float mixed = base[i] + share * (other[i] - base[i]);

		if (base[i] != other[i] && isfinite(mixed))
			base[i] = mixed;
	}
}

/* The key of a pair in a table; never 0. */
static uint64_t pair_of(uint32_t base, uint32_t other)
{
	return ((uint64_t)base << 32 | other) + 1;
}

/* 1 if a pair is mixed already. @param number  receives its number */
static int is_known(const struct table *known, uint32_t base, uint32_t other, uint32_t *number)
{
	const uintptr_t found = (uintptr_t)table_find(known, pair_of(base, other));

	*number = (uint32_t)found - 1;
	return found != 0;
}

/* Remember the number of a mixed pair. @return it; SCENE_NONE: no memory (reported) */
static uint32_t note(struct table *known, uint32_t base, uint32_t other, uint32_t number)
{
	return table_set(known, pair_of(base, other), (void *)((uintptr_t)number + 1)) ? SCENE_NONE : number;
}

/* --- Programs ---------------------------------------------------------------------------------------------------- */

/* The words before a program's constants. */
static size_t code_words(const struct scene_program *p)
{
	return (sizeof(*p) + p->n_instructions * sizeof(struct scene_instruction) +
	        p->n_lights * sizeof(struct scene_program_light)) / sizeof(uint32_t);
}

/* Mix the constants of programs with the same code. @param base, other  as in materials */
static uint32_t mix_program(struct mixer *m, uint32_t base, uint32_t other)
{
	const struct scene_program *a = scene_program_of(m->base, base), *b = scene_program_of(m->other, other);
	const size_t words = a ? code_words(a) + a->n_constants : 0;
	uint32_t number, *to;

	if (!a || !b || a->n_instructions != b->n_instructions || a->n_lights != b->n_lights ||
	    memcmp(a, b, code_words(a) * sizeof(*to)) != 0 || memcmp(a, b, words * sizeof(*to)) == 0)
		return base;
	if (is_known(&m->programs, base, other, &number))
		return number;
	if (MEMORY_GROW(m->out->programs, m->room_programs, m->out->n_programs + words))
		return SCENE_NONE;
	to = m->out->programs + m->out->n_programs;
	memcpy(to, a, words * sizeof(*to));
	mix((float *)(to + code_words(a)), (const float *)((const uint32_t *)b + code_words(b)), a->n_constants, m->share);
	number = m->out->n_programs + 1;
	m->out->n_programs += (uint32_t)words;
	return note(&m->programs, base, other, number);
}

/* --- Materials --------------------------------------------------------------------------------------------------- */

/* Interpolate a light's position: along the camera's motion if the light moves like static things, else linearly. */
static void place_light(const struct mixer *m, struct scene_light *out, const struct scene_light *other)
{
	const struct scene_light *first = m->is_back ? other : out, *second = m->is_back ? out : other;
	double from[4], to[4], moved[4], off = 0, far = 0;

	for (int k = 0; k < 4; k++) {
		from[k] = (double)first->position_eye[k];
		to[k] = (double)second->position_eye[k];
	}
	mix(out->position_eye, other->position_eye, 4, m->share);
	if (!m->camera)
		return;
	matrix_transform(moved, m->camera, from);
	for (int k = 0; k < 4; k++) {
		off = fmax(off, fabs(moved[k] - to[k]));
		far = fmax(far, fabs(to[k]));
	}
	if (off > STAYS * far)
		return;
	matrix_transform(moved, m->camera_part, from);
	for (int k = 0; k < 4; k++)
		out->position_eye[k] = (float)moved[k];
}

/* Mix lights if the same ones are on in both. @return 0 or ERR_SYSTEM (reported) */
static int mix_lights(struct mixer *m, struct scene_material *out, const struct scene_material *other)
{
	struct scene *s = m->out;
	const uint32_t first = s->n_lights;

	if (out->light_count != other->light_count || !out->light_count)
		return 0;
	for (uint32_t i = 0; i < out->light_count; i++)
		if (s->lights[out->light_first + i].index != m->other->lights[other->light_first + i].index)
			return 0;
	if (MEMORY_GROW(s->lights, m->room_lights, first + out->light_count))
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < out->light_count; i++) {
		const struct scene_light *b = &m->other->lights[other->light_first + i];
		struct scene_light *a = &s->lights[first + i];

		*a = s->lights[out->light_first + i];
		place_light(m, a, b);
		mix(a->ambient, b->ambient, 12, m->share); /* diffuse and specular included */
		mix(a->spot_direction_eye, b->spot_direction_eye, 8, m->share); /* exponent, cutoff and attenuation
		                                                                   included */
	}
	out->light_first = first;
	s->n_lights += out->light_count;
	return 0;
}

/* @return 0 or ERR_SYSTEM (reported) */
static int mix_units(struct mixer *m, struct scene_material *out, const struct scene_material *other)
{
	struct scene *s = m->out;
	const uint32_t first = s->n_units;

	if (out->unit_count != other->unit_count || !out->unit_count)
		return 0;
	if (MEMORY_GROW(s->units, m->room_units, first + out->unit_count))
		return ERR_SYSTEM;
	for (uint32_t i = 0; i < out->unit_count; i++) {
		const struct scene_unit *b = &m->other->units[other->unit_first + i];
		struct scene_unit *a = &s->units[first + i];

		*a = s->units[out->unit_first + i];
		if (a->unit != b->unit)
			continue;
		mix(a->env_color, b->env_color, 4, m->share);
		mix(a->matrix, b->matrix, 16, m->share);
		if (memcmp(a->gen_mode, b->gen_mode, sizeof(a->gen_mode)) == 0) {
			mix(&a->gen_object_plane[0][0], &b->gen_object_plane[0][0], 16, m->share);
			mix(&a->gen_eye_plane[0][0], &b->gen_eye_plane[0][0], 16, m->share);
		}
	}
	out->unit_first = first;
	s->n_units += out->unit_count;
	return 0;
}

static void mix_numbers(struct scene_material *out, const struct scene_material *other, float share)
{
	const size_t face = sizeof(out->front) / sizeof(float);

	mix(out->light_model_ambient, other->light_model_ambient, 4, share);
	mix(out->front.ambient, other->front.ambient, face, share);
	mix(out->back.ambient, other->back.ambient, face, share);
	if (out->fog && other->fog && out->fog_mode == other->fog_mode)
		mix(&out->fog_density, &other->fog_density, 7, share); /* start, end and colour included */
	if (out->clip_plane_mask == other->clip_plane_mask)
		mix(out->clip_plane_eye[0], other->clip_plane_eye[0], sizeof(out->clip_plane_eye) / sizeof(float), share);
	mix(&out->line_width, &other->line_width, 1, share);
	mix(&out->point_size, &other->point_size, 1, share);
	mix(&out->alpha_ref, &other->alpha_ref, 1, share);
	mix(out->blend_color, other->blend_color, 4, share);
}

uint32_t mixed_material(struct mixer *m, uint32_t base, uint32_t other)
{
	struct scene_material out = m->base->materials[base];
	const struct scene_material *b = &m->other->materials[other];
	uint32_t number;

	if (is_known(&m->materials, base, other, &number))
		return number;
	mix_numbers(&out, b, m->share);
	out.fragment_program = mix_program(m, out.fragment_program, b->fragment_program);
	out.vertex_program = mix_program(m, out.vertex_program, b->vertex_program);
	if (out.fragment_program == SCENE_NONE || out.vertex_program == SCENE_NONE || mix_lights(m, &out, b) ||
	    mix_units(m, &out, b) || MEMORY_GROW(m->out->materials, m->room_materials, m->out->n_materials + 1))
		return SCENE_NONE;
	number = m->out->n_materials++;
	m->out->materials[number] = out;
	return note(&m->materials, base, other, number);
}

/* --- Currents, views, clears ------------------------------------------------------------------------------------- */

uint32_t mixed_current(struct mixer *m, uint32_t base, uint32_t other)
{
	const struct scene_current *b = &m->other->currents[other];
	uint32_t number;

	if (is_known(&m->currents, base, other, &number))
		return number;
	if (MEMORY_GROW(m->out->currents, m->room_currents, m->out->n_currents + 1))
		return SCENE_NONE;
	number = m->out->n_currents++;
	m->out->currents[number] = m->base->currents[base];
	mix(m->out->currents[number].color, b->color, sizeof(*b) / sizeof(float), m->share);
	return note(&m->currents, base, other, number);
}

/* Mix projections, which may contain a motion of the camera, and a zoom. */
static void mix_projection(const struct mixer *m, float out[16], const float first[16], const float second[16])
{
	double a[16], b[16], back[16], motion[16], part[16], mixed[16];

	matrix_from_floats(a, first);
	matrix_from_floats(b, second);
	if (!matrix_invert(back, a))
		return;
	matrix_mul(motion, back, b);
	if (!pose_part(part, motion, m->at))
		return;
	matrix_mul(mixed, a, part);
	for (int i = 0; i < 16; i++)
		out[i] = (float)mixed[i];
}

uint32_t mixed_view(struct mixer *m, uint32_t base, uint32_t other)
{
	const struct scene_view *a = &m->base->views[base], *b = &m->other->views[other];
	struct scene_view *out;
	uint32_t number;

	if (is_known(&m->views, base, other, &number))
		return number;
	if (MEMORY_GROW(m->out->views, m->room_views, m->out->n_views + 1))
		return SCENE_NONE;
	number = m->out->n_views++;
	out = &m->out->views[number];
	*out = *a;
	if (memcmp(a->projection, b->projection, sizeof(a->projection)) != 0) {
		mix(out->projection, b->projection, 16, m->share);
		mix_projection(m, out->projection, m->is_back ? b->projection : a->projection,
		               m->is_back ? a->projection : b->projection);
	}
	return note(&m->views, base, other, number);
}

void mixed_clears(struct mixer *m)
{
	struct scene *s = m->out;

	for (uint32_t i = 0; s->n_clears == m->other->n_clears && i < s->n_clears; i++)
		if (s->clears[i].buffers == m->other->clears[i].buffers)
			mix(s->clears[i].color, m->other->clears[i].color, 4, m->share);
}

/* --- Meshes ------------------------------------------------------------------------------------------------------ */

int mixed_same_points(const struct scene_mesh *a, const struct scene_mesh *b)
{
	return a == b || memcmp(a->hash, b->hash, sizeof(a->hash)) == 0 ||
	       (a->kind == b->kind && a->vertex_count == b->vertex_count &&
	        memcmp(a->position, b->position, a->vertex_count * 4 * sizeof(float)) == 0);
}

int mixed_suits(const struct scene_mesh *a, const struct scene_mesh *b)
{
	const size_t n = (size_t)a->vertex_count;

	if (a->kind != b->kind || a->attributes != b->attributes || a->vertex_count != b->vertex_count ||
	    a->primitive_count != b->primitive_count ||
	    memcmp(a->index, b->index, (size_t)a->primitive_count * a->kind * sizeof(*a->index)) != 0)
		return 0;
	for (int u = 0; u < SCENE_MAX_UNITS; u++)
		if (a->texcoord[u] && memcmp(a->texcoord[u], b->texcoord[u], n * 4 * sizeof(float)) != 0)
			return 0;
	return 1;
}

/* Memory with the scene's lifetime; NULL (reported) */
static void *keep(struct mixer *m, size_t bytes)
{
	void *kept;

	if (MEMORY_GROW(m->owned, m->room_owned, m->n_owned + 1))
		return NULL;
	kept = malloc(bytes + 1);
	if (!kept)
		err_report(ERR_SYSTEM, NULL, "out of memory");
	else
		m->owned[m->n_owned++] = kept;
	return kept;
}

/* Mix an attribute, n numbers. @return 0 or ERR_SYSTEM (reported) */
static int mix_attribute(struct mixer *m, const float **out, const float *other, size_t n)
{
	const float *base = *out;
	float *mixed;

	if (!base || !other || memcmp(base, other, n * sizeof(*base)) == 0)
		return 0;
	mixed = keep(m, n * sizeof(*mixed));
	if (!mixed)
		return ERR_SYSTEM;
	memcpy(mixed, base, n * sizeof(*mixed));
	mix(mixed, other, n, m->share);
	*out = mixed;
	return 0;
}

/* Mix normals; their lengths are the mix of lengths, since lighting depends on them. */
static int mix_normals(struct mixer *m, const float **out, const float *other, size_t n)
{
	const float *base = *out;
	int err = mix_attribute(m, out, other, 3 * n);
	float *mixed = (float *)(uintptr_t)*out;

	for (size_t i = 0; !err && *out != base && i < 3 * n; i += 3) {
		const float now = hypotf(hypotf(mixed[i], mixed[i + 1]), mixed[i + 2]),
			    was = hypotf(hypotf(base[i], base[i + 1]), base[i + 2]),
			    then = hypotf(hypotf(other[i], other[i + 1]), other[i + 2]);

		for (size_t k = i; k < i + 3 && now > 0; k++)
			mixed[k] *= (was + m->share * (then - was)) / now;
	}
	return err;
}

static int mix_attributes(struct mixer *m, struct scene_mesh *out, const struct scene_mesh *other)
{
	const size_t n = out->vertex_count;
	int err = mix_attribute(m, &out->position, other->position, 4 * n);

	if (!err)
		err = mix_normals(m, &out->normal, other->normal, n);
	if (!err)
		err = mix_attribute(m, &out->color, other->color, 4 * n);
	if (!err)
		err = mix_attribute(m, &out->secondary, other->secondary, 4 * n);
	if (!err)
		err = mix_attribute(m, &out->fog_coord, other->fog_coord, n);
	for (int i = 0; i < SCENE_MAX_GENERICS && !err; i++)
		err = mix_attribute(m, &out->generics[i], other->generics[i], 4 * n);
	return err;
}

uint32_t mixed_mesh(struct mixer *m, uint32_t base, uint32_t other)
{
	const struct scene_mesh *a = m->base->meshes[base], *b = m->other->meshes[other];
	struct scene_mesh *out;
	XXH128_hash_t hash;
	uint64_t name[5] = { a->hash[0], a->hash[1], b->hash[0], b->hash[1] };
	uint32_t number;

	if (!mixed_suits(a, b) || memcmp(a->hash, b->hash, sizeof(a->hash)) == 0)
		return base;
	if (is_known(&m->meshes, base, other, &number))
		return number;
	out = keep(m, sizeof(*out));
	if (!out || MEMORY_GROW(m->out->meshes, m->room_meshes, m->out->n_meshes + 1))
		return SCENE_NONE;
	*out = *a;
	if (mix_attributes(m, out, b))
		return SCENE_NONE;
	memcpy(&name[4], &m->share, sizeof(m->share));
	hash = XXH3_128bits(name, sizeof(name));
	out->hash[0] = hash.low64;
	out->hash[1] = hash.high64;
	number = m->out->n_meshes++;
	m->out->meshes[number] = out;
	return note(&m->meshes, base, other, number);
}

void mixed_end(struct mixer *m)
{
	table_free(&m->materials);
	table_free(&m->currents);
	table_free(&m->views);
	table_free(&m->meshes);
	table_free(&m->programs);
}
