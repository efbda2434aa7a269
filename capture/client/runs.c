/* Runs inside the traced program. */
#define XXH_INLINE_ALL
#include "capture/client/runs.h"

#include <GL/gl.h>
#include <stddef.h>
#include <sys/mman.h>
#include <xxhash.h>

#include "capture/format/call.h"
#include "capture/gl/context.h"
#include "capture/gl/skip.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/tables.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "tables/commands.h"
#include "tables/enums.h"

enum { N_SLOTS = 1 << 14, N_PROBES = 8, MIN_BYTES = 128, MAX_LISTS = 1 << 14, CREDIT = 16, BLOCK_BYTES = 1 << 20 };
enum { FIRST_ROOM = 1 << 18, MAX_ROOM = 1 << 26 }; /* size of a thread's buffer */
#define MAX_KEPT_BYTES (128l << 20)                /* per context */

/*
 * Names of lists, counted down. A GL that allocates the name after the highest one in use (Mesa) then never gives the
 * program a name that we take later. Names that programs choose themselves are far lower; if one does collide, we make
 * no more lists.
 */
enum { FIRST_NAME = CALL_RUN_FIRST, LAST_NAME = CALL_RUN_LAST };

struct run {
	XXH128_hash_t hash;
	uint32_t bytes;         /* 0: the slot is free */
	int seen;               /* times drawn, at most 2 */
	unsigned list;          /* 0: it has none */
	const uint8_t *records; /* NULL unless the run has a list */
	struct run *next;       /* the one that followed last time */
};

struct block { /* the head of a piece of the arena */
	struct block *before;
	size_t bytes;
};

struct runs_table {
	unsigned epoch;         /* the trace that has the lists */
	int off;                /* no more lists, ever */
	int compiling;          /* the program makes a list */
	long kept_bytes;
	int n_lists;
	int credit;             /* lists that may be made before their run is drawn again; refunded when it is */
	struct block *arena;
	uint8_t *arena_at, *arena_end;
	struct run *last;       /* the run before; &head at the start */
	struct run head;
	struct run slots[N_SLOTS];
};

__thread struct runs_thread runs_self __attribute__((tls_model("initial-exec"), visibility("hidden")));

static __thread struct {
	uint8_t *room;
	size_t room_bytes;
	struct runs_table *table;
	struct run *guess; /* runs_self.expect points into its records */
} self __attribute__((tls_model("initial-exec")));

static _Atomic unsigned next_name = FIRST_NAME;
static _Atomic int names_taken; /* the program uses names of ours */

/* Writing records */

static unsigned value_bytes(char kind)
{
	return kind == 'd' ? 8 : kind == 'b' || kind == 'B' || kind == 't' ? 1 : kind == 's' || kind == 'S' ? 2 : 4;
}

static uint8_t *put_value(uint8_t *p, char kind, const uint8_t *at)
{
	union { float f; double d; int8_t b; int16_t s; int32_t i; uint8_t B; uint16_t S; uint32_t I; } v;

	memcpy(&v, at, value_bytes(kind));
	switch (kind) {
	case 'f': return put_float(p, v.f);
	case 'd': return put_double(p, v.d);
	case 'b': return put_sint(p, v.b);
	case 's': return put_sint(p, v.s);
	case 'i': return put_sint(p, v.i);
	case 'B': return put_uint(p, v.B);
	case 'S': return put_uint(p, v.S);
	case 'I': return put_uint(p, v.I);
	case 't': return put_bool8(p, v.B);
	case 'p': return put_enum_small(p, v.I, enums_PrimitiveType);
	case 'y': return put_symbol(p, v.i);
	default: return put_enum(p, v.I);
	}
}

static void write_record(unsigned command, const uint8_t *at, unsigned bytes)
{
	const uint8_t *end = at + bytes;
	uint8_t *p = writer_enter(command);
	unsigned argument = 0;

	if (!p)
		return;
	for (const char *shape = commands[command].shape; *shape; shape++) {
		unsigned n = 1;

		p = put_argument(p, argument++);
		if (*shape == '*' || (*shape >= '1' && *shape <= '9')) {
			n = *shape == '*' ? (unsigned)(end - at) / value_bytes(shape[1]) : (unsigned)(*shape - '0');
			p = put_array_head(p, (long)n);
			shape++;
		}
		for (; n; n--, at += value_bytes(*shape))
			p = put_value(p, *shape, at);
	}
	writer_call_end(p);
}

