/* Gate R4: compares which pixels are covered, whatever their colour. */
#include "diff/score/measures.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "diff/score/picture.h"

/*
 * By colour, a pixel is covered if it differs from the background by more than COVER_HIGH codes, and uncovered up to
 * COVER_LOW. In between it matches both, so that rounding flips no pixel where something fades into the background.
 */
enum { COVER_LOW = 2, COVER_HIGH = 4 };

/**
 * Find the most frequent colour among the chosen pixels.
 * @param chosen  1 for pixels that count; NULL: all do
 * @param found   receives 0 if no pixel is chosen, so that color is not set
 * @return 0 or ERR_SYSTEM (reported)
 */
static int find_background(const uint8_t *rgb, const uint8_t *chosen, size_t n, uint8_t color[3], int *found)
{
	uint32_t *counts = calloc(1 << 24, sizeof(*counts)), most = 0;

	if (!counts)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < n; i++) {
		const uint8_t *p = rgb + 3 * i;
		uint32_t *count = &counts[p[0] << 16 | p[1] << 8 | p[2]];

		if (chosen && !chosen[i])
			continue;
		if (++*count > most) {
			most = *count;
			memcpy(color, p, 3);
		}
	}
	free(counts);
	*found = most > 0;
	return 0;
}

/** Measure the largest group of marked pixels that touch, at sides or corners. Clears the marks. */
static int largest_blob(uint8_t *marks, int width, int height, uint64_t *largest)
{
	const size_t n = (size_t)width * (size_t)height;
	uint32_t *stack = malloc((n ? n : 1) * sizeof(*stack));

	if (!stack)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	*largest = 0;
	for (size_t start = 0; start < n; start++) {
		size_t top = 0;
		uint64_t size = 0;

		if (!marks[start])
			continue;
		marks[start] = 0;
		stack[top++] = (uint32_t)start;
		while (top) {
			int x = (int)(stack[--top] % (uint32_t)width), y = (int)(stack[top] / (uint32_t)width);

			size++;
			for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++) {
				for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++) {
					size_t i = (size_t)v * (size_t)width + (size_t)u;

					if (marks[i]) {
						marks[i] = 0; /* each pixel is pushed once, so the stack holds n */
						stack[top++] = (uint32_t)i;
					}
				}
			}
		}
		*largest = size > *largest ? size : *largest;
	}
	free(stack);
	return 0;
}

/** Depth of the background: that of undrawn pixels in the traced frame; GL's default if all are covered. */
static float background_depth(const struct score_picture *traced, size_t n)
{
	for (size_t i = 0; traced->id && i < n; i++)
		if (traced->id[i] == 0)
			return traced->depth[i];
	return 1;
}

/* Whether a pixel is covered: 0 no, 1 perhaps, 2 yes. */
static int coverage(const struct score_picture *pic, size_t i, int use_depth, float far_depth,
                    const uint8_t *background)
{
	int d = background ? score_code_difference(pic->rgb + 3 * i, background) : 0;

	if (use_depth && pic->depth[i] != far_depth)
		return 2;
	return d > COVER_HIGH ? 2 : d > COVER_LOW ? 1 : 0;
}

int gate_silhouette(struct gate_frame *f)
{
	const struct score_picture *ref = f->ref, *traced = &f->traced;
	const size_t n = (size_t)ref->width * ref->height;
	const int use_depth = ref->depth && traced->depth;
	const float far_depth = use_depth ? background_depth(traced, n) : 1;
	uint8_t *marks = calloc(n ? n : 1, 1);
	uint8_t background[2][3];
	uint64_t both = 0, unmatched = 0, largest = 0;
	int found[2], err = ERR_SYSTEM;

	if (!marks) {
		err_report(ERR_SYSTEM, NULL, "out of memory");
		goto fail;
	}
	/* Find the background's colour on each side, among pixels where the traced frame drew nothing. */
	for (size_t i = 0; i < n; i++)
		marks[i] = traced->id ? traced->id[i] == 0 : use_depth ? traced->depth[i] == far_depth : 1;
	err = find_background(ref->rgb, marks, n, background[0], &found[0]);
	if (!err)
		err = find_background(traced->rgb, marks, n, background[1], &found[1]);
	if (err)
		goto fail;
	if (!use_depth && !found[0]) {
		gate_note(f, GATE_R4, "depth is not on both sides, and every pixel is covered");
		goto fail;
	}

	for (size_t i = 0; i < n; i++) {
		marks[i] = 0;
		if (score_ignores(ref, i))
			continue;
		int a = coverage(ref, i, use_depth, far_depth, found[0] ? background[0] : NULL);
		int b = coverage(traced, i, use_depth, far_depth, found[1] ? background[1] : NULL);

		marks[i] = (a == 2 && b == 0) || (a == 0 && b == 2);
		unmatched += marks[i];
		both += a && b;
	}
	err = largest_blob(marks, (int)ref->width, (int)ref->height, &largest);
	if (err)
		goto fail;
	gate_measure(f, GATE_R4, 0, both + unmatched ? (double)both / (double)(both + unmatched) : 1);
	gate_measure(f, GATE_R4, 1, (double)largest);
	gate_note(f, GATE_R4, "%s; %" PRIu64 " px covered, %" PRIu64 " unmatched",
	     use_depth ? "from depth and colour"
	               : ref->depth ? "no depth known of the frame: from difference to the background colour"
	                            : "no depth reference: from difference to the background colour",
	     both + unmatched, unmatched);
fail:
	free(marks);
	return err;
}
