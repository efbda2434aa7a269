#include "look/study/light/baked.h"

#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/draws/modelview.h"
#include "look/draws/solid.h"

enum { MOST_VERTICES = 200000 };
/* Samples lie this far inside a vertex's triangles: beyond an edge another wall may begin. */
#define WITHIN 0.01
/* Triangles around a vertex are one surface if their normals are within 26 degrees. */
#define SAME_SURFACE 0.9
/* Colours of a mesh that differ by less are the same colour. */
#define VARIES 0.05f

/* 1 if a draw's colours may be light, either alone or times a texture. */
static int may_be_baked(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_unit *unit = m->unit_count ? &s->units[m->unit_first] : NULL;

	if (!solid_is(s, in) || m->lighting || m->blend || m->stencil_test || m->program || m->shade_model == GL_FLAT ||
	    m->unit_count > 1 || drawn_in_parallel(&s->views[in->view]) ||
	    modelview_kind_of(in->modelview) != MODELVIEW_PLAIN)
		return 0;
	return s->meshes[in->mesh]->color && (!unit || (unit->env_mode == GL_MODULATE && !unit->gen_mode[0]));
}

static int varies(const struct scene_mesh *mesh)
{
	for (int k = 0; k < 3; k++) {
		float low = 1, high = 0;

		for (uint32_t v = 0; v < mesh->vertex_count; v++) {
			low = fminf(low, mesh->color[4 * (size_t)v + (size_t)k]);
			high = fmaxf(high, mesh->color[4 * (size_t)v + (size_t)k]);
		}
		if (high - low > VARIES)
			return 1;
	}
	return 0;
}

/* Sums over the triangles around a vertex. */
struct corner {
	double normal[3], middle[3]; /* in the world, weighted by twice the triangles' areas */
	double area;
};

static void add_triangle(struct corner *corners, const uint32_t *index, double place[3][3], double side)
{
	double n[3], area;

	for (int k = 0; k < 3; k++) {
		const int a = (k + 1) % 3, b = (k + 2) % 3;

		n[k] = side * ((place[1][a] - place[0][a]) * (place[2][b] - place[0][b]) -
		               (place[1][b] - place[0][b]) * (place[2][a] - place[0][a]));
	}
	area = sqrt(matrix_dot3(n, n));
	for (int v = 0; v < 3; v++) {
		struct corner *c = &corners[index[v]];

		c->area += area;
		for (int k = 0; k < 3; k++) {
			c->normal[k] += n[k];
			c->middle[k] += area * (place[0][k] + place[1][k] + place[2][k]) / 3;
		}
	}
}

static int put_vertices(struct lightmaps *l, const struct scene_mesh *mesh, const struct corner *corners,
                        const double world[16])
{
	if (MEMORY_GROW(l->texels, l->room, l->n + mesh->vertex_count))
		return ERR_SYSTEM;
	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		const struct corner *c = &corners[v];
		const double length = sqrt(matrix_dot3(c->normal, c->normal));
		const float *p = mesh->position + 4 * (size_t)v;
		struct lightmap_texel *texel = &l->texels[l->n];
		double at[3];

		if (!(c->area > 0) || length < SAME_SURFACE * c->area)
			continue;
		matrix_point(at, world, (double[3]){ (double)p[0], (double)p[1], (double)p[2] });
		for (int k = 0; k < 3; k++) {
			texel->at[k] = at[k] + WITHIN * (c->middle[k] / c->area - at[k]);
			texel->normal[k] = c->normal[k] / length;
			texel->light[k] = fmin(1, fmax(0, (double)mesh->color[4 * (size_t)v + (size_t)k]));
		}
		texel->wall = l->n_colors;
		l->n++;
	}
	l->n_colors++;
	return 0;
}

static int put_mesh(struct lightmaps *l, const struct scene_mesh *mesh, const double world[16], double side)
{
	struct corner *corners = calloc(mesh->vertex_count + (size_t)1, sizeof(*corners));
	int err = 0;

	if (!corners)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < mesh->primitive_count; i++) {
		double place[3][3];

		for (int v = 0; v < 3; v++) {
			const float *p = mesh->position + 4 * (size_t)mesh->index[3 * (size_t)i + (size_t)v];

			matrix_point(place[v], world, (double[3]){ (double)p[0], (double)p[1], (double)p[2] });
		}
		add_triangle(corners, mesh->index + 3 * (size_t)i, place, side);
	}
	err = put_vertices(l, mesh, corners, world);
	free(corners);
	return err;
}

static uint64_t key_of(const struct scene *s, const struct scene_instance *in, const struct motion_thing *t)
{
	const struct scene_material *m = &s->materials[in->material];

	(void)t;
	return solid_is(s, in) && !m->blend && !m->alpha_test && !m->stencil_test ? s->meshes[in->mesh]->hash[0] : 0;
}

static int put_draw(struct lightmaps *l, const struct scene *s, const struct scene_instance *in,
                    const struct motion_thing *t)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	int err = 0;

	if (may_be_baked(s, in) && varies(mesh) && l->n + mesh->vertex_count <= MOST_VERTICES)
		err = put_mesh(l, mesh, t->world, s->materials[in->material].front_face == GL_CW ? -1 : 1);
	return err || !t->votes ? err : lightmaps_put_occluder(l, mesh, t->world);
}

int baked_add(struct lightmaps *l, const struct scene *s, const struct motion *motion)
{
	static const struct lightmaps_kind kind = { key_of, put_draw };

	return lightmaps_walk(l, s, motion, &kind);
}
