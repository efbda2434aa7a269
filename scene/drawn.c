/* Finds the instance of a draw by binary search. */
#include "scene/drawn.h"

uint32_t scene_instance_of(const struct scene *scene, uint32_t draw)
{
	uint32_t low = 0, high = scene->n_instances;

	while (low < high) {
		const uint32_t middle = low + (high - low) / 2;

		if (scene->instances[middle].draw <= draw)
			low = middle + 1;
		else
			high = middle;
	}
	return low ? low - 1 : SCENE_NONE;
}
