#include "look/study/roles/roles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/study/motion/face.h"

/* Tolerance of matrices, as a share of the size of the world. */
#define SAME 1e-4
/* Faces look at the viewer if they are within five degrees. */
#define FACING 0.996
/* A texture belongs to particles if this share of its draws face the viewer. */
#define FACING_SHARE 0.95

static int is_same(const double a[16], const double b[16])
{
	for (int i = 0; i < 16; i++)
		if (!(fabs(a[i] - b[i]) <= SAME * (1 + fabs(a[i]))))
			return 0;
	return 1;
}

/* The inverse of a camera's rotation. */
static void turn_back(const double camera[16], double out[16])
{
	memset(out, 0, 16 * sizeof(*out));
	for (int c = 0; c < 3; c++)
		for (int r = 0; r < 3; r++)
			out[4 * c + r] = camera[4 * r + c];
	out[15] = 1;
}

/* --- Sky --------------------------------------------------------------------------------------------------------- */

/* @param walked  the viewer has moved since the last frame */
static void note_thing(struct roles *r, const struct motion *m, uint32_t i, const double eye[16], const double back[16],
                       int walked)
{
	struct role_thing *t = &r->things[i];
	double turned[16];

	matrix_mul(turned, back, eye);
	if (walked && m->things[i].frames > 1) {
		t->came_along += (uint32_t)is_same(t->turned, turned);
		t->stayed += (uint32_t)!is_same(t->turned, turned);
	}
	memcpy(t->turned, turned, sizeof(turned));
}

/* The distance of a thing's middle, in sizes of the thing. */
static double distance_in_sizes(const struct motion_thing *t)
{
	double at[3];

	matrix_point(at, t->eye, t->middle);
	return sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]) / (t->size * matrix_scale(t->eye));
}

/* A thing that turns about a point resembles a sky, but a sky, or a side of its box, surrounds the viewer. */
static int is_sky(const struct roles *r, const struct motion *m, size_t i)
{
	return !r->things[i].is_flat && r->things[i].came_along >= 2 && !r->things[i].stayed &&
	       2 * m->things[i].carried < m->things[i].again && distance_in_sizes(&m->things[i]) < 0.5 &&
	       !kinds_has_sky(&r->kinds, m->things[i].mesh);
}

/* A thing that stays put while everything else turns seems to be held, but a held thing is near, and small compared
 * to the world. */
static int is_held(const struct roles *r, const struct motion *m, size_t i)
{
	const struct motion_thing *t = &m->things[i];
	double largest = 0;

	if (r->things[i].is_flat || t->carried < 2 || t->still || !(distance_in_sizes(t) < 2))
		return 0;
	for (size_t k = 0; k < m->n_things; k++)
		largest = fmax(largest, m->things[k].size * matrix_scale(m->things[k].eye));
	return t->size * matrix_scale(t->eye) < 0.25 * largest;
}

/* --- Particles --------------------------------------------------------------------------------------------------- */

/* 1 if every face looks at the viewer, or straight back along the view. */
static int faces_viewer(const struct scene_mesh *mesh, const double eye[16])
{
	for (uint32_t p = 0; p < mesh->primitive_count; p++) {
		struct face face;

		if (face_of(mesh, eye, p, &face) && fabs(face.normal[2]) < FACING &&
		    fabs(matrix_dot3(face.normal, face.corner[0])) < FACING * sqrt(matrix_dot3(face.corner[0], face.corner[0])))
			return 0;
	}
	return 1;
}

