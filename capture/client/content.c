/* Runs inside the traced program. */
#define XXH_INLINE_ALL
#include "capture/client/content.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <sys/mman.h>
#include <xxhash.h>

#include "capture/gl/context.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "tables/commands.h"

enum { N_ENTRIES = 1 << 13, FIRST_NAME = 0x60000000 }; /* names that no program gets from glGenBuffers */
#define MAX_OWNED_BYTES (512l << 20) /* per context, on replay */
#define MAX_COPIED_BYTES (64l << 20)

struct content_entry {
	XXH128_hash_t hash;
	long bytes;
	unsigned buffer; /* 0: seen once */
};
struct content_table {
	unsigned epoch; /* the trace that has the buffers */
	long owned_bytes;
	uint8_t *copy; /* the program's memory, read once */
	size_t copy_bytes;
	struct content_entry entries[N_ENTRIES];
};

static _Atomic unsigned next_name = FIRST_NAME;

void content_bind(unsigned target, unsigned buffer)
{
	fake_call(CMD_glBindBuffer, "eu", target, buffer);
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
	fake_call(CMD_glBufferData, "elbe", target, bytes, data, bytes, GL_STATIC_DRAW);
}

static void release(void *data)
{
	struct content_table *t = data;

	if (t->copy)
		munmap(t->copy, t->copy_bytes);
	munmap(t, sizeof(*t));
}

/* The current context's table, created on demand; NULL: out of memory. */
static struct content_table *current_table(void)
{
	struct content_table *t = context_data(CONTEXT_CONTENTS);

	if (t && t->epoch == writer_epoch())
		return t;
	if (t)
		release(t);
	t = pages_map(sizeof(*t));
	if (t)
		t->epoch = writer_epoch();
	context_set_data(CONTEXT_CONTENTS, t, release);
	return t;
}

unsigned content_buffer(unsigned target, const void *data, long bytes, int *bound)
{
	struct content_table *t = current_table();
	struct content_entry *entry;
	XXH128_hash_t hash;

	if (!t)
		return 0;
	hash = XXH3_128bits(data, (size_t)bytes);
	entry = &t->entries[hash.low64 % N_ENTRIES];
	if (entry->bytes != bytes || !XXH128_isEqual(entry->hash, hash)) {
		*entry = (struct content_entry){ hash, bytes, 0 }; /* a buffer that was in this entry is forgotten, but
		                                                      remains valid */
		return 0;
	}
	if (!entry->buffer && t->owned_bytes + bytes <= MAX_OWNED_BYTES) {
		entry->buffer = content_new_buffer();
		t->owned_bytes += bytes;
		content_bind(target, entry->buffer);
		content_data(target, data, bytes);
		*bound = 1;
	}
	return entry->buffer;
}

unsigned content_of_memory(unsigned target, const void *data, long bytes, int *bound)
{
	struct content_table *t = bytes >= CONTENT_MIN_BYTES && bytes <= MAX_COPIED_BYTES ? current_table() : NULL;

	if (!t || !pages_grow(&t->copy, &t->copy_bytes, (size_t)bytes))
		return 0;
	pages_read(t->copy, data, (size_t)bytes);
	return content_buffer(target, t->copy, bytes, bound);
}
