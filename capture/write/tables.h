/*
 * Runs inside the traced program. The types of the generated tables, which describe each command and enumerant.
 * tables/commands.h numbers the commands, tables/enums.h names the groups of enumerants.
 */
#pragma once

#include <stdint.h>

struct command {
	const char *name;
	unsigned n_args;
	const char *arg_names; /* concatenated, each with its NUL */
	/*
	 * One letter for each argument of a command that may be in a run (runs.h); else NULL. f d: floats of 4 and 8
	 * bytes; b s i, B S I: signed and unsigned integers of 1, 2, 4; e: enumerant, p: a primitive's, t: truth, y:
	 * number
	 * or enumerant. A digit before it: an array of that length; '*': as many as there are bytes.
	 */
	const char *shape;
	int draws; /* 1: only draws, or ends a frame */
};
extern const struct command commands[]; /* sorted by name */

struct enum_entry {
	const char *name;
	uint32_t value;
};
struct bits_entry {
	unsigned number; /* its signature's number */
	unsigned n_flags;
	const struct enum_entry *flags;
};
extern const struct enum_entry enum_entries[]; /* the index is the signature's number, 0 is unused */
extern const uint16_t enum_index[0x10000];     /* value -> index in enum_entries, 0 if it has no name */
