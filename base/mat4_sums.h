/*
 * Matrices and products whose entries are sums. mat4.c includes this twice, so there is no #pragma once: with `real` as
 * float, and as long double, the x87's precision. Numbers are rounded to float where Mesa's C code stores them in one
 * (math/m_matrix.c).
 */

SUM(transform)(float out[4], const float m[16], const float v[4])
{
	float p[4];

	for (int r = 0; r < 4; r++)
		p[r] = (float)((real)m[r] * v[0] + (real)m[r + 4] * v[1] + (real)m[r + 8] * v[2] + (real)m[r + 12] * v[3]);
	memcpy(out, p, sizeof(p));
}

SUM(transform_plane)(float out[4], const float plane[4], const float inverse[16])
{
	float p[4];

	for (int c = 0; c < 4; c++)
		p[c] = (float)((real)plane[0] * inverse[4 * c] + (real)plane[1] * inverse[4 * c + 1] +
		               (real)plane[2] * inverse[4 * c + 2] + (real)plane[3] * inverse[4 * c + 3]);
	memcpy(out, p, sizeof(p));
}

SUM(rotation)(float out[16], float angle_deg, float x, float y, float z)
{
	const float angle = (float)(angle_deg * M_PI / 180.0);
	const real s = sinf(angle), c = cosf(angle), one_c = (float)(1 - c);
	const float length = sqrtf((float)((real)x * x + (real)y * y + (real)z * z));
	const int turned = (x != 0) + (y != 0) + (z != 0);
	float xx, yy, zz, xy, yz, zx, xs, ys, zs;

	memcpy(out, mat4_identity, 16 * sizeof(float));
	if (turned == 1) { /* about a coordinate axis: the other entries are exactly 0 and 1, however short the vector */
		const int axis = x != 0 ? 0 : y != 0 ? 1 : 2, i = (axis + 1) % 3, j = (axis + 2) % 3;
		const float sine = (float)(x + y + z < 0 ? -s : s);

		out[5 * i] = out[5 * j] = (float)c;
		out[4 * i + j] = sine;
		out[4 * j + i] = -sine;
		return;
	}
	if (length <= 1.0e-4f)
		return;
	x /= length;
	y /= length;
	z /= length;
	xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, zx = z * x;
	xs = (float)(x * s), ys = (float)(y * s), zs = (float)(z * s);
	out[0] = (float)(one_c * xx + c);
	out[4] = (float)(one_c * xy - zs);
	out[8] = (float)(one_c * zx + ys);
	out[1] = (float)(one_c * xy + zs);
	out[5] = (float)(one_c * yy + c);
	out[9] = (float)(one_c * yz - xs);
	out[2] = (float)(one_c * zx - ys);
	out[6] = (float)(one_c * yz + xs);
	out[10] = (float)(one_c * zz + c);
}

SUM(translate)(float m[16], float tx, float ty, float tz)
{
	for (int r = 0; r < 4; r++)
		m[12 + r] = (float)((real)m[r] * tx + (real)m[4 + r] * ty + (real)m[8 + r] * tz + m[12 + r]);
}

SUM(frustum)(float out[16], float left, float right, float bottom, float top, float near, float far)
{
	const real w = (real)right - left, h = (real)top - bottom, d = (real)far - near;

	memset(out, 0, 16 * sizeof(float));
	out[0] = (float)((real)2 * near / w);
	out[5] = (float)((real)2 * near / h);
	out[8] = (float)(((real)right + left) / w);
	out[9] = (float)(((real)top + bottom) / h);
	out[10] = (float)(-((real)far + near) / d);
	out[11] = -1;
	out[14] = (float)(-((real)2 * far * near) / d);
}

SUM(ortho)(float out[16], float left, float right, float bottom, float top, float near, float far)
{
	const real w = (real)right - left, h = (real)top - bottom, d = (real)far - near;

	memset(out, 0, 16 * sizeof(float));
	out[0] = (float)(2 / w);
	out[5] = (float)(2 / h);
	out[10] = (float)(-2 / d);
	out[12] = (float)(-((real)right + left) / w);
	out[13] = (float)(-((real)top + bottom) / h);
	out[14] = (float)(-((real)far + near) / d);
	out[15] = 1;
}
