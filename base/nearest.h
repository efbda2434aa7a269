/* Which of the words that exist is meant by one that does not. */
#pragma once

#include <stddef.h>

struct nearest {
	const char *typed;
	const char *word; /* the nearest so far; NULL: none is near */
	size_t wrong;     /* letters that make the one of the other */
};

/**
 * Try one of the words that exist. It is near where at most a third of the letters typed have to be put in, left out, changed or swapped
 * with their neighbour (Damerau 1964, restricted: no letter is changed between two that are swapped).
 */
void nearest_try(struct nearest *nearest, const char *word);
