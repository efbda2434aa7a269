#include "look/study/light/lightmaps.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "gl_tokens.h"
#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/draws/modelview.h"

enum { MOST_TEXELS = 400000, MOST_TRIANGLES = 500000 };

int lightmaps_is_pass(const struct scene_material *m)
{
	return drawn_multiplies(m) && !m->depth_write && m->depth_test && m->unit_count == 1 && !m->lighting;
}

/* The unit whose texture is light; NULL: none. */
static const struct scene_unit *light_unit(const struct scene *s, const struct scene_material *m)
{
	const struct scene_unit *unit = m->unit_count ? &s->units[m->unit_first + m->unit_count - 1] : NULL;

	if (!unit || m->lighting || unit->env_mode != GL_MODULATE || unit->gen_mode[0] || s->textures[unit->texture]->floats ||
	    s->textures[unit->texture]->target != GL_TEXTURE_2D || s->textures[unit->texture]->border)
		return NULL;
	return (m->unit_count == 2 && !m->blend && m->depth_write) || lightmaps_is_pass(m) ? unit : NULL;
}

/* A corner of a wall: texture coordinates in texels, and its position in the world. */
struct corner {
	double s, t, at[3];
};

static void corner_of(const struct scene_mesh *mesh, const struct scene_unit *unit, const struct scene_texture *texture,
                      const double world[16], uint32_t vertex, struct corner *out)
{
	const float *c = mesh->texcoord[unit->unit] + 4 * vertex, *p = mesh->position + 4 * vertex, *m = unit->matrix;

	out->s = (double)(m[0] * c[0] + m[4] * c[1] + m[8] * c[2] + m[12] * c[3]) * texture->width;
	out->t = (double)(m[1] * c[0] + m[5] * c[1] + m[9] * c[2] + m[13] * c[3]) * texture->height;
	matrix_point(out->at, world, (double[3]){ (double)p[0], (double)p[1], (double)p[2] });
}

/* Twice the signed area of a triangle in the texture. */
static double area(const struct corner *a, const struct corner *b, double s, double t)
{
	return (b->s - a->s) * (t - a->t) - (b->t - a->t) * (s - a->s);
}

/* Add the texels whose centres are in a triangle. */
static int put_texels(struct lightmaps *l, const struct scene_texture *texture, const struct corner c[3],
                      const double normal[3], unsigned wall)
{
	double whole = area(&c[0], &c[1], c[2].s, c[2].t);
	int s0 = (int)floor(fmin(c[0].s, fmin(c[1].s, c[2].s))), s1 = (int)ceil(fmax(c[0].s, fmax(c[1].s, c[2].s)));
	int t0 = (int)floor(fmin(c[0].t, fmin(c[1].t, c[2].t))), t1 = (int)ceil(fmax(c[0].t, fmax(c[1].t, c[2].t)));

	if (s0 < -1 || t0 < -1 || s1 > (int)texture->width + 1 || t1 > (int)texture->height + 1 || whole == 0)
		return 0; /* repeated, and so no lightmap */
	for (int t = t0 < 0 ? 0 : t0; t < t1 && t < (int)texture->height; t++)
		for (int s = s0 < 0 ? 0 : s0; s < s1 && s < (int)texture->width; s++) {
			double w0 = area(&c[1], &c[2], s + 0.5, t + 0.5) / whole,
			       w1 = area(&c[2], &c[0], s + 0.5, t + 0.5) / whole, w2 = 1 - w0 - w1;
			const uint8_t *texel = texture->texels + 4 * ((size_t)t * texture->width + (size_t)s);

			if (w0 < 0 || w1 < 0 || w2 < 0 || l->n >= MOST_TEXELS)
				continue;
			if (MEMORY_GROW(l->texels, l->room, l->n + 1))
				return ERR_SYSTEM;
			for (int k = 0; k < 3; k++) {
				l->texels[l->n].at[k] = w0 * c[0].at[k] + w1 * c[1].at[k] + w2 * c[2].at[k];
				l->texels[l->n].normal[k] = normal[k];
				l->texels[l->n].light[k] = texel[k] / 255.0;
			}
			l->texels[l->n++].wall = wall;
		}
	return 0;
}