static void note_texture(struct roles *r, const struct scene *s, const struct scene_instance *in, const double eye[16],
                         uint64_t frame)
{
	const struct scene_material *m = &s->materials[in->material];
	const uint64_t *hash = m->unit_count ? s->textures[s->units[m->unit_first].texture]->hash : NULL;
	unsigned i = 0;

	if (!hash || !m->blend || s->views[in->view].projection[11] == 0)
		return;
	while (i < r->n_textures && memcmp(r->textures[i].hash, hash, sizeof(r->textures[i].hash)) != 0)
		i++;
	if (i == ROLES_MOST)
		return;
	if (i == r->n_textures) {
		r->textures[i] = (struct role_texture){ .hash = { hash[0], hash[1] } };
		r->n_textures++;
	}
	if (s->meshes[in->mesh]->kind == SCENE_POINTS)
		r->textures[i].points++;
	if (s->meshes[in->mesh]->kind == SCENE_POINTS || faces_viewer(s->meshes[in->mesh], eye))
		r->textures[i].facing++;
	else
		r->textures[i].others++;
	r->textures[i].frames += r->textures[i].last != frame;
	r->textures[i].last = frame;
}

static int is_particle(const struct roles *r, const struct role_texture *t)
{
	return (r->turns || t->points == t->facing) && t->frames >= 2 && t->facing >= FACING_SHARE * (t->facing + t->others);
}

/* --- HUD --------------------------------------------------------------------------------------------------------- */

/* Count the draws in parallel projection, in frames that show a world in perspective with depth written and tested. */
static void note_hud(struct roles *r, const struct scene *s)
{
	unsigned parallel = 0, deep = 0;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_material *m = &s->materials[s->instances[i].material];
		const struct scene_view *view = &s->views[s->instances[i].view];
		const int is_flat = drawn_in_parallel(view);

		if (view->target || s->instances[i].rectangle || m->stencil_test)
			continue;
		parallel += (unsigned)is_flat;
		deep += !is_flat && m->depth_test && m->depth_write;
	}
	if (!deep || !parallel)
		return;
	r->hud_draws += parallel;
	r->hud_frames++;
}

/* --- All roles --------------------------------------------------------------------------------------------------- */

int roles_add(struct roles *r, const struct scene *scene, const struct motion *motion)
{
	const struct motion_camera *now = motion_now(motion);
	double back[16];
	int walked = 0;

	if (MEMORY_GROW(r->things, r->room_things, motion->n_things + 1))
		return ERR_SYSTEM;
	if (motion->n_things > r->n_things)
		memset(r->things + r->n_things, 0, (motion->n_things - r->n_things) * sizeof(*r->things));
	r->n_things = motion->n_things;
	turn_back(now->eye_from_world, back);
	if (r->knows_camera && now->moved) {
		double from[16], inverse[16], here[3], there[3], off = 0;

		for (int c = 0; c < 3; c++)
			off += fabs(now->eye_from_world[5 * c] - r->camera[5 * c]);
		r->turns += off > 1e-4;
		walked = matrix_invert(inverse, r->camera) && matrix_invert(from, now->eye_from_world);
		matrix_point(there, inverse, (double[3]){ 0, 0, 0 });
		matrix_point(here, from, (double[3]){ 0, 0, 0 });
		off = 0;
		for (int k = 0; k < 3; k++)
			off += fabs(here[k] - there[k]);
		walked = walked && off > 10 * SAME * (1 + fabs(here[0]) + fabs(here[1]) + fabs(here[2]));
	}
	for (uint32_t i = 0; i < scene->n_instances; i++) {
		double eye[16];

		if (scene->meshes[scene->instances[i].mesh]->kind == SCENE_POINTS &&
		    scene->materials[scene->instances[i].material].point_sprite)
			note_texture(r, scene, &scene->instances[i], eye, motion->n_frames);
		if (motion->of_instance[i] == SCENE_NONE)
			continue;
		matrix_from_floats(eye, scene->instances[i].modelview);
		note_thing(r, motion, motion->of_instance[i], eye, back, walked);
		r->things[motion->of_instance[i]].is_flat |= (uint32_t)drawn_in_parallel(&scene->views[scene->instances[i].view]);
		note_texture(r, scene, &scene->instances[i], eye, motion->n_frames);
	}
	note_hud(r, scene);
	memcpy(r->camera, now->eye_from_world, sizeof(r->camera));
	r->knows_camera = 1;
	return kinds_add(&r->kinds, scene);
}

