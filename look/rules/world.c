#include "look/rules/world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "base/mat4.h"
#include "look/rules/rules.h"

enum { MAX_VOTES = 256 }; /* one for each time that a frame draws an anchor */

int world_hash_begins(const uint64_t hash[2], const char *text)
{
	char whole[33];

	hash_text(hash, whole);
	return strncmp(whole, text, strlen(text)) == 0;
}

/* 1 if two matrices place things alike, up to the rounding of float products. */
static int agree(const float a[16], const float b[16])
{
	float far = 1;

	for (int i = 12; i < 15; i++)
		far = fmaxf(far, fmaxf(fabsf(a[i]), fabsf(b[i])));
	for (int i = 0; i < 16; i++)
		if (!(fabsf(a[i] - b[i]) <= (i < 12 ? 2e-3f : 2e-3f * far)))
			return 0;
	return 1;
}

int world_find(const struct rules *rules, const struct scene *scene, float eye_from_world[16], uint32_t *part)
{
	float votes[MAX_VOTES][16]; /* eye_from_world by each anchor */
	uint32_t parts[MAX_VOTES];
	int n = 0, best = 0, most = 0;

	for (uint32_t a = 0; a < rules->world_count; a++) {
		float world_from_mesh[16];

		if (!mat4_invert(world_from_mesh, rules->world[a].at))
			continue;
		for (uint32_t i = 0; i < scene->n_instances && n < MAX_VOTES; i++)
			if (world_hash_begins(scene->meshes[scene->instances[i].mesh]->hash, rules->world[a].mesh)) {
				parts[n] = rules->world[a].part ? *rules->world[a].part : 0;
				mat4_mul(votes[n++], scene->instances[i].modelview, world_from_mesh);
			}
	}
	for (int i = 0; i < n; i++) {
		int same = 0;

		for (int k = 0; k < n; k++)
			same += parts[i] == parts[k] && agree(votes[i], votes[k]);
		if (same > most) {
			most = same;
			best = i;
		}
	}
	if (n)
		memcpy(eye_from_world, votes[best], sizeof(votes[best]));
	if (n && part)
		*part = parts[best];
	return n > 0;
}
