/* Runs inside the traced program. */
#include "capture/client/mirror.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <string.h>
#include <sys/mman.h>

#include "capture/client/content.h"
#include "capture/client/watch.h"
#include "capture/gl/context.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "tables/commands.h"

enum { N_MIRRORS = 1 << 12, N_PROBES = 8, BLOCK = 1 << 17 };
enum { PATIENCE = 16, SAMPLE = 8 };     /* after PATIENCE new contents in a row, only every SAMPLEth is looked up */
enum { CREDIT = 64 }; /* mirrors that may be made before their array is drawn again; refunded when it is */
enum { WATCH_AFTER = 64, WATCH_NEVER = 1 << 30 }; /* draws in a row that found the same bytes */
enum { REWRITTEN = 8 };                 /* times that most watched pages were written with the same bytes */
#define MAX_MIRRORED_BYTES (256l << 20) /* per context, here and on replay */

struct mirror {
	const uint8_t *data;
	unsigned buffer;   /* 0: drawn from once */
	int unproven;      /* made on credit, not drawn from since */
	unsigned misses;   /* contents since the last known one */
	long room;         /* the buffer's size */
	long first, end;   /* the range held by the buffer and `copy` */
	uint8_t *copy;     /* `copy_bytes` mapped */
	size_t copy_bytes;
	struct mirror_indices indices;
	struct watch watch; /* within what is held: pages to be read only after a store */
	int equal;          /* draws since the last difference */
	int patience;       /* draws before the array is watched */
	int rewritten;
};

struct mirror_table {
	unsigned epoch; /* the trace that has the buffers */
	int credit;
	long bytes;
	uint8_t *staging; /* the program's memory, read once */
	size_t staging_bytes;
	struct mirror mirrors[N_MIRRORS];
};

/* End a mirror. `told`: 1 to delete the trace's buffer as well. */
static void drop(struct mirror_table *t, struct mirror *m, int told)
{
	uint8_t *p = m->buffer && told ? writer_enter_fake(CMD_glDeleteBuffers) : NULL;

	if (p) {
		p = put_sint(put_argument(p, 0), 1);
		p = put_array_u32(put_argument(p, 1), &m->buffer, 1);
		writer_call_end(p);
	}
	if (m->copy)
		munmap(m->copy, m->copy_bytes);
	watch_end(&m->watch);
	t->bytes -= m->room;
	memset(m, 0, sizeof(*m));
}

static void forget_all(struct mirror_table *t)
{
	for (int i = 0; i < N_MIRRORS; i++)
		if (t->mirrors[i].copy)
			drop(t, &t->mirrors[i], 0);
	if (t->staging)
		munmap(t->staging, t->staging_bytes);
	memset(t, 0, sizeof(*t));
	t->epoch = writer_epoch();
	t->credit = CREDIT;
}

static void release(void *table)
{
	forget_all(table);
	munmap(table, sizeof(struct mirror_table));
}

/* The current context's table, created on demand; NULL: out of memory. */
static struct mirror_table *current_table(void)
{
	struct mirror_table *t = context_data(CONTEXT_MIRRORS);

	if (t && t->epoch != writer_epoch())
		forget_all(t);
	if (t || !(t = pages_map(sizeof(*t))))
		return t;
	context_set_data(CONTEXT_MIRRORS, t, release);
	t->credit = CREDIT;
	t->epoch = writer_epoch();
	return t;
}

/* The array's mirror, or a new one, which may replace another array's. */
static struct mirror *find(struct mirror_table *t, const uint8_t *data)
{
	uint64_t at = ((uintptr_t)data >> 2) * 0x9E3779B97F4A7C15u >> 40;
	struct mirror *place = NULL;

	for (unsigned i = 0; i < N_PROBES; i++) {
		struct mirror *m = &t->mirrors[(at + i) % N_MIRRORS];

		if (m->data == data)
			return m;
		if (!place || (place->buffer && !m->buffer) || (place->data && !m->data))
			place = m;
	}
	if (place->data)
		drop(t, place, 1);
	return place;
}

/*
 * The first difference between program and mirror in [first, end), to within a block; `end` if there is none. Bytes
 * that the mirror does not hold yet count as different.
 */
static long difference(struct mirror_table *t, const struct mirror *m, long first, long end)
{
	if (!pages_grow(&t->staging, &t->staging_bytes, BLOCK))
		return first;
	for (long at = first; at < end;) {
		long bytes = end - at < BLOCK ? end - at : BLOCK;

		if (at < m->first || at + bytes > m->end) {
			if (at < m->first || at >= m->end)
				return at;
			bytes = m->end - at;
		}
		pages_read(t->staging, m->data + at, (size_t)bytes);
		if (memcmp(t->staging, m->copy + at, (size_t)bytes) != 0)
			return at;
		at += bytes;
	}
	return end;
}

/* Arrays that stay the same are watched, so that their pages need not be read. */

static void begin_watch(struct mirror_table *t, struct mirror *m)
{
	long end;

	m->equal = 0;
	if (!watch_begin(&m->watch, m->data + m->first, m->data + m->end)) {
		m->patience = m->patience < WATCH_NEVER / 4 ? 4 * m->patience : WATCH_NEVER;
		return;
	}
	end = (long)(m->watch.end - (uintptr_t)m->data);
	if (difference(t, m, (long)(m->watch.first - (uintptr_t)m->data), end) < end)
		watch_end(&m->watch);
}

