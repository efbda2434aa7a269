/*
 * Runs inside the traced program. The trace writer: calls go into the recording's chunk, chunks into the file (sink.h).
 *
 * A recorded call is written in one piece where nothing comes back from it (writer_enter, arguments, writer_call_end, then
 * the real call), else in two (writer_enter, inputs, writer_enter_end, the real call, writer_leave, outputs,
 * writer_leave_end). Between enter and end the writer is locked, and the caller holds the write position `p` for put_*
 * (values.h). Grammar: trace.md. Every function keeps errno. None allocates, aborts or exits.
 */
#ifndef CAPTURE_WRITE_WRITER_H
#define CAPTURE_WRITE_WRITER_H

#include <stddef.h>
#include <stdint.h>

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

#endif
