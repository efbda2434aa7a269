#include "look/draws/modelview.h"

#include <math.h>
#include <string.h>

enum modelview_kind modelview_named(const char *name)
{
	static const char *const names[] = { "plain", "mirrored", "singular" };
	enum modelview_kind kind = MODELVIEW_PLAIN;

	while (kind < N_MODELVIEW_KINDS && strcmp(names[kind], name) != 0)
		kind++;
	return kind;
}

/* The volume that the first three columns span, relative to orthogonal columns of the same lengths. Below 0 if they
 * swap left and right hands. */
static double fullness3(const float *m)
{
	double volume = (double)m[0] * ((double)m[5] * m[10] - (double)m[6] * m[9]) -
	                (double)m[4] * ((double)m[1] * m[10] - (double)m[2] * m[9]) +
	                (double)m[8] * ((double)m[1] * m[6] - (double)m[2] * m[5]);
	double most = 1;

	for (int c = 0; c < 12; c += 4)
		most *= sqrt((double)m[c] * m[c] + (double)m[c + 1] * m[c + 1] + (double)m[c + 2] * m[c + 2]);
	return most > 0 ? volume / most : 0;
}

/* The same for four columns, without the sign. w is in units of the distance to the origin, so that distant things do
 * not count as flat. */
static double fullness4(const float *m)
{
	double a[16], far = sqrt((double)m[12] * m[12] + (double)m[13] * m[13] + (double)m[14] * m[14]), volume = 1, most = 1;

	for (int c = 0; c < 4; c++)
		for (int r = 0; r < 4; r++)
			a[4 * c + r] = (double)m[4 * c + r] * (far > 0 && r == 3 ? far : 1) / (far > 0 && c == 3 ? far : 1);
	for (int c = 0; c < 4; c++)
		most *= sqrt(a[4 * c] * a[4 * c] + a[4 * c + 1] * a[4 * c + 1] + a[4 * c + 2] * a[4 * c + 2] +
		             a[4 * c + 3] * a[4 * c + 3]);
	for (int c = 0; c < 4; c++) { /* Gram-Schmidt: the lengths that remain */
		double length = sqrt(a[4 * c] * a[4 * c] + a[4 * c + 1] * a[4 * c + 1] + a[4 * c + 2] * a[4 * c + 2] +
		                     a[4 * c + 3] * a[4 * c + 3]);

		volume *= length;
		for (int k = c + 1; k < 4 && length > 0; k++) {
			double along = 0;

			for (int r = 0; r < 4; r++)
				along += a[4 * c + r] * a[4 * k + r] / (length * length);
			for (int r = 0; r < 4; r++)
				a[4 * k + r] -= along * a[4 * c + r];
		}
	}
	return most > 0 ? volume / most : 0;
}

enum modelview_kind modelview_kind_of(const float m[16])
{
	const int is_affine = m[3] == 0 && m[7] == 0 && m[11] == 0;

	if (is_affine ? fabs(fullness3(m)) < 1e-4 : fullness4(m) < 1e-5)
		return MODELVIEW_SINGULAR;
	return fullness3(m) < 0 ? MODELVIEW_MIRRORED : MODELVIEW_PLAIN;
}
