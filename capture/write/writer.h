/*
 * Runs inside the traced program. The trace writer: calls go into a chunk in memory, chunks go to the file (sink.h).
 *
 * A recorded call is written in one piece where nothing comes back from it (writer_enter, arguments, writer_call_end, then
 * the real call), in two where something does (writer_enter, inputs, writer_enter_end, the real call, writer_leave, outputs,
 * writer_leave_end). Between enter and end the writer is locked and the caller holds the write position `p`, which every
 * put_* function takes and returns; at least WRITER_MARGIN bytes are free at each return, enough for any scalar arguments.
 * Grammar: trace.md. Every function keeps errno. None allocates, aborts or exits.
 */
#ifndef CAPTURE_WRITE_WRITER_H
#define CAPTURE_WRITE_WRITER_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "capture/format/tags.h"

struct command {
	const char *name;
	unsigned n_args;
	const char *arg_names; /* one after the other, each with its NUL */
	void *thunk;
	/*
	 * What its arguments are, one after the other, where the command may stand in a run (runs.h); else NULL. f d: floats of 4
	 * and 8 bytes; b s i, B S I: signed and unsigned integers of 1, 2, 4; e: enumerant, p: of a primitive, t: truth, y: number
	 * or enumerant. A digit before it: an array of so many; '*': as many as there are bytes.
	 */
	const char *shape;
	int draws; /* 1: does nothing but draw, or end a frame */
};
extern const struct command commands[]; /* generated; sorted by name */

struct enum_entry {
	const char *name;
	uint32_t value;
};
struct bits_entry {
	unsigned number; /* of its signature */
	unsigned n_flags;
	const struct enum_entry *flags;
};
extern const struct enum_entry enum_entries[]; /* generated; the index is the signature's number, 0 is unused */
extern const uint16_t enum_index[0x10000];     /* value -> index in enum_entries, 0 where it has no name */

enum { WRITER_MARGIN = 4096 };

/** Begin a call. Returns the write position, or NULL where the call is not recorded (recording off, or a nested call). */
uint8_t *writer_enter(unsigned command);

/** Begin a call that the recorder makes up; it is executed by readers like any other. */
uint8_t *writer_enter_fake(unsigned command);

/** Begin apitrace's own memcpy(dest, src, n): bytes that the program stored where no call shows it. */
uint8_t *writer_enter_memcpy(void);

/** End a call of which nothing comes back. */
void writer_call_end(uint8_t *p);

/** End the first half of a call. Returns what writer_leave wants. */
uint64_t writer_enter_end(uint8_t *p);

/** Begin the second half. NULL where `call` is 0 (the call is not recorded) or the recording has ended since. */
uint8_t *writer_leave(uint64_t call);
void writer_leave_end(uint8_t *p);

/** Between these, calls of this thread are the window system library's own and not recorded. */
void writer_nest(void);
void writer_unnest(void);

/** Calls of which `left_out` says 1 are not written, until this is called with NULL. */
void writer_skip(int (*left_out)(unsigned command));

/** How often recording was switched on or off from outside, by the command's signal or key. */
unsigned writer_toggles(void);

/** Called once, before the next call of this thread is begun: calls that wait to be written. NULL: none wait any more. */
void writer_wait_with(void (*flush)(void));

/** Which trace of this process it is that is being written, from 1 on: what was written to an earlier one is not there. */
unsigned writer_epoch(void);

/** 1 where a call made now by this thread would be recorded. */
int writer_active(void);

/** A command passed through that is not recorded. */
void writer_count_unknown(unsigned command);

/** The call that this thread makes next ends a frame. */
void writer_frame_ends(void);

/** A frame is complete: hand everything to the kernel, so that it outlives the process. Returns the frames so far. */
uint64_t writer_frame_ended(void);

/** Hand what is complete to the kernel where the last time is a while ago. */
void writer_flush_sometimes(void);

/** Frames completed so far: the number of the frame being drawn. */
uint64_t writer_frames(void);

/** Bytes of the trace in the file. */
uint64_t writer_bytes(void);

/** End the recording, all of it written; calls pass through from here on. */
void writer_end(void);

/** This process was told to stop the program and did: the command reports success. */
void writer_note_quit(void);

/**
 * Path of a file beside this process' trace, with .trace replaced by `suffix` (".ref").
 * @return 0, or -1 where there is no trace or it does not fit
 */
int writer_sidecar(char *out, size_t size, const char *suffix);

/** Say something once on standard error: "relume: ...". */
void writer_say(const char *fmt, ...) __attribute__((format(printf, 1, 2)));

/* Bulk values: may hand chunks to the file on the way. A negative count is 0; a NULL pointer is written as null. */

