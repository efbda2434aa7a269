#include "look/draws/pairs.h"

#include <stdlib.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"

/* A hash of the positions of all corners. The other attributes of vertices may differ between draws. */
static uint64_t hash_points(const struct scene_mesh *mesh)
{
	XXH3_state_t state;

	XXH3_64bits_reset(&state);
	for (uint32_t i = 0; i < 3 * mesh->primitive_count; i++)
		XXH3_64bits_update(&state, mesh->position + 4 * mesh->index[i], 16);
	return XXH3_64bits_digest(&state);
}

static uint64_t key_of(const struct pairs *p, const struct scene *s, uint32_t instance, enum modelview_kind kind)
{
	uint64_t parts[2] = { p->points[s->instances[instance].mesh], (uint64_t)kind };

	return XXH3_64bits(parts, sizeof(parts));
}

int pairs_make(struct pairs *p, const struct scene *s)
{
	p->next = malloc((s->n_instances + (size_t)1) * sizeof(*p->next));
	p->points = calloc(s->n_meshes + (size_t)1, sizeof(*p->points));
	if (!p->next || !p->points)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < s->n_meshes; i++)
		p->points[i] = s->meshes[i]->kind == SCENE_TRIANGLES ? hash_points(s->meshes[i]) : 0;
	for (uint32_t i = s->n_instances; i-- > 0;) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *m = &s->materials[in->material];
		uint64_t key = key_of(p, s, i, modelview_kind_of(in->modelview));

		p->next[i] = SCENE_NONE;
		if (s->meshes[in->mesh]->kind != SCENE_TRIANGLES || in->rectangle || s->views[in->view].target ||
		    !(m->color_mask & 7) || !m->depth_test)
			continue;
		p->next[i] = (uint32_t)((uintptr_t)table_find(&p->first, key) - 1);
		if (table_set(&p->first, key, (void *)((uintptr_t)i + 1)))
			return ERR_SYSTEM;
	}
	return 0;
}

void pairs_free(struct pairs *p)
{
	table_free(&p->first);
	free(p->next);
	free(p->points);
}

uint32_t pairs_find(const struct pairs *p, const struct scene *s, uint32_t instance, enum modelview_kind kind)
{
	return (uint32_t)((uintptr_t)table_find(&p->first, key_of(p, s, instance, kind)) - 1);
}
