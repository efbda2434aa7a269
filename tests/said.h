/* Captures what a tested function reports on stderr. */
#pragma once

#include <check.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct said {
	FILE *log;
	int stderr_was;
};

static inline struct said said_begin(void)
{
	struct said s = { tmpfile(), dup(2) };

	ck_assert(s.log && s.stderr_was >= 0);
	dup2(fileno(s.log), 2);
	return s;
}

/** @param out  receives the text since said_begin(), cut to size */
static inline void said_end(struct said *s, char *out, size_t size)
{
	dup2(s->stderr_was, 2);
	close(s->stderr_was);
	rewind(s->log);
	out[fread(out, 1, size - 1, s->log)] = '\0';
	fclose(s->log);
}

static inline void said_write_file(const char *path, const char *text)
{
	FILE *f = fopen(path, "w");

	ck_assert_ptr_nonnull(f);
	fputs(text, f);
	fclose(f);
}
