#include "base/err.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

static _Thread_local int *shared;
static const char *before = ""; /* each line */

/* One allocation failure causes others: report only the first. */
static int is_said(const char *fmt)
{
	static int said;

	return strstr(fmt, "out of memory") && __atomic_exchange_n(&said, 1, __ATOMIC_RELAXED);
}

static struct err_lines *lines; /* or NULL */
static uint32_t process;

/* Has an earlier process printed this line? Records that this one has. */
static int is_old(const char *where, const char *text)
{
	const uint64_t hash = XXH3_64bits_withSeed(text, strlen(text), where ? XXH3_64bits(where, strlen(where)) : 0);
	const size_t n = lines ? sizeof(lines->said) / sizeof(lines->said[0]) : 0;

	for (size_t i = 0; i < n; i++) {
		uint64_t none = 0;

		if (__atomic_compare_exchange_n(&lines->said[i].hash, &none, hash, 0, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
			lines->said[i].process = process;
			return 0;
		}
		if (none == hash)
			return lines->said[i].process < process;
	}
	return 0;
}

static void print_line(const char *kind, const char *where, const char *fmt, va_list args)
{
	char text[1024];

	vsnprintf(text, sizeof(text), fmt, args);
	if (is_old(where, text))
		return;
	/* One call, so that lines of threads and processes do not interleave. */
	if (where)
		fprintf(stderr, "%srelume: %s%s: %s\n", before, kind, where, text);
	else
		fprintf(stderr, "%srelume: %s%s\n", before, kind, text);
}

void err_carry_on(struct err_lines *of, uint32_t number)
{
	lines = of;
	process = number;
}

void err_clear_bar(int stands)
{
	before = stands ? "\r\033[K" : "";
}

int err_report(int code, const char *where, const char *fmt, ...)
{
	va_list args;

	if ((shared && __atomic_exchange_n(shared, 1, __ATOMIC_RELAXED)) || is_said(fmt))
		return code;
	va_start(args, fmt);
	print_line("", where, fmt, args);
	va_end(args);
	return code;
}

void err_share(int *said)
{
	shared = said;
}

void err_warn(const char *where, const char *fmt, ...)
{
	va_list args;

	va_start(args, fmt);
	print_line("warning: ", where, fmt, args);
	va_end(args);
}
