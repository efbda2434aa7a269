#include "verbs/farm/spans.h"

#include <inttypes.h>

static void put_run(struct spans *s)
{
	if (!s->n)
		return;
	if (s->printed == SPANS_MOST)
		fputs(",...", s->out);
	if (s->printed++ >= SPANS_MOST)
		return;
	fprintf(s->out, "%s%" PRIu64, s->printed > 1 ? "," : "", s->first);
	if (s->n > 1)
		fprintf(s->out, "%c%" PRIu64, s->n == 2 && s->step > 1 ? ',' : '-', s->last);
	if (s->n > 2 && s->step > 1)
		fprintf(s->out, "x%" PRIu64, s->step);
}

void spans_add(struct spans *s, uint64_t frame)
{
	const uint64_t step = frame - s->last, last = s->last;

	if (s->n == 2 && s->step > 1 && step != s->step) { /* two frames are no run: the second may begin one */
		s->n = 1;
		put_run(s);
		s->first = last;
	} else if (s->n > 1 && step != s->step) {
		put_run(s);
		s->n = 0;
	}
	if (!s->n)
		s->first = frame;
	if (s->n == 1)
		s->step = step;
	s->last = frame;
	s->n++;
}

void spans_end(struct spans *s)
{
	put_run(s);
	s->n = 0;
}
