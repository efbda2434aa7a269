#include "look/draws/followed.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"

uint64_t followed_points(const struct scene_mesh *mesh)
{
	return XXH3_64bits_withSeed(mesh->position, mesh->vertex_count * 4 * sizeof(float), mesh->kind);
}

uint64_t followed_triangles(const struct scene_mesh *mesh)
{
	const uint64_t head[3] = { mesh->kind, mesh->vertex_count, mesh->primitive_count };

	return XXH3_64bits_withSeed(mesh->index, (size_t)mesh->primitive_count * mesh->kind * sizeof(*mesh->index),
	                            XXH3_64bits(head, sizeof(head)));
}

/* The key of the next draw with this key; draws with the same key are counted. 0: out of memory (reported) */
static uint64_t next_key(struct table *counts, uint64_t key)
{
	const uintptr_t before = (uintptr_t)table_find(counts, key);
	const uint64_t parts[2] = { key, before };

	return table_set(counts, key, (void *)(before + 1)) ? 0 : XXH3_64bits(parts, sizeof(parts));
}

/* The keys of an instance, as in struct followed. @return 0 or ERR_SYSTEM (reported) */
static int next_keys(struct table *counts, const struct scene *scene, uint32_t i, uint64_t keys[3])
{
	const struct scene_mesh *mesh = scene->meshes[scene->instances[i].mesh];

	keys[0] = next_key(counts, XXH3_64bits(mesh->hash, sizeof(mesh->hash)));
	keys[1] = next_key(counts, followed_points(mesh));
	keys[2] = next_key(counts, followed_triangles(mesh));
	return keys[0] && keys[1] && keys[2] ? 0 : ERR_SYSTEM;
}

int followed_note(struct followed *p, const struct scene *scene)
{
	struct table counts = { 0 };
	int err = 0;

	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		uint64_t keys[3];

		if (scene->instances[i].rectangle)
			continue;
		err = next_keys(&counts, scene, i, keys);
		for (int k = 0; k < 3 && !err; k++)
			err = table_set(&p->by[k], keys[k], (void *)((uintptr_t)i + 1));
	}
	table_free(&counts);
	return err;
}

void followed_free(struct followed *p)
{
	for (int k = 0; k < 3; k++)
		table_free(&p->by[k]);
}

int followed_find(const struct followed *p, const struct scene *scene, uint32_t *out)
{
	struct table counts = { 0 };
	int err = 0;

	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		uintptr_t found = 0;
		uint64_t keys[3];

		out[i] = SCENE_NONE;
		if (scene->instances[i].rectangle)
			continue;
		err = next_keys(&counts, scene, i, keys);
		for (int k = 0; k < 3 && !err && !found; k++)
			found = (uintptr_t)table_find(&p->by[k], keys[k]);
		out[i] = found ? (uint32_t)found - 1 : SCENE_NONE;
	}
	table_free(&counts);
	return err;
}
