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

#include "capture/write/content.h"
#include "capture/gl/memory.h"
#include "capture/gl/wrap.h"

enum { N_ENTRIES = 1 << 13, FIRST_NAME = 0x60000000 }; /* names that no program gets from glGenBuffers */
#define MAX_OWNED_BYTES (512l << 20) /* of one context, on replay */
#define MAX_COPIED_BYTES (64l << 20)

struct content_entry {
	XXH128_hash_t hash;
	long bytes;
	unsigned buffer; /* 0: seen once */
};
struct content_table {
	unsigned epoch; /* of the trace that has the buffers */
	long owned_bytes;
	uint8_t *copy; /* the program's memory, read once */
	long copy_bytes;
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

/* Made at need; NULL where there is no memory. */
static struct content_table *make_table(struct content_table **table)
{
	if (*table && (*table)->epoch != writer_epoch())
		content_free(table);
	if (!*table) {
		void *pages = mmap(NULL, sizeof(**table), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

		if (pages == MAP_FAILED)
			return NULL;
		*table = pages;
		(*table)->epoch = writer_epoch();
	}
	return *table;
}

unsigned content_buffer(struct content_table **table, unsigned target, const void *data, long bytes, int *bound)
{
	struct content_entry *entry;
	XXH128_hash_t hash;

	if (!make_table(table))
		return 0;
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

unsigned content_of_memory(struct content_table **table, unsigned target, const void *data, long bytes, int *bound)
{
	struct content_table *t = bytes >= CONTENT_MIN_BYTES && bytes <= MAX_COPIED_BYTES ? make_table(table) : NULL;

	if (!t)
		return 0;
	if (t->copy_bytes < bytes) {
		void *pages = mmap(NULL, (size_t)bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

		if (pages == MAP_FAILED)
			return 0;
		if (t->copy)
			munmap(t->copy, (size_t)t->copy_bytes);
		t->copy = pages;
		t->copy_bytes = bytes;
	}
	memory_read(t->copy, data, (size_t)bytes);
	return content_buffer(table, target, t->copy, bytes, bound);
}

void content_free(struct content_table **table)
{
	if (*table && (*table)->copy)
		munmap((*table)->copy, (size_t)(*table)->copy_bytes);
	if (*table)
		munmap(*table, sizeof(**table));
	*table = NULL;
}
