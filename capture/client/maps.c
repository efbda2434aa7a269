/* Runs inside the traced program. */
#include "capture/client/maps.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <pthread.h>
#include <string.h>
#include <sys/mman.h>

#include "capture/client/watch.h"
#include "capture/gl/context.h"
#include "capture/write/pages.h"
#include "capture/write/report.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "real.h"

enum { MAX_MAPS = 256, BLOCK = 1 << 14, MAX_PIECES = 8 };

struct map {
	const uint8_t *data; /* NULL: the slot is free */
	long bytes;
	uint8_t *copy;       /* the content in the trace */
	const void *context; /* the one that mapped it */
	unsigned epoch;      /* the trace that has it */
	struct watch watch;
	unsigned looks;      /* while it is not watched */
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct map maps[MAX_MAPS];
static _Atomic int n_maps;

/* `own`: 1 if `from` is the recorder's own memory, not the program's. */
static void record_memory(const uint8_t *to, const uint8_t *from, long bytes, int own)
{
	uint8_t *p = to && bytes > 0 ? writer_enter_memcpy() : NULL;

	if (!p)
		return;
	p = put_opaque(put_argument(p, 0), to);
	p = own ? put_own_blob(put_argument(p, 1), from, bytes) : put_blob(put_argument(p, 1), from, bytes);
	p = put_uint(put_argument(p, 2), (uint64_t)bytes);
	writer_call_end(p);
}

/* Persistent mappings, under the lock */

static void drop(struct map *m)
{
	watch_end(&m->watch);
	munmap(m->copy, (size_t)m->bytes);
	memset(m, 0, sizeof(*m));
	n_maps--;
}

static struct map *find(const void *data)
{
	for (int i = 0; i < MAX_MAPS; i++)
		if (maps[i].data == data)
			return &maps[i];
	return NULL;
}

/* Write and copy the differences in [from, end): in each block, from the first differing byte to the last. */
static void compare(struct map *m, long from, long end)
{
	uint8_t now[BLOCK];

	for (long at = from; at < end; at += BLOCK) {
		long n = end - at < BLOCK ? end - at : BLOCK, first = 0;

		pages_read(now, m->data + at, (size_t)n);
		if (memcmp(now, m->copy + at, (size_t)n) == 0)
			continue;
		while (now[first] == m->copy[at + first])
			first++;
		while (now[n - 1] == m->copy[at + n - 1])
			n--;
		memcpy(m->copy + at + first, now + first, (size_t)(n - first));
		record_memory(m->data + at + first, m->copy + at + first, n - first, 1);
	}
}

static void compare_watched(struct map *m)
{
	long first = (long)(m->watch.first - (uintptr_t)m->data), end = (long)(m->watch.end - (uintptr_t)m->data);
	struct watch written[MAX_PIECES];
	int n = watch_take_written(&m->watch, m->watch.first, m->watch.end, written, MAX_PIECES);

	if (n < 0) {
		watch_end(&m->watch);
		compare(m, 0, m->bytes);
		return;
	}
	compare(m, 0, first);
	for (int i = 0; i < n; i++)
		compare(m, (long)(written[i].first - (uintptr_t)m->data), (long)(written[i].end - (uintptr_t)m->data));
	compare(m, end, m->bytes);
}

static void write_changes(struct map *m)
{
	if (m->watch.end) {
		compare_watched(m);
		return;
	}
	/* Only touched pages can be watched: try after one look, two, four, and so on. */
	m->looks++;
	if ((m->looks & (m->looks - 1)) == 0)
		watch_begin(&m->watch, m->data, m->data + m->bytes);
	compare(m, 0, m->bytes);
}

static void end_all_of(void *context)
{
	pthread_mutex_lock(&lock);
	for (int i = 0; i < MAX_MAPS; i++)
		if (maps[i].data && maps[i].context == context)
			drop(&maps[i]);
	pthread_mutex_unlock(&lock);
}

static void begin(struct map *m, const void *data, long bytes)
{
	void *copy = pages_map((size_t)bytes);

	if (!copy) {
		report_say("no memory to follow a mapped buffer of %ld bytes; what is written there is not recorded", bytes);
		return;
	}
	*m = (struct map){ .data = data, .bytes = bytes, .copy = copy, .context = context_current(), .epoch = writer_epoch() };
	n_maps++;
	context_set_data(CONTEXT_MAPS, (void *)(uintptr_t)m->context, end_all_of);
	pages_read(copy, data, (size_t)bytes);
	record_memory(m->data, m->copy, bytes, 1);
}

void maps_begun(const void *data, long bytes, unsigned access)
{
	struct map *m;

	if (!data || bytes <= 0 || !writer_active() || !context_current() || !(access & GL_MAP_PERSISTENT_BIT) ||
	    !(access & GL_MAP_WRITE_BIT) || (access & GL_MAP_FLUSH_EXPLICIT_BIT))
		return;
	pthread_mutex_lock(&lock);
	m = find(data);
	if (m)
		drop(m); /* it has ended unnoticed */
	m = find(NULL);
	if (m)
		begin(m, data, bytes);
	else
		report_say("more than %d mapped buffers at a time; what is written to the others is not recorded", MAX_MAPS);
	pthread_mutex_unlock(&lock);
}

void maps_read(void)
{
	if (!n_maps || !writer_active())
		return;
	pthread_mutex_lock(&lock);
	for (int i = 0; i < MAX_MAPS; i++) {
		if (maps[i].data && maps[i].epoch != writer_epoch())
			drop(&maps[i]);
		else if (maps[i].data)
			write_changes(&maps[i]);
	}
	pthread_mutex_unlock(&lock);
}

/* Write all of a persistent mapping and forget it. @return 0 if it was not one */
static int ended(const void *data)
{
	struct map *m;

	if (!n_maps)
		return 0;
	pthread_mutex_lock(&lock);
	m = find(data);
	if (m) {
		if (m->epoch == writer_epoch())
			compare(m, 0, m->bytes);
		drop(m);
	}
	pthread_mutex_unlock(&lock);
	return m != NULL;
}

/* Mappings as GL knows them */

static int buffer_get(unsigned target, unsigned pname)
{
	int value = 0;

	real_glGetBufferParameteriv(target, pname, &value);
	return value;
}

/* The address that the target's buffer is mapped to. */
static const uint8_t *mapped_at(unsigned target)
{
	void *data = NULL;

	real_glGetBufferPointerv(target, GL_BUFFER_MAP_POINTER, &data);
	return data;
}

void maps_buffers_deleted(int n, const unsigned *names)
{
	int bound;

	if (!n_maps || n <= 0 || !names || !context_has(HAS_DESKTOP))
		return;
	context_errors_before();
	bound = context_get(GL_ARRAY_BUFFER_BINDING);
	for (int i = 0; i < n; i++) {
		const uint8_t *data;

		if (!names[i] || !real_glIsBuffer(names[i]))
			continue;
		real_glBindBuffer(GL_ARRAY_BUFFER, names[i]);
		data = mapped_at(GL_ARRAY_BUFFER);
		if (data)
			ended(data);
	}
	real_glBindBuffer(GL_ARRAY_BUFFER, (unsigned)bound);
	context_errors_after();
}

void maps_unmapped(unsigned target)
{
	const uint8_t *data;
	long bytes;

	if (!writer_active() || !context_has(HAS_DESKTOP) || !context_has(HAS_BUFFERS) ||
	    !buffer_get(target, GL_BUFFER_MAPPED) || buffer_get(target, GL_BUFFER_ACCESS) == GL_READ_ONLY)
		return;
	data = mapped_at(target);
	if (data && ended(data))
		return;
	bytes = buffer_get(target, GL_BUFFER_SIZE);
	if (context_has(HAS_MAP_RANGE)) {
		if (buffer_get(target, GL_BUFFER_ACCESS_FLAGS) & GL_MAP_FLUSH_EXPLICIT_BIT)
			return; /* written at each flush */
		bytes = buffer_get(target, GL_BUFFER_MAP_LENGTH);
	}
	record_memory(data, data, bytes, 0);
}

void maps_flushed(unsigned target, long offset, long length)
{
	const uint8_t *data;

	if (!writer_active() || !buffer_get(target, GL_BUFFER_MAPPED))
		return;
	data = mapped_at(target);
	if (data && offset >= 0)
		record_memory(data + offset, data + offset, length, 0);
}
