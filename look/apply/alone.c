#include "look/apply/alone.h"

#include <stdio.h>

#include "base/err.h"
#include "base/hash.h"
#include "look/apply/match.h"

/* Bits for the keys that a candidate combines. */
enum { TEXTURE = 1, MESH = 2, LIST = 4, DRAWS = 8 };

static void write_hash(const char *key, const uint64_t hash[2], char *out, size_t size)
{
	char text[33];

	hash_text(hash, text);
	snprintf(out, size, "%s: \"%s\", ", key, text);
}

/* Write the keys in `which` for an instance, as YAML. */
static void write_keys(const struct scene *scene, const struct scene_instance *in, int which, char keys[ALONE_BYTES])
{
	const struct scene_material *m = &scene->materials[in->material];
	char texture[64] = "", mesh[64] = "", list[32] = "", draws[32] = "";
	/* the last of several, since the first may be a shadow or light shared with other surfaces */
	const uint32_t last = m->unit_first + m->unit_count - 1;
	int n;

	if (which & TEXTURE)
		write_hash("texture", scene->textures[scene->units[last].texture]->hash, texture, sizeof(texture));
	if (which & MESH)
		write_hash("mesh", scene->meshes[in->mesh]->hash, mesh, sizeof(mesh));
	if (which & LIST)
		snprintf(list, sizeof(list), "list: %u, ", scene->draws[in->draw].list);
	if (which & DRAWS)
		snprintf(draws, sizeof(draws), "draws: \"%u\", ", in->draw);
	n = snprintf(keys, ALONE_BYTES, "{ %s%s%s%s", texture, mesh, list, draws);
	snprintf(keys + n - 2, ALONE_BYTES - (size_t)n + 2, " }"); /* replaces the last comma */
}

/* Count the instances that a rule with these keys matches, read as rules are. @return their number, or ERR_SYSTEM
 * (reported) */
static int count_matches(const struct scene *scene, const char *keys)
{
	struct applying a = { .scene = scene };
	struct look *look = NULL;
	char text[ALONE_BYTES + 64];
	const int n = snprintf(text, sizeof(text), "surfaces:\n  - match: %s\n", keys);
	int err = rules_parse("the rule", text, (size_t)n, &look), found = 0;

	if (err)
		return err;
	a.look = look;
	err = match_begin(&a);
	for (uint32_t i = 0; i < scene->n_instances && !err; i++)
		found += match_applies(&a, &scene->instances[i], 0);
	match_end(&a);
	rules_free(&look);
	return err ? err : found;
}

int alone_find(const struct scene *scene, uint32_t instance, char keys[ALONE_BYTES])
{
	static const int candidates[] = { TEXTURE, MESH, TEXTURE | MESH, TEXTURE | MESH | LIST };
	const struct scene_instance *in = &scene->instances[instance];
	const int has = (scene->materials[in->material].unit_count ? TEXTURE : 0) | MESH |
	                (scene->draws[in->draw].list ? LIST : 0);
	int matched = 0;

	for (size_t i = 0; i < sizeof(candidates) / sizeof(candidates[0]); i++) {
		if (candidates[i] & ~has)
			continue;
		write_keys(scene, in, candidates[i], keys);
		matched = count_matches(scene, keys);
		if (matched <= 1)
			return matched < 0 ? matched : 0;
	}
	write_keys(scene, in, has | DRAWS, keys);
	return matched - 1;
}
