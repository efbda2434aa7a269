/* Arithmetic on 4 x 4 matrices of doubles: products, the inverse, null vectors. */
#include "look/draws/matrix.h"

#include <math.h>
#include <string.h>

const double matrix_identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

void matrix_from_floats(double out[16], const float m[16])
{
	for (int i = 0; i < 16; i++)
		out[i] = (double)m[i];
}

void matrix_mul(double out[16], const double a[16], const double b[16])
{
	for (int c = 0; c < 4; c++)
		for (int r = 0; r < 4; r++)
			out[4 * c + r] = a[r] * b[4 * c] + a[4 + r] * b[4 * c + 1] + a[8 + r] * b[4 * c + 2] + a[12 + r] * b[4 * c + 3];
}

/* Exchange columns a and b of a 4 x 4 matrix. */
static void exchange(double *m, int a, int b)
{
	for (int r = 0; r < 4 && a != b; r++) {
		double kept = m[4 * a + r];

		m[4 * a + r] = m[4 * b + r];
		m[4 * b + r] = kept;
	}
}

/*
 * Gauss-Jordan elimination on columns, with the largest pivot of each row. A matrix counts as singular if a pivot is at
 * most 1e-12 of its largest element.
 */
int matrix_invert(double out[16], const double m[16])
{
	double a[16], largest = 0;

	memcpy(a, m, sizeof(a));
	memcpy(out, matrix_identity, sizeof(a));
	for (int i = 0; i < 16; i++)
		largest = fmax(largest, fabs(m[i]));
	for (int r = 0; r < 4; r++) {
		int pivot = r;
		double scale;

		for (int c = r + 1; c < 4; c++)
			if (fabs(a[4 * c + r]) > fabs(a[4 * pivot + r]))
				pivot = c;
		exchange(a, r, pivot);
		exchange(out, r, pivot);
		if (!(fabs(a[4 * r + r]) > 1e-12 * largest))
			return 0;
		scale = 1 / a[4 * r + r];
		for (int k = 0; k < 4; k++) {
			a[4 * r + k] *= scale;
			out[4 * r + k] *= scale;
		}
		for (int c = 0; c < 4; c++) {
			double by = a[4 * c + r];

			for (int k = 0; k < 4 && c != r; k++) {
				a[4 * c + k] -= by * a[4 * r + k];
				out[4 * c + k] -= by * out[4 * r + k];
			}
		}
	}
	return 1;
}

void matrix_transform(double out[4], const double m[16], const double p[4])
{
	for (int r = 0; r < 4; r++)
		out[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r] * p[3];
}

void matrix_point(double out[3], const double m[16], const double p[3])
{
	double q[4];

	matrix_transform(q, m, (double[]){ p[0], p[1], p[2], 1 });
	for (int k = 0; k < 3; k++)
		out[k] = q[k] / q[3];
}

double matrix_dot3(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int matrix_normalize3(double v[3])
{
	const double length = sqrt(matrix_dot3(v, v));

	for (int k = 0; k < 3 && length > 0; k++)
		v[k] /= length;
	return length > 0;
}

double matrix_determinant3(const double m[16])
{
	return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]);
}

double matrix_scale(const double m[16])
{
	double longest = 0;

	for (int c = 0; c < 3; c++)
		longest = fmax(longest, sqrt(m[4 * c] * m[4 * c] + m[4 * c + 1] * m[4 * c + 1] + m[4 * c + 2] * m[4 * c + 2]));
	return longest;
}

/*
 * Make a symmetric matrix diagonal by Jacobi rotations (Press et al., "Numerical Recipes", sec. 11.1): each makes the
 * elements pq and qp of a zero; t, c and s are its tangent, cosine and sine.
 * @param a  receives the eigenvalues on its diagonal
 * @param v  receives the eigenvectors, as columns
 */
static void jacobi(double a[16], double v[16])
{
	memcpy(v, matrix_identity, 16 * sizeof(*v));
	for (int sweep = 0; sweep < 30; sweep++)
		for (int p = 0; p < 3; p++)
			for (int q = p + 1; q < 4; q++) {
				double apq = a[4 * q + p], theta, t, c, s;

				if (fabs(apq) < 1e-300)
					continue;
				theta = (a[4 * q + q] - a[4 * p + p]) / (2 * apq);
				t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
				c = 1 / sqrt(t * t + 1);
				s = t * c;
				for (int k = 0; k < 4; k++) { /* columns of a and v, then rows of a */
					double x = a[4 * p + k], y = a[4 * q + k];

					a[4 * p + k] = c * x - s * y;
					a[4 * q + k] = s * x + c * y;
					x = v[4 * p + k];
					y = v[4 * q + k];
					v[4 * p + k] = c * x - s * y;
					v[4 * q + k] = s * x + c * y;
				}
				for (int k = 0; k < 4; k++) {
					double x = a[4 * k + p], y = a[4 * k + q];

					a[4 * k + p] = c * x - s * y;
					a[4 * k + q] = s * x + c * y;
				}
			}
}

double matrix_null(double out[4], const double m[16], int left)
{
	double square[16], v[16], largest = 0, y[4], length = 0;
	int least = 0;

	/* M^T M, or M M^T for v M: its eigenvalues are the squares of the lengths that M gives its eigenvectors. */
	for (int c = 0; c < 4; c++)
		for (int r = 0; r < 4; r++) {
			square[4 * c + r] = 0;
			for (int k = 0; k < 4; k++)
				square[4 * c + r] += left ? m[4 * k + c] * m[4 * k + r] : m[4 * c + k] * m[4 * r + k];
		}
	jacobi(square, v);
	for (int c = 0; c < 4; c++) {
		largest = fmax(largest, fabs(square[5 * c]));
		if (fabs(square[5 * c]) < fabs(square[5 * least]))
			least = c;
	}
	memcpy(out, v + 4 * least, 4 * sizeof(*out));
	/* The length of M v: the root of the least eigenvalue would be less exact. */
	for (int r = 0; r < 4; r++) {
		y[r] = 0;
		for (int k = 0; k < 4; k++)
			y[r] += left ? m[4 * r + k] * out[k] : m[4 * k + r] * out[k];
		length += y[r] * y[r];
	}
	return largest > 0 ? sqrt(length / largest) : 0;
}
