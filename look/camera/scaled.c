#include "look/camera/scaled.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "scene/program.h"

struct scaling {
	const struct scene *from;
	struct scaled *out;
	float by[2]; /* whole pixels of the new window over those of the old one; nearly the factor */
	float factor;
};

static int32_t edge(float at)
{
	return (int32_t)lrintf(at);
}

/* Edges go to the nearest pixel's, so that parts that met still meet. */
static void scale_part(const struct scaling *a, int32_t part[4])
{
	for (int k = 0; k < 2; k++) {
		const int32_t low = edge((float)part[k] * a->by[k]), high = edge((float)(part[k] + part[k + 2]) * a->by[k]);

		part[k] = low;
		part[k + 2] = high - low;
	}
}

static void scale_view(const struct scaling *a, struct scene_view *view)
{
	for (int k = 0; k < 4; k++)
		view->viewport[k] *= a->by[k % 2];
	scale_part(a, view->scissor);
}

static int looks_at_window(const struct scene *s, const struct scene_material *m)
{
	const struct scene_program *fragments =
		m->fragment_program ? (const struct scene_program *)(s->programs + m->fragment_program - 1) : NULL;
	const struct scene_program *vertices =
		m->vertex_program ? (const struct scene_program *)(s->programs + m->vertex_program - 1) : NULL;

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

/* The one point that a rectangle of pixels begins at, in the new window's coordinates. */
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
			position[4 * v + k] = from->position[4 * v + k] * (k < 2 ? a->by[k] : 1);
	mesh->position = position;
	mesh->hash[0] ^= XXH3_64bits(a->by, sizeof(a->by));
	out->scene.meshes[out->scene.n_meshes] = mesh;
	in->mesh = out->scene.n_meshes++;
	out->n_placed++;
	return 0;
}

/* Each pixel of what was there before becomes several. */
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
				     q = (size_t)((uint64_t)y * from->height / s->height) * from->width +
			                 (size_t)((uint64_t)x * from->width / s->width);

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
	out->serial = ~s->serial; /* pictures of the one are none of the other */
	out->before = NULL;
	out->instances = copy_of(s->instances, s->n_instances, 0, sizeof(*s->instances));
	out->materials = copy_of(s->materials, s->n_materials, 0, sizeof(*s->materials));
	out->views = copy_of(s->views, s->n_views, 0, sizeof(*s->views));
	out->clears = copy_of(s->clears, s->n_clears, 0, sizeof(*s->clears));
	out->rectangles = copy_of(s->rectangles, s->n_rectangles, 0, sizeof(*s->rectangles));
	out->meshes = copy_of(s->meshes, s->n_meshes, s->n_rectangles, sizeof(*s->meshes));
	a->out->placed = calloc(s->n_rectangles + (size_t)1, sizeof(*a->out->placed));
	return out->instances && out->materials && out->views && out->clears && out->rectangles && out->meshes &&
	                       a->out->placed ?
	               0 :
	               err_report(ERR_SYSTEM, NULL, "out of memory");
}

static int scale_scene(struct scaling *a)
{
	struct scene *s = &a->out->scene;
	int err = copy_scene(a);

	if (err)
		return err;
	s->width = (uint32_t)edge((float)s->width * a->by[0]);
	s->height = (uint32_t)edge((float)s->height * a->by[1]);
	for (uint32_t i = 0; i < s->n_views; i++)
		scale_view(a, &s->views[i]);
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

int scaled_make(const struct scene *scene, float factor, struct scaled *out)
{
	const float size[2] = { (float)scene->width, (float)scene->height };
	struct scaling a = { .from = scene, .out = out, .factor = factor };
	int err;

	memset(out, 0, sizeof(*out));
	for (int k = 0; k < 2; k++) {
		const float pixels = roundf(size[k] * factor);

		if (!(pixels >= 1) || pixels > (float)SCALED_MOST)
			return err_report(ERR_USAGE, NULL,
			                  "frame %llu is %ux%u: by %g it has no pixel, or more than %u on a side",
			                  (unsigned long long)scene->frame, scene->width, scene->height, (double)factor,
			                  SCALED_MOST);
		a.by[k] = pixels / size[k];
	}
	err = scale_scene(&a);
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