/* Add a wall with its light. */
static int put_wall(struct lightmaps *l, const struct scene *s, const struct scene_instance *in,
                    const struct scene_unit *unit, const double world[16])
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const struct scene_texture *texture = s->textures[unit->texture];
	const double side = (s->materials[in->material].front_face == GL_CW ? -1 : 1); /* the front */
	int err = 0;

	for (uint32_t i = 0; i < mesh->primitive_count && !err; i++) {
		struct corner c[3];
		double n[3], length;

		for (int k = 0; k < 3; k++)
			corner_of(mesh, unit, texture, world, mesh->index[3 * i + (uint32_t)k], &c[k]);
		for (int k = 0; k < 3; k++) {
			int a = (k + 1) % 3, b = (k + 2) % 3;

			n[k] = side * ((c[1].at[a] - c[0].at[a]) * (c[2].at[b] - c[0].at[b]) -
			               (c[1].at[b] - c[0].at[b]) * (c[2].at[a] - c[0].at[a]));
		}
		length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
		for (int k = 0; k < 3; k++)
			n[k] /= length > 0 ? length : 1;
		if (length > 0)
			err = put_texels(l, texture, c, n, l->n_units + l->n_passes);
	}
	return err;
}

int lightmaps_put_occluder(struct lightmaps *l, const struct scene_mesh *mesh, const double world[16])
{
	int err = 0;

	for (uint32_t i = 0; i < mesh->primitive_count && !err && l->walls.n < MOST_TRIANGLES; i++) {
		double corners[9];

		for (int k = 0; k < 3; k++) {
			const float *p = mesh->position + 4 * mesh->index[3 * i + (uint32_t)k];

			matrix_point(corners + 3 * k, world, (double[3]){ (double)p[0], (double)p[1], (double)p[2] });
		}
		err = occluders_put(&l->walls, corners);
	}
	return err;
}

int lightmaps_walk(struct lightmaps *l, const struct scene *s, const struct motion *motion,
                   const struct lightmaps_kind *kind)
{
	int err = 0;

	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		const struct motion_thing *t = motion->of_instance[i] == SCENE_NONE ? NULL : &motion->things[motion->of_instance[i]];
		const uint64_t key = t && (!t->again || t->still == t->again) ? kind->key_of(s, &s->instances[i], t) : 0;

		if (!key || table_find(&l->seen, key))
			continue;
		err = table_set(&l->seen, key, (void *)(uintptr_t)1);
		if (!err)
			err = kind->put(l, s, &s->instances[i], t);
	}
	return err;
}

static uint64_t key_of(const struct scene *s, const struct scene_instance *in, const struct motion_thing *t)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_unit *unit = light_unit(s, m);
	const uint64_t hash = s->meshes[in->mesh]->hash[0];

	if (modelview_kind_of(in->modelview) != MODELVIEW_PLAIN || m->stencil_test)
		return 0;
	if (unit)
		return hash ^ s->textures[unit->texture]->hash[0] * 0x9e3779b97f4a7c15u;
	return m->blend || m->lighting || !t->votes || m->alpha_test ? 0 : hash;
}

static int put_draw(struct lightmaps *l, const struct scene *s, const struct scene_instance *in,
                    const struct motion_thing *t)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const struct scene_unit *unit = light_unit(s, m);
	int err = 0;

	if (unit && mesh->texcoord[unit->unit]) {
		err = put_wall(l, s, in, unit, t->world);
		*(m->unit_count == 2 ? &l->n_units : &l->n_passes) += 1;
		l->unit = m->unit_count == 2 ? unit->unit : l->unit;
	}
	return err || lightmaps_is_pass(m) ? err : lightmaps_put_occluder(l, mesh, t->world);
}

int lightmaps_add(struct lightmaps *l, const struct scene *s, const struct motion *motion)
{
	static const struct lightmaps_kind kind = { key_of, put_draw };

	return lightmaps_walk(l, s, motion, &kind);
}

void lightmaps_free(struct lightmaps *l)
{
	free(l->texels);
	occluders_free(&l->walls);
	table_free(&l->seen);
	*l = (struct lightmaps){ .n = 0 };
}
