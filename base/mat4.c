#include "base/mat4.h"

#include <math.h>
#include <string.h>

const float mat4_identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

/* One column at a time. Each entry uses the same operations, in the same order, as if computed alone. */
typedef float column __attribute__((vector_size(16)));

void mat4_mul(float out[16], const float a[16], const float b[16])
{
	column c[4], product[4];

	memcpy(c, a, sizeof(c));
	for (int i = 0; i < 4; i++, b += 4)
		product[i] = c[0] * b[0] + c[1] * b[1] + c[2] * b[2] + c[3] * b[3];
	memcpy(out, product, sizeof(product));
}

#define real float
#define SUM(name) void mat4_##name
#include "base/mat4_sums.h"
#undef real
#undef SUM
#define real long double
#define SUM(name) static void x87_##name
#include "base/mat4_sums.h"

static void x87_mul(float out[16], const float a[16], const float b[16])
{
	float product[16];

	for (int column = 0; column < 16; column += 4)
		x87_transform(product + column, a, b + column);
	memcpy(out, product, sizeof(product));
}

const struct mat4_sums mat4_sums[2] = {
	{ mat4_mul, mat4_transform, mat4_transform_plane, mat4_rotation, mat4_translate, mat4_frustum, mat4_ortho },
	{ x87_mul, x87_transform, x87_transform_plane, x87_rotation, x87_translate, x87_frustum, x87_ortho },
};

void mat4_transpose(float out[16], const float m[16])
{
	float t[16];

	for (int i = 0; i < 16; i++)
		t[i] = m[(i % 4) * 4 + i / 4];
	memcpy(out, t, sizeof(t));
}

int mat4_invert(float out[16], const float m[16])
{
	/* Gauss-Jordan with row pivoting, in double. */
	double rows[4][8];

	for (int r = 0; r < 4; r++)
		for (int c = 0; c < 4; c++) {
			rows[r][c] = m[r + 4 * c];
			rows[r][4 + c] = r == c;
		}
	for (int c = 0; c < 4; c++) {
		int pivot = c;
		for (int r = c + 1; r < 4; r++)
			if (fabs(rows[r][c]) > fabs(rows[pivot][c]))
				pivot = r;
		if (!(fabs(rows[pivot][c]) > 0)) {
			memcpy(out, mat4_identity, 16 * sizeof(float));
			return 0;
		}
		for (int k = 0; k < 8; k++) {
			double swap = rows[c][k];
			rows[c][k] = rows[pivot][k];
			rows[pivot][k] = swap;
		}
		for (int r = 0; r < 4; r++) {
			double factor = rows[r][c] / rows[c][c];
			for (int k = c; k < 8 && r != c; k++)
				rows[r][k] -= factor * rows[c][k];
		}
	}
	for (int r = 0; r < 4; r++)
		for (int c = 0; c < 4; c++)
			out[r + 4 * c] = (float)(rows[r][4 + c] / rows[r][r]);
	return 1;
}

void mat4_turn(float out[3], const float m[16], const float v[3])
{
	float turned[4];

	mat4_transform(turned, m, (const float[4]){ v[0], v[1], v[2], 0 });
	memcpy(out, turned, 3 * sizeof(*out));
}
