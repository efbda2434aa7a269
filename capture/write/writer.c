/* Runs inside the traced program. */
#include "capture/write/writer.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/membarrier.h>
#include <pthread.h>
#include <sched.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "commands.h"
#include "capture/gl/memory.h"
#include "capture/write/sink.h"
#include "capture/stats.h"
#include "enums.h"

enum { PATH_BYTES = STATS_PATH_BYTES, FLUSH_AFTER_NS = 20000000, NO_MEMBARRIER_US = 20000 };
enum { FIRST_COMMAND_ID = 4 }; /* 0 to 3 are apitrace's own memory functions */

static _Atomic int lock_word;

/* All but `state` is read and written under the lock. */
static struct {
	_Atomic enum { IDLE, RECORDING, ENDED } state; /* IDLE: nothing called yet, no file yet */
	uint8_t *chunk, *end, *p; /* bytes not yet handed over lie in [chunk, p) */
	uint64_t n_calls;
	_Atomic uint64_t n_frames;
	uint64_t flushed_ns;
	uint8_t bits_known[N_BITS_ENTRIES];
	uint8_t visual_known, memcpy_known;
	_Atomic unsigned epoch;
	struct stats_process *process; /* never NULL once recording */
} w;

static uint8_t command_known[N_COMMANDS];
static uint8_t enum_known[N_ENUM_ENTRIES];
static char wanted_path[PATH_BYTES]; /* RELUME_TRACE */
static struct recorder_stats *stats;
static struct stats_process own_process; /* where the command maps no file of figures */
static _Atomic uint32_t n_threads;
static int only_this_process; /* no child of it gets a trace */

/* initial-exec: reached without a call, and the library is there from the start. */
static __thread struct {
	unsigned depth;  /* > 0: inside the writer or nested, nothing is recorded */
	unsigned number; /* 1-based */
	void (*waiting)(void); /* writes calls that wait */
	int frame_ends;        /* the call it makes next does so */
	int is_owner;          /* it is in the lock by owning it */
} self __attribute__((tls_model("initial-exec")));

/*
 * The lock. As long as one thread only calls GL it owns the lock, and taking it is a plain store and a load: no atomic
 * operation, no cache line that moves. Another thread that comes takes the ownership away, once and for good, with the kernel's
 * help: membarrier makes every thread pass a barrier, so that either the owner sees that it owns the lock no more, or the other
 * sees that the owner is inside.
 */
#define NO_OWNER ((uintptr_t)1)

static _Atomic uintptr_t owner; /* address of the owner's `self`; 0: none yet, NO_OWNER: never again */
static _Atomic int owner_inside;

static int membarrier(int command)
{
	return (int)syscall(SYS_membarrier, command, 0, 0);
}

static void lock(void)
{
	unsigned spins = 0;

	self.is_owner = 0;
	if (atomic_load_explicit(&owner, memory_order_relaxed) == (uintptr_t)&self) {
		atomic_store_explicit(&owner_inside, 1, memory_order_relaxed);
		atomic_signal_fence(memory_order_seq_cst);
		if (atomic_load_explicit(&owner, memory_order_relaxed) == (uintptr_t)&self) {
			self.is_owner = 1;
			return;
		}
		atomic_store_explicit(&owner_inside, 0, memory_order_release);
	}
	while (atomic_exchange_explicit(&lock_word, 1, memory_order_acquire))
		if (++spins > 64)
			sched_yield();
	if (owner > NO_OWNER) {
		owner = NO_OWNER;
		if (membarrier(MEMBARRIER_CMD_PRIVATE_EXPEDITED))
			usleep(NO_MEMBARRIER_US); /* forbidden since: by then each store has long been seen */
		while (atomic_load_explicit(&owner_inside, memory_order_acquire))
			sched_yield();
	}
}

static void unlock(void)
{
	if (self.is_owner)
		atomic_store_explicit(&owner_inside, 0, memory_order_release);
	else
		atomic_store_explicit(&lock_word, 0, memory_order_release);
}

/* The thread that makes the first call; it is in the lock. */
static void choose_owner(void)
{
	if (!owner && membarrier(MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED) == 0)
		owner = (uintptr_t)&self;
}

