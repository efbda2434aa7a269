/* Finds the draws that show the failing pixels. */
#include "diff/score/measures.h"

#include <stdlib.h>

#include "base/err.h"

/* One failing pixel, counted against a draw. */
struct vote {
	uint32_t draw;
	uint32_t at; /* pixel index */
};

static int compare_votes(const void *a, const void *b)
{
	const struct vote *x = a, *y = b;

	if (x->draw != y->draw)
		return x->draw < y->draw ? -1 : 1;
	return (x->at > y->at) - (x->at < y->at);
}

/* The draw number of a pixel; 0: none. 2^32 - 256 is the largest float below 2^32. */
static uint32_t draw_at(const float *ids, size_t i)
{
	return ids[i] > 0 && ids[i] < 4294967040.0f ? (uint32_t)ids[i] : 0;
}

/** Insert a draw into the list of those with most failing pixels, in descending order; earlier ones precede equals. */
static void add_blame(struct score *s, const struct score_blame *blame)
{
	uint32_t at = s->n_blame;

	if (at == SCORE_MAX_BLAME) {
		if (s->blame[at - 1].pixels >= blame->pixels)
			return;
		at--;
	} else {
		s->n_blame++;
	}
	for (; at > 0 && s->blame[at - 1].pixels < blame->pixels; at--)
		s->blame[at] = s->blame[at - 1];
	s->blame[at] = *blame;
}

/** Sort votes by draw, and blame each draw for its failing pixels. */
static void count_votes(struct vote *votes, size_t n, uint32_t width, int is_approved, struct score *s)
{
	qsort(votes, n, sizeof(*votes), compare_votes);
	for (size_t i = 0, end; i < n; i = end) {
		struct score_blame b = { .draw = votes[i].draw, .is_approved = is_approved, .x0 = UINT32_MAX, .y0 = UINT32_MAX };

		for (end = i; end < n && votes[end].draw == b.draw; end++) {
			uint32_t x = votes[end].at % width, y = votes[end].at / width;

			b.x0 = x < b.x0 ? x : b.x0;
			b.x1 = x > b.x1 ? x : b.x1;
			b.y0 = y < b.y0 ? y : b.y0;
			b.y1 = y > b.y1 ? y : b.y1;
		}
		b.pixels = end - i;
		add_blame(s, &b);
	}
}

int gate_blame(const struct gate_frame *f)
{
	const struct score_picture *traced = &f->traced;
	const struct image *was = f->approved ? f->approved->image : NULL;
	const uint8_t *blamed = f->blamed;
	const size_t n = (size_t)f->ref->width * f->ref->height;
	struct score *s = f->score;
	const float *old = was && was->width == traced->width && was->height == traced->height
		? image_channel(was, "id") : NULL;
	struct vote *votes;
	size_t count = 0, moved = 0;

	for (size_t i = 0; i < n; i++)
		s->blamed_pixels += blamed[i];
	if (!traced->id || s->blamed_pixels == 0)
		return 0;
	votes = malloc(2 * s->blamed_pixels * sizeof(*votes));
	if (!votes)
		return err_report(ERR_SYSTEM, NULL, "out of memory");

	/* A missing draw has no pixels to blame it by. Where the approved frame shows another draw, blame that one
	 * first. */
	for (size_t i = 0; old && i < n; i++)
		if (blamed[i] && draw_at(old, i) != draw_at(traced->id, i))
			votes[moved++] = (struct vote){ draw_at(old, i), (uint32_t)i };
	count_votes(votes, moved, traced->width, 1, s);
	for (size_t i = 0; i < n; i++)
		if (blamed[i])
			votes[moved + count++] = (struct vote){ draw_at(traced->id, i), (uint32_t)i };
	count_votes(votes + moved, count, traced->width, 0, s);
	free(votes);
	return 0;
}
