#include "look/camera/scaled.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "base/mat4.h"
#include "look/draws/drawn.h"
#include "scene/backdrop.h"
#include "scene/program.h"

#define COVERS 0.999f /* a quad that reaches this far from the middle to the window's edges covers all of it */

struct scaling {
	const struct scene *from;
	struct scaled *out;
	float factor;
	float by[2];    /* pixels of the new window for one of the old window; nearly the factor, so that whole
	                   numbers stay whole */
	float shift[2]; /* position of the old window's picture in the new window, pixels */
	float share[2]; /* width and height of the old picture, relative to the new window; 1: all */
};

static int32_t edge(float at)
{
	return (int32_t)lrintf(at);
}

/* Round edges to the nearest pixel, so that adjacent parts stay adjacent. */
static void scale_part(const struct scaling *a, int32_t part[4])
{
	const int32_t whole[4] = { 0, 0, (int32_t)a->out->scene.width, (int32_t)a->out->scene.height };

	if (scene_is_whole(a->from, part)) {
		memcpy(part, whole, sizeof(whole));
		return;
	}
	for (int k = 0; k < 2; k++) {
		const int32_t low = edge((float)part[k] * a->by[k] + a->shift[k]),
			      high = edge((float)(part[k] + part[k + 2]) * a->by[k] + a->shift[k]);

		part[k] = low;
		part[k + 2] = high - low;
	}
}

static int shows_window(const struct scene *s, const struct scene_view *view)
{
	return view->viewport[0] == 0 && view->viewport[1] == 0 && view->viewport[2] == (float)s->width &&
	       view->viewport[3] == (float)s->height;
}

static int is_of_another_shape(const struct scaling *a)
{
	return a->share[0] * a->share[1] < 1;
}

/* @param placed  1: programs place what it shows */
static void scale_view(const struct scaling *a, struct scene_view *view, int placed)
{
	const int widens = shows_window(a->from, view) && !placed;

	for (int k = 0; k < 4; k++)
		view->viewport[k] = view->viewport[k] * a->by[k % 2] + (k < 2 ? a->shift[k] : 0);
	scale_part(a, view->scissor);
	a->out->narrow += placed && is_of_another_shape(a);
	if (!widens)
		return;
	for (int k = 0; k < 2; k++) {
		view->viewport[k] = 0;
		view->viewport[k + 2] = (float)(k ? a->out->scene.height : a->out->scene.width);
		for (int column = 0; column < 4; column++)
			view->projection[4 * column + k] *= a->share[k];
	}
}

/* 1 if a draw is a quad over the whole recorded window, in parallel projection. */
static int covers_window(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_view *view = &s->views[in->view];
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	float low[2] = { 2, 2 }, high[2] = { -2, -2 };

	if (in->rectangle || mesh->primitive_count > 2 || mesh->kind != SCENE_TRIANGLES ||
	    s->materials[in->material].vertex_program || !shows_window(s, view) || !drawn_in_parallel(view))
		return 0;
	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		float eye[4], clip[4];

		mat4_transform(eye, in->modelview, mesh->position + 4 * (size_t)v);
		mat4_transform(clip, view->projection, eye);
		for (int k = 0; k < 2; k++) {
			low[k] = fminf(low[k], clip[k] / clip[3]);
			high[k] = fmaxf(high[k], clip[k] / clip[3]);
		}
	}
	return low[0] <= -COVERS && low[1] <= -COVERS && high[0] >= COVERS && high[1] >= COVERS;
}

/* Add a second view for each, which stretches the recorded window over the whole new one, for quads that cover the
 * old one. */
static void spread_views(const struct scaling *a)
{
	struct scene *s = &a->out->scene;
	const uint32_t n = a->from->n_views;

	for (uint32_t i = 0; i < n; i++) {
		s->views[n + i] = a->from->views[i];
		memcpy(s->views[n + i].viewport, (const float[]){ 0, 0, (float)s->width, (float)s->height },
		       sizeof(s->views[i].viewport));
		memcpy(s->views[n + i].scissor, s->views[i].scissor, sizeof(s->views[i].scissor));
	}
	s->n_views = 2 * n;
	for (uint32_t i = 0; i < s->n_instances; i++)
		if (covers_window(a->from, &a->from->instances[i]))
			s->instances[i].view += n;
}

