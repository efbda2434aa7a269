#include "replay/index/snapshot_layout.h"

#include <string.h>
#include <xxhash.h>

#include "layout.h"
#include "replay/machine/commands.h"
#include "replay/index/snapshot_parts.h"

#define FORM 1 /* raise it if the meaning of snapshots changes though no struct does */

uint64_t snapshot_layout(void)
{
#define SINGLE(type, member) { #type "." #member, 0, sizeof(((struct type *)0)->member) },
#define PLACED(type, member, element) \
	{ #type "." #member, offsetof(struct type, member), sizeof(((struct type *)0)->member) },
	static const struct {
		const char *name;
		size_t offset, bytes;
	} members[] = { SNAPSHOT_MEMBERS(PLACED, SINGLE) };
	XXH64_hash_t hash = FORM;

	for (size_t i = 0; i < sizeof(members) / sizeof(members[0]); i++) {
		const uint64_t place[] = { members[i].offset, members[i].bytes };

		hash = XXH3_64bits_withSeed(members[i].name, strlen(members[i].name), hash);
		hash = XXH3_64bits_withSeed(place, sizeof(place), hash);
	}
	for (unsigned i = 0; i < n_gls_commands; i++)
		hash = XXH3_64bits_withSeed(gls_commands[i].name, strlen(gls_commands[i].name), hash);
	return hash;
}
