#include "verbs/bisect/align.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"

enum { MOST_EDITS = 500 }; /* in a script; time and memory grow with the square of this */

struct part {
	size_t a0, a1, b0, b1;
};

struct work {
	const uint64_t *a, *b;
	uint8_t *a_parts, *b_parts; /* 1: has no partner */
	int32_t *rows;              /* for scripts of 0 .. MOST_EDITS edits: row d has 2 d + 1 places */
};

struct key_place {
	uint64_t key;
	size_t at;
};

/* A pair of equal elements that occur once in each part, and the longest chain of such pairs that ends here. */
struct anchor {
	size_t a, b, before; /* before: the anchor before it, counted from 1; 0: none */
};

static void trim(const struct work *w, struct part *p)
{
	while (p->a0 < p->a1 && p->b0 < p->b1 && w->a[p->a0] == w->b[p->b0])
		p->a0++, p->b0++;
	while (p->a0 < p->a1 && p->b0 < p->b1 && w->a[p->a1 - 1] == w->b[p->b1 - 1])
		p->a1--, p->b1--;
}

/* --- Myers, "An O(ND) Difference Algorithm and Its Variations" (1986), figure 2 ---------------------------------- */

static int32_t *row(const struct work *w, int d)
{
	return w->rows + (size_t)d * (size_t)d + (size_t)d; /* its middle: diagonal 0 */
}

/* Is the furthest path on diagonal k reached from diagonal k + 1 (down), rather than from k - 1? */
static int comes_down(const int32_t *before, int d, int k)
{
	return k == -d || (k != d && before[k - 1] < before[k + 1]);
}

/* The furthest that d edits reach on diagonal k. */
static int32_t furthest(const int32_t *before, int d, int k)
{
	return comes_down(before, d, k) ? before[k + 1] : before[k - 1] + 1;
}

static void mark_script(struct work *w, const struct part *p, int edits)
{
	int32_t x = (int32_t)(p->a1 - p->a0), y = (int32_t)(p->b1 - p->b0);

	for (int d = edits; d > 0; d--) {
		const int32_t *before = row(w, d - 1);
		const int k = x - y, down = comes_down(before, d, k);

		x = before[down ? k + 1 : k - 1];
		y = x - (down ? k + 1 : k - 1);
		if (down)
			w->b_parts[p->b0 + (size_t)y] = 1;
		else
			w->a_parts[p->a0 + (size_t)x] = 1;
	}
}

/* @return 1; 0: it takes too many edits */
static int find_script(struct work *w, const struct part *p)
{
	const int32_t n = (int32_t)(p->a1 - p->a0), m = (int32_t)(p->b1 - p->b0);

	for (int d = 0; d <= MOST_EDITS; d++)
		for (int k = -d; k <= d; k += 2) {
			int32_t x = d ? furthest(row(w, d - 1), d, k) : 0, y = x - k;

			while (x < n && y < m && w->a[p->a0 + (size_t)x] == w->b[p->b0 + (size_t)y])
				x++, y++;
			row(w, d)[k] = x;
			if (x >= n && y >= m) {
				mark_script(w, p, d);
				return 1;
			}
		}
	return 0;
}

/* --- Anchors ----------------------------------------------------------------------------------------------------- */

static int compare_keys(const void *x, const void *y)
{
	const struct key_place *a = x, *b = y;

	return a->key != b->key ? (a->key > b->key) - (a->key < b->key) : (a->at > b->at) - (a->at < b->at);
}

static struct key_place *sort_keys(const uint64_t *keys, size_t first, size_t end)
{
	struct key_place *out = malloc((end - first + 1) * sizeof(*out));

	for (size_t i = first; out && i < end; i++)
		out[i - first] = (struct key_place){ keys[i], i };
	if (out)
		qsort(out, end - first, sizeof(*out), compare_keys);
	return out;
}

static int is_single(const struct key_place *s, size_t n, size_t i)
{
	return (i == 0 || s[i - 1].key != s[i].key) && (i + 1 == n || s[i + 1].key != s[i].key);
}

static int compare_anchors(const void *x, const void *y)
{
	const struct anchor *a = x, *b = y;

	return (a->a > b->a) - (a->a < b->a);
}