void roles_free(struct roles *r)
{
	free(r->things);
	kinds_free(&r->kinds);
	*r = (struct roles){ .things = NULL };
}

typedef int role_test(const struct roles *r, const struct motion *m, size_t i);

/* The next mesh whose things all have a role, identified by the first of them. @param next  where to start
 * @return SCENE_NONE: there is none */
static uint32_t next_mesh(const struct roles *r, const struct motion *m, role_test *has, size_t next)
{
	for (size_t i = next; i < r->n_things; i++) {
		int all = has(r, m, i);

		for (size_t k = 0; k < r->n_things && all; k++)
			if (k != i && memcmp(m->things[k].mesh, m->things[i].mesh, sizeof(m->things[i].mesh)) == 0)
				all = k > i ? has(r, m, k) : 0; /* an earlier thing has reported this mesh, or lacks
				                                   the role */
		if (all)
			return (uint32_t)i;
	}
	return SCENE_NONE;
}

static void find_meshes(const struct roles *r, const struct motion *m, role_test *has, const char *role,
                        const char *why, const struct finding_value sets[3], struct findings *out)
{
	unsigned n = 0;

	for (uint32_t i = next_mesh(r, m, has, 0); i != SCENE_NONE && n < ROLES_MOST; i = next_mesh(r, m, has, i + 1))
		for (int turned = 0; turned < 2; turned++) {
			const struct motion_thing *t = &m->things[i];
			const uint64_t *hash = turned ? t->turned : t->mesh;
			struct finding *rule;

			if (!(hash[0] | hash[1]))
				continue;
			n++;
			rule = findings_add(out, FINDINGS_SURFACES, "%s", role);
			finding_explain(rule, 1 - 1.0 / (1 + t->again), "in %u frames %s", t->again, why);
			FINDING_MATCH(rule, FINDING_HASHED("mesh", hash));
			finding_set(rule, sets, 3);
		}
}

static void find_particles(const struct roles *r, struct findings *out)
{
	for (unsigned i = 0; i < r->n_textures; i++) {
		const struct role_texture *t = &r->textures[i];
		struct finding *rule;

		if (!is_particle(r, t))
			continue;
		rule = findings_add(out, FINDINGS_SURFACES, "particle");
		finding_explain(rule, (double)t->facing / (t->facing + t->others), "%u of %u draws in %u frames %s", t->facing,
		                t->facing + t->others, t->frames,
		                t->points == t->facing ? "are points with a picture" : "face the viewer, who turns");
		FINDING_MATCH(rule, FINDING_HASHED("texture", t->hash), FINDING_IS("blended", 1));
		FINDING_SET(rule, FINDING_IS("shadows", 0), FINDING_IS("dome", 0));
	}
}

void roles_find(const struct roles *r, const struct motion *m, int is_relit, struct findings *out)
{
	static const struct finding_value sky[3] = { FINDING_IS("shadows", 0), FINDING_IS("shaded", 0) };
	static const struct finding_value held[3] = { FINDING_IS("shadows", 0), FINDING_IS("dome", 0), FINDING_IS("lit", 0) };
	struct finding *rule;

	find_meshes(r, m, is_sky, "sky", "it turned with the world and came along with the viewer", sky, out);
	find_meshes(r, m, is_held, "view model", "it was where it was before the viewer, who moved", held, out);
	find_particles(r, out);
	if (r->hud_frames) {
		rule = findings_add(out, FINDINGS_SURFACES, "HUD");
		finding_explain(rule, 1 - 0.5 / (1 + r->hud_frames),
		                "%u draws in %u frames are in parallel projection over a world in perspective", r->hud_draws,
		                r->hud_frames);
		FINDING_MATCH(rule, FINDING_IS("parallel", 1), FINDING_IS("stencil_tested", 0));
		FINDING_SET(rule, FINDING_IS("shadows", 0), FINDING_IS("mirrors", 0), FINDING_IS("dome", 0));
	}
	kinds_find(&r->kinds, is_relit, out);
}
