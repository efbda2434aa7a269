/*
 * Writes calls that a reader delivered as a new trace: format 6 in Snappy chunks of 1 MiB (capture/format/trace.md),
 * whatever their own trace was packed in.
 *
 * Calls are numbered anew from 0, in the order in which they are handed over. Each is written whole: its return follows
 * its arguments at once. Stack traces are not kept. The file appears under its name when it is finished (base/part.h).
 *
 * The recorder has a writer of its own (capture/write/writer.h): it encodes a running program's values of C by
 * generated tables. This one encodes values that know their type, with names from the trace.
 */
#pragma once

#include "replay/trace/reader.h"

struct trace_out;

/**
 * Begin a trace, with the properties of the one that is read.
 * @return 0, ERR_USAGE (reported: both are one file) or ERR_SYSTEM (reported)
 */
int trace_out_open(struct trace_out **out, const char *path, const char *from_path, const struct trace_reader *from);

/**
 * Write a call. Signatures are known by their address: those of one reader, which must live as long as the writer.
 * @return 0 or ERR_SYSTEM (reported: the disk, memory); then every further call returns the same
 */
int trace_out_call(struct trace_out *o, const struct call *call);

/**
 * Finish the file and give it its name. Closes the writer in any case.
 * @param bytes  receives the size of the file; may be NULL
 * @return 0 or ERR_SYSTEM (reported; no file is left)
 */
int trace_out_finish(struct trace_out **out, uint64_t *bytes);

/** Give up: no file is left. */
void trace_out_drop(struct trace_out **out);
