/* Finds the draws that are a frame's sky. */
#include "scene/skies.h"

#include <stdlib.h>
#include <string.h>

#include "scene/backdrop.h"
#include "scene/depths.h"
#include "scene/scene.h"

/* 1 if a clear before an instance drops all depth. next: the first clear not yet examined */
static int drops_depth(const struct scene *s, uint32_t instance, uint32_t *next)
{
	int drops = 0;

	for (; *next < s->n_clears && s->clears[*next].before_instance <= instance; ++*next)
		drops |= s->clears[*next].buffers & 2 && scene_clears_window(s, &s->clears[*next]);
	return drops;
}

/* Instances so far that wrote depth without colour. */
struct laid {
	uint32_t *instances, n;
};

static int lays_depth(const struct scene_material *m)
{
	return !(m->color_mask & 7) && m->depth_test && m->depth_write;
}

static int is_laid(const struct scene *s, const struct laid *laid, uint32_t instance)
{
	uint32_t k = 0;

	while (k < laid->n && !scene_is_same_body(s, instance, laid->instances[k]))
		k++;
	return k < laid->n;
}

static size_t count_spaces(const struct scene *s)
{
	size_t n = 0;

	for (uint32_t v = 0; v < s->n_views; v++)
		n = s->views[v].space >= n ? s->views[v].space + (size_t)1 : n;
	return n;
}

int scene_find_skies(const struct scene *scene, uint8_t *skies)
{
	const size_t n_spaces = count_spaces(scene);
	uint8_t *deep = calloc(n_spaces + 1, 1); /* [space]: 1 if something in it leaves colour and depth */
	struct laid laid = { malloc((scene->n_instances + (size_t)1) * sizeof(*laid.instances)), 0 };
	const int has_room = deep && laid.instances;
	const uint32_t backdrop = scene_backdrop(scene);
	uint32_t clear = 0;

	for (uint32_t i = 0; i < scene->n_instances && has_room; i++) {
		const struct scene_material *m = &scene->materials[scene->instances[i].material];
		const struct scene_view *view = &scene->views[scene->instances[i].view];

		if (drops_depth(scene, i, &clear))
			memset(deep, 0, n_spaces);
		if (i >= backdrop && m->depth_test && m->depth_write && m->color_mask & 7 && !scene_is_never_drawn(m))
			deep[view->space] = 1;
		skies[i] = !deep[view->space] && (m->color_mask & 7) && !m->stencil_test &&
		           view->projection[11] != 0 && !is_laid(scene, &laid, i);
		if (lays_depth(m))
			laid.instances[laid.n++] = i;
	}
	free(laid.instances);
	free(deep);
	return has_room ? 0 : -1;
}
