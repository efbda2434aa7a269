#include "look/study/motion/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/memory.h"
#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/study/motion/box.h"

/* Tolerances: positions as a share of their distance from the viewer, rotations as an angle. Products of floats are
 * far more exact. */
#define SAME_PLACE 1e-3
#define SAME_TURN 2e-3
enum { MAX_GUESSES = 48 };

/* --- Things ------------------------------------------------------------------------------------------------------ */

static int is_deep(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];

	return s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !in->rectangle && m->depth_test && m->depth_write &&
	       (m->color_mask & 7) && s->views[in->view].target == 0;
}

/* The hash of a mesh's points. The mesh's own hash may change as the viewer moves, since it depends on how quads are
 * split. */
static XXH128_hash_t hash_points(const struct scene_mesh *mesh)
{
	const uint32_t head[3] = { mesh->kind, mesh->vertex_count, mesh->primitive_count };
	XXH3_state_t hash;

	XXH3_128bits_reset(&hash);
	XXH3_128bits_update(&hash, head, sizeof(head));
	XXH3_128bits_update(&hash, mesh->position, (size_t)mesh->vertex_count * 4 * sizeof(*mesh->position));
	if (mesh->texcoord[0])
		XXH3_128bits_update(&hash, mesh->texcoord[0], (size_t)mesh->vertex_count * 4 * sizeof(*mesh->texcoord[0]));
	return XXH3_128bits_digest(&hash);
}

/* Note a hash that a thing's mesh has in some frame. */
static void note_hash(struct motion_thing *t, const uint64_t hash[2])
{
	if (memcmp(t->mesh, hash, sizeof(t->mesh)) != 0)
		memcpy(t->turned, hash, sizeof(t->turned));
}

/*
 * Find the thing of an instance: it has the same mesh, the same handedness, and the same number of equal draws before
 * it in the frame. A mirrored copy is another thing.
 * @param out  receives its index; SCENE_NONE: none, there are too many
 * @return 0 or ERR_SYSTEM (reported)
 */
static int find_thing(struct motion *m, struct table *counts, const struct scene *s, const struct scene_instance *in,
                      const double eye[16], uint32_t *out)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const XXH128_hash_t points = hash_points(mesh);
	uint64_t parts[4] = { points.low64, points.high64, matrix_determinant3(eye) < 0, 0 },
		 key = XXH3_64bits(parts, sizeof(parts));
	uintptr_t before = (uintptr_t)table_find(counts, key), found;
	struct box box;

	*out = SCENE_NONE;
	if (table_set(counts, key, (void *)(before + 1)))
		return ERR_SYSTEM;
	parts[3] = before;
	key = XXH3_64bits(parts, sizeof(parts));
	found = (uintptr_t)table_find(&m->by_key, key);
	if (found) {
		note_hash(&m->things[found - 1], mesh->hash);
		*out = (uint32_t)(found - 1);
		return 0;
	}
	if (m->n_things >= MOTION_MAX_THINGS)
		return 0;
	if (MEMORY_GROW(m->things, m->room_things, m->n_things + 1) || table_set(&m->by_key, key, (void *)(m->n_things + 1)))
		return ERR_SYSTEM;
	m->things[m->n_things] = (struct motion_thing){ .mesh = { mesh->hash[0], mesh->hash[1] } };
	box = box_of(mesh, matrix_identity);
	m->things[m->n_things].size = box_measure(&box, m->things[m->n_things].middle);
	*out = (uint32_t)m->n_things++;
	return 0;
}

/* --- The camera -------------------------------------------------------------------------------------------------- */

/* A thing votes for the camera that makes it stand still. */
struct vote {
	uint32_t thing;
	double eye[16], camera[16], weight;
};

/* 1 if a camera shows a thing, at its place in the world, where it was drawn. */
static int stands(const struct motion_thing *t, const double camera[16], const double eye[16])
{
	double expected[16], here[3], there[3], far = 0, off = 0, scale = matrix_scale(eye);

	matrix_mul(expected, camera, t->world);
	matrix_point(here, eye, t->middle);
	matrix_point(there, expected, t->middle);
	for (int k = 0; k < 3; k++) {
		far += here[k] * here[k];
		off += (here[k] - there[k]) * (here[k] - there[k]);
	}
	if (!(sqrt(off) <= SAME_PLACE * (sqrt(far) + scale * t->size)))
		return 0;
	for (int c = 0; c < 3; c++)
		for (int r = 0; r < 3; r++)
			if (!(fabs(expected[4 * c + r] - eye[4 * c + r]) <= SAME_TURN * scale))
				return 0;
	return 1;
}

static double support(const struct motion *m, const struct vote *votes, size_t n, const double camera[16],
                      size_t *agreeing)
{
	double sum = 0;

	*agreeing = 0;
	for (size_t i = 0; i < n; i++)
		if (stands(&m->things[votes[i].thing], camera, votes[i].eye)) {
			sum += votes[i].weight;
			++*agreeing;
		}
	return sum;
}

