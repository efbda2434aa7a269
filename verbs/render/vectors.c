#include "verbs/render/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/vec3.h"
#include "look/draws/followed.h"
#include "look/draws/matrix.h"
#include "scene/drawn.h"

/* Tolerance for points of a triangle, as positions are floats: how far off its plane and sides they may be, as a share
 * of its size. */
#define OFF_TRIANGLE 1e-3

/* A draw of a mesh. */
struct placed {
	uint64_t mesh[2]; /* its hash */
	double eye[16], projection[16];
	float viewport[4];
	float (*position)[4]; /* [n_vertices]; owned */
	uint32_t n_vertices;
};

struct vectors_frame {
	struct placed *placed; /* [n], as the scene's instances */
	uint32_t n, height;
	struct followed followed;
};

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static int note_instance(const struct scene *scene, uint32_t i, struct vectors_frame *f)
{
	const struct scene_instance *in = &scene->instances[i];
	const struct scene_mesh *mesh = scene->meshes[in->mesh];
	const struct scene_view *view = &scene->views[in->view];
	struct placed *p = &f->placed[i];

	memcpy(p->mesh, mesh->hash, sizeof(p->mesh));
	matrix_from_floats(p->eye, in->modelview);
	matrix_from_floats(p->projection, view->projection);
	memcpy(p->viewport, view->viewport, sizeof(p->viewport));
	p->n_vertices = mesh->vertex_count;
	p->position = malloc((size_t)mesh->vertex_count * sizeof(*p->position) + 1);
	if (!p->position)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	memcpy(p->position, mesh->position, (size_t)mesh->vertex_count * sizeof(*p->position));
	return 0;
}

struct vectors_frame *vectors_note(const struct scene *scene)
{
	struct vectors_frame *f = calloc(1, sizeof(*f));
	int err = 0;

	if (f)
		f->placed = calloc(scene->n_instances + (size_t)1, sizeof(*f->placed));
	if (!f || !f->placed)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		f->n = i + 1;
		if (!scene->instances[i].rectangle)
			err = note_instance(scene, i, f);
	}
	if (!err)
		err = followed_note(&f->followed, scene);
	if (!err)
		f->height = scene->height;
	if (err && f)
		vectors_free(&f);
	return f;
}

void vectors_free(struct vectors_frame **frame)
{
	struct vectors_frame *f = *frame;

	*frame = NULL;
	if (!f)
		return;
	for (uint32_t i = 0; i < f->n; i++)
		free(f->placed[i].position);
	free(f->placed);
	followed_free(&f->followed);
	free(f);
}

/* --- Points ------------------------------------------------------------------------------------------------------ */

/* Project a point of eye space onto the picture: pixels from the left and from the top. @return 0: behind the viewer */
static int project(const struct placed *p, uint32_t height, const double eye[3], double out[2])
{
	const double at[4] = { eye[0], eye[1], eye[2], 1 };
	double clip[4];

	matrix_transform(clip, p->projection, at);
	if (!(clip[3] > 0))
		return 0;
	out[0] = (double)p->viewport[0] + (clip[0] / clip[3] + 1) / 2 * (double)p->viewport[2];
	out[1] = (double)height - ((double)p->viewport[1] + (clip[1] / clip[3] + 1) / 2 * (double)p->viewport[3]);
	return 1;
}

/* Data of vectors_add. */
struct work {
	const struct scene *scene;
	const struct vectors_frame *before;
	struct vectors_frame *now;
	const struct placed **was;  /* [n_instances]: its partner in the previous frame, or NULL */
	uint32_t width, height;
	const float *id, *position[3];
	float *x, *y, *known;
	uint32_t *instance; /* [pixels]: the instance that shows and has a partner, or SCENE_NONE */
};

/* Set a pixel's vector. Its point is at `here` and was at `there`, each in its frame's eye space. */
static void put(struct work *w, size_t pixel, const struct placed *now, const struct placed *was, const double here[3],
                const double there[3])
{
	double to[2], from[2];

	if (!project(now, w->height, here, to) || !project(was, w->before->height, there, from))
		return;
	w->x[pixel] = (float)(to[0] - from[0]);
	w->y[pixel] = (float)(to[1] - from[1]);
	w->known[pixel] = 1;
}