/* 1 if one of the next records sets the same state before any vertex. */
static int is_overwritten(const uint8_t *at, const uint8_t *end)
{
	enum { LOOK_AHEAD = 12 };
	uint32_t first, word;

	memcpy(&first, at, sizeof(first));
	if (commands[first & 0xFFFF].shape[0] == 'e' || strncmp(commands[first & 0xFFFF].name, "glVertexAttrib", 14) == 0)
		return 0; /* an argument selects the state that these set: material, texture unit, attribute */
	for (int i = 0; i < LOOK_AHEAD; i++) {
		memcpy(&word, at, sizeof(word));
		at += 4 + (((word >> 16) + 3) & ~3u);
		if (at >= end)
			return 0;
		memcpy(&word, at, sizeof(word));
		if ((word & 0xFFFF) == (first & 0xFFFF))
			return 1;
	}
	return 0;
}

static void write_records(const uint8_t *at, size_t bytes)
{
	const uint8_t *end = at + bytes;
	int skip = skip_draws();

	while (at < end) {
		uint32_t word;

		memcpy(&word, at, sizeof(word));
		if (!skip || !is_overwritten(at, end))
			write_record(word & 0xFFFF, at + 4, word >> 16);
		at += 4 + (((word >> 16) + 3) & ~3u);
	}
}

/* Keeping records */

/* An unexpected call: write the run so far, and the rest call by call. */
static void write_open_run(void)
{
	const uint8_t *from = runs_self.expect ? self.guess->records : self.room;
	const uint8_t *to = runs_self.expect ? runs_self.expect : runs_self.at;

	runs_self.open = 0;
	runs_self.expect = NULL;
	write_records(from, (size_t)(to - from));
}

int runs_grow(void)
{
	size_t used = (size_t)(runs_self.at - self.room), bytes = self.room ? 2 * self.room_bytes : FIRST_ROOM;

	if (bytes > MAX_ROOM || !pages_grow(&self.room, &self.room_bytes, bytes)) {
		writer_wait_with(NULL);
		write_open_run();
		return 0;
	}
	runs_self.at = self.room + used;
	runs_self.end = self.room + bytes - 2 * RUNS_MAX_ARGUMENTS;
	return 1;
}

int runs_diverge(void)
{
	size_t bytes = (size_t)(runs_self.expect - self.guess->records);

	runs_self.at = self.room;
	while (self.room_bytes < bytes + 2 * RUNS_MAX_ARGUMENTS)
		if (!runs_grow())
			return 0;
	memcpy(self.room, self.guess->records, bytes);
	runs_self.at = self.room + bytes;
	runs_self.expect = NULL;
	return 1;
}

/* Known runs */

static void forget_all(struct runs_table *t)
{
	while (t->arena) {
		struct block *block = t->arena;

		t->arena = block->before;
		munmap(block, block->bytes);
	}
	memset(t, 0, sizeof(*t));
	t->last = &t->head;
	t->credit = CREDIT;
	t->epoch = writer_epoch();
}

static void *keep(struct runs_table *t, const uint8_t *records, size_t bytes)
{
	uint8_t *kept;

	if (bytes > (size_t)(t->arena_end - t->arena_at)) {
		size_t room = (sizeof(struct block) + bytes + BLOCK_BYTES - 1) & ~(size_t)(BLOCK_BYTES - 1);
		struct block *block = pages_map(room);

		if (!block)
			return NULL;
		block->before = t->arena;
		block->bytes = room;
		t->arena = block;
		t->arena_at = (uint8_t *)(block + 1);
		t->arena_end = (uint8_t *)block + room;
	}
	kept = t->arena_at;
	t->arena_at += bytes; /* a multiple of four */
	memcpy(kept, records, bytes);
	return kept;
}

static void release(void *table)
{
	forget_all(table);
	munmap(table, sizeof(struct runs_table));
}

/* The current context's table, or NULL. */
static struct runs_table *current_table(void)
{
	struct runs_table *t = context_data(CONTEXT_RUNS);
	int compiling, off;

	if (t && t->epoch == writer_epoch())
		return t;
	if (!t) {
		t = context_current() ? pages_map(sizeof(*t)) : NULL;
		if (!t)
			return NULL;
		context_set_data(CONTEXT_RUNS, t, release);
	}
	compiling = t->compiling;
	off = t->off;
	forget_all(t);
	t->compiling = compiling;
	t->off = off;
	return t;
}

/* The run's slot, a new one for a new run; NULL: no room. */
static struct run *look_up(struct runs_table *t, const uint8_t *records, size_t bytes)
{
	XXH128_hash_t hash = XXH3_128bits(records, bytes);
	struct run *free_slot = NULL;

