#include "base/mat4.h"

#include <math.h>
#include <string.h>

const float mat4_identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

/* A column at once. Each entry is made by the same operations in the same order as if it were made alone. */
typedef float column __attribute__((vector_size(16)));

void mat4_mul(float out[16], const float a[16], const float b[16])
{
	column c[4], product[4];

	memcpy(c, a, sizeof(c));
	for (int i = 0; i < 4; i++, b += 4)
		product[i] = c[0] * b[0] + c[1] * b[1] + c[2] * b[2] + c[3] * b[3];
	memcpy(out, product, sizeof(product));
}

void mat4_rotation(float out[16], float angle_deg, float x, float y, float z)
{
	const float angle = (float)(angle_deg * M_PI / 180.0);
	const float s = sinf(angle), c = cosf(angle), one_c = 1.0f - c;
	const float length = sqrtf(x * x + y * y + z * z);
	const int turned = (x != 0) + (y != 0) + (z != 0);

	memcpy(out, mat4_identity, 16 * sizeof(float));
	if (turned == 1) { /* about an axis: the other entries are 0 and 1 to the last bit, however short the vector */
		const int axis = x != 0 ? 0 : y != 0 ? 1 : 2, i = (axis + 1) % 3, j = (axis + 2) % 3;
		const float sine = x + y + z < 0 ? -s : s;

		out[5 * i] = out[5 * j] = c;
		out[4 * i + j] = sine;
		out[4 * j + i] = -sine;
		return;
	}
	if (length <= 1.0e-4f)
		return;
	x /= length;
	y /= length;
	z /= length;
	out[0] = one_c * (x * x) + c;
	out[4] = one_c * (x * y) - z * s;
	out[8] = one_c * (z * x) + y * s;
	out[1] = one_c * (x * y) + z * s;
	out[5] = one_c * (y * y) + c;
	out[9] = one_c * (y * z) - x * s;
	out[2] = one_c * (z * x) - y * s;
	out[6] = one_c * (y * z) + x * s;
	out[10] = one_c * (z * z) + c;
}

void mat4_frustum(float out[16], float left, float right, float bottom, float top, float near, float far)
{
	memset(out, 0, 16 * sizeof(float));
	out[0] = 2 * near / (right - left);
	out[5] = 2 * near / (top - bottom);
	out[8] = (right + left) / (right - left);
	out[9] = (top + bottom) / (top - bottom);
	out[10] = -(far + near) / (far - near);
	out[11] = -1;
	out[14] = -(2 * far * near) / (far - near);
}

void mat4_ortho(float out[16], float left, float right, float bottom, float top, float near, float far)
{
	memset(out, 0, 16 * sizeof(float));
	out[0] = 2 / (right - left);
	out[5] = 2 / (top - bottom);
	out[10] = -2 / (far - near);
	out[12] = -(right + left) / (right - left);
	out[13] = -(top + bottom) / (top - bottom);
	out[14] = -(far + near) / (far - near);
	out[15] = 1;
}

void mat4_transpose(float out[16], const float m[16])
{
	float t[16];

	for (int i = 0; i < 16; i++)
		t[i] = m[(i % 4) * 4 + i / 4];
	memcpy(out, t, sizeof(t));
}

int mat4_invert(float out[16], const float m[16])
{
	/* Gauss and Jordan with row pivoting, in double. */
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

void mat4_transform(float out[4], const float m[16], const float v[4])
{
	float p[4];

	for (int r = 0; r < 4; r++)
		p[r] = m[r] * v[0] + m[r + 4] * v[1] + m[r + 8] * v[2] + m[r + 12] * v[3];
	memcpy(out, p, sizeof(p));
}

void mat4_turn(float out[3], const float m[16], const float v[3])
{
	float turned[4];

	mat4_transform(turned, m, (const float[4]){ v[0], v[1], v[2], 0 });
	memcpy(out, turned, 3 * sizeof(*out));
}

void mat4_transform_plane(float out[4], const float plane[4], const float inverse[16])
{
	float p[4];

	for (int c = 0; c < 4; c++)
		p[c] = plane[0] * inverse[4 * c] + plane[1] * inverse[4 * c + 1] + plane[2] * inverse[4 * c + 2] +
		       plane[3] * inverse[4 * c + 3];
	memcpy(out, p, sizeof(p));
}
