#include "tracer/frame/common/picture_kept.h"

#include <stdlib.h>
#include <string.h>

/* Copy a picture's planes from another of the same size; `to` has at least the planes of `from`. */
static void copy_planes(struct scene_picture *to, const struct scene_picture *from, size_t n)
{
	memcpy(to->rgba, from->rgba, 4 * n); /* NOLINT(clang-analyzer-core.NullDereference): both have planes */
	memcpy(to->depth, from->depth, n * sizeof(*to->depth));
	memcpy(to->stencil, from->stencil, n);
	if (to->colors)
		memcpy(to->colors, from->colors, 4 * n * sizeof(*to->colors));
	to->unknown = from->unknown;
}

void picture_free(struct scene_picture *p)
{
	for (int i = 0; p && p->samples && i < SCENE_SAMPLES; i++) {
		free(p->samples[i].rgba);
		free(p->samples[i].depth);
		free(p->samples[i].stencil);
		free(p->samples[i].colors);
	}
	if (p) {
		free(p->samples);
		free(p->rgba);
		free(p->depth);
		free(p->stencil);
		free(p->colors);
	}
	free(p);
}

/* Allocate the planes of a scene's picture. @return 0: out of memory */
static int reserve_planes(const struct scene *scene, struct scene_picture *p)
{
	const size_t n = (size_t)scene->width * scene->height;

	p->width = scene->width;
	p->height = scene->height;
	p->depth_bits = scene->depth_bits > 24 ? 24 : scene->depth_bits;
	p->rgba = malloc(4 * n);
	p->depth = malloc(n * sizeof(*p->depth));
	p->stencil = malloc(n);
	p->colors = scene->floats ? malloc(4 * n * sizeof(*p->colors)) : NULL;
	return p->rgba && p->depth && p->stencil && (p->colors || !scene->floats);
}

struct scene_picture *picture_blank(const struct scene *scene)
{
	struct scene_picture *p = calloc(1, sizeof(*p));
	int enough = p && reserve_planes(scene, p);

	if (enough && scene->samples > 1)
		enough = (p->samples = calloc(SCENE_SAMPLES, sizeof(*p->samples))) != NULL;
	for (int i = 0; enough && p->samples && i < SCENE_SAMPLES; i++)
		enough = reserve_planes(scene, &p->samples[i]);
	if (enough)
		return p;
	picture_free(p);
	return NULL;
}

/* 1 if all pixels of a scene are known. */
static int is_whole(const struct scene *scene)
{
	return scene->start || !scene->needs_previous || scene->is_first;
}

void picture_keep(struct picture_kept *kept, const struct scene *scene, const struct scene_picture *picture)
{
	size_t n = (size_t)scene->width * scene->height;

	picture_kept_free(kept);
	if (!scene->serial)
		return;
	kept->picture = picture_blank(scene);
	if (!kept->picture)
		return;
	copy_planes(kept->picture, picture, n);
	for (int i = 0; i < SCENE_SAMPLES && picture->samples; i++)
		copy_planes(&kept->picture->samples[i], &picture->samples[i], n);
	kept->serial = scene->serial;
	kept->n_instances = scene->n_instances;
	kept->n_clears = scene->n_clears;
	kept->is_start_there = scene->start != NULL;
	kept->is_whole = is_whole(scene);
}

/* 1 if the kept picture belongs to this scene. The scene and its window may have grown since. */
static int is_of(const struct picture_kept *kept, const struct scene *scene)
{
	const struct scene_picture *p = kept->picture;

	return p && kept->serial == scene->serial && kept->is_start_there == (scene->start != NULL) &&
	       p->width == scene->width && p->height == scene->height;
}

int picture_recall(const struct picture_kept *kept, const struct scene *scene, struct scene_picture *picture)
{
	size_t n = (size_t)scene->width * scene->height;
	const struct scene_picture *p = kept->picture;

	if (!is_of(kept, scene) || kept->n_instances != scene->n_instances || kept->n_clears != scene->n_clears ||
	    (picture->colors && !p->colors) || (picture->samples && !p->samples))
		return 0;
	copy_planes(picture, p, n);
	for (int i = 0; i < SCENE_SAMPLES && picture->samples; i++)
		copy_planes(&picture->samples[i], &p->samples[i], n);
	return 1;
}

int picture_rest(const struct picture_kept *kept, const struct scene *scene, struct scene *rest)
{
	const struct scene_picture *p = kept->picture;
	const uint32_t n_clears = scene->n_clears - kept->n_clears;

	/* Pictures have at most 24 bits of depth. */
	if (!is_of(kept, scene) || !kept->is_whole || !is_whole(scene) || scene->depth_bits > 24 ||
	    kept->n_instances > scene->n_instances || kept->n_clears > scene->n_clears)
		return 0;
	*rest = *scene;
	rest->instances += kept->n_instances;
	rest->n_instances -= kept->n_instances;
	rest->clears = malloc((n_clears + (size_t)1) * sizeof(*rest->clears));
	rest->n_clears = n_clears;
	rest->start = p;
	rest->needs_previous = 1;
	for (uint32_t i = 0; i < n_clears && rest->clears; i++) {
		rest->clears[i] = scene->clears[kept->n_clears + i];
		rest->clears[i].before_instance -= kept->n_instances;
	}
	return rest->clears != NULL;
}

void picture_kept_free(struct picture_kept *kept)
{
	picture_free(kept->picture);
	*kept = (struct picture_kept){ .picture = NULL };
}