	for (unsigned i = 0; i < N_PROBES; i++) {
		struct run *run = &t->slots[(hash.low64 + i) % N_SLOTS];

		if (run->bytes == bytes && XXH128_isEqual(run->hash, hash))
			return run;
		if (!run->list && (!free_slot || (free_slot->bytes && !run->bytes)))
			free_slot = run;
	}
	if (!free_slot)
		return NULL;
	*free_slot = (struct run){ .hash = hash, .bytes = (uint32_t)bytes };
	return free_slot;
}

/*
 * Mesa does not draw lists exactly as immediate mode. It splits quads along the other diagonal, which shows in the last
 * bit of some pixels, and draws line loops wrongly. A list called between Begin and End draws as immediate mode does,
 * so for these primitives Begin and End stay outside the list.
 */
static int stays_outside(const uint8_t *records)
{
	uint32_t mode;

	memcpy(&mode, records + 4, sizeof(mode));
	return mode == GL_QUADS || mode == GL_LINE_LOOP;
}

enum { BEGIN_BYTES = 8, END_BYTES = 4 }; /* a run's first and last record */

static void write_call(const struct run *run)
{
	if (stays_outside(run->records))
		write_records(run->records, BEGIN_BYTES);
	fake_call(CMD_glCallList, "u", run->list);
	if (stays_outside(run->records))
		write_records(run->records + run->bytes - END_BYTES, END_BYTES);
}

static int make_list(struct runs_table *t, struct run *run, const uint8_t *records)
{
	unsigned name;

	if (t->n_lists == MAX_LISTS || t->kept_bytes + run->bytes > MAX_KEPT_BYTES || next_name < LAST_NAME)
		return 0;
	run->records = keep(t, records, run->bytes);
	if (!run->records)
		return 0;
	name = next_name--;
	t->n_lists++;
	t->kept_bytes += run->bytes;
	fake_call(CMD_glNewList, "ue", name, GL_COMPILE);
	if (stays_outside(records))
		write_records(records + BEGIN_BYTES, run->bytes - BEGIN_BYTES - END_BYTES);
	else
		write_records(records, run->bytes);
	fake_call(CMD_glEndList, "");
	run->list = name;
	return 1;
}

int runs_begin(unsigned mode)
{
	if (!runs_self.open) {
		struct runs_table *t = writer_active() && context_has(HAS_FIXED_FUNCTION) ? current_table() : NULL;

		if (!t || t->off || t->compiling || names_taken)
			return 0;
		self.table = t;
		self.guess = t->last->next;
		runs_self.expect = self.guess ? self.guess->records : NULL;
		runs_self.at = self.room;
		runs_self.open = 1;
		writer_wait_with(write_open_run);
	}
	return runs_put(CMD_glBegin, &mode, sizeof(mode));
}

int runs_end(void)
{
	struct runs_table *t = self.table;
	struct run *run = NULL;
	size_t bytes;

	if (!runs_self.open || !runs_put(CMD_glEnd, "", 0))
		return 0;
	runs_self.open = 0;
	writer_wait_with(NULL);
	bytes = (size_t)(runs_self.at - self.room);
	if (runs_self.expect)
		run = self.guess;
	else if (bytes >= MIN_BYTES)
		run = look_up(t, self.room, bytes);
	if (run && run->list && run->seen == 1)
		t->credit++;
	else if (run && !run->list && !skip_draws() && (run->seen || t->credit > 0) && make_list(t, run, self.room) &&
	         !run->seen)
		t->credit--;
	if (run && run->list)
		write_call(run);
	else
		write_records(self.room, bytes);
	if (run) {
		run->seen += run->seen < 2;
		t->last->next = run;
		t->last = run;
	}
	return 1;
}

static void end_lists(void)
{
	struct runs_table *t = context_has(HAS_FIXED_FUNCTION) ? current_table() : NULL;

	if (t)
		t->off = 1;
}

void runs_edge_flag_set(void)
{
	end_lists();
}

void runs_color_material(unsigned face)
{
	if (face == GL_BACK)
		end_lists();
}

void runs_list_state(void)
{
	struct runs_table *t = context_has(HAS_FIXED_FUNCTION) ? current_table() : NULL;

	if (t)
		t->compiling = context_get(GL_LIST_INDEX) != 0;
}

void runs_lists_used(unsigned first, long count)
{
	if (count > 0 && first <= FIRST_NAME && (unsigned long)first + (unsigned long)count > LAST_NAME)
		names_taken = 1;
}
