#include "base/err.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local int *shared;

static void print_line(const char *kind, const char *where, const char *fmt, va_list args)
{
	char text[1024];

	vsnprintf(text, sizeof(text), fmt, args);
	/* One call, so that lines of several threads and processes do not mix. */
	if (where)
		fprintf(stderr, "relume: %s%s: %s\n", kind, where, text);
	else
		fprintf(stderr, "relume: %s%s\n", kind, text);
}

int err_report(int code, const char *where, const char *fmt, ...)
{
	va_list args;

	if (shared && __atomic_exchange_n(shared, 1, __ATOMIC_RELAXED))
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
