#include "base/frames.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"

#define MOST_STEPS 100000000 /* about a second */

static int compare_first(const void *a, const void *b)
{
	const struct frame_range *x = a, *y = b;

	return (x->first > y->first) - (x->first < y->first);
}

/** Read a decimal number at *p and move *p past it. @return 0 if there is none or it does not fit 64 bits */
static int parse_number(const char **p, uint64_t *out)
{
	uint64_t value = 0;

	if (**p < '0' || **p > '9')
		return 0;
	for (; **p >= '0' && **p <= '9'; (*p)++) {
		unsigned digit = (unsigned)(**p - '0');

		if (value > (UINT64_MAX - digit) / 10)
			return 0;
		value = value * 10 + digit;
	}
	*out = value;
	return 1;
}

static int parse_range(const char **p, struct frame_range *r)
{
	if (!parse_number(p, &r->first))
		return 0;
	r->last = r->first;
	r->step = 1;
	if (**p == '-') {
		(*p)++;
		if (**p == '\0' || **p == ',' || **p == 'x')
			r->last = UINT64_MAX; /* to the end */
		else if (!parse_number(p, &r->last) || r->last < r->first)
			return 0;
	}
	if (**p == 'x') {
		(*p)++;
		if (!parse_number(p, &r->step) || r->step == 0)
			return 0;
	}
	if (r->first == r->last)
		r->step = 1;
	return 1;
}

/* Join ranges of every frame that overlap. */
static void join(struct frame_list *list)
{
	struct frame_range *whole = NULL; /* the last one kept */
	size_t kept = 0;

	for (size_t i = 0; i < list->n_ranges; i++) {
		struct frame_range r = list->ranges[i];

		if (r.step == 1 && whole && r.first <= whole->last) {
			whole->last = r.last > whole->last ? r.last : whole->last;
			continue;
		}
		list->ranges[kept] = r;
		whole = r.step == 1 ? &list->ranges[kept] : whole;
		kept++;
	}
	list->n_ranges = kept;
}

/** 1 if no two ranges can hold the same frame, so that their counts can be added. */
static int is_disjoint(const struct frame_list *list)
{
	for (size_t i = 1; i < list->n_ranges; i++)
		if (list->ranges[i].first <= list->ranges[i - 1].last)
			return 0;
	return 1;
}

/* 1 if counting the frames one by one, over all ranges, takes too long. */
static int is_too_long(const struct frame_list *list)
{
	uint64_t left = MOST_STEPS / (list->n_ranges ? list->n_ranges : 1);

	for (size_t i = 0; i < list->n_ranges; i++) {
		uint64_t steps = (list->ranges[i].last - list->ranges[i].first) / list->ranges[i].step;

		if (steps >= left)
			return 1;
		left -= steps + 1;
	}
	return 0;
}

int frame_list_parse(const char *text, struct frame_list *out)
{
	return frame_list_parse_of(text, "frame range", out);
}

int frame_list_parse_of(const char *text, const char *what, struct frame_list *out)
{
	struct frame_list list = { 0 };
	const char *p = text;

	for (;;) {
		if (memory_resize(&list.ranges, list.n_ranges + 1, sizeof(*list.ranges))) {
			frame_list_free(&list);
			return ERR_SYSTEM;
		}
		if (!parse_range(&p, &list.ranges[list.n_ranges]) || (*p != ',' && *p != '\0')) {
			frame_list_free(&list);
			return err_report(ERR_USAGE, NULL, "'%s' is not a %s; write 7, 1-500, 55-, 1-500x5, "
			                  "or several with commas", text, what);
		}
		list.n_ranges++;
		if (*p == '\0')
			break;
		p++;
	}
	qsort(list.ranges, list.n_ranges, sizeof(*list.ranges), compare_first);
	join(&list);
	if (!is_disjoint(&list) && is_too_long(&list)) {
		frame_list_free(&list);
		return err_report(ERR_USAGE, NULL,
		                  "'%s' names too much in ranges that overlap; write ranges that do not", text);
	}
	*out = list;
	return 0;
}

void frame_list_free(struct frame_list *list)
{
	free(list->ranges);
	*list = (struct frame_list){ 0 };
}

