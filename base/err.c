#include "base/err.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static _Thread_local int *shared;
static const char *before = ""; /* each line */

/* Memory that is short for one thing is short for all that comes of it: one line says so. */
static int is_said(const char *fmt)
{
	static int said;

	return strstr(fmt, "out of memory") && __atomic_exchange_n(&said, 1, __ATOMIC_RELAXED);
}

static void print_line(const char *kind, const char *where, const char *fmt, va_list args)
{
	char text[1024];

	vsnprintf(text, sizeof(text), fmt, args);
	/* One call, so that lines of several threads and processes do not mix. */
	if (where)
		fprintf(stderr, "%srelume: %s%s: %s\n", before, kind, where, text);
	else
		fprintf(stderr, "%srelume: %s%s\n", before, kind, text);
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