/* @param placed  [n_views], all 0 */
static void scale_views(const struct scaling *a, uint8_t *placed)
{
	struct scene *s = &a->out->scene;

	for (uint32_t i = 0; i < s->n_instances; i++)
		placed[s->instances[i].view] |= s->materials[s->instances[i].material].vertex_program != 0;
	for (uint32_t i = 0; i < a->from->n_views; i++)
		scale_view(a, &s->views[i], placed[i]);
	if (is_of_another_shape(a))
		spread_views(a);
}

static int looks_at_window(const struct scene *s, const struct scene_material *m)
{
	const struct scene_program *fragments = scene_program_of(s, m->fragment_program);
	const struct scene_program *vertices = scene_program_of(s, m->vertex_program);

	return (fragments && fragments->inputs >> SCENE_INPUT_POSITION & 1) ||
	       (vertices && vertices->outputs >> SCENE_RESULT_POINT_SIZE & 1);
}

static void scale_material(const struct scaling *a, struct scene_material *m)
{
	const uint32_t stipple = m->line_stipple >> 16;
	const float longer = fminf(fmaxf(roundf((float)stipple * a->factor), 1), 65535);

	m->line_width *= a->factor;
	m->point_size *= a->factor;
	m->point_size_min *= a->factor;
	m->point_size_max *= a->factor;
	m->point_fade_threshold *= a->factor;
	m->polygon_offset_factor *= a->factor;
	if (stipple)
		m->line_stipple = (uint32_t)longer << 16 | (m->line_stipple & 0xffff);
	a->out->stipples += m->polygon_stipple != SCENE_NONE;
	a->out->programs += (uint32_t)looks_at_window(a->from, m);
}

/* Place the point where a rectangle of pixels starts, in the new window's coordinates. */
static int place_mesh(struct scaling *a, struct scene_instance *in)
{
	struct scaled *out = a->out;
	const struct scene_mesh *from = a->from->meshes[in->mesh];
	struct scene_mesh *mesh = &out->placed[out->n_placed];
	float *position = malloc(4 * sizeof(float) * from->vertex_count);

	if (!position)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	*mesh = *from;
	for (uint32_t v = 0; v < from->vertex_count; v++)
		for (uint32_t k = 0; k < 4; k++)
			position[4 * v + k] = k < 2 ? from->position[4 * v + k] * a->by[k] + a->shift[k] :
			                              from->position[4 * v + k];
	mesh->position = position;
	mesh->hash[0] ^= XXH3_64bits(a->by, sizeof(a->by)) ^ XXH3_64bits(a->shift, sizeof(a->shift));
	out->scene.meshes[out->scene.n_meshes] = mesh;
	in->mesh = out->scene.n_meshes++;
	out->n_placed++;
	return 0;
}

/* The old pixel, of n, at a new one; beyond the border, the border's. */
static size_t old_place(const struct scaling *a, int axis, uint32_t at, uint32_t n)
{
	const float old = floorf(((float)at + 0.5f - a->shift[axis]) / a->by[axis]);

	return (size_t)fminf(fmaxf(old, 0), (float)(n - 1));
}

/* Enlarge each pixel of the earlier picture. */
static int scale_start(const struct scaling *a, const struct scene_picture *from)
{
	struct scene *s = &a->out->scene;
	struct scene_picture *to = &a->out->start;
	const size_t n = (size_t)s->width * s->height;

	*to = (struct scene_picture){ .width = s->width, .height = s->height, .depth_bits = from->depth_bits };
	to->rgba = malloc(4 * n);
	to->depth = malloc(sizeof(*to->depth) * n);
	to->stencil = malloc(n);
	to->colors = from->colors ? malloc(4 * sizeof(*to->colors) * n) : NULL;
	if (!to->rgba || !to->depth || !to->stencil || (from->colors && !to->colors))
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t y = 0; y < s->height; y++)
		for (uint32_t x = 0; x < s->width; x++) {
			const size_t p = (size_t)y * s->width + x,
				     q = old_place(a, 1, y, from->height) * from->width + old_place(a, 0, x, from->width);

			memcpy(to->rgba + 4 * p, from->rgba + 4 * q, 4);
			to->depth[p] = from->depth[q];
			to->stencil[p] = from->stencil[q];
			if (to->colors)
				memcpy(to->colors + 4 * p, from->colors + 4 * q, 4 * sizeof(*to->colors));
		}
	s->start = to;
	a->out->starts = 1;
	return 0;
}

