/* Both recordings are executed side by side, and held against each other call by call. */
#pragma once

#include "bisect/partners.h"

enum { GOOD, BAD, N_SIDES };

/* What differs at one place: a call with other arguments, or calls that only one of them has, or has in the place of others. */
struct parting {
	size_t frame[N_SIDES];     /* from 0 */
	uint64_t number[N_SIDES];  /* of the call, as `relume dump` numbers it; where there is none, of the call before */
	size_t count[N_SIDES];     /* calls; 0: this recording has none here */
	char *text[N_SIDES];       /* of the first of them; NULL: none */
	char *argument;            /* the first that differs, where both have one call of a command; else NULL */
	char *state;               /* what of the state differs after it and did not before, a line each; NULL: nothing */
	const char *effect;        /* what else it changes ("what is drawn"); NULL: nothing that is known */
};

struct partings {
	struct parting *list; /* [n] */
	size_t n, room;
	int is_cut;           /* 1: there may be more */
};

/**
 * Find where two recordings part.
 * @param most  so many at most
 * @return 0 or ERR_* (reported)
 */
int walk_both(const struct partners *partners, const struct recording *good, const struct recording *bad, size_t most, struct partings *out);
void partings_free(struct partings *p);
