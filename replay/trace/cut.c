#include "replay/trace/cut.h"

#include <string.h>

#include "base/err.h"
#include "base/hash.h"

void trace_warn_cut(const char *path, uint64_t call)
{
	static _Thread_local uint64_t warned[2]; /* the hash of the last path */
	uint64_t hash[2];

	hash_bytes(path, strlen(path), hash);
	if (memcmp(hash, warned, sizeof(warned)) == 0)
		return;
	memcpy(warned, hash, sizeof(warned));
	err_warn(path, "the file is cut short after call %llu; frames before it are whole, and 'relume repair' saves them",
	         (unsigned long long)call);
}
