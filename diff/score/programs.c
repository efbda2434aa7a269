/* Measures how well pixels agree for draws that ran the application's own programs. */
#include "diff/score/measures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/frames.h"
#include "diff/score/picture.h"

#define MOST_DRAWS ((size_t)1 << 24)

/* Count the pixels that the listed draws show. marked: [n] scratch memory, by draw number */
static void count_pixels(const struct gate_frame *f, const struct frame_list *draws, uint8_t *marked, size_t n,
                         struct score_program *program)
{
	const size_t n_pixels = (size_t)f->ref->width * f->ref->height;
	const float *id = f->traced.id;

	memset(marked, 0, n);
	for (size_t i = 0; i < draws->n_ranges; i++)
		for (uint64_t draw = draws->ranges[i].first; draw <= draws->ranges[i].last && draw < n; draw++)
			marked[draw] = 1;
	for (size_t i = 0; i < n_pixels; i++)
		if (id[i] >= 1 && id[i] < (float)n && marked[(size_t)id[i]] && !score_ignores(f->ref, i)) {
			program->pixels++;
			program->failing += f->maps.failing[i];
		}
}

/* One past the highest draw number in the frame. */
static size_t end_of_draws(const struct gate_frame *f)
{
	const size_t n = (size_t)f->ref->width * f->ref->height;
	size_t end = 1;

	for (size_t i = 0; i < n; i++)
		if (f->traced.id[i] >= (float)end && f->traced.id[i] < (float)MOST_DRAWS)
			end = (size_t)f->traced.id[i] + 1;
	return end;
}

/* Add a program and its draws: "program object 7=1-4,9-9". Modifies the text, and ignores text of another form. */
static void add_program(const struct gate_frame *f, char *text, uint8_t *marked, size_t n)
{
	struct score *s = f->score;
	struct score_program *program = &s->programs[s->n_programs];
	struct frame_list draws = { .ranges = NULL };
	char *ranges = strchr(text, '=');

	if (!ranges || !ranges[1] || s->n_programs == SCORE_MAX_PROGRAMS)
		return;
	*ranges++ = 0;
	if (frame_list_parse(ranges, &draws) != 0)
		return;
	*program = (struct score_program){ .pixels = 0 };
	snprintf(program->name, sizeof(program->name), "%s", text);
	count_pixels(f, &draws, marked, n, program);
	s->n_programs += program->pixels > 0;
	frame_list_free(&draws);
}

int gate_programs(const struct gate_frame *f)
{
	const char *listed = image_attribute(f->img, "relume:programs");
	uint8_t *marked;
	char *text, *rest;
	size_t n;

	if (!listed || !f->traced.id || !f->maps.failing)
		return 0;
	n = end_of_draws(f);
	marked = malloc(n);
	text = rest = strdup(listed);
	for (char *part; marked && text && (part = strsep(&rest, ";"));)
		add_program(f, part, marked, n);
	n = marked && text;
	free(marked);
	free(text);
	return n ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory for programs");
}
