/* Runs inside the traced program. */
#include "capture/write/writer.h"

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capture/format/sidecar.h"
#include "capture/stats.h"
#include "capture/write/clock.h"
#include "capture/write/lock.h"
#include "capture/write/recording.h"
#include "capture/write/report.h"
#include "capture/write/sink.h"
#include "capture/write/tables.h"
#include "capture/write/values.h"
#include "tables/commands.h"

enum { FLUSH_AFTER_NS = 20000000 };
enum { FIRST_COMMAND_ID = 4 }; /* 0 to 3 are apitrace's own memory functions */

/* Under the lock. */
static uint8_t command_known[N_COMMANDS], memcpy_known;
static uint64_t flushed_ns;
static _Atomic unsigned epoch;

static char wanted_path[STATS_PATH_BYTES]; /* RELUME_TRACE */
static _Atomic uint32_t n_threads;
static int only_this_process; /* 1: its children get no trace */

/* initial-exec: reached without a call, as the library is loaded from the start. */
static __thread struct {
	unsigned depth;  /* > 0: inside the writer or nested, nothing is recorded */
	unsigned number; /* 1-based */
	void (*waiting)(void); /* writes calls that wait */
	int hand_over;         /* the next call ends a frame: pack what is before it */
	uint64_t ended;        /* this thread's last frame, from 1, until writer_frame_ended has returned it; or 0 */
} self __attribute__((tls_model("initial-exec")));

/* Opening */

static uint8_t *put_head(uint8_t *p)
{
	char name[STATS_PATH_BYTES];
	ssize_t n = readlink("/proc/self/exe", name, sizeof(name) - 1);

	name[n > 0 ? n : 0] = '\0';
	*p++ = TRACE_VERSION;
	*p++ = TRACE_SEMANTICS;
	p = put_chars(p, "process.name");
	p = put_chars(p, name);
	*p++ = 0; /* no more properties */
	return p;
}

