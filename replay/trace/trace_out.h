/*
 * Writes calls from a reader to a new trace: format 6 in Snappy chunks of 1 MiB (capture/format/trace.md), whatever the
 * container of the original.
 *
 * Calls are renumbered from 0 in the order they are written. Each is written as a whole: its return immediately follows
 * its arguments. Stack traces are dropped. The file appears under its name when it is complete (base/part.h).
 *
 * The recorder has a separate writer (capture/write/writer.h), which encodes the C values of a running program with
 * generated tables. This one encodes values that carry their type, with names from the trace.
 */
#pragma once

#include "replay/trace/reader.h"

struct trace_out;

/**
 * Start a trace, with the properties of an existing one.
 * @return 0, ERR_USAGE (reported: both are the same file) or ERR_SYSTEM (reported)
 */
int trace_out_open(struct trace_out **out, const char *path, const char *from_path, const struct trace_reader *from);

/**
 * Write a call. Signatures are identified by address: they must come from one reader, which must live as long as the
 * writer.
 * @return 0 or ERR_SYSTEM (reported: the disk, memory); then every further call returns the same
 */
int trace_out_call(struct trace_out *o, const struct call *call);

/**
 * Complete the file and give it its name. Always closes the writer.
 * @param bytes  receives the size of the file; may be NULL
 * @return 0 or ERR_SYSTEM (reported; no file is left)
 */
int trace_out_finish(struct trace_out **out, uint64_t *bytes);

/** Abandon the file: nothing is left of it. */
void trace_out_drop(struct trace_out **out);
