#include "base/options.h"

#include <assert.h>
#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/limits.h"
#include "base/manual.h"
#include "base/nearest.h"

/* Help texts: names take up to NAME_COLUMNS, lines PAGE_COLUMNS. */
enum { NAME_COLUMNS = 25, PAGE_COLUMNS = 114, FIRST_ROW = 256 /* getopt_long's result for the first row */ };

/* Most words that name files; no confined verb takes more. */
enum { MOST_WORDS = 33 };

static const struct options_row help_row = { "help", 'h', NULL, "this text", .set = NULL };

/* --- Help -------------------------------------------------------------------------------------------------------- */

static int format_name(const struct options_row *row, char *out, size_t size)
{
	char letter[8] = "    ";

	if (row->letter)
		snprintf(letter, sizeof(letter), "-%c, ", row->letter);
	return snprintf(out, size, "  %s--%s%s%s", letter, row->name, row->argument ? " " : "",
	                row->argument ? row->argument : "");
}

static void print_row(const struct options_row *row, int column, FILE *out)
{
	char name[80];
	int at, n;

	if (!row->name) {
		fprintf(out, "%s\n", row->help);
		return;
	}
	at = format_name(row, name, sizeof(name));
	at = fprintf(out, "%-*s", column > at + 2 ? column : at + 2, name);
	for (const char *word = row->help; *word; word += n + (word[n] == ' ')) {
		n = (int)strcspn(word, " ");
		if (word > row->help && at + 1 + n > PAGE_COLUMNS)
			at = fprintf(out, "\n%*s", column, "") - 1;
		else if (word > row->help)
			at += fprintf(out, " ");
		at += fprintf(out, "%.*s", n, word);
	}
	fputc('\n', out);
}

void options_print_help(const struct options_table *table, FILE *out)
{
	const struct manual_text *examples = manual_find(manual_examples, table->verb);
	int column = format_name(&help_row, NULL, 0);

	for (size_t i = 0; i < table->n_rows; i++) {
		const int n = table->rows[i].name ? format_name(&table->rows[i], NULL, 0) : 0;

		column = n > column && n <= NAME_COLUMNS ? n : column;
	}
	fprintf(out, "%s\n", table->head);
	for (size_t i = 0; i < table->n_rows; i++)
		print_row(&table->rows[i], column + 2, out);
	print_row(&help_row, column + 2, out);
	if (table->notes)
		fprintf(out, "\n%s", table->notes);
	if (examples)
		fprintf(out, "\nExamples:\n%s", examples->text);
}

int options_misuse(const struct options_table *table)
{
	return err_report(ERR_USAGE, NULL, "%s takes %s; 'relume help %s' says more", table->verb, table->takes, table->verb);
}

/* Say what of a command line is missing or too much. */
static int check_complete(const struct options_table *table, const struct options_line *line)
{
	const struct options_row *missing = NULL;

	for (size_t i = 0; i < table->n_rows && !missing; i++)
		if (table->rows[i].is_required && !line->given[i])
			missing = &table->rows[i];
	if (line->n_words > table->most && table->most >= 0)
		return err_report(ERR_USAGE, NULL, "%s takes %s, and '%s' is one too many; 'relume help %s' says more", table->verb,
		                  table->takes, line->words[table->most], table->verb);
	if (line->n_words < table->least && (line->n_words || missing || !table->takes))
		return options_misuse(table);
	if (line->n_words < table->least)
		return err_report(ERR_USAGE, NULL, "%s takes %s, but no file is named; 'relume help %s' says more", table->verb,
		                  table->takes, table->verb);
	if (missing)
		return err_report(ERR_USAGE, NULL, "%s takes %s, but %s%s is missing; 'relume help %s' says more", table->verb,
		                  table->takes, missing->letter ? "-" : "--",
		                  missing->letter ? (const char[]){ missing->letter, '\0' } : missing->name, table->verb);
	return 0;
}

/* --- Parsing ----------------------------------------------------------------------------------------------------- */

