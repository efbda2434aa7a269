#include "scene/backdrop.h"

#include "scene/scene.h"

int scene_clears_window(const struct scene *s, const struct scene_clear *c)
{
	return c->target == 0 && c->scissor[0] <= 0 && c->scissor[1] <= 0 &&
	       c->scissor[0] + c->scissor[2] >= (int32_t)s->width &&
	       c->scissor[1] + c->scissor[3] >= (int32_t)s->height;
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
