#include "base/nearest.h"

#include <string.h>

#define MAX_LETTERS 40 /* longer words are compared by their first letters only */

static size_t least(size_t a, size_t b)
{
	return a < b ? a : b;
}

static size_t count_wrong(const char *a, const char *b)
{
	const size_t n_a = strnlen(a, MAX_LETTERS), n_b = strnlen(b, MAX_LETTERS);
	size_t d[MAX_LETTERS + 1][MAX_LETTERS + 1];

	for (size_t i = 0; i <= n_a; i++)
		d[i][0] = i;
	for (size_t j = 0; j <= n_b; j++)
		d[0][j] = j;
	for (size_t i = 1; i <= n_a; i++)
		for (size_t j = 1; j <= n_b; j++) {
			d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
			if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
				d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
		}
	return d[n_a][n_b];
}

void nearest_try(struct nearest *nearest, const char *word)
{
	const size_t wrong = count_wrong(nearest->typed, word);

	if (3 * wrong > strlen(nearest->typed) || (nearest->word && wrong >= nearest->wrong))
		return;
	nearest->word = word;
	nearest->wrong = wrong;
}
