/*
 * The command line of a verb. One table lists each option's name, its line in `--help`, and where its value is stored:
 *
 *     static const struct options_row rows[] = {
 *         { "frame", 'f', "N", "which frame, from 0 (default 0)", options_frame, .at = offsetof(struct asked, frame) },
 *         { "json", 'j', NULL, "as JSON", options_flag, .at = offsetof(struct asked, json) },
 *     };
 *
 * getopt_long does the parsing; unknown options are reported by name. Every verb has -h, --help without a row. Man
 * pages and shell completion are generated from the help text (packaging/pages.py).
 */
#pragma once

#include <stddef.h>
#include <stdio.h>

#include "base/confine.h"

enum { OPTIONS_MAX_ROWS = 64 };

struct options_row {
	const char *name;     /* long name; NULL: a heading, with `help` as its text */
	char letter;          /* short name; 0: none */
	const char *argument; /* the value's name in the help text; NULL: the option takes none */
	const char *help;     /* one line; wrapped when printed */
	/**
	 * Take a value.
	 * @param value  as typed, "" for an option without one; lives as long as argv
	 * @param out    `at` bytes into the verb's own struct
	 * @return 0 or ERR_* (reported)
	 */
	int (*set)(const struct options_row *row, const char *value, void *out);
	size_t at;
	unsigned least, most;     /* options_number: the smallest and the largest value */
	float low, high;          /* options_real: the least and the largest value */
	const char *const *words; /* options_word, options_text: accepted values, ended by NULL */
	int is_required;
	int kind;                 /* the verb's own */
	enum confine_use use;     /* how the verb uses the file that the value names: options_confine */
};

/* An array of rows and its length, in a table's initializer. */
#define OPTIONS_ROWS(array) .rows = (array), .n_rows = sizeof(array) / sizeof((array)[0])

struct options_table {
	const char *verb;
	const char *head;  /* usage, then what the verb does */
	const struct options_row *rows;
	size_t n_rows;
	const char *notes; /* text after the options, such as exit codes; NULL: none */
	const char *takes; /* required: "one trace and -o FILE" */
	int least, most;   /* number of words that are not options; most -1: any number */
	enum confine_use words_use; /* how the verb uses the files that words name */
	int stops;         /* 1: the first such word ends the options; the rest is another program's */
};

/* The rest of a command line. */
struct options_line {
	char **words; /* those that are not options; within argv */
	int n_words;
	const char *given[OPTIONS_MAX_ROWS]; /* by row: the last value, "" for an option without one; NULL: not given */
};

/**
 * Parse a command line.
 * @param argv  argv[0] names the verb in messages; sorted so that words follow options
 * @param out   the verb's own struct, filled by the rows
 * @return 0; 1 if help was printed; ERR_USAGE (reported), or the result of a row's `set`
 */
int options_parse(const struct options_table *table, int argc, char **argv, void *out, struct options_line *line);

/** A row for verbs that read recordings, without its braces. */
#define OPTIONS_NO_SANDBOX \
	.name = "no-sandbox", .help = "for debugging: no limits of memory and time, " \
	"and all rights that reading a recording does not need (files, sockets, programs)", .set = options_no_sandbox

/**
 * Keep the rights to the files that a command line names and those that verbs of this kind need; drop all others and
 * start the limits. With --no-sandbox, do nothing. Call before the first thread is started.
 * @param also  one more file to read; NULL: none
 * @return 0 or ERR_SYSTEM (reported)
 */
int options_confine(const struct options_table *table, const struct options_line *line, enum confine_kind kind,
                    const char *also);

/** Report the words that the verb requires. @return ERR_USAGE */
int options_misuse(const struct options_table *table);

void options_print_help(const struct options_table *table, FILE *out);

/* Setters for the common kinds of values; each comment gives the type of `out`. */
int options_no_sandbox(const struct options_row *row, const char *value, void *out); /* none */
int options_text(const struct options_row *row, const char *value, void *out); /* const char *, borrowed; of `words` if
                                                                                  any */
int options_flag(const struct options_row *row, const char *value, void *out);   /* int: 1 */
int options_clear(const struct options_row *row, const char *value, void *out);  /* int: 0 */
int options_number(const struct options_row *row, const char *value, void *out); /* unsigned, 0 to `most` */
int options_real(const struct options_row *row, const char *value, void *out);   /* float, `low` to `high` */
int options_word(const struct options_row *row, const char *value, void *out);   /* int or enum: place in `words` */
int options_bytes(const struct options_row *row, const char *value, void *out);  /* uint64_t, "800M" */
int options_frame(const struct options_row *row, const char *value, void *out);  /* uint64_t */
int options_frames(const struct options_row *row, const char *value, void *out); /* struct frame_list */
