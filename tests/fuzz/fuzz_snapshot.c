/* A snapshot whose hashes are not verified, as in an index where someone has corrected them. Input: snapshot.h. */
#include <stdlib.h>

#include "replay/gl/dispatch.h"
#include "replay/index/snapshot.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/snapshot.h"
#include "tests/fuzz/target.h"

#define MOST_MADE ((size_t)1 << 20)

struct file {
	const uint8_t *data;
	size_t size;
};

/* The blob with that name, cut or padded if another size is requested. */
static uint8_t *get(void *user, const uint64_t name[2], size_t n)
{
	struct file rest = *(const struct file *)user;
	struct snapshot_record r;

	while (snapshot_record_next(&rest.data, &rest.size, &r))
		if (r.name[0] == name[0] && r.name[1] == name[1] && (n <= r.n || n <= MOST_MADE)) {
			uint8_t *out = calloc(n ? n : 1, 1);

			return out ? memcpy(out, r.bytes, n < r.n ? n : r.n) : NULL;
		}
	return NULL;
}

static int put(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user, (void)name, (void)data, (void)n;
	return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct file all = { data, size };
	struct snapshot_blobs blobs = { .put = put, .get = get, .user = &all };
	struct snapshot_record state, r;
	struct gls_exec *x = NULL;
	struct bytes again = { 0 };

	if (!snapshot_record_next(&data, &size, &state) || gls_exec_create(&x, "snapshot"))
		return 0;
	if (!snapshot_load(x, &blobs, state.bytes, state.n)) {
		int used = 0;

		snapshot_save(x, &blobs, &again);
		while (!used && snapshot_record_next(&data, &size, &r))
			if (r.name[0] == UINT64_MAX && r.name[1] == UINT64_MAX) {
				calls_go_on(x, r.bytes, r.n, &calls_grey);
				used = 1;
			}
		if (!used)
			calls_go_on(x, NULL, 0, &calls_grey);
	}
	free(again.data);
	gls_exec_destroy(&x);
	return 0;
}