static void take_point(const struct work *w, size_t pixel, double out[3])
{
	for (int k = 0; k < 3; k++)
		out[k] = (double)w->position[k][pixel];
}

/* Pixels of unchanged meshes. moves: [n_instances][16], from this frame's eye space to the previous one's */
static void follow_rigid(struct work *w, const double (*moves)[16], const uint8_t *is_rigid)
{
	for (size_t pixel = 0; pixel < (size_t)w->width * w->height; pixel++) {
		const uint32_t i = w->instance[pixel];
		double here[3], there[3];

		if (i == SCENE_NONE || !is_rigid[i])
			continue;
		take_point(w, pixel, here);
		matrix_point(there, moves[i], here);
		put(w, pixel, &w->now->placed[i], w->was[i], here, there);
	}
}

/* A point's barycentric weights in a triangle. @return 0: it is outside */
static int weigh(const double corner[3][3], const double point[3], double weight[3])
{
	double a[3], b[3], p[3], n[3], c[3], square;

	for (int k = 0; k < 3; k++) {
		a[k] = corner[1][k] - corner[0][k];
		b[k] = corner[2][k] - corner[0][k];
		p[k] = point[k] - corner[0][k];
	}
	vec3_cross(a, b, n);
	square = matrix_dot3(n, n);
	if (!(square > 0) || fabs(matrix_dot3(p, n)) > OFF_TRIANGLE * pow(square, 0.75))
		return 0;
	vec3_cross(p, b, c);
	weight[1] = matrix_dot3(c, n) / square;
	vec3_cross(a, p, c);
	weight[2] = matrix_dot3(c, n) / square;
	weight[0] = 1 - weight[1] - weight[2];
	return weight[0] > -OFF_TRIANGLE && weight[1] > -OFF_TRIANGLE && weight[2] > -OFF_TRIANGLE;
}

/* The pixels that a triangle may cover. @return 0: none */
static int pixels_of(const struct work *w, const struct placed *p, const double corner[3][3], uint32_t low[2],
                     uint32_t end[2])
{
	const double size[2] = { w->width, w->height };
	double least[2] = { INFINITY, INFINITY }, most[2] = { -INFINITY, -INFINITY };

	for (int i = 0; i < 3; i++) {
		double at[2] = { 0, 0 };
		const int ahead = project(p, w->height, corner[i], at);

		for (int k = 0; k < 2; k++) {
			least[k] = ahead ? fmin(least[k], at[k]) : 0;
			most[k] = ahead ? fmax(most[k], at[k]) : size[k];
		}
		if (!ahead)
			break;
	}
	for (int k = 0; k < 2; k++) {
		low[k] = least[k] > 1 ? (uint32_t)fmin(least[k] - 1, size[k]) : 0;
		end[k] = most[k] > 0 ? (uint32_t)fmin(most[k] + 2, size[k]) : 0;
	}
	return low[0] < end[0] && low[1] < end[1];
}

/* The corners of a triangle in eye space. */
static void place_corners(const struct placed *p, const uint32_t *index, double corner[3][3])
{
	for (int i = 0; i < 3; i++) {
		const float *v = p->position[index[i]];
		const double at[4] = { (double)v[0], (double)v[1], (double)v[2], (double)v[3] };
		double eye[4];

		matrix_transform(eye, p->eye, at);
		for (int k = 0; k < 3; k++)
			corner[i][k] = eye[k] / eye[3];
	}
}

/* Pixels of a mesh whose vertices have moved: each moves with its triangle. */
static void follow_triangles(struct work *w, uint32_t i)
{
	const struct scene_mesh *mesh = w->scene->meshes[w->scene->instances[i].mesh];
	const struct placed *now = &w->now->placed[i], *was = w->was[i];

	for (uint32_t t = 0; t < mesh->primitive_count && mesh->kind == SCENE_TRIANGLES; t++) {
		double here[3][3], there[3][3];
		uint32_t low[2], end[2];

		place_corners(now, mesh->index + 3 * t, here);
		if (!pixels_of(w, now, (const double (*)[3])here, low, end))
			continue;
		place_corners(was, mesh->index + 3 * t, there);
		for (uint32_t y = low[1]; y < end[1]; y++)
			for (uint32_t x = low[0]; x < end[0]; x++) {
				const size_t pixel = (size_t)y * w->width + x;
				double point[3], then[3], weight[3];

				if (w->instance[pixel] != i || w->known[pixel] > 0)
					continue;
				take_point(w, pixel, point);
				if (!weigh((const double (*)[3])here, point, weight))
					continue;
				for (int k = 0; k < 3; k++)
					then[k] = weight[0] * there[0][k] + weight[1] * there[1][k] + weight[2] * there[2][k];
				put(w, pixel, now, was, point, then);
			}
	}
}

