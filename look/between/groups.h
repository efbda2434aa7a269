/* Draws of two frames in groups: those that one key names, in the order of each frame. */
#pragma once

#include "look/between/bridge.h"

struct group {
	uint32_t *members, *rivals; /* [n], [n_rivals]: instances of the base and of the other frame, in order */
	uint8_t *is_taken;          /* [n_rivals] */
	uint32_t n, n_rivals;
};

struct groups {
	struct group *all;
	uint32_t n, room;
};

/** Names a draw of one of the two frames. with: as given. @return 0: it is in no group */
typedef uint64_t groups_key(const struct scene *s, uint32_t instance, const void *with);

/**
 * Gather the draws of both frames, but no pixel rectangles. Each group has a draw of the base.
 * @return 0 or ERR_SYSTEM (reported): groups_free all the same
 */
int groups_find(struct groups *groups, const struct bridge *b, groups_key *key, const void *with);
void groups_free(struct groups *groups);

/** Couple a member of a group and a rival of it, by their places in it. */
void group_couple(struct bridge *b, struct group *g, uint32_t member, uint32_t rival);
int group_is_coupled(const struct bridge *b, const struct group *g, uint32_t member);

/** Let a draw be without a partner, which is yet to be found among several. */
void group_part(struct bridge *b, uint32_t i);
