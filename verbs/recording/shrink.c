/* Delta debugging, with several tests at once. */
#include "verbs/recording/shrink.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

/* The things still in the set, in order, and memory for the sets of one test. */
struct work {
	size_t *left, n_left, n, at_once;
	uint8_t **sets;
	int *fails;
	shrink_test *test;
	void *user;
};

static int begin(struct work *w, const uint8_t *in)
{
	w->left = malloc((w->n + 1) * sizeof(*w->left));
	w->sets = calloc(w->at_once, sizeof(*w->sets));
	w->fails = calloc(w->at_once, sizeof(*w->fails));
	for (size_t i = 0; w->sets && i < w->at_once; i++)
		if (!(w->sets[i] = malloc(w->n + 1)))
			return 0;
	for (size_t i = 0; w->left && i < w->n; i++)
		if (in[i])
			w->left[w->n_left++] = i;
	return w->left && w->sets && w->fails;
}

static void end(struct work *w)
{
	for (size_t i = 0; w->sets && i < w->at_once; i++)
		free(w->sets[i]);
	free(w->sets);
	free(w->fails);
	free(w->left);
}

/* Try to remove each piece of this size once. changed: receives 1 if any could be removed. */
static int leave_out(struct work *w, size_t size, int *changed)
{
	size_t stop = w->n_left;
	int err = 0;

	while (stop && !err) {
		size_t ends[64], n = 0, first;

		for (size_t e = stop; e && n < w->at_once && n < 64; e -= e < size ? e : size)
			ends[n++] = e;
		for (size_t s = 0; s < n; s++) {
			memset(w->sets[s], 0, w->n);
			for (size_t i = 0; i < w->n_left; i++)
				w->sets[s][w->left[i]] = i >= ends[s] || i + size < ends[s];
		}
		err = w->test(w->user, w->sets, n, w->fails);
		for (first = 0; first < n && !w->fails[first];)
			first++;
		stop = ends[first < n ? first : n - 1];
		stop -= stop < size ? stop : size;
		if (err || first == n)
			continue;
		memmove(w->left + stop, w->left + ends[first], (w->n_left - ends[first]) * sizeof(*w->left));
		w->n_left -= ends[first] - stop;
		*changed = 1;
	}
	return err;
}

int shrink(uint8_t *in, size_t n, size_t at_once, shrink_test *test, void *user)
{
	struct work w = { .n = n, .at_once = at_once, .test = test, .user = user };
	int err = begin(&w, in) ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory"), changed = 1;

	for (size_t size = (w.n_left + 1) / 2; size && !err && w.n_left; size = size == 1 && changed ? 1 : size / 2) {
		changed = 0;
		err = leave_out(&w, size, &changed);
	}
	if (!err) {
		memset(in, 0, n);
		for (size_t i = 0; i < w.n_left; i++)
			in[w.left[i]] = 1;
	}
	end(&w);
	return err;
}