static uint64_t now_ns(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

void writer_say(const char *fmt, ...)
{
	char text[512];
	int saved = errno, n;
	va_list args;

	va_start(args, fmt);
	n = snprintf(text, sizeof(text), "relume: ");
	n += vsnprintf(text + n, sizeof(text) - (size_t)n - 1, fmt, args);
	va_end(args);
	if (n > (int)sizeof(text) - 2)
		n = (int)sizeof(text) - 2;
	text[n++] = '\n';
	if (write(STDERR_FILENO, text, (size_t)n) < 0)
		errno = saved; /* nobody listens: nothing to be done */
	errno = saved;
}

/* The file */

/* Ends the recording early, once, where something went wrong with the file. */
static void look_for_errors(void)
{
	struct sink_state sink = sink_state();

	w.process->bytes = sink.bytes;
	w.process->calls = w.n_calls;
	if (!sink.error || w.state == ENDED)
		return;
	w.state = ENDED;
	w.process->failed = sink.error;
	writer_say("%s: %s: %s; recording ends after frame %llu, the program goes on", sink.path, sink.what, strerror(sink.error),
	           (unsigned long long)w.n_frames);
}

/* The chunk is complete up to p. Returns where to go on. `now`: only when it is in the file. */
static uint8_t *spill(uint8_t *p, int now)
{
	size_t bytes = (size_t)(p - w.chunk);
	int saved = errno;

	if (w.state == RECORDING) {
		w.chunk = now ? sink_write(bytes) : sink_hand_over(bytes);
		w.end = w.chunk + SINK_CHUNK;
		look_for_errors();
	}
	errno = saved;
	return w.chunk;
}

uint8_t *put_room(uint8_t *p)
{
	return w.end - p < WRITER_MARGIN ? spill(p, 0) : p;
}

/* Scalars */

uint8_t *put_varint(uint8_t *p, uint64_t v)
{
	while (v >= 0x80) {
		*p++ = (uint8_t)(v | 0x80);
		v >>= 7;
	}
	*p++ = (uint8_t)v;
	return p;
}

uint8_t *put_uint(uint8_t *p, uint64_t v)
{
	*p++ = TRACE_UINT;
	return put_varint(p, v);
}

uint8_t *put_sint(uint8_t *p, int64_t v)
{
	*p++ = v < 0 ? TRACE_SINT : TRACE_UINT;
	return put_varint(p, v < 0 ? 0 - (uint64_t)v : (uint64_t)v);
}

uint8_t *put_address(uint8_t *p, uintptr_t v)
{
	if (!v)
		return put_null(p);
	*p++ = TRACE_OPAQUE;
	return put_varint(p, v);
}

static uint8_t *put_chars(uint8_t *p, const char *s)
{
	size_t n = strlen(s);

	p = put_varint(p, n);
	memcpy(p, s, n);
	return p + n;
}

/* A signature holds one name and is written with the first value that needs it. */
static uint8_t *put_enum_entry(uint8_t *p, unsigned number)
{
	*p++ = TRACE_ENUM;
	p = put_varint(p, number);
	if (!enum_known[number]) {
		enum_known[number] = 1;
		*p++ = 1;
		p = put_chars(p, enum_entries[number].name);
		p = put_uint(p, enum_entries[number].value);
	}
	return put_uint(p, enum_entries[number].value);
}

uint8_t *put_enum(uint8_t *p, uint32_t v)
{
	unsigned number = v < 0x10000 ? enum_index[v] : 0;

	return number ? put_enum_entry(p, number) : put_uint(p, v);
}

uint8_t *put_enum_small(uint8_t *p, uint32_t v, const uint16_t group[16])
{
	return v < 16 && group[v] ? put_enum_entry(p, group[v]) : put_enum(p, v);
}

uint8_t *put_symbol(uint8_t *p, int64_t v)
{
	return v >= 0x200 && v < 0x10000 && enum_index[v] ? put_enum(p, (uint32_t)v) : put_sint(p, v);
}

uint8_t *put_bits(uint8_t *p, uint32_t v, const struct bits_entry *bits)
{
	*p++ = TRACE_BITMASK;
	p = put_varint(p, bits->number);
	if (!w.bits_known[bits->number]) {
		w.bits_known[bits->number] = 1;
		p = put_varint(p, bits->n_flags);
		for (unsigned i = 0; i < bits->n_flags; i++) {
			p = put_chars(p, bits->flags[i].name);
			p = put_varint(p, bits->flags[i].value);
		}
		p = put_room(p);
	}
	return put_varint(p, v);
}

uint8_t *put_bool8(uint8_t *p, unsigned v)
{
	return v < 2 ? put_enum_entry(p, enums_Boolean[v]) : put_uint(p, v);
}

uint8_t *put_bool32(uint8_t *p, unsigned v)
{
	*p++ = v ? TRACE_TRUE : TRACE_FALSE;
	return p;
}

/* Opening */

static void put_head(void)
{
	static const char key[] = "process.name";
	char name[PATH_BYTES];
	ssize_t n = readlink("/proc/self/exe", name, sizeof(name));
	uint8_t *p = w.chunk;

	*p++ = TRACE_VERSION;
	*p++ = TRACE_SEMANTICS;
	p = put_varint(p, sizeof(key) - 1);
	memcpy(p, key, sizeof(key) - 1);
	p += sizeof(key) - 1;
	p = put_varint(p, n > 0 ? (uint64_t)n : 0);
	memcpy(p, name, n > 0 ? (size_t)n : 0);
	p += n > 0 ? n : 0;
	*p++ = 0; /* no more properties */
	w.p = p;
}

static struct stats_process *new_process(void)
{
	uint32_t slot = stats ? atomic_fetch_add(&stats->n_processes, 1) : STATS_MAX_PROCESSES;

	return slot < STATS_MAX_PROCESSES ? &stats->processes[slot] : &own_process;
}

/* First recorded call of this process. */
static void open_trace(void)
{
	w.process = new_process();
	w.chunk = sink_open(wanted_path);
	snprintf(w.process->path, sizeof(w.process->path), "%s", sink_state().path);
	w.state = RECORDING;
	look_for_errors();
	if (!w.chunk)
		return;
	w.end = w.chunk + SINK_CHUNK;
	w.epoch++;
	put_head();
	w.p = spill(w.p, 1); /* a trace from here on, whatever happens */
	w.flushed_ns = now_ns();
	choose_owner();
}

/* Calls */

static uint8_t *put_call_signature(uint8_t *p, const struct command *command)
{
	const char *name = command->arg_names;

	p = put_chars(p, command->name);
	p = put_varint(p, command->n_args);
	for (unsigned i = 0; i < command->n_args; i++) {
		p = put_chars(p, name);
		name += strlen(name) + 1;
	}
	return put_room(p);
}

/* Locks, and opens the trace where this is the first call. NULL, unlocked, where nothing is recorded. */
static uint8_t *begin(void)
{
	int saved;

	if (self.depth || w.state == ENDED)
		return NULL;
	self.depth = 1; /* a signal handler that calls GL while we hold the lock goes unrecorded */
	lock();
	if (w.state == IDLE) {
		saved = errno;
		open_trace();
		errno = saved;
	}
	if (w.state == RECORDING)
		return put_room(w.p);
	unlock();
	self.depth = 0;
	return NULL;
}

static void end(uint8_t *p)
{
	w.p = p;
	unlock();
	self.depth = 0;
}

void writer_wait_with(void (*flush)(void))
{
	self.waiting = flush;
}

unsigned writer_epoch(void)
{
	return w.epoch;
}

static void write_waiting(void)
{
	void (*flush)(void) = self.waiting;

	self.waiting = NULL;
	flush();
}

/* `id` is the signature's in this trace. */
static uint8_t *enter(unsigned id, const struct command *command, uint8_t *known, unsigned flags)
{
	uint8_t *p;

	if (self.waiting)
		write_waiting();
	p = begin();
	if (!p)
		return NULL;
	if (!self.number)
		self.number = atomic_fetch_add(&n_threads, 1) + 1;
	*p++ = TRACE_ENTER;
	p = put_varint(p, self.number - 1);
	p = put_varint(p, id);
	if (!*known)
		p = put_call_signature(p, command);
	*known = 1;
	if (flags) {
		*p++ = TRACE_DETAIL_FLAGS;
		*p++ = (uint8_t)flags;
	}
	return p;
}

static int (*_Atomic left_out)(unsigned command);

void writer_skip(int (*says)(unsigned command))
{
	left_out = says;
}

static int is_left_out(unsigned command)
{
	int (*says)(unsigned) = atomic_load_explicit(&left_out, memory_order_relaxed);

	return says && says(command);
}

unsigned writer_toggles(void)
{
	return stats ? stats->toggles : 0;
}

uint8_t *writer_enter(unsigned command)
{
	return is_left_out(command) ? NULL : enter(command + FIRST_COMMAND_ID, &commands[command], &command_known[command], 0);
}

uint8_t *writer_enter_fake(unsigned command)
{
	return is_left_out(command) ? NULL : enter(command + FIRST_COMMAND_ID, &commands[command], &command_known[command], CALL_FAKE);
}

uint8_t *writer_enter_memcpy(void)
{
	static const struct command memory_copy = { "memcpy", 3, "dest\0src\0n\0", NULL, NULL, 0 };

	return enter(0, &memory_copy, &w.memcpy_known, CALL_FAKE);
}

void writer_call_end(uint8_t *p)
{
	*p++ = TRACE_DETAIL_END;
	*p++ = TRACE_LEAVE;
	p = put_varint(p, w.n_calls++);
	*p++ = TRACE_DETAIL_END;
	end(p);
}

uint64_t writer_enter_end(uint8_t *p)
{
	uint64_t call = ++w.n_calls;

	*p++ = TRACE_DETAIL_END;
	end(p);
	return call;
}

uint8_t *writer_leave(uint64_t call)
{
	uint8_t *p = call ? begin() : NULL;

	if (!p)
		return NULL;
	*p++ = TRACE_LEAVE;
	return put_varint(p, call - 1);
}

void writer_leave_end(uint8_t *p)
{
	*p++ = TRACE_DETAIL_END;
	end(p);
}

void writer_frame_ends(void)
{
	self.frame_ends = 1;
}

/* The call that ends a frame has been written: packing goes on while it is made. */
static void hand_over_frame(void)
{
	uint8_t *p = begin();

	if (p)
		end(spill(p, 0));
	self.frame_ends = 0;
}

void writer_nest(void)
{
	if (self.frame_ends)
		hand_over_frame();
	self.depth++;
}

void writer_unnest(void)
{
	self.depth--;
}

int writer_active(void)
{
	return !self.depth && w.state != ENDED;
}

void writer_count_unknown(unsigned command)
{
	static _Atomic uint8_t slots[N_COMMANDS]; /* 1-based place in the table of figures, 255: it is full */
	uint8_t slot = slots[command];

	if (!stats || !writer_active() || slot == 255)
		return;
	if (!slot) {
		uint32_t n = atomic_fetch_add(&stats->n_unknown, 1);

		slot = n < STATS_MAX_UNKNOWN ? (uint8_t)(n + 1) : 255;
		slots[command] = slot;
		if (slot == 255)
			return;
		snprintf(stats->unknown[n].name, STATS_NAME_BYTES, "%s", commands[command].name);
	}
	stats->unknown[slot - 1].calls++;
}

uint64_t writer_frames(void)
{
	return w.n_frames;
}

uint64_t writer_bytes(void)
{
	return w.process ? w.process->bytes : 0;
}

uint64_t writer_frame_ended(void)
{
	uint8_t *p = begin();
	uint64_t frames;

	if (!p)
		return 0;
	frames = ++w.n_frames;
	p = spill(p, 1);
	if (w.state == RECORDING)
		w.process->frames = frames; /* counted once it cannot be lost */
	w.flushed_ns = now_ns();
	end(p);
	return frames;
}

void writer_flush_sometimes(void)
{
	uint8_t *p = begin();

	if (!p)
		return;
	if (now_ns() - w.flushed_ns > FLUSH_AFTER_NS) {
		p = spill(p, 1);
		w.flushed_ns = now_ns();
	}
	end(p);
}

void writer_end(void)
{
	uint8_t *p;

	if (w.state != RECORDING)
		return;
	p = begin();
	if (!p)
		return;
	p = spill(p, 1);
	w.state = ENDED;
	end(p);
}

void writer_note_quit(void)
{
	if (w.process)
		w.process->quit = 1;
}

int writer_sidecar(char *out, size_t size, const char *suffix)
{
	const char *path = sink_state().path;
	size_t stem = strlen(path);
	int n;

	if (!stem)
		return -1;
	if (stem > 6 && strcmp(path + stem - 6, ".trace") == 0)
		stem -= 6;
	n = snprintf(out, size, "%.*s%s", (int)stem, path, suffix);
	return n > 0 && (size_t)n < size ? 0 : -1;
}

/* Bulk values */

uint8_t *put_memory(uint8_t *p, const void *data, size_t bytes)
{
	const uint8_t *from = data;

	while (bytes) {
		size_t n = (size_t)(w.end - p);

		if (n > bytes)
			n = bytes;
		memory_read(p, from, n);
		p += n;
		from += n;
		bytes -= n;
		p = put_room(p);
	}
	return put_room(p);
}

static uint8_t *put_sized(uint8_t *p, unsigned tag, const void *data, long bytes)
{
	if (!data)
		return put_null(p);
	*p++ = (uint8_t)tag;
	p = put_varint(p, bytes > 0 ? (uint64_t)bytes : 0);
	return put_memory(p, data, bytes > 0 ? (size_t)bytes : 0);
}

uint8_t *put_string(uint8_t *p, const char *s, long bytes)
{
	return put_sized(p, TRACE_STRING, s, s && bytes < 0 ? (long)memory_text_bytes(s) : bytes);
}

uint8_t *put_text(uint8_t *p, const char *s, long size)
{
	return put_sized(p, TRACE_STRING, s, s && size > 0 ? (long)strnlen(s, (size_t)size) : 0);
}

uint8_t *put_blob(uint8_t *p, const void *data, long bytes)
{
	return put_sized(p, TRACE_BLOB, data, bytes);
}

uint8_t *put_own_blob(uint8_t *p, const void *data, long bytes)
{
	const uint8_t *from = data;

	if (!data)
		return put_null(p);
	*p++ = TRACE_BLOB;
	p = put_varint(p, (uint64_t)bytes);
	while (bytes) {
		long n = w.end - p < bytes ? w.end - p : bytes;

		memcpy(p, from, (size_t)n);
		p = put_room(p + n);
		from += n;
		bytes -= n;
	}
	return put_room(p);
}

uint8_t *put_array_head(uint8_t *p, long n)
{
	*p++ = TRACE_ARRAY;
	return put_varint(p, n > 0 ? (uint64_t)n : 0);
}

uint8_t *put_strings(uint8_t *p, const char *const *strings, long count, const int *lengths)
{
	if (!strings)
		return put_null(p);
	p = put_array_head(p, count);
	for (long i = 0; i < count; i++) { /* a call that GL refuses may have anything here */
		const char *text;
		int length = -1;

		memory_read(&text, strings + i, sizeof(text));
		if (lengths)
			memory_read(&length, lengths + i, sizeof(length));
		p = put_string(p, text, length);
	}
	return p;
}

uint8_t *put_zeros(uint8_t *p, const void *data, long n)
{
	if (!data)
		return put_null(p);
	p = put_array_head(p, n);
	for (long i = 0; i < n; i++) {
		p = put_uint(p, 0);
		if (i % 256 == 255)
			p = put_room(p);
	}
	return put_room(p);
}

/* Elements of one type: `value` writes v[i]. Room is looked after every so many, none takes more than 128 bytes. */
#define DEFINE_PUT_ARRAY(suffix, type, value)                                                                                 \
	uint8_t *put_array_##suffix(uint8_t *p, type const *v, long n)                                                        \
	{                                                                                                                     \
		if (!v)                                                                                                       \
			return put_null(p);                                                                                   \
		p = put_array_head(p, n);                                                                                     \
		for (long i = 0; i < n; i++) {                                                                                \
			p = value;                                                                                            \
			if (i % 16 == 15)                                                                                     \
				p = put_room(p);                                                                              \
		}                                                                                                             \
		return put_room(p);                                                                                           \
	}

DEFINE_PUT_ARRAY(s8, int8_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u8, uint8_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(s16, int16_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u16, uint16_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(s32, int32_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u32, uint32_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(s64, int64_t, put_sint(p, v[i]))
DEFINE_PUT_ARRAY(u64, uint64_t, put_uint(p, v[i]))
DEFINE_PUT_ARRAY(f32, float, put_float(p, v[i]))
DEFINE_PUT_ARRAY(f64, double, put_double(p, v[i]))
DEFINE_PUT_ARRAY(enum, uint32_t, put_enum(p, v[i]))
DEFINE_PUT_ARRAY(bool8, uint8_t, put_bool8(p, v[i]))
DEFINE_PUT_ARRAY(bool32, uint32_t, put_bool32(p, v[i]))
DEFINE_PUT_ARRAY(ptr, const void *, put_opaque(p, v[i]))

/* Xutil.h's XVisualInfo, laid out by hand: the recorder needs no X11 headers for one struct. */
struct visual_info {
	void *visual;
	unsigned long visualid;
	int screen, depth, c_class;
	unsigned long red_mask, green_mask, blue_mask;
	int colormap_size, bits_per_rgb;
};

uint8_t *put_visual(uint8_t *p, const void *visual)
{
	static const char *const members[] = { "visual", "visualid", "screen", "depth", "c_class", "red_mask",
		                               "green_mask", "blue_mask", "colormap_size", "bits_per_rgb" };
	const struct visual_info *info = visual;

	if (!info)
		return put_null(p);
	*p++ = TRACE_STRUCT;
	p = put_varint(p, 0);
	if (!w.visual_known) {
		w.visual_known = 1;
		p = put_chars(p, "XVisualInfo");
		p = put_varint(p, sizeof(members) / sizeof(members[0]));
		for (size_t i = 0; i < sizeof(members) / sizeof(members[0]); i++)
			p = put_chars(p, members[i]);
	}
	p = put_opaque(p, info->visual);
	p = put_uint(p, info->visualid);
	p = put_sint(p, info->screen);
	p = put_sint(p, info->depth);
	p = put_sint(p, info->c_class);
	p = put_uint(p, info->red_mask);
	p = put_uint(p, info->green_mask);
	p = put_uint(p, info->blue_mask);
	p = put_sint(p, info->colormap_size);
	return put_sint(p, info->bits_per_rgb);
}

/* Beginning and end of the process */

/* A child's copy of the process has no thread: what was handed to it is waited for. */
static void lock_for_child(void)
{
	lock();
	if (w.state == RECORDING)
		sink_write(0);
}

/* A child gets a trace of its own with its first call; what the parent has not written stays the parent's. */
static void start_child(void)
{
	unlock();
	self.depth = 0;
	if (w.state == ENDED)
		return;
	if (only_this_process) {
		w.state = ENDED;
		return;
	}
	if (w.state == IDLE)
		return;
	sink_leave();
	owner = 0;
	w.n_calls = 0;
	w.n_frames = 0;
	memset(command_known, 0, sizeof(command_known));
	memset(enum_known, 0, sizeof(enum_known));
	memset(w.bits_known, 0, sizeof(w.bits_known));
	w.visual_known = w.memcpy_known = 0;
	w.state = IDLE;
}

static void map_stats(const char *path)
{
	int fd = open(path, O_RDWR | O_CLOEXEC);
	struct stat st;
	void *p;

	if (fd < 0)
		return;
	if (fstat(fd, &st) == 0 && (size_t)st.st_size >= sizeof(*stats)) {
		p = mmap(NULL, sizeof(*stats), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
		stats = p == MAP_FAILED ? NULL : p;
	}
	close(fd);
}

__attribute__((constructor)) static void writer_start(void)
{
	const char *path = getenv("RELUME_TRACE"), *figures = getenv("RELUME_STATS"), *only = getenv("RELUME_ONLY_PROCESS");
	int saved = errno;

	only_this_process = only != NULL;
	if (!path || !*path || strlen(path) >= sizeof(wanted_path) || (only && atol(only) != getpid())) {
		w.state = ENDED;
	} else {
		strcpy(wanted_path, path);
		if (figures)
			map_stats(figures);
		pthread_atfork(lock_for_child, unlock, start_child);
	}
	errno = saved;
}

__attribute__((destructor)) static void writer_stop(void)
{
	writer_end();
}
