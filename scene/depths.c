/* Finds draws that write depth and no colour. */
#include "scene/depths.h"

#include <string.h>

#include "gl_tokens.h"
#include "scene/backdrop.h"
#include "scene/scene.h"

/* The first instance whose depth no later clear drops. */
static uint32_t first_kept(const struct scene *s)
{
	uint32_t first = 0;

	for (uint32_t i = 0; i < s->n_clears; i++)
		if (s->clears[i].buffers & 2 && scene_clears_window(s, &s->clears[i]))
			first = s->clears[i].before_instance;
	return first;
}

int scene_is_never_drawn(const struct scene_material *m)
{
	return m->cull_face == GL_FRONT_AND_BACK || (m->depth_test && m->depth_func == GL_NEVER) ||
	       (m->alpha_test && m->alpha_func == GL_NEVER) ||
	       (m->stencil_test && m->stencil_front.func == GL_NEVER && m->stencil_back.func == GL_NEVER);
}

static int is_depth_alone(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_view *view = &s->views[in->view];

	return !(m->color_mask & 7) && !scene_is_never_drawn(m) && m->depth_test && m->depth_write && !m->stencil_test &&
	       (m->depth_func == GL_LESS || m->depth_func == GL_LEQUAL) && view->target == 0 &&
	       view->depth_range[0] != view->depth_range[1] &&
	       s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !in->rectangle;
}

/* 1 if a material's own colour covers what is behind it, wholly or in part; passes that only add light do not. */
static int is_body(const struct scene_material *m)
{
	return m->color_mask & 7 && m->depth_test && (!m->blend || m->blend_dst_rgb == GL_ONE_MINUS_SRC_ALPHA);
}

int scene_is_same_body(const struct scene *s, uint32_t first, uint32_t second)
{
	const struct scene_instance *a = &s->instances[first], *b = &s->instances[second];
	const struct scene_mesh *p = s->meshes[a->mesh], *q = s->meshes[b->mesh];

	return memcmp(a->modelview, b->modelview, sizeof(a->modelview)) == 0 &&
	       (p == q || (p->vertex_count == q->vertex_count && p->primitive_count == q->primitive_count &&
	                   memcmp(p->position, q->position, 4 * sizeof(*p->position) * p->vertex_count) == 0));
}

void scene_find_depths(const struct scene *scene, uint8_t *depths)
{
	uint32_t n = 0;

	for (uint32_t i = first_kept(scene); i < scene->n_instances; i++)
		n += depths[i] = (uint8_t)is_depth_alone(scene, &scene->instances[i]);
	for (uint32_t i = 0; i < scene->n_instances && n; i++)
		for (uint32_t k = 0; k < i && is_body(&scene->materials[scene->instances[i].material]); k++)
			if (depths[k] && scene_is_same_body(scene, i, k))
				depths[k] = 0;
}
