/* Guess which known word an unknown one was meant to be. */
#pragma once

#include <stddef.h>

struct nearest {
	const char *typed;
	const char *word; /* the nearest so far; NULL: none is near enough */
	size_t wrong;     /* letters to change to get from one to the other */
};

/**
 * Try one known word. It is near if at most a third of the letters typed must be inserted, deleted, changed or swapped
 * with a neighbour (Damerau 1964, restricted: no letter is changed between two that are swapped).
 */
void nearest_try(struct nearest *nearest, const char *word);
