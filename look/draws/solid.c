#include "look/draws/solid.h"

#include "scene/backdrop.h"

int solid_is(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_view *view = &s->views[in->view];

	return (uint32_t)(in - s->instances) >= scene_backdrop(s) && m->depth_test && m->depth_write &&
	       m->color_mask & 7 && !in->rectangle && view->target == 0 &&
	       s->meshes[in->mesh]->kind == SCENE_TRIANGLES && view->depth_range[0] != view->depth_range[1];
}
