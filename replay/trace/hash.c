#include "replay/trace/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"

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

int hash_whole(const char *path, uint64_t out[2])
{
	XXH3_state_t *state = XXH3_createState();
	XXH128_hash_t hash;
	int rc = state ? 0 : err_report(ERR_SYSTEM, path, "out of memory");

	if (!rc) {
		XXH3_128bits_reset(state);
		rc = hash_file(path, UINT64_MAX, state);
	}
	if (!rc) {
		hash = XXH3_128bits_digest(state);
		out[0] = hash.low64;
		out[1] = hash.high64;
	}
	XXH3_freeState(state);
	return rc;
}
