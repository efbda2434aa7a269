#include "look/spare/carved.h"

#include "gl_tokens.h"
#include "scene/depths.h"

static const struct scene_material *material_of(const struct scene *s, uint32_t i)
{
	return &s->materials[s->instances[i].material];
}

/* 1 if a draw writes the depth of every visible part of its body. */
static int leaves_whole(const struct scene_material *m)
{
	return m->depth_test && m->depth_write && m->depth_func != GL_EQUAL && !m->alpha_test && !m->stencil_test &&
	       !m->fragment_program && !scene_is_never_drawn(m);
}

static int has_whole(const struct scene *s, uint32_t i)
{
	for (uint32_t k = i; k-- > 0;)
		if (leaves_whole(material_of(s, k)) && scene_is_same_body(s, k, i))
			return 1;
	return 0;
}

uint32_t carved_find(const struct scene *s, uint32_t *bits)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_material *m = material_of(s, i);

		if (!m->depth_test || m->depth_func != GL_EQUAL || s->instances[i].rectangle || has_whole(s, i))
			continue;
		bits[i] |= SCENE_FILM;
		n++;
	}
	return n;
}