/* First recorded call of this process. */
static void open_trace(void)
{
	recording_open(wanted_path);
	if (!recording.chunk)
		return;
	epoch++;
	recording.p = recording_spill(put_head(recording.chunk), 1); /* the trace exists, whatever happens from here on */
	flushed_ns = clock_ns();
	lock_choose_owner();
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

/* Lock, and open the trace at the first call. NULL, unlocked, where nothing is recorded. */
static uint8_t *begin(void)
{
	int saved;

	if (self.depth || recording.state == RECORDING_ENDED)
		return NULL;
	self.depth = 1; /* a signal handler that calls GL while we hold the lock goes unrecorded */
	lock_take();
	if (recording.state == RECORDING_IDLE) {
		saved = errno;
		open_trace();
		errno = saved;
	}
	if (recording.state == RECORDING_ON)
		return put_room(recording.p);
	lock_leave();
	self.depth = 0;
	return NULL;
}

static void end(uint8_t *p)
{
	recording.p = p;
	lock_leave();
	self.depth = 0;
}

void writer_wait_with(void (*flush)(void))
{
	self.waiting = flush;
}

unsigned writer_epoch(void)
{
	return epoch;
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

uint8_t *writer_enter(unsigned command)
{
	return is_left_out(command) ? NULL : enter(command + FIRST_COMMAND_ID, &commands[command], &command_known[command], 0);
}

uint8_t *writer_enter_fake(unsigned command)
{
	return is_left_out(command) ?
	               NULL :
	               enter(command + FIRST_COMMAND_ID, &commands[command], &command_known[command], CALL_FAKE);
}

uint8_t *writer_enter_memcpy(void)
{
	static const struct command memory_copy = { "memcpy", 3, "dest\0src\0n\0", NULL, 0 };

	return enter(0, &memory_copy, &memcpy_known, CALL_FAKE);
}

void writer_call_end(uint8_t *p)
{
	*p++ = TRACE_DETAIL_END;
	*p++ = TRACE_LEAVE;
	p = put_varint(p, recording.n_calls++);
	*p++ = TRACE_DETAIL_END;
	end(p);
}

/* Readers order frames by these events, so the number is given under the same lock. */
static void number_frame(void)
{
	self.ended = ++recording.n_frames;
}

void writer_frame_call_end(uint8_t *p)
{
	number_frame();
	writer_call_end(p);
}

void writer_frame_leave_end(uint8_t *p)
{
	number_frame();
	writer_leave_end(p);
}

uint64_t writer_enter_end(uint8_t *p)
{
	uint64_t call = ++recording.n_calls;

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
	self.hand_over = 1;
}

/* The call that ends a frame is written: pack it while the call is made. */
static void hand_over_frame(void)
{
	uint8_t *p = begin();

	if (p)
		end(recording_spill(p, 0));
	self.hand_over = 0;
}

void writer_nest(void)
{
	if (self.hand_over)
		hand_over_frame();
	self.depth++;
}

void writer_unnest(void)
{
	self.depth--;
}

int writer_active(void)
{
	return !self.depth && recording.state != RECORDING_ENDED;
}

void writer_count_unknown(unsigned command)
{
	if (writer_active())
		report_unknown(command);
}

uint64_t writer_frames(void)
{
	return recording.n_frames;
}

uint64_t writer_bytes(void)
{
	return recording.process ? recording.process->bytes : 0;
}

uint64_t writer_frame_ended(void)
{
	const uint64_t frame = self.ended;
	uint8_t *p = frame ? begin() : NULL;

	self.ended = 0;
	if (!p)
		return 0;
	p = recording_spill(p, 1);
	flushed_ns = clock_ns();
	end(p);
	return frame;
}

void writer_flush_sometimes(void)
{
	uint8_t *p = begin();

	if (!p)
		return;
	if (clock_ns() - flushed_ns > FLUSH_AFTER_NS) {
		p = recording_spill(p, 1);
		flushed_ns = clock_ns();
	}
	end(p);
}

void writer_end(void)
{
	uint8_t *p;

	if (recording.state != RECORDING_ON)
		return;
	p = begin();
	if (!p)
		return;
	p = recording_spill(p, 1);
	recording.state = RECORDING_ENDED;
	end(p);
}

void writer_note_end(unsigned trigger)
{
	if (recording.process)
		recording.process->ends[trigger]++;
}

void writer_note_window(uintptr_t drawable)
{
	static _Atomic uintptr_t first;
	uintptr_t none = 0;
	int is_first = atomic_compare_exchange_strong(&first, &none, drawable) || none == drawable;

	if (recording.process && (!is_first || !recording.process->windows))
		recording.process->windows = is_first ? 1 : 2;
}

void writer_note_program(void)
{
	if (recording.process)
		recording.process->programs = 1;
}

void writer_note_context(int is_core)
{
	if (recording.process && recording.process->contexts < 1 + is_core)
		recording.process->contexts = 1 + is_core;
}

void writer_note_quit(void)
{
	if (recording.process)
		recording.process->quit = 1;
}

void writer_will_quit(void)
{
	recording.quits = 1;
}

int writer_has_failed(void)
{
	return recording.process && recording.process->failed;
}

void writer_note_lost_references(void)
{
	if (recording.process)
		recording.process->lost_references = 1;
}

int writer_sidecar(char *out, size_t size, const char *suffix)
{
	const char *path = sink_state().path;

	return *path && sidecar_name(out, size, path, suffix) ? 0 : -1;
}

/* Beginning and end of the process */

/* The child lacks the sink's thread: wait until it has written everything. */
static void lock_for_child(void)
{
	lock_take();
	if (recording.state == RECORDING_ON)
		sink_write(0, (struct sink_content){ 0 });
}

/* A child gets its own trace at its first call; unwritten data stays the parent's. */
static void start_child(void)
{
	lock_leave();
	self.depth = 0;
	if (recording.state == RECORDING_ENDED)
		return;
	if (only_this_process) {
		recording.state = RECORDING_ENDED;
		return;
	}
	if (recording.state == RECORDING_IDLE)
		return;
	sink_leave();
	lock_forget_owner();
	recording.n_calls = 0;
	recording.n_frames = 0;
	memset(command_known, 0, sizeof(command_known));
	memcpy_known = 0;
	values_forget();
	recording.state = RECORDING_IDLE;
}

__attribute__((constructor)) static void writer_start(void)
{
	const char *path = getenv("RELUME_TRACE"), *figures = getenv("RELUME_STATS"), *only = getenv("RELUME_ONLY_PROCESS");
	int saved = errno;

	only_this_process = only != NULL;
	if (!path || !*path || strlen(path) >= sizeof(wanted_path) || (only && atol(only) != getpid())) {
		recording.state = RECORDING_ENDED;
	} else {
		strcpy(wanted_path, path);
		if (figures)
			report_open(figures, getenv("RELUME_STATS_FD"));
		pthread_atfork(lock_for_child, lock_leave, start_child);
	}
	errno = saved;
}

__attribute__((destructor)) static void writer_stop(void)
{
	writer_end();
}
