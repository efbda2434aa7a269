#include "scene/skies.h"

#include <stdlib.h>

#include "scene/backdrop.h"
#include "scene/scene.h"

int scene_find_skies(const struct scene *scene, uint8_t *skies)
{
	uint32_t *space = malloc((scene->n_views + (size_t)1) * sizeof(*space)); /* the first view with the same one */
	uint8_t *deep = calloc(scene->n_views + (size_t)1, 1);
	const uint32_t backdrop = scene_backdrop(scene);

	for (uint32_t v = 0; v < scene->n_views && space && deep; v++) {
		space[v] = 0;
		while (scene->views[space[v]].space != scene->views[v].space)
			space[v]++;
	}
	for (uint32_t i = 0; i < scene->n_instances && space && deep; i++) {
		const struct scene_instance *instance = &scene->instances[i];
		const struct scene_material *m = &scene->materials[instance->material];

		if (m->depth_test && m->depth_write && i >= backdrop)
			deep[space[instance->view]] = 1;
		skies[i] = !deep[space[instance->view]] && (m->color_mask & 7) && !m->stencil_test &&
		           scene->views[instance->view].projection[11] != 0;
	}
	free(deep);
	free(space);
	return space && deep ? 0 : -1;
}
