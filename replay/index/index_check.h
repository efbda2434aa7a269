/* Checks an index against its trace. */
#pragma once

struct index;

/**
 * Replay the whole trace, and also from every checkpoint to the next; compare each state reached with the saved one,
 * byte by byte.
 * @return 0; ERR_FAILED (reported: which checkpoint, which way, the first byte); ERR_INPUT, ERR_SYSTEM (reported)
 */
int index_check(struct index *index);