int frame_list_contains(const struct frame_list *list, uint64_t frame)
{
	if (list->n_ranges == 0)
		return 1;
	for (size_t i = 0; i < list->n_ranges; i++) {
		const struct frame_range *r = &list->ranges[i];

		if (frame >= r->first && frame <= r->last && (frame - r->first) % r->step == 0)
			return 1;
	}
	return 0;
}

uint64_t frame_list_last(const struct frame_list *list)
{
	uint64_t last = 0;

	if (list->n_ranges == 0)
		return UINT64_MAX;
	for (size_t i = 0; i < list->n_ranges; i++) {
		const struct frame_range *r = &list->ranges[i];
		uint64_t end = r->last == UINT64_MAX ? r->last : r->last - (r->last - r->first) % r->step;

		if (end > last)
			last = end;
	}
	return last;
}

uint64_t frame_list_needed(const struct frame_list *list)
{
	uint64_t needed = 0;

	for (size_t i = 0; i < list->n_ranges; i++) {
		const struct frame_range *r = &list->ranges[i];
		const uint64_t end = r->last == UINT64_MAX ? r->first : r->last - (r->last - r->first) % r->step;

		needed = end > needed ? end : needed;
	}
	return needed;
}

int frame_report_missing(const char *trace, uint64_t frame, uint64_t n)
{
	if (n == 0)
		return err_report(ERR_INPUT, trace, "holds no whole frame");
	if (n == 1)
		return err_report(ERR_USAGE, trace, "there is no frame %" PRIu64 "; the trace has 1 frame (0)", frame);
	return err_report(ERR_USAGE, trace,
	                  "there is no frame %" PRIu64 "; the trace has %" PRIu64 " frames (0 to %" PRIu64 ")", frame, n,
	                  n - 1);
}

/** The first frame of a range from `from` on. */
static int next_of_range(const struct frame_range *r, uint64_t from, uint64_t *frame)
{
	uint64_t steps;

	if (from <= r->first) {
		*frame = r->first;
		return 1;
	}
	if (from > r->last)
		return 0;
	steps = (from - r->first - 1) / r->step + 1;
	if (steps > (r->last - r->first) / r->step)
		return 0;
	*frame = r->first + steps * r->step;
	return 1;
}

int frame_list_next(const struct frame_list *list, uint64_t from, uint64_t *frame)
{
	uint64_t candidate;
	int found = 0;

	if (list->n_ranges == 0) {
		*frame = from;
		return 1;
	}
	for (size_t i = 0; i < list->n_ranges; i++)
		if (next_of_range(&list->ranges[i], from, &candidate) && (!found || candidate < *frame)) {
			*frame = candidate;
			found = 1;
		}
	return found;
}

uint64_t frame_list_count(const struct frame_list *list, uint64_t end)
{
	uint64_t count = 0;

	if (list->n_ranges == 0)
		return end;
	if (is_disjoint(list)) {
		for (size_t i = 0; i < list->n_ranges; i++) {
			const struct frame_range *r = &list->ranges[i];

			if (r->first < end)
				count += ((end - 1 < r->last ? end - 1 : r->last) - r->first) / r->step + 1;
		}
		return count;
	}
	/* Ranges overlap, so count frames one by one. */
	for (uint64_t frame = 0; frame_list_next(list, frame, &frame) && frame < end; frame++)
		count++;
	return count;
}

int frame_number_parse(const char *text, uint64_t *frame)
{
	char *end;

	*frame = strtoull(text, &end, 10);
	if (end == text || *end || *text == '-')
		return err_report(ERR_USAGE, NULL, "'%s' is not a frame number", text);
	return 0;
}

int frame_chunk_parse(const char *text, uint64_t *i, uint64_t *n)
{
	const char *p = text;

	if (!parse_number(&p, i) || *p++ != '/' || !parse_number(&p, n) || *p || *i < 1 || *i > *n)
		return err_report(ERR_USAGE, NULL, "'%s' is not a chunk; write i/n with i from 1 to n, as in 3/50", text);
	return 0;
}