/* By weight, the largest first. */
static int by_weight(const void *a, const void *b)
{
	double x = ((const struct vote *)a)->weight, y = ((const struct vote *)b)->weight;

	return x < y ? 1 : x > y ? -1 : 0;
}

/* 1 if the viewer is inside a thing's box, as in a world that is drawn in one piece. */
static int surrounds_viewer(const struct motion_thing *t, const double eye[16])
{
	double inverse[16], at[3], square = 0;

	if (!matrix_invert(inverse, eye))
		return 0;
	matrix_point(at, inverse, (double[3]){ 0, 0, 0 });
	for (int k = 0; k < 3; k++)
		square += (at[k] - t->middle[k]) * (at[k] - t->middle[k]);
	return sqrt(square) < 0.5 * t->size;
}

/*
 * The camera that more than half of the votes, by size, agree on; otherwise, or if it explains as much, the last one.
 * A single thing is no evidence for a camera, since it may move itself, unless it surrounds the viewer.
 */
static void choose_camera(const struct motion *m, struct vote *votes, size_t n, struct motion_camera *camera)
{
	double whole = 0, best;
	size_t agreeing;

	qsort(votes, n, sizeof(*votes), by_weight);
	for (size_t i = 0; i < n; i++)
		whole += votes[i].weight;
	if (!(whole > 0))
		return;
	best = support(m, votes, n, camera->eye_from_world, &agreeing);
	for (size_t i = 0; i < n && i < MAX_GUESSES && best < 0.999 * whole; i++) {
		double sum = support(m, votes, n, votes[i].camera, &agreeing);

		if (sum <= best * 1.001 || sum <= 0.5 * whole ||
		    (agreeing < 2 && !surrounds_viewer(&m->things[votes[i].thing], votes[i].eye)))
			continue;
		best = sum;
		memcpy(camera->eye_from_world, votes[i].camera, sizeof(camera->eye_from_world));
		camera->moved = 1;
	}
	camera->share = best / whole;
	camera->witnessed = 1;
}

static int is_parallel(const struct scene *s, uint32_t i)
{
	return drawn_in_parallel(&s->views[s->instances[i].view]);
}

/*
 * A frame continues the part of the largest thing that stands still, if more than half of the frame has been seen
 * before and stands still. Otherwise the viewer has been taken to an unknown place, and another part begins.
 */
static void choose_part(struct motion *m, const struct vote *votes, size_t n, double fresh,
                        struct motion_camera *camera)
{
	double stands_still = 0, all = fresh, most = 0;

	for (size_t i = 0; i < n; i++) {
		const struct motion_thing *t = &m->things[votes[i].thing];

		all += votes[i].weight;
		if (!stands(t, camera->eye_from_world, votes[i].eye))
			continue;
		stands_still += votes[i].weight;
		if (votes[i].weight > most) {
			most = votes[i].weight;
			camera->part = t->part;
		}
	}
	if (!(stands_still > all / 2))
		camera->part = m->n_parts++;
}

/* Every thing drawn before votes. Large ones have more weight, up to a limit, because a distant plane is not the
 * world. Draws in parallel projection over a world in perspective are HUDs and do not vote. @param fresh  receives
 * the weight of those that are drawn for the first time */
static size_t collect_votes(const struct motion *m, const struct scene *s, struct vote *votes, double *fresh)
{
	size_t n = 0;
	double mean = 0;
	int in_perspective = 0;

	*fresh = 0;
	for (uint32_t i = 0; i < s->n_instances; i++)
		in_perspective |= m->of_instance[i] != SCENE_NONE && m->things[m->of_instance[i]].votes && !is_parallel(s, i);

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct motion_thing *t = m->of_instance[i] == SCENE_NONE ? NULL : &m->things[m->of_instance[i]];
		struct vote *v = &votes[n];
		double inverse[16];

		if (!t || !t->votes || (in_perspective && is_parallel(s, i)))
			continue;
		matrix_from_floats(v->eye, s->instances[i].modelview);
		v->weight = t->size * matrix_scale(v->eye);
		if (!t->frames || !matrix_invert(inverse, t->world)) {
			*fresh += v->weight;
			continue;
		}
		v->thing = m->of_instance[i];
		matrix_mul(v->camera, v->eye, inverse);
		mean += v->weight;
		n++;
	}
	for (size_t i = 0; i < n; i++)
		votes[i].weight = fmin(votes[i].weight, 4 * mean / (double)n) + 1e-9;
	return n;
}

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static void note_thing(struct motion *m, struct motion_thing *t, const double eye[16],
                       const struct motion_camera *camera)
{
	double inverse[16];
	int knows = t->frames && camera->witnessed;

	if (knows) {
		int same_eye = 1;

		for (int i = 0; i < 16; i++)
			same_eye &= fabs(t->eye[i] - eye[i]) <= 1e-5 * (1 + fabs(eye[i]));
		t->again++;
		if (stands(t, camera->eye_from_world, eye))
			t->still++;
		else if (camera->moved && same_eye)
			t->carried++;
	}
	if ((!knows || !stands(t, camera->eye_from_world, eye)) && matrix_invert(inverse, camera->eye_from_world))
		matrix_mul(t->world, inverse, eye);
	memcpy(t->eye, eye, sizeof(t->eye));
	t->frames++;
	t->part = camera->part;
	t->last = m->n_frames + 1;
	t->seen[m->n_frames / 64] |= 1ull << m->n_frames % 64;
}