/* 1 if [first, end) of a watched array equals the mirror. */
static int is_unchanged(struct mirror_table *t, struct mirror *m, long first, long end)
{
	long from = (long)(m->watch.first - (uintptr_t)m->data), to = (long)(m->watch.end - (uintptr_t)m->data), bytes = 0;
	struct watch written[8];
	int n;

	if (first < from && difference(t, m, first, end < from ? end : from) < (end < from ? end : from))
		return 0;
	if (end > to && difference(t, m, first > to ? first : to, end) < end)
		return 0;
	if (first >= to || end <= from)
		return 1;
	/* Whole pages: the kernel tells of each only once. */
	from = first <= from ? from : from + ((first - from) & -4096l);
	to = end >= to ? to : from + ((end - from + 4095) & -4096l);
	n = watch_take_written(&m->watch, (uintptr_t)m->data + (uintptr_t)from, (uintptr_t)m->data + (uintptr_t)to,
	                       written, 8);
	for (int i = 0; i < n; i++) {
		long at = (long)(written[i].first - (uintptr_t)m->data), piece_end = (long)(written[i].end - (uintptr_t)m->data);

		bytes += piece_end - at;
		if (difference(t, m, at, piece_end) < piece_end)
			return 0;
	}
	if (2 * bytes > to - from && ++m->rewritten > REWRITTEN) { /* a fault per page costs more than reading the page */
		m->patience = WATCH_NEVER;
		watch_end(&m->watch);
	}
	return n >= 0;
}

/* Room in buffer and copy for bytes up to `end`. 1: the buffer is new and empty; 0: there was enough; -1: there is no
 * memory. */
static int make_room(struct mirror_table *t, struct mirror *m, long end)
{
	long room = 2 * m->room < end ? end : 2 * m->room;

	if (end <= m->room)
		return 0;
	if (t->bytes + room - m->room > MAX_MIRRORED_BYTES || !pages_grow(&m->copy, &m->copy_bytes, (size_t)room))
		return -1;
	t->bytes += room - m->room;
	m->room = room;
	return 1;
}

/* Bring the buffer up to date with staging, which holds [first, end) and differs from `changed` on; it is bound
 * then. */
static int update(struct mirror_table *t, struct mirror *m, unsigned target, long first, long end, long changed)
{
	int fresh = make_room(t, m, end), made = !m->buffer;
	long whole_end = end;

	if (fresh < 0)
		return 0;
	/* Only the words that differ. */
	while (changed < end && changed >= m->first && changed < m->end && m->copy[changed] == t->staging[changed - first])
		changed++;
	changed &= ~3l;
	for (; end - changed > 4 && end <= m->end; end -= 4)
		if (memcmp(m->copy + end - 4, t->staging + end - 4 - first, 4) != 0)
			break;
	if (first == 0 && fresh == 0 && whole_end >= m->end && t->staging_bytes == m->copy_bytes) {
		uint8_t *copy = m->copy;

		m->copy = t->staging;
		t->staging = copy;
	} else {
		memcpy(m->copy + first, t->staging, (size_t)(end - first));
	}
	if (made)
		m->buffer = content_new_buffer();
	if (made || m->first == m->end) {
		m->first = first;
		m->end = end;
	}
	m->first = first < m->first ? first : m->first;
	m->end = end > m->end ? end : m->end;
	m->indices.bytes = 0;
	content_bind(target, m->buffer);
	if (fresh) {
		int whole = m->first == 0 && m->end == m->room;

		content_data(target, whole ? m->copy : NULL, m->room);
		if (whole)
			return 1;
		changed = m->first;
		end = m->end;
	}
	fake_call(CMD_glBufferSubData, "ellb", target, changed, end - changed, m->copy + changed, end - changed);
	return 1;
}

unsigned mirror_buffer(unsigned target, const void *data, long first, long end, int *bound,
                       struct mirror_indices **indices)
{
	struct mirror_table *t = current_table();
	struct mirror *m = t ? find(t, data) : NULL;
	int new, held, wanted;
	long changed;

	if (indices)
		*indices = NULL;
	if (!m)
		return 0;
	new = !m->data;
	m->data = data;
	m->patience = m->patience ? m->patience : WATCH_AFTER;
	/* Keep the held range contiguous. */
	if (m->buffer && first > m->end)
		first = m->end;
	if (m->buffer && end < m->first)
		end = m->first;
	if (m->watch.end && is_unchanged(t, m, first, end)) {
		changed = end;
	} else {
		watch_end(&m->watch);
		changed = m->buffer ? difference(t, m, first, end) : first;
		m->equal = changed == end ? m->equal + 1 : 0;
		if (m->equal > 0 && m->equal == m->patience)
			begin_watch(t, m);
	}
	if (changed == end) {
		t->credit += m->unproven;
		m->unproven = 0;
		if (indices)
			*indices = &m->indices;
		return m->buffer;
	}
	held = m->buffer && changed >= m->first && changed < m->end;
	wanted = m->buffer || !new || t->credit > 0;
	if (!pages_grow(&t->staging, &t->staging_bytes, (size_t)(end - first)))
		return 0;
	pages_read(t->staging, (const uint8_t *)data + first, (size_t)(end - first));
	/* New contents: look them up, as they may come back. */
	if (first == 0 && (held || !wanted) && (m->misses++ < PATIENCE || m->misses % SAMPLE == 0)) {
		unsigned buffer = content_buffer(target, t->staging, end, bound);

		if (buffer)
			m->misses = 0;
		if (buffer)
			return buffer;
	}
	if (!wanted || !update(t, m, target, first, end, changed))
		return 0;
	*bound = 1;
	if (new) {
		t->credit--;
		m->unproven = 1;
	}
	if (indices)
		*indices = &m->indices;
	return m->buffer;
}