/** The frame at index `rank` of the list. */
static uint64_t frame_of_rank(const struct frame_list *list, uint64_t rank)
{
	uint64_t frame = 0;

	if (list->n_ranges == 0)
		return rank;
	if (is_disjoint(list)) {
		for (size_t i = 0; i < list->n_ranges; i++) {
			const struct frame_range *r = &list->ranges[i];
			uint64_t count = (r->last - r->first) / r->step + 1;

			if (rank < count)
				return r->first + rank * r->step;
			rank -= count;
		}
		return UINT64_MAX;
	}
	for (; frame_list_next(list, frame, &frame) && rank; frame++)
		rank--;
	return frame;
}

/** How many frames the first i of n parts hold: total * i / n without overflow. */
static uint64_t frames_before(uint64_t total, uint64_t i, uint64_t n)
{
	return total / n * i + total % n * i / n;
}

uint64_t frame_list_part_of(const struct frame_list *list, uint64_t end, uint64_t frame, uint64_t n)
{
	uint64_t total = frame_list_count(list, end), rank = frame_list_count(list, frame), low = 1, high = n;

	while (low < high) {
		uint64_t middle = low + (high - low) / 2;

		if (rank < frames_before(total, middle, n))
			high = middle;
		else
			low = middle + 1;
	}
	return low;
}

int frame_list_chunk(struct frame_list *list, uint64_t end, uint64_t i, uint64_t n)
{
	uint64_t total = frame_list_count(list, end), first, last;
	uint64_t from = frames_before(total, i - 1, n), to = frames_before(total, i, n);
	size_t kept = 0;

	if (from == to)
		return 1;
	first = frame_of_rank(list, from);
	last = frame_of_rank(list, to - 1);
	if (list->n_ranges == 0) {
		list->ranges = malloc(sizeof(*list->ranges));
		if (!list->ranges)
			return err_report(ERR_SYSTEM, NULL, "out of memory");
		list->ranges[0] = (struct frame_range){ first, last, 1 };
		list->n_ranges = 1;
		return 0;
	}
	for (size_t k = 0; k < list->n_ranges; k++) {
		struct frame_range r = list->ranges[k];

		if (!next_of_range(&r, first, &r.first) || r.first > last)
			continue;
		r.last = r.last < last ? r.last : last;
		list->ranges[kept++] = r;
	}
	list->n_ranges = kept;
	qsort(list->ranges, kept, sizeof(*list->ranges), compare_first);
	return 0;
}

/** The frame number's place in a pattern: where it starts, how long it is, and the width it is padded to. */
static int find_number(const char *pattern, size_t *start, size_t *length, int *width)
{
	for (const char *p = pattern; *p; p++) {
		const char *q = p;

		if (*p == '#') {
			while (*q == '#')
				q++;
			*width = (int)(q - p);
		} else if (*p == '%') {
			/* two digits are wide enough for any frame number */
			*width = 0;
			for (q++; *q >= '0' && *q <= '9' && *width < 10; q++)
				*width = *width * 10 + (*q - '0');
			if (*q != 'd')
				continue;
			q++;
		} else if (p[0] == '$' && p[1] == 'F') {
			q += 2;
			*width = (*q >= '1' && *q <= '9') ? *q++ - '0' : 0;
		} else if (strncmp(p, "{frame}", 7) == 0) {
			q += 7;
			*width = 0;
		} else {
			continue;
		}
		*start = (size_t)(p - pattern);
		*length = (size_t)(q - p);
		return 1;
	}
	return 0;
}

int frame_pattern_has_number(const char *pattern)
{
	size_t start, length;
	int width;

	return find_number(pattern, &start, &length, &width);
}

size_t frame_pattern_prefix(const char *pattern)
{
	size_t start, length;
	int width;

	return find_number(pattern, &start, &length, &width) ? start : strlen(pattern);
}

int frame_pattern_expand(const char *pattern, uint64_t frame, char *out, size_t size)
{
	size_t start, length;
	int width, n;

	if (find_number(pattern, &start, &length, &width))
		n = snprintf(out, size, "%.*s%0*" PRIu64 "%s", (int)start, pattern, width, frame,
		             pattern + start + length);
	else
		n = snprintf(out, size, "%s", pattern);
	if (n < 0 || (size_t)n >= size)
		return err_report(ERR_USAGE, pattern, "the file name is too long");
	return 0;
}
