#include "base/frames.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"

static int compare_first(const void *a, const void *b)
{
	const struct frame_range *x = a, *y = b;

	return (x->first > y->first) - (x->first < y->first);
}

/** Read a decimal number at *p and move *p past it; 0 where there is none or it does not fit 64 bits. */
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
		if (!parse_number(p, &r->last) || r->last < r->first)
			return 0;
	}
	if (**p == 'x') {
		(*p)++;
		if (!parse_number(p, &r->step) || r->step == 0)
			return 0;
	}
	return 1;
}

int frame_list_parse(const char *text, struct frame_list *out)
{
	struct frame_list list = { 0 };
	const char *p = text;

	for (;;) {
		struct frame_range *grown = realloc(list.ranges, (list.n_ranges + 1) * sizeof(*grown));

		if (!grown) {
			frame_list_free(&list);
			return err_report(ERR_SYSTEM, NULL, "out of memory");
		}
		list.ranges = grown;
		if (!parse_range(&p, &list.ranges[list.n_ranges]) || (*p != ',' && *p != '\0')) {
			frame_list_free(&list);
			return err_report(ERR_USAGE, NULL, "'%s' is no frame range; write 7, 1-500, 1-500x5, "
			                  "or several with commas", text);
		}
		list.n_ranges++;
		if (*p == '\0')
			break;
		p++;
	}
	qsort(list.ranges, list.n_ranges, sizeof(*list.ranges), compare_first);
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
		uint64_t end = r->last - (r->last - r->first) % r->step;

		if (end > last)
			last = end;
	}
	return last;
}

uint64_t frame_list_count(const struct frame_list *list, uint64_t end)
{
	uint64_t count = 0;

	if (list->n_ranges == 0)
		return end;
	/* Ranges may overlap, so frames are asked for one by one; the cost is that of naming them. */
	for (uint64_t frame = 0; frame < end && frame <= frame_list_last(list); frame++)
		count += (uint64_t)frame_list_contains(list, frame);
	return count;
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
