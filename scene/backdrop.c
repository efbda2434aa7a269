/* Finds a frame's backdrop: the draws before a clear that drops their depth and keeps their colours. */
#include "scene/backdrop.h"

#include "scene/scene.h"

int scene_is_whole(const struct scene *s, const int32_t part[4])
{
	return part[0] <= 0 && part[1] <= 0 && part[0] + part[2] >= (int32_t)s->width &&
	       part[1] + part[3] >= (int32_t)s->height;
}

int scene_clears_window(const struct scene *s, const struct scene_clear *c)
{
	return c->target == 0 && scene_is_whole(s, c->scissor);
}

uint32_t scene_backdrop(const struct scene *s)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < s->n_clears; i++) {
		const struct scene_clear *c = &s->clears[i];

		if ((c->buffers & 3) == 2 && scene_clears_window(s, c) &&
		    2 * (uint64_t)c->before_instance < s->n_instances)
			n = c->before_instance;
	}
	return n;
}
