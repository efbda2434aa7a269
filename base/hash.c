#include "base/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"

#define NAMED_BYTES ((uint64_t)1 << 20)

void hash_bytes(const void *data, size_t n, uint64_t out[2])
{
	XXH128_hash_t hash = XXH3_128bits(data, n);

	out[0] = hash.low64;
	out[1] = hash.high64;
}

int hash_file(const char *path, uint64_t limit, XXH3_state_t *state)
{
	static _Thread_local char piece[1 << 16];
	int file = open(path, O_RDONLY | O_CLOEXEC), rc = 0;
	ssize_t n = file < 0 ? -1 : 1;

	while (n > 0 && limit) {
		n = read(file, piece, limit < sizeof(piece) ? (size_t)limit : sizeof(piece));
		if (n > 0) {
			XXH3_128bits_update(state, piece, (size_t)n);
			limit -= (uint64_t)n;
		}
	}
	if (n < 0)
		rc = err_report(ERR_INPUT, path, "cannot be read: %s", strerror(errno));
	if (file >= 0)
		close(file);
	return rc;
}

/* The bytes of a file up to a limit, then `more`. */
static int digest(const char *path, uint64_t limit, const void *more, size_t n, XXH128_hash_t *hash)
{
	XXH3_state_t *state = XXH3_createState();
	int rc = state ? 0 : err_report(ERR_SYSTEM, path, "out of memory");

	if (!rc) {
		XXH3_128bits_reset(state);
		rc = hash_file(path, limit, state);
	}
	if (!rc) {
		XXH3_128bits_update(state, more, n);
		*hash = XXH3_128bits_digest(state);
	}
	XXH3_freeState(state);
	return rc;
}

int hash_whole(const char *path, uint64_t out[2])
{
	XXH128_hash_t hash = { 0, 0 };
	int rc = digest(path, UINT64_MAX, "", 0, &hash);

	out[0] = hash.low64;
	out[1] = hash.high64;
	return rc;
}

void hash_text(const uint64_t hash[2], char out[33])
{
	snprintf(out, 33, "%016llx%016llx", (unsigned long long)hash[1], (unsigned long long)hash[0]);
}

int hash_name(const char *path, uint64_t size, char out[33])
{
	XXH128_hash_t hash;
	int rc = digest(path, NAMED_BYTES, &size, sizeof(size), &hash);

	if (!rc)
		hash_text((const uint64_t[2]){ hash.low64, hash.high64 }, out);
	return rc;
}