/* Build the arguments of getopt_long; the row of --help comes last. */
static void make_getopt(const struct options_table *table, struct option longs[OPTIONS_MAX_ROWS + 2],
                        char letters[2 * OPTIONS_MAX_ROWS + 5])
{
	const size_t n = table->n_rows;
	int n_longs = 0;

	assert(n <= OPTIONS_MAX_ROWS);
	if (table->stops)
		*letters++ = '+';
	*letters++ = ':'; /* makes getopt_long distinguish a missing argument from an unknown option, and print nothing */
	for (size_t i = 0; i <= n; i++) {
		const struct options_row *row = i < n ? &table->rows[i] : &help_row;

		if (!row->name)
			continue;
		longs[n_longs++] = (struct option){ row->name, row->argument ? required_argument : no_argument, NULL,
			                            FIRST_ROW + (int)i };
		if (row->letter)
			*letters++ = row->letter;
		if (row->letter && row->argument)
			*letters++ = ':';
	}
	*letters = '\0';
}

static size_t find_row(const struct options_table *table, int c)
{
	size_t i = 0;

	if (c >= FIRST_ROW)
		return (size_t)(c - FIRST_ROW);
	while (i < table->n_rows && table->rows[i].letter != c)
		i++;
	return i;
}

/* @param word  where getopt_long stopped  @param c  its result: ':' if a value is missing, else '?' */
static int refuse(const struct options_table *table, const struct option *longs, const char *word, int c)
{
	const int is_letter = optopt > 0 && optopt < FIRST_ROW;
	const char letter[3] = { '-', (char)optopt, '\0' };
	char name[64];
	struct nearest nearest = { .typed = name + 2 };

	snprintf(name, sizeof(name), "%.*s", is_letter ? 2 : (int)strcspn(word, "="), is_letter ? letter : word);
	if (c == ':')
		return err_report(ERR_USAGE, NULL, "%s: %s takes a value; 'relume help %s' says which", table->verb,
		                  name, table->verb);
	if (optopt >= FIRST_ROW)
		return err_report(ERR_USAGE, NULL, "%s: %s takes no value", table->verb, name);
	for (; !is_letter && longs->name; longs++)
		nearest_try(&nearest, longs->name);
	return err_report(ERR_USAGE, NULL, "%s has no option '%s'%s%s; 'relume help %s' lists them", table->verb, name,
	                  nearest.word ? ", but --" : "", nearest.word ? nearest.word : "", table->verb);
}

