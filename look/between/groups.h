/* Groups of draws with the same key in two frames, each in the order of its frame: candidates for couples. */
#pragma once

#include "look/between/bridge.h"

struct group {
	uint32_t *members, *rivals; /* [n], [n_rivals]: instances of the base and of the other frame, in order */
	uint8_t *is_taken;          /* [n_rivals]: 1 if coupled */
	uint32_t n, n_rivals;
};

struct groups {
	struct group *all;
	uint32_t n, room;
};

/**
 * The key of a draw of one of the two frames. @param with  as passed to groups_find @return 0: it belongs to no group
 */
typedef uint64_t groups_key(const struct scene *s, uint32_t instance, const void *with);

/**
 * Group the draws of both frames, except pixel rectangles. Each group has a draw of the base.
 * @return 0 or ERR_SYSTEM (reported); call groups_free in any case
 */
int groups_find(struct groups *groups, const struct bridge *b, groups_key *key, const void *with);
void groups_free(struct groups *groups);

/** Couple a member and a rival of a group, given their positions in it. */
void group_couple(struct bridge *b, struct group *g, uint32_t member, uint32_t rival);
/** 1 if a member has a partner. */
int group_is_coupled(const struct bridge *b, const struct group *g, uint32_t member);

/** Undo the couple of an instance of the base, whose partner is to be chosen among several. */
void group_part(struct bridge *b, uint32_t i);
