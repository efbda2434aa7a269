/* Executes both recordings side by side, and compares them call by call. */
#pragma once

#include "verbs/bisect/partners.h"

enum { GOOD, BAD, N_SIDES };

/* A difference: a call whose arguments differ, calls that only one recording has, or calls that replace others. */
struct parting {
	size_t frame[N_SIDES];     /* from 0 */
	uint64_t number[N_SIDES];  /* the call's number in `relume dump`; if there is none, that of the call before */
	size_t count[N_SIDES];     /* calls; 0: this recording has none here */
	char *text[N_SIDES];       /* text of the first of them; NULL: none */
	char *argument;            /* first argument that differs, if both have one call of the same command; else NULL */
	char *state;               /* state that begins to differ here, one line for each member; NULL: none */
	const char *effect;        /* other effects of the call ("the drawing"); NULL: none known */
};

struct partings {
	struct parting *list; /* [n] */
	size_t n, room;
	int is_cut;           /* 1: there may be more */
};

/**
 * Find the differences between two recordings.
 * @param most  stop after this many
 * @return 0 or ERR_* (reported)
 */
int walk_both(const struct partners *partners, const struct recording *good, const struct recording *bad, size_t most,
              struct partings *out);
void partings_free(struct partings *p);