/* --- All together ------------------------------------------------------------------------------------------------ */

/* Match each instance with one of the previous frame. */
static int match_all(struct work *w)
{
	uint32_t *found = malloc((w->scene->n_instances + (size_t)1) * sizeof(*found));
	int err = found ? followed_find(&w->before->followed, w->scene, found) :
	                  err_report(ERR_SYSTEM, NULL, "out of memory");

	for (uint32_t i = 0; i < w->scene->n_instances && !err; i++)
		w->was[i] = found[i] != SCENE_NONE ? &w->before->placed[found[i]] : NULL;
	free(found);
	return err;
}

/* Find the instance that each pixel shows: the last one that begins with the pixel's draw or before it. */
static void find_instances(struct work *w)
{
	const struct scene *scene = w->scene;

	for (size_t pixel = 0; pixel < (size_t)w->width * w->height; pixel++) {
		const uint32_t draw = (uint32_t)w->id[pixel], i = draw ? scene_instance_of(scene, draw) : SCENE_NONE;

		w->instance[pixel] = i != SCENE_NONE && w->was[i] ? i : SCENE_NONE;
	}
}

static int follow_all(struct work *w)
{
	const uint32_t n = w->scene->n_instances;
	double (*moves)[16] = calloc(n + (size_t)1, sizeof(*moves));
	uint8_t *is_rigid = calloc(n + (size_t)1, 1);
	int err = moves && is_rigid ? match_all(w) : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err)
		find_instances(w);
	for (uint32_t i = 0; i < n && !err; i++) {
		double back[16];

		if (!w->was[i] || memcmp(w->was[i]->mesh, w->now->placed[i].mesh, sizeof(w->was[i]->mesh)) != 0)
			continue;
		is_rigid[i] = (uint8_t)matrix_invert(back, w->now->placed[i].eye);
		if (memcmp(w->was[i]->eye, w->now->placed[i].eye, sizeof(back)) == 0)
			memcpy(moves[i], matrix_identity, sizeof(back));
		else
			matrix_mul(moves[i], w->was[i]->eye, back);
	}
	if (!err)
		follow_rigid(w, (const double (*)[16])moves, is_rigid);
	for (uint32_t i = 0; i < n && !err; i++)
		if (w->was[i] && !is_rigid[i] && w->was[i]->n_vertices == w->now->placed[i].n_vertices)
			follow_triangles(w, i);
	free(moves);
	free(is_rigid);
	return err;
}

int vectors_add(const struct scene *scene, const struct vectors_frame *before, struct image *img)
{
	static const char *const names[3] = { "P.X", "P.Y", "P.Z" };
	struct work w = { .scene = scene, .before = before, .width = img->width, .height = img->height };
	int err = 0;

	w.id = image_channel(img, "id");
	for (int k = 0; k < 3; k++)
		w.position[k] = image_channel(img, names[k]);
	w.x = image_add_channel(img, "motion.X", 1);
	w.y = image_add_channel(img, "motion.Y", 1);
	w.known = image_add_channel(img, "motion.A", 0);
	if (!w.id || !w.position[0] || !w.position[1] || !w.position[2] || !w.x || !w.y || !w.known)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!before)
		return 0;
	w.now = vectors_note(scene);
	w.was = calloc(scene->n_instances + (size_t)1, sizeof(*w.was));
	w.instance = malloc((size_t)img->width * img->height * sizeof(*w.instance) + 1);
	if (!w.now)
		err = ERR_SYSTEM;
	else if (!w.was || !w.instance)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = follow_all(&w);
	vectors_free(&w.now);
	free(w.was);
	free(w.instance);
	return err;
}