int options_parse(const struct options_table *table, int argc, char **argv, void *out, struct options_line *line)
{
	struct option longs[OPTIONS_MAX_ROWS + 2] = { { 0 } };
	char letters[2 * OPTIONS_MAX_ROWS + 5];
	int c, err;

	*line = (struct options_line){ 0 };
	make_getopt(table, longs, letters);
	optind = 0; /* glibc: start over */
	while ((c = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
		const size_t i = find_row(table, c);
		const struct options_row *row = &table->rows[i];

		if (c == '?' || c == ':')
			return refuse(table, longs, argv[optind - 1], c);
		if (i == table->n_rows) {
			options_print_help(table, stdout);
			return 1;
		}
		line->given[i] = optarg ? optarg : "";
		err = row->set(row, line->given[i], (char *)out + row->at);
		if (err)
			return err;
	}
	line->words = argv + optind;
	line->n_words = argc - optind;
	return check_complete(table, line);
}

/* --- What is kept ------------------------------------------------------------------------------------------------ */

static int no_sandbox;

int options_no_sandbox(const struct options_row *row, const char *value, void *out)
{
	(void)row, (void)value, (void)out;
	no_sandbox = 1;
	return 0;
}

/* Limits for the total size of the recordings named. */
static void limit(const struct confine_file *files, size_t n, enum confine_kind kind)
{
	const char *recording = NULL;
	struct limits limits;
	struct stat info;
	uint64_t bytes = 0;

	for (size_t i = 0; i < n; i++)
		if (files[i].use == CONFINE_RECORDING && stat(files[i].path, &info) == 0 && S_ISREG(info.st_mode)) {
			recording = recording ? recording : files[i].path;
			bytes += (uint64_t)info.st_size;
		}
	limits = kind == CONFINE_READER ? limits_of_reader(bytes) : limits_of_tracer(bytes);
	if (recording)
		limits_begin(recording, &limits);
}

int options_confine(const struct options_table *table, const struct options_line *line, enum confine_kind kind,
                    const char *also)
{
	struct confine_file files[OPTIONS_MAX_ROWS + MOST_WORDS + 1];
	size_t n = 0;
	int err;

	for (size_t i = 0; i < table->n_rows; i++)
		if (line->given[i] && table->rows[i].use)
			files[n++] = (struct confine_file){ line->given[i], table->rows[i].use };
	for (int i = 0; i < line->n_words && i < MOST_WORDS; i++)
		files[n++] = (struct confine_file){ line->words[i], table->words_use };
	if (also)
		files[n++] = (struct confine_file){ also, CONFINE_READS };
	if (no_sandbox)
		return 0;
	err = confine_to(files, n, kind);
	if (!err && (kind == CONFINE_READER || kind == CONFINE_TRACER))
		limit(files, n, kind);
	return err;
}

/* --- Values ------------------------------------------------------------------------------------------------------ */

/* @return a value's index in the row's words, or ERR_USAGE (reported) */
static int find_word(const struct options_row *row, const char *value)
{
	char list[160] = "";
	size_t n = 0;

	for (int i = 0; row->words[i]; i++) {
		if (strcmp(value, row->words[i]) == 0)
			return i;
		n += (size_t)snprintf(list + n, sizeof(list) - n, "%s%s", !i ? "" : row->words[i + 1] ? ", " : " or ", row->words[i]);
		n = n < sizeof(list) ? n : sizeof(list) - 1;
	}
	return err_report(ERR_USAGE, NULL, "--%s takes %s, not '%s'", row->name, list, value);
}

int options_text(const struct options_row *row, const char *value, void *out)
{
	*(const char **)out = value;
	return row->words && find_word(row, value) < 0 ? ERR_USAGE : 0;
}

int options_real(const struct options_row *row, const char *value, void *out)
{
	float *number = out;
	char *end;

	*number = strtof(value, &end);
	if (end == value || *end || !(*number >= row->low && *number <= row->high))
		return err_report(ERR_USAGE, NULL, "--%s takes a number from %g to %g, not '%s'", row->name,
		                  (double)row->low, (double)row->high, value);
	return 0;
}

int options_word(const struct options_row *row, const char *value, void *out)
{
	const int i = find_word(row, value);

	if (i >= 0)
		*(int *)out = i;
	return i < 0 ? i : 0;
}

int options_flag(const struct options_row *row, const char *value, void *out)
{
	(void)row, (void)value;
	*(int *)out = 1;
	return 0;
}

int options_clear(const struct options_row *row, const char *value, void *out)
{
	(void)row, (void)value;
	*(int *)out = 0;
	return 0;
}

int options_number(const struct options_row *row, const char *value, void *out)
{
	unsigned long number;
	char *end;

	errno = 0;
	number = strtoul(value, &end, 10);
	if (errno || end == value || *end || *value == '-' || number < row->least || number > row->most)
		return err_report(ERR_USAGE, NULL, "--%s takes a number from %u to %u, not '%s'", row->name, row->least,
		                  row->most, value);
	*(unsigned *)out = (unsigned)number;
	return 0;
}

int options_bytes(const struct options_row *row, const char *value, void *out)
{
	static const char units[] = "KMGT";
	char *end;
	double bytes = strtod(value, &end);
	const char *unit = *end ? strchr(units, *end & ~0x20) : NULL;

	if (end == value || !(bytes > 0) || (*end && (!unit || end[1])) || bytes > 1e15)
		return err_report(ERR_USAGE, NULL, "--%s takes a number of bytes such as 800M or 4G, not '%s'", row->name, value);
	for (const char *u = units; unit && u <= unit; u++)
		bytes *= 1024;
	*(uint64_t *)out = (uint64_t)bytes;
	return 0;
}

int options_frame(const struct options_row *row, const char *value, void *out)
{
	(void)row;
	return frame_number_parse(value, out) ? ERR_USAGE : 0;
}

int options_frames(const struct options_row *row, const char *value, void *out)
{
	(void)row;
	frame_list_free(out);
	return frame_list_parse(value, out);
}