/* Keep the longest chain that rises in b as well. @return its length; the chain is moved to the front, in order */
static size_t keep_chain(struct anchor *anchors, size_t n, size_t *ends)
{
	size_t length = 0, at;

	for (size_t i = 0; i < n; i++) {
		size_t low = 0, high = length;

		while (low < high) {
			const size_t middle = (low + high) / 2;

			if (anchors[ends[middle]].b < anchors[i].b)
				low = middle + 1;
			else
				high = middle;
		}
		anchors[i].before = low ? ends[low - 1] + 1 : 0;
		ends[low] = i;
		length += low == length;
	}
	at = length ? ends[length - 1] + 1 : 0;
	for (size_t i = length; i > 0; i--, at = anchors[at - 1].before)
		ends[i - 1] = at - 1;
	for (size_t i = 0; i < length; i++)
		anchors[i] = anchors[ends[i]];
	return length;
}

/* @return 0 or ERR_SYSTEM (reported) */
static int find_anchors(const struct work *w, const struct part *p, struct anchor **out, size_t *n_out)
{
	const size_t n = p->a1 - p->a0, m = p->b1 - p->b0;
	struct key_place *a = sort_keys(w->a, p->a0, p->a1), *b = sort_keys(w->b, p->b0, p->b1);
	struct anchor *anchors = malloc((n + 1) * sizeof(*anchors));
	size_t *ends = malloc((n + 1) * sizeof(*ends)), found = 0;
	const int ok = a && b && anchors && ends;

	for (size_t i = 0, j = 0; ok && i < n && j < m;) {
		if (a[i].key == b[j].key && is_single(a, n, i) && is_single(b, m, j))
			anchors[found++] = (struct anchor){ a[i].at, b[j].at, 0 };
		if (a[i].key <= b[j].key)
			i++;
		else
			j++;
	}
	if (ok) {
		qsort(anchors, found, sizeof(*anchors), compare_anchors);
		*n_out = keep_chain(anchors, found, ends);
	}
	free(a);
	free(b);
	free(ends);
	if (!ok)
		free(anchors);
	*out = ok ? anchors : NULL;
	return ok ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* --- All of it --------------------------------------------------------------------------------------------------- */

static int solve(struct work *w, struct part p)
{
	struct anchor *anchors = NULL;
	size_t n = 0;
	int err = 0;

	trim(w, &p);
	if (p.a0 < p.a1 && p.b0 < p.b1) {
		if (find_script(w, &p))
			return 0;
		err = find_anchors(w, &p, &anchors, &n);
	}
	if (!n) {
		memset(w->a_parts + p.a0, 1, p.a1 - p.a0);
		memset(w->b_parts + p.b0, 1, p.b1 - p.b0);
	}
	for (size_t i = 0; i < n && !err; i++) {
		err = solve(w, (struct part){ p.a0, anchors[i].a, p.b0, anchors[i].b });
		p.a0 = anchors[i].a + 1;
		p.b0 = anchors[i].b + 1;
	}
	if (n && !err)
		err = solve(w, p);
	free(anchors);
	return err;
}

static int collect(const struct work *w, size_t n, size_t m, struct align_hunk **hunks, size_t *n_hunks)
{
	size_t room = 0;

	for (size_t i = 0, j = 0; i < n || j < m;) {
		struct align_hunk h = { i, i, j, j };

		while (h.a1 < n && w->a_parts[h.a1])
			h.a1++;
		while (h.b1 < m && w->b_parts[h.b1])
			h.b1++;
		if (h.a1 == i && h.b1 == j) {
			i++, j++;
			continue;
		}
		if (MEMORY_GROW(*hunks, room, *n_hunks + 1))
			return ERR_SYSTEM;
		(*hunks)[(*n_hunks)++] = h;
		i = h.a1;
		j = h.b1;
	}
	return 0;
}

int align_keys(const uint64_t *a, size_t n, const uint64_t *b, size_t m, struct align_hunk **hunks, size_t *n_hunks)
{
	struct work w = { .a = a, .b = b, .a_parts = calloc(n + 1, 1), .b_parts = calloc(m + 1, 1),
	                  .rows = malloc((MOST_EDITS + 1) * (size_t)(MOST_EDITS + 1) * sizeof(*w.rows)) };
	int err;

	*hunks = NULL;
	*n_hunks = 0;
	if (!w.a_parts || !w.b_parts || !w.rows)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	else if (n >= INT32_MAX / 2 || m >= INT32_MAX / 2)
		err = err_report(ERR_INPUT, NULL, "%zu and %zu calls are too many to be aligned", n, m);
	else
		err = solve(&w, (struct part){ 0, n, 0, m });
	if (!err)
		err = collect(&w, n, m, hunks, n_hunks);
	free(w.a_parts);
	free(w.b_parts);
	free(w.rows);
	return err;
}
