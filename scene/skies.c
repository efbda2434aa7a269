#include "scene/skies.h"

#include <stdlib.h>
#include <string.h>

#include "scene/backdrop.h"
#include "scene/depths.h"
#include "scene/scene.h"

/* Whether a clear before an instance drops all depth. next: the first clear that was not looked at */
static int drops_depth(const struct scene *s, uint32_t instance, uint32_t *next)
{
	int drops = 0;

	for (; *next < s->n_clears && s->clears[*next].before_instance <= instance; ++*next)
		drops |= s->clears[*next].buffers & 2 && scene_clears_window(s, &s->clears[*next]);
	return drops;
}

/* Whether an instance colours what was laid into the depth buffer before. */
static int is_laid_before(const struct scene *s, uint32_t instance)
{
	for (uint32_t k = 0; k < instance; k++) {
		const struct scene_material *m = &s->materials[s->instances[k].material];

		if (!(m->color_mask & 7) && m->depth_test && m->depth_write && scene_is_same_body(s, instance, k))
			return 1;
	}
	return 0;
}

int scene_find_skies(const struct scene *scene, uint8_t *skies)
{
	uint32_t *space = malloc((scene->n_views + (size_t)1) * sizeof(*space)); /* the first view with the same one */
	uint8_t *deep = calloc(scene->n_views + (size_t)1, 1);
	uint32_t clear = 0;

	for (uint32_t v = 0; v < scene->n_views && space && deep; v++) {
		space[v] = 0;
		while (scene->views[space[v]].space != scene->views[v].space)
			space[v]++;
	}
	for (uint32_t i = 0; i < scene->n_instances && space && deep; i++) {
		const struct scene_instance *instance = &scene->instances[i];
		const struct scene_material *m = &scene->materials[instance->material];

		if (drops_depth(scene, i, &clear))
			memset(deep, 0, scene->n_views);
		if (m->depth_test && m->depth_write && m->color_mask & 7 && !scene_is_never_drawn(m))
			deep[space[instance->view]] = 1;
		skies[i] = !deep[space[instance->view]] && (m->color_mask & 7) && !m->stencil_test &&
		           scene->views[instance->view].projection[11] != 0 && !is_laid_before(scene, i);
	}
	free(deep);
	free(space);
	return space && deep ? 0 : -1;
}
