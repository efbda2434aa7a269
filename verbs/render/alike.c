#include "verbs/render/alike.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

struct alike_reason {
	char *text;
	uint64_t *frames;
	size_t n;
};

static struct alike_reason *find(struct alike *a, const char *text)
{
	struct alike_reason *more;
	size_t i = 0;

	while (i < a->n && strcmp(a->reasons[i].text, text) != 0)
		i++;
	if (i < a->n)
		return &a->reasons[i];
	more = realloc(a->reasons, (a->n + 1) * sizeof(*more));
	if (!more)
		return NULL;
	a->reasons = more;
	more[a->n] = (struct alike_reason){ .text = strdup(text) };
	return more[a->n].text ? &more[a->n++] : NULL;
}

void alike_note(struct alike *a, uint64_t frame, const char *text)
{
	struct alike_reason *r = find(a, text);
	uint64_t *more = r ? realloc(r->frames, (r->n + 1) * sizeof(*more)) : NULL;

	if (more) {
		r->frames = more;
		more[r->n++] = frame;
	}
	if (!more || r->n == 1)
		err_report(ERR_SYSTEM, NULL, "frame %" PRIu64 ": %s", frame, text);
}

static int by_number(const void *a, const void *b)
{
	const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;

	return (x > y) - (x < y);
}

/* "7-19, 21"; "and so on" where the room ends. */
static void write_ranges(struct alike_reason *r, char *text, size_t size)
{
	size_t at = 0;

	qsort(r->frames, r->n, sizeof(*r->frames), by_number);
	for (size_t i = 0, last; i < r->n; i = last + 1) {
		for (last = i; last + 1 < r->n && r->frames[last + 1] <= r->frames[last] + 1; last++)
			;
		if (size - at < 64) {
			snprintf(text + at, size - at, ", and so on");
			return;
		}
		at += (size_t)snprintf(text + at, size - at, "%s%" PRIu64, i ? ", " : "", r->frames[i]);
		if (r->frames[last] > r->frames[i])
			at += (size_t)snprintf(text + at, size - at, "-%" PRIu64, r->frames[last]);
	}
}

void alike_end(struct alike *a)
{
	char ranges[512];

	for (size_t i = 0; i < a->n; i++) {
		struct alike_reason *r = &a->reasons[i];

		if (r->n > 1) {
			write_ranges(r, ranges, sizeof(ranges));
			err_report(ERR_SYSTEM, NULL, "frames %s: %s", ranges, r->text);
		}
		free(r->text);
		free(r->frames);
	}
	free(a->reasons);
	*a = (struct alike){ .n = 0 };
}
