/*
 * Runs inside the traced program. The trace writer: calls go into the recording's chunk, chunks into the file (sink.h).
 *
 * A call that returns nothing is written in one piece (writer_enter, arguments, writer_call_end, then the real call),
 * any other in two (writer_enter, inputs, writer_enter_end, the real call, writer_leave, outputs, writer_leave_end).
 * Between enter and end the writer is locked, and the caller holds the write position `p` for put_*
 * (values.h). Grammar: trace.md. Every function keeps errno. None allocates, aborts or exits.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/** Begin a call. @return the write position; NULL: the call is not recorded (recording off, or a nested call) */
uint8_t *writer_enter(unsigned command);

/** Begin a call that the recorder makes up; readers execute it like any other. */
uint8_t *writer_enter_fake(unsigned command);

/** Begin apitrace's own memcpy(dest, src, n): bytes that the program stored without a call. */
uint8_t *writer_enter_memcpy(void);

/** End a call that returns nothing. */
void writer_call_end(uint8_t *p);

/** The same for a call that ends a frame, and for its second half: the frame has its number from here on. */
void writer_frame_call_end(uint8_t *p);
void writer_frame_leave_end(uint8_t *p);

/** End the first half of a call. Returns what writer_leave wants. */
uint64_t writer_enter_end(uint8_t *p);

/** Begin the second half. @return NULL if `call` is 0 (the call is not recorded) or the recording has ended since */
uint8_t *writer_leave(uint64_t call);
void writer_leave_end(uint8_t *p);

/** Between these, this thread's calls are the window system library's own and not recorded. */
void writer_nest(void);
void writer_unnest(void);

/** Leave out each call that `left_out` returns 1 for. NULL: none. */
void writer_skip(int (*left_out)(unsigned command));

/** Call `flush` once, before this thread's next call begins, to write pending calls. NULL: none are pending. */
void writer_wait_with(void (*flush)(void));

/** The number of this process' trace, from 1; changes after a fork. A new trace shares nothing with the one before. */
unsigned writer_epoch(void);

/** 1 if a call that this thread makes now would be recorded. */
int writer_active(void);

/** Count a command that passes through unrecorded. */
void writer_count_unknown(unsigned command);

/** This thread's next call ends a frame. */
void writer_frame_ends(void);

/**
 * A frame of this thread is complete: hand everything to the kernel, so that it outlives the process.
 * @return the frame's number, from 1 on; 0: it is not in the trace
 */
uint64_t writer_frame_ended(void);

/** The same for all complete data, if the last time was a while ago. */
void writer_flush_sometimes(void);

/** Frames numbered so far. If only one thread ends frames, this is the number, from 0, of the frame being drawn. */
uint64_t writer_frames(void);

/** Bytes of the trace in the file. */
uint64_t writer_bytes(void);

/** Write everything and end the recording; calls pass through from here on. */
void writer_end(void);

/** Count a call that ends a frame if the user asks for it. */
void writer_note_end(unsigned trigger);
/** The same of a frame's window. */
void writer_note_window(uintptr_t drawable);
/** A shader or program that the program makes current. */
void writer_note_program(void);

/** A context is current; `is_core`: one of a core profile. */
void writer_note_context(int is_core);

/** The recorder ended the program as requested: the command reports success. */
void writer_note_quit(void);

/** The program ends with the recording (--quit-after): an error that ends the recording says so. */
void writer_will_quit(void);

/** 1 if an error has ended the recording. */
int writer_has_failed(void);
/** An error has ended the reference frames. */
void writer_note_lost_references(void);

/**
 * Path of a file beside this process' trace, with .trace replaced by `suffix` (".ref").
 * @return 0; -1: there is no trace, or the path does not fit
 */
int writer_sidecar(char *out, size_t size, const char *suffix);