/** Text; `bytes` < 0: up to its NUL. */
uint8_t *put_string(uint8_t *p, const char *s, long bytes);
/** Text in a buffer of `size` bytes that may lack a NUL. */
uint8_t *put_text(uint8_t *p, const char *s, long size);
/** Raw memory, read without ever faulting: what cannot be read is written as zeros (memory.h). */
uint8_t *put_blob(uint8_t *p, const void *data, long bytes);
/** Raw memory of the recorder's own. */
uint8_t *put_own_blob(uint8_t *p, const void *data, long bytes);
/** `count` texts; `lengths` may be NULL, and an entry below 0 means up to the NUL. */
uint8_t *put_strings(uint8_t *p, const char *const *strings, long count, const int *lengths);
/** An XVisualInfo. */
uint8_t *put_visual(uint8_t *p, const void *visual);

uint8_t *put_array_s8(uint8_t *p, const int8_t *v, long n);
uint8_t *put_array_u8(uint8_t *p, const uint8_t *v, long n);
uint8_t *put_array_s16(uint8_t *p, const int16_t *v, long n);
uint8_t *put_array_u16(uint8_t *p, const uint16_t *v, long n);
uint8_t *put_array_s32(uint8_t *p, const int32_t *v, long n);
uint8_t *put_array_u32(uint8_t *p, const uint32_t *v, long n);
uint8_t *put_array_s64(uint8_t *p, const int64_t *v, long n);
uint8_t *put_array_u64(uint8_t *p, const uint64_t *v, long n);
uint8_t *put_array_f32(uint8_t *p, const float *v, long n);
uint8_t *put_array_f64(uint8_t *p, const double *v, long n);
uint8_t *put_array_enum(uint8_t *p, const uint32_t *v, long n);
uint8_t *put_array_bool8(uint8_t *p, const uint8_t *v, long n);
uint8_t *put_array_bool32(uint8_t *p, const uint32_t *v, long n);
uint8_t *put_array_ptr(uint8_t *p, const void *const *v, long n);
/** An array of `n` zeros in place of memory at `data` that GL fills later. */
uint8_t *put_zeros(uint8_t *p, const void *data, long n);
/** The head of an array of `n` values that the caller puts. */
uint8_t *put_array_head(uint8_t *p, long n);
/** Room for any scalar values again, after many of them. */
uint8_t *put_room(uint8_t *p);
/** Raw bytes without a tag; `data` is read without faulting. */
uint8_t *put_memory(uint8_t *p, const void *data, size_t bytes);

/* Scalars. What every call needs is inline, the rest is not: there are thousands of thunks. */

/** `index` < 128. */
static inline uint8_t *put_argument(uint8_t *p, unsigned index)
{
	p[0] = TRACE_DETAIL_ARGUMENT;
	p[1] = (uint8_t)index;
	return p + 2;
}

static inline uint8_t *put_return(uint8_t *p)
{
	*p++ = TRACE_DETAIL_RESULT;
	return p;
}

static inline uint8_t *put_null(uint8_t *p)
{
	*p++ = TRACE_NULL;
	return p;
}

static inline uint8_t *put_float(uint8_t *p, float v)
{
	*p++ = TRACE_FLOAT;
	memcpy(p, &v, sizeof(v));
	return p + sizeof(v);
}

static inline uint8_t *put_double(uint8_t *p, double v)
{
	*p++ = TRACE_DOUBLE;
	memcpy(p, &v, sizeof(v));
	return p + sizeof(v);
}

uint8_t *put_varint(uint8_t *p, uint64_t v);
uint8_t *put_uint(uint8_t *p, uint64_t v);
uint8_t *put_sint(uint8_t *p, int64_t v);
uint8_t *put_address(uint8_t *p, uintptr_t v);
#define put_opaque(p, v) put_address(p, (uintptr_t)(v))
/** An enumerant; a plain number where it has no name. */
uint8_t *put_enum(uint8_t *p, uint32_t v);
/** An enumerant of a group, whose small values have names of their own. */
uint8_t *put_enum_small(uint8_t *p, uint32_t v, const uint16_t group[16]);
/** A number that may be an enumerant in a numeric parameter; small values are taken for numbers. */
uint8_t *put_symbol(uint8_t *p, int64_t v);
uint8_t *put_bits(uint8_t *p, uint32_t v, const struct bits_entry *bits);
/** Truth: the enumerants GL_FALSE and GL_TRUE in GL, a plain truth value in GLX and EGL. */
uint8_t *put_bool8(uint8_t *p, unsigned v);
uint8_t *put_bool32(uint8_t *p, unsigned v);

#endif
