/*
 * Runs inside the traced program. The same bytes drawn again and again are stored once: in a buffer object of the recorder's
 * own, which exists only in the trace.
 *
 * A content gets its buffer when it is seen for the second time, so that vertices that change every frame make none, and
 * replaying a long recording does not fill the GL with buffers that are used once. Contents are known by a 128-bit hash,
 * for each context apart (contexts need not share objects).
 */
#define XXH_INLINE_ALL
#include <GL/gl.h>
#include <GL/glext.h>
#include <sys/mman.h>
#include <xxhash.h>

#include "capture/content.h"
#include "capture/wrap.h"

enum { N_ENTRIES = 1 << 13, FIRST_NAME = 0x60000000 }; /* names that no program gets from glGenBuffers */
#define MAX_OWNED_BYTES (512l << 20) /* of one context, on replay */

struct content_entry {
	XXH128_hash_t hash;
	long bytes;
	unsigned buffer; /* 0: seen once */
};
struct content_table {
	unsigned epoch; /* of the trace that has the buffers */
	long owned_bytes;
	struct content_entry entries[N_ENTRIES];
};

static _Atomic unsigned next_name = FIRST_NAME;

void content_bind(unsigned target, unsigned buffer)
{
	uint8_t *p = writer_enter_fake(CMD_glBindBuffer);

	if (!p)
		return;
	p = put_enum(put_argument(p, 0), target);
	p = put_uint(put_argument(p, 1), buffer);
	writer_call_end(p);
}

unsigned content_new_buffer(void)
{
	unsigned name = next_name++;
	uint8_t *p = writer_enter_fake(CMD_glGenBuffers);
	uint64_t call;

	if (!p)
		return name;
	p = put_sint(put_argument(p, 0), 1);
	call = writer_enter_end(p);
	p = writer_leave(call);
	if (!p)
		return name;
	p = put_array_u32(put_argument(p, 1), &name, 1);
	writer_leave_end(p);
	return name;
}

void content_data(unsigned target, const void *data, long bytes)
{
	uint8_t *p = writer_enter_fake(CMD_glBufferData);

	if (!p)
		return;
	p = put_enum(put_argument(p, 0), target);
	p = put_sint(put_argument(p, 1), bytes);
	p = put_own_blob(put_argument(p, 2), data, bytes);
	p = put_enum(put_argument(p, 3), GL_STATIC_DRAW);
	writer_call_end(p);
}

unsigned content_buffer(struct content_table **table, unsigned target, const void *data, long bytes, int *bound)
{
	struct content_entry *entry;
	XXH128_hash_t hash;

	if (*table && (*table)->epoch != writer_epoch())
		content_free(table);
	if (!*table) {
		void *pages = mmap(NULL, sizeof(**table), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

		if (pages == MAP_FAILED)
			return 0;
		*table = pages;
		(*table)->epoch = writer_epoch();
	}
	hash = XXH3_128bits(data, (size_t)bytes);
	entry = &(*table)->entries[hash.low64 % N_ENTRIES];
	if (entry->bytes != bytes || !XXH128_isEqual(entry->hash, hash)) {
		*entry = (struct content_entry){ hash, bytes, 0 }; /* a buffer that lived here is forgotten, not wrong */
		return 0;
	}
	if (!entry->buffer && (*table)->owned_bytes + bytes <= MAX_OWNED_BYTES) {
		entry->buffer = content_new_buffer();
		(*table)->owned_bytes += bytes;
		content_bind(target, entry->buffer);
		content_data(target, data, bytes);
		*bound = 1;
	}
	return entry->buffer;
}

void content_free(struct content_table **table)
{
	if (*table)
		munmap(*table, sizeof(**table));
	*table = NULL;
}
