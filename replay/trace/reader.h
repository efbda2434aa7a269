/*
 * Reads apitrace's traces (formats 0 .. 6) call by call, as a stream: memory use does not grow with the file.
 *
 * Containers: Snappy chunks (what recorders write), one gzip stream, one Brotli stream. Calls are ordered by their
 * return. A call and everything it points to belong to the reader and are valid until the next trace_reader_next;
 * signatures live as long as the reader. Nothing in the file is trusted: a file truncated at any byte delivers every
 * complete call.
 *
 * The reader does not know what calls mean.
 */
#pragma once

#include "capture/format/call.h"

struct trace_reader;

/* The types that trace_value.sig points to. */
struct trace_values_sig { /* for an ENUM or a BITMASK */
	uint32_t n;
	const char **names;
	uint64_t *values; /* signed for an enum */
};
struct trace_struct_sig {
	const char *name;
	uint32_t n;
	const char **members;
};

/** Find the number of a command by name; -1: it has none. */
typedef int32_t trace_find(const char *name);

/**
 * Open a trace and read its header.
 * @param find  gives commands their numbers (call_sig.command); NULL: all are -1
 * @return 0, ERR_INPUT (reported: missing, a folder, empty, a picture, not a trace, a newer format) or ERR_SYSTEM
 */
int trace_reader_open(struct trace_reader **out, const char *path, trace_find *find);
void trace_reader_close(struct trace_reader **r);

/**
 * The next call.
 * @param call  receives it; NULL unless 1 is returned
 * @return 1; 0 at the end (with one warning if the file ends within an event); ERR_INPUT (reported with the byte and
 *         the
 *         call) if the data is invalid; ERR_SYSTEM. After 0 or an error every further call returns the same.
 */
int trace_reader_next(struct trace_reader *r, const struct call **call);

/** A place between two calls that the reader can return to. */
struct trace_place {
	uint64_t piece; /* offset in the file of the container's piece that holds it; UINT64_MAX: reading cannot start there */
	uint64_t piece_start; /* unpacked bytes before that piece */
	uint64_t offset;      /* unpacked bytes before the place */
	uint64_t number;      /* number of the next call */
};

/**
 * The reader's position. @return 1; 0: the reader cannot return here, because a call that was entered has not returned
 * yet
 */
int trace_reader_place(const struct trace_reader *r, struct trace_place *place);

/**
 * Serialize all signatures that the reader has seen so far. A trace defines each signature only where it is first used.
 * @param out, n  receive them; free with free()
 * @return 0 or ERR_SYSTEM (reported)
 */
int trace_reader_signatures(const struct trace_reader *r, uint8_t **out, size_t *n);

/**
 * Continue from a place, forwards or backwards.
 * @param signatures  from a reader of the same file that had read at least as far
 * @return 0; ERR_INPUT (reported: invalid signatures, or the file has no such place); ERR_SYSTEM
 */
int trace_reader_seek(struct trace_reader *r, const struct trace_place *place, const uint8_t *signatures, size_t n);

/** A property of the header ("process.name"), or NULL. */
const char *trace_reader_property(const struct trace_reader *r, const char *name);

/** The i-th property. @return 1, or 0 if there are no more */
int trace_reader_property_at(const struct trace_reader *r, size_t i, const char **name, const char **value);

/** 1 if the file was found to end inside an event or chunk. */
int trace_reader_is_cut(const struct trace_reader *r);

/** The last call of such a file; 0: it is whole, as far as it was read. */
uint64_t trace_reader_cut_after(const struct trace_reader *r);

/** Hash the file while it is read: see container_hash_begin and container_hash_end. */
int trace_reader_hash_begin(struct trace_reader *r);
int trace_reader_hash_end(struct trace_reader *r, uint64_t out[2]);

/** Number of bytes of the file read so far, and its size. */
uint64_t trace_reader_offset(const struct trace_reader *r);
uint64_t trace_reader_behind(const struct trace_reader *r); /* see container_behind */
uint64_t trace_reader_size(const struct trace_reader *r);

/** Name of an ENUM's value, or NULL if the signature has none. */
const char *trace_enum_name(const struct trace_value *v);
