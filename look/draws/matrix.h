/*
 * Matrices of doubles: m[16], column-major, column vectors, p' = M p, as in OpenGL. Matrices in a recording are
 * products of floats, and inverses and null vectors of such matrices need more precision.
 */
#pragma once

extern const double matrix_identity[16];

void matrix_from_floats(double out[16], const float m[16]);
/** out = a b; out must not be a or b. */
void matrix_mul(double out[16], const double a[16], const double b[16]);
/** Invert a matrix. out must not be m. @return 1; 0: m is singular, and out undefined */
int matrix_invert(double out[16], const double m[16]);
/** out = M p. */
void matrix_transform(double out[4], const double m[16], const double p[4]);
/** Transform a point and divide by w. If w is 0, out is infinite or NaN. */
void matrix_point(double out[3], const double m[16], const double p[3]);
double matrix_dot3(const double a[3], const double b[3]);
/** Scale a vector to length 1. @return 1; 0: v is 0 and stays unchanged */
int matrix_normalize3(double v[3]);
/** The determinant of the upper left 3 x 3. */
double matrix_determinant3(const double m[16]);

/**
 * Find the unit vector that a matrix takes nearest to zero (the smallest eigenvalue of M^T M, by Jacobi's method).
 * @param left  1: for v M instead of M v
 * @return |M v|, relative to the length of the unit vector that M stretches most
 */
double matrix_null(double out[4], const double m[16], int left);

/** The factor of the axis that a matrix stretches most: the length of the longest column of the upper left 3 x 3. */
double matrix_scale(const double m[16]);