/* Follow meshes with the same triangles and texture coordinates but other points. */
static int note_shape(struct motion *m, const struct scene_mesh *mesh)
{
	uint64_t parts[4] = { mesh->kind, mesh->vertex_count, mesh->primitive_count, 0 }, key, points;
	struct motion_shape *shape;
	uintptr_t found;

	if (mesh->kind != SCENE_TRIANGLES || mesh->primitive_count < 16)
		return 0; /* quads and the like all look alike */
	parts[3] = XXH3_64bits(mesh->index, (size_t)mesh->primitive_count * 3 * sizeof(*mesh->index));
	if (mesh->texcoord[0])
		parts[3] ^= XXH3_64bits(mesh->texcoord[0], (size_t)mesh->vertex_count * 16);
	key = XXH3_64bits(parts, sizeof(parts));
	points = mesh->hash[0];
	found = (uintptr_t)table_find(&m->by_topology, key);
	if (!found) {
		if (MEMORY_GROW(m->shapes, m->room_shapes, m->n_shapes + 1) ||
		    table_set(&m->by_topology, key, (void *)(m->n_shapes + 1)))
			return ERR_SYSTEM;
		m->shapes[m->n_shapes] = (struct motion_shape){ .points = points, .triangles = mesh->primitive_count };
		found = ++m->n_shapes;
	}
	shape = &m->shapes[found - 1];
	if (shape->last == m->n_frames + 1)
		return 0;
	shape->frames++;
	shape->changed += shape->points != points;
	shape->points = points;
	shape->last = m->n_frames + 1;
	return 0;
}

static int place_things(struct motion *m, const struct scene *s)
{
	struct table counts = { .n = 0 };
	int err = 0;

	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		const struct scene_instance *in = &s->instances[i];
		double eye[16], inverse[16];

		m->of_instance[i] = SCENE_NONE;
		matrix_from_floats(eye, in->modelview);
		if (s->meshes[in->mesh]->kind != SCENE_TRIANGLES || in->rectangle || s->views[in->view].target ||
		    !matrix_invert(inverse, eye))
			continue;
		err = find_thing(m, &counts, s, in, eye, &m->of_instance[i]);
		if (m->of_instance[i] != SCENE_NONE)
			m->things[m->of_instance[i]].votes = (uint32_t)is_deep(s, in);
	}
	table_free(&counts);
	return err;
}

int motion_add(struct motion *m, const struct scene *scene)
{
	struct motion_camera camera = { .frame = scene->frame, .share = 0 };
	struct vote *votes = malloc((scene->n_instances + (size_t)1) * sizeof(*votes));
	double fresh;
	size_t n;
	int err = 0;

	if (!votes)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (m->n_frames >= MOTION_MAX_FRAMES || MEMORY_GROW(m->cameras, m->room_frames, m->n_frames + 1) ||
	    MEMORY_GROW(m->of_instance, m->room_instances, scene->n_instances + (size_t)1)) {
		free(votes);
		return ERR_SYSTEM;
	}
	memcpy(camera.eye_from_world, m->n_frames ? motion_now(m)->eye_from_world : matrix_identity,
	       sizeof(camera.eye_from_world));
	err = place_things(m, scene);
	if (!err) {
		n = collect_votes(m, scene, votes, &fresh);
		choose_camera(m, votes, n, &camera);
		choose_part(m, votes, n, fresh, &camera);
	}
	free(votes);
	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		double eye[16];

		if (m->of_instance[i] == SCENE_NONE)
			continue;
		matrix_from_floats(eye, scene->instances[i].modelview);
		note_thing(m, &m->things[m->of_instance[i]], eye, &camera);
		err = note_shape(m, scene->meshes[scene->instances[i].mesh]);
	}
	m->cameras[m->n_frames++] = camera;
	return err;
}

const struct motion_camera *motion_now(const struct motion *m)
{
	return &m->cameras[m->n_frames - 1];
}

int motion_is_static(const struct motion_thing *t)
{
	return t->votes && t->again && t->still == t->again;
}

void motion_free(struct motion *m)
{
	free(m->things);
	free(m->shapes);
	free(m->cameras);
	free(m->of_instance);
	table_free(&m->by_key);
	table_free(&m->by_topology);
	*m = (struct motion){ .n_things = 0 };
}

uint32_t motion_main_part(const struct motion *m, uint32_t *count)
{
	uint32_t counts[MOTION_MAX_FRAMES] = { 0 }, main = 0;

	for (size_t i = 0; i < m->n_frames; i++)
		counts[m->cameras[i].part]++;
	for (uint32_t k = 0; k < m->n_parts; k++)
		if (counts[k] > counts[main])
			main = k;
	*count = counts[main];
	return main;
}