static void *copy_of(const void *items, size_t n, size_t room, size_t size)
{
	void *copy = malloc((n + room + 1) * size);

	if (copy && n)
		memcpy(copy, items, n * size);
	return copy;
}

static int copy_scene(const struct scaling *a)
{
	const struct scene *s = a->from;
	struct scene *out = &a->out->scene;

	*out = *s;
	out->release = NULL;
	out->serial = ~s->serial; /* pictures of one are not valid for the other */
	out->before = NULL;
	out->instances = copy_of(s->instances, s->n_instances, 0, sizeof(*s->instances));
	out->materials = copy_of(s->materials, s->n_materials, 0, sizeof(*s->materials));
	out->views = copy_of(s->views, s->n_views, s->n_views, sizeof(*s->views));
	out->clears = copy_of(s->clears, s->n_clears, 0, sizeof(*s->clears));
	out->rectangles = copy_of(s->rectangles, s->n_rectangles, 0, sizeof(*s->rectangles));
	out->meshes = copy_of(s->meshes, s->n_meshes, s->n_rectangles, sizeof(*s->meshes));
	a->out->placed = calloc(s->n_rectangles + (size_t)1, sizeof(*a->out->placed));
	return out->instances && out->materials && out->views && out->clears && out->rectangles && out->meshes &&
	                       a->out->placed ?
	               0 :
	               err_report(ERR_SYSTEM, NULL, "out of memory");
}

static int scale_scene(struct scaling *a, const uint32_t size[2])
{
	struct scene *s = &a->out->scene;
	uint8_t *placed = calloc(a->from->n_views + (size_t)1, 1);
	int err = placed ? copy_scene(a) : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (err) {
		free(placed);
		return err;
	}
	s->width = size[0];
	s->height = size[1];
	scale_views(a, placed);
	free(placed);
	for (uint32_t i = 0; i < s->n_clears; i++)
		scale_part(a, s->clears[i].scissor);
	for (uint32_t i = 0; i < s->n_materials; i++)
		scale_material(a, &s->materials[i]);
	for (uint32_t i = 0; i < s->n_rectangles; i++)
		for (int k = 0; k < 2; k++)
			s->rectangles[i].zoom[k] *= a->by[k];
	for (uint32_t i = 0; i < s->n_instances && !err; i++)
		if (s->instances[i].rectangle)
			err = place_mesh(a, &s->instances[i]);
	return err || !s->start ? err : scale_start(a, a->from->start);
}

int scaled_make(const struct scene *scene, float factor, const uint32_t size[2], struct scaled *out)
{
	const float old[2] = { (float)scene->width, (float)scene->height };
	struct scaling a = { .from = scene, .out = out };
	const int given = size[0] && size[1];
	float pixels[2];
	int err;

	memset(out, 0, sizeof(*out));
	a.factor = given ? fminf((float)size[0] / old[0], (float)size[1] / old[1]) : factor;
	for (int k = 0; k < 2; k++) {
		const float picture = roundf(old[k] * a.factor);

		pixels[k] = given ? (float)size[k] : picture;
		if (!(picture >= 1) || pixels[k] > (float)SCALED_MOST)
			return err_report(ERR_INPUT, NULL,
			                  "frame %llu is %ux%u: scaled by %g, it has no pixels or more than %u on a side",
			                  (unsigned long long)scene->frame, scene->width, scene->height,
			                  (double)a.factor, SCALED_MOST);
		a.by[k] = picture / old[k];
		a.shift[k] = floorf(0.5f * (pixels[k] - picture));
		a.share[k] = picture / pixels[k];
	}
	err = scale_scene(&a, (const uint32_t[]){ (uint32_t)pixels[0], (uint32_t)pixels[1] });
	if (err)
		scaled_release(out);
	return err;
}

void scaled_release(struct scaled *scaled)
{
	struct scene *s = &scaled->scene;

	for (uint32_t i = 0; i < scaled->n_placed; i++)
		free((void *)(uintptr_t)scaled->placed[i].position);
	free(scaled->placed);
	free(scaled->start.rgba);
	free(scaled->start.depth);
	free(scaled->start.stencil);
	free(scaled->start.colors);
	free(s->instances);
	free(s->materials);
	free(s->views);
	free(s->clears);
	free(s->rectangles);
	free(s->meshes);
	memset(scaled, 0, sizeof(*scaled));
}
