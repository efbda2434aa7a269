#include "verbs/bisect/partners.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/memory.h"

/* Keys for comparing frames or calls. */
enum by { BY_KEY, BY_NAME };

static uint64_t *keys_of_frames(const struct recording *r, enum by by)
{
	uint64_t *keys = malloc((r->n_frames + 1) * sizeof(*keys));

	for (size_t f = 0; keys && f < r->n_frames; f++) {
		keys[f] = 0;
		for (size_t i = r->frames[f]; i < r->frames[f + 1]; i++)
			keys[f] = XXH64(by == BY_KEY ? &r->calls[i].key : &r->calls[i].name, sizeof(uint64_t), keys[f]);
	}
	return keys;
}

static int add_hunk(struct partners *p, const struct align_hunk *h)
{
	if (h->a0 == h->a1 && h->b0 == h->b1)
		return 0;
	if (MEMORY_GROW(p->hunks, p->room, p->n + 1))
		return ERR_SYSTEM;
	p->hunks[p->n++] = *h;
	return 0;
}

/* The elements of two recordings, while they are aligned. */
struct sides {
	const struct recording *good, *bad;
	uint64_t *good_keys, *bad_keys; /* keys of frames, by name */
	struct partners *partners;
};

static int pair_frames(struct sides *s, size_t a, size_t b)
{
	const struct recording *g = s->good, *r = s->bad;
	const size_t g0 = g->frames[a], n = g->frames[a + 1] - g0, b0 = r->frames[b], m = r->frames[b + 1] - b0;
	uint64_t *x = malloc((n + 1) * sizeof(*x)), *y = malloc((m + 1) * sizeof(*y));
	struct align_hunk *hunks = NULL;
	size_t n_hunks = 0;
	int err = x && y ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; i < n && !err; i++)
		x[i] = g->calls[g0 + i].key;
	for (size_t i = 0; i < m && !err; i++)
		y[i] = r->calls[b0 + i].key;
	if (!err)
		err = align_keys(x, n, y, m, &hunks, &n_hunks);
	for (size_t i = 0; i < n_hunks && !err; i++)
		err = add_hunk(s->partners, &(struct align_hunk){ g0 + hunks[i].a0, g0 + hunks[i].a1, b0 + hunks[i].b0,
		                                                  b0 + hunks[i].b1 });
	s->partners->frames[a] = b;
	free(hunks);
	free(x);
	free(y);
	return err;
}

/* Frames that have nothing in common pair in order; the rest of the longer side has no partner. */
static int pair_rest(struct sides *s, const struct align_hunk *h)
{
	size_t a = h->a0, b = h->b0;
	int err = 0;

	for (; a < h->a1 && b < h->b1 && !err; a++, b++)
		err = pair_frames(s, a, b);
	if (!err)
		err = add_hunk(s->partners, &(struct align_hunk){ s->good->frames[a], s->good->frames[h->a1],
		                                                  s->bad->frames[b], s->bad->frames[h->b1] });
	return err;
}

/* Frames that differ: those of the same commands pair first. */
static int pair_hunk(struct sides *s, const struct align_hunk *h)
{
	struct align_hunk *hunks = NULL;
	size_t n = 0, a = h->a0, b = h->b0;
	int err = 0;

	if (h->a1 - h->a0 == h->b1 - h->b0)
		return pair_rest(s, h);
	err = align_keys(s->good_keys + h->a0, h->a1 - h->a0, s->bad_keys + h->b0, h->b1 - h->b0, &hunks, &n);
	for (size_t i = 0; i <= n && !err; i++) {
		const struct align_hunk rest = i < n ? (struct align_hunk){ h->a0 + hunks[i].a0, h->a0 + hunks[i].a1,
			                                                    h->b0 + hunks[i].b0, h->b0 + hunks[i].b1 } :
		                                       (struct align_hunk){ h->a1, h->a1, h->b1, h->b1 };

		for (; a < rest.a0 && !err; a++, b++)
			err = pair_frames(s, a, b);
		if (!err)
			err = pair_rest(s, &rest);
		a = rest.a1;
		b = rest.b1;
	}
	free(hunks);
	return err;
}

int partners_find(struct partners *p, const struct recording *good, const struct recording *bad)
{
	struct sides s = { good, bad, keys_of_frames(good, BY_NAME), keys_of_frames(bad, BY_NAME), p };
	uint64_t *x = keys_of_frames(good, BY_KEY), *y = keys_of_frames(bad, BY_KEY);
	struct align_hunk *hunks = NULL;
	size_t n = 0, a = 0, b = 0;
	int err = 0;

	*p = (struct partners){ .frames = malloc((good->n_frames + 1) * sizeof(*p->frames)) };
	if (!s.good_keys || !s.bad_keys || !x || !y || !p->frames)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = align_keys(x, good->n_frames, y, bad->n_frames, &hunks, &n);
	for (size_t i = 0; i <= n && !err; i++) {
		for (; a < (i < n ? hunks[i].a0 : good->n_frames); a++, b++)
			p->frames[a] = b;
		if (i == n)
			break;
		for (; a < hunks[i].a1; a++)
			p->frames[a] = SIZE_MAX;
		b = hunks[i].b1;
		err = pair_hunk(&s, &hunks[i]);
	}
	free(hunks);
	free(s.good_keys);
	free(s.bad_keys);
	free(x);
	free(y);
	return err;
}

void partners_free(struct partners *p)
{
	free(p->hunks);
	free(p->frames);
	*p = (struct partners){ .n = 0 };
}
