#include "look/between/pose.h"

#include <math.h>
#include <string.h>

#include "look/draws/matrix.h"

#define MOST_STEPS 64 /* the polar decomposition needs about ten */
#define AFFINE 1e-6   /* tolerance for the last row's first three numbers, relative to the fourth */

/* A rotation by `angle`, 0 to pi, about a unit vector. */
struct turn {
	double axis[3], angle;
};

/* out = a b, 3 x 3, column-major. */
static void mul3(double out[9], const double a[9], const double b[9])
{
	for (int c = 0; c < 3; c++)
		for (int r = 0; r < 3; r++)
			out[3 * c + r] = a[r] * b[3 * c] + a[3 + r] * b[3 * c + 1] + a[6 + r] * b[3 * c + 2];
}

static void transform3(double out[3], const double m[9], const double v[3])
{
	for (int r = 0; r < 3; r++)
		out[r] = m[r] * v[0] + m[3 + r] * v[1] + m[6 + r] * v[2];
}

/* out = the inverse of m, transposed. @return the determinant of m; if it is 0, out is undefined */
static double inverse_transpose(double out[9], const double m[9])
{
	double determinant;

	for (int c = 0; c < 3; c++)
		for (int r = 0; r < 3; r++) {
			const int c1 = (c + 1) % 3, c2 = (c + 2) % 3, r1 = (r + 1) % 3, r2 = (r + 2) % 3;

			out[3 * c + r] = m[3 * c1 + r1] * m[3 * c2 + r2] - m[3 * c2 + r1] * m[3 * c1 + r2];
		}
	determinant = m[0] * out[0] + m[1] * out[1] + m[2] * out[2];
	for (int i = 0; i < 9; i++)
		out[i] /= determinant;
	return determinant;
}

/* The rotation nearest to a matrix, by Newton's iteration (Higham, "Computing the Polar Decomposition", 1986).
 * @return 0: the matrix flattens or mirrors */
static int nearest_rotation(double out[9], const double m[9])
{
	double change = INFINITY;

	memcpy(out, m, 9 * sizeof(*out));
	for (int step = 0; step < MOST_STEPS && change > 1e-14; step++) {
		double other[9];

		if (!(inverse_transpose(other, out) > 1e-30))
			return 0;
		change = 0;
		for (int i = 0; i < 9; i++) {
			const double next = 0.5 * (out[i] + other[i]);

			change = fmax(change, fabs(next - out[i]));
			out[i] = next;
		}
	}
	return change <= 1e-10;
}

/* The axis and angle of a rotation, from a multiple of its unit quaternion: the products of the quaternion's largest
 * number with all four, for precision. */
static struct turn turn_of(const double r[9])
{
	const double squares[4] = { 1 + r[0] + r[4] + r[8], 1 + r[0] - r[4] - r[8], 1 - r[0] + r[4] - r[8],
		                    1 - r[0] - r[4] + r[8] };
	double q[4], length;
	struct turn t = { .axis = { 0, 0, 1 } };
	int most = 0;

	for (int i = 1; i < 4; i++)
		most = squares[i] > squares[most] ? i : most;
	q[0] = r[5] - r[7];
	q[1] = r[6] - r[2];
	q[2] = r[1] - r[3];
	q[3] = squares[0];
	if (most) {
		const int i = most - 1, k = (i + 1) % 3, l = (i + 2) % 3;

		q[3] = q[i];
		q[i] = squares[most];
		q[k] = r[3 * i + k] + r[3 * k + i];
		q[l] = r[3 * i + l] + r[3 * l + i];
	}
	length = sqrt(matrix_dot3(q, q));
	t.angle = 2 * atan2(length, fabs(q[3]));
	for (int k = 0; k < 3 && length > 0; k++)
		t.axis[k] = (q[3] < 0 ? -q[k] : q[k]) / length;
	return t;
}

/* out = a + b K + c K^2, where K v is the cross product of the axis and v. */
static void about(double out[9], const double axis[3], double a, double b, double c)
{
	const double k[9] = { 0, axis[2], -axis[1], -axis[2], 0, axis[0], axis[1], -axis[0], 0 };
	double square[9];

	mul3(square, k, k);
	for (int i = 0; i < 9; i++)
		out[i] = (i % 4 ? 0 : a) + b * k[i] + c * square[i];
}

/* The rotation by an angle about t's axis (Rodrigues' formula). */
static void rotation(double out[9], const struct turn *t, double angle)
{
	about(out, t->axis, 1, sin(angle), 1 - cos(angle));
}

/* The translation of a body that slides by v while it turns. */
static void slide(double out[3], const struct turn *t, double angle, const double v[3])
{
	double m[9];

	about(m, t->axis, 1, angle > 1e-9 ? (1 - cos(angle)) / angle : angle / 2,
	      angle > 1e-4 ? (angle - sin(angle)) / angle : angle * angle / 6);
	transform3(out, m, v);
}

/* The inverse of slide. */
static void unslide(double out[3], const struct turn *t, const double v[3])
{
	const double half = t->angle / 2;
	double m[9];

	about(m, t->axis, 1, -half, t->angle > 1e-4 ? 1 - half / tan(half) : t->angle * t->angle / 12);
	transform3(out, m, v);
}

int pose_part(double out[16], const double motion[16], double at)
{
	double linear[9], turned[9], back[9], stretch[9], part[9], velocity[3], place[3];
	struct turn t;

	for (int c = 0; c < 3; c++)
		if (fabs(motion[4 * c + 3]) > AFFINE * fabs(motion[15]))
			return 0;
	if (!(fabs(motion[15]) > 0))
		return 0;
	for (int i = 0; i < 9; i++)
		linear[i] = motion[4 * (i / 3) + i % 3] / motion[15];
	if (!nearest_rotation(turned, linear))
		return 0;
	for (int i = 0; i < 9; i++)
		back[i] = turned[3 * (i % 3) + i / 3];
	mul3(stretch, back, linear);
	for (int i = 0; i < 9; i++)
		stretch[i] = (i % 4 ? 0 : 1 - at) + at * stretch[i];
	t = turn_of(turned);
	rotation(turned, &t, at * t.angle);
	mul3(part, turned, stretch);
	unslide(velocity, &t, (const double[]){ motion[12] / motion[15], motion[13] / motion[15], motion[14] / motion[15] });
	for (int k = 0; k < 3; k++)
		velocity[k] *= at;
	slide(place, &t, at * t.angle, velocity);
	for (int i = 0; i < 16; i++)
		out[i] = i == 15 ? 1 : i % 4 == 3 ? 0 : i < 12 ? part[3 * (i / 4) + i % 4] : place[i - 12];
	return 1;
}
