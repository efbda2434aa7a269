/*
 * Matrices of doubles: m[16], column-major, column vectors, p' = M p, as OpenGL's. What a recording holds are products
 * of floats; inverses and null vectors of those need more digits than they have.
 */
#pragma once

extern const double matrix_identity[16];

void matrix_from_floats(double out[16], const float m[16]);
/** out = a b; out is neither a nor b. */
void matrix_mul(double out[16], const double a[16], const double b[16]);
/** @return 1; 0: m is singular, and out undefined */
int matrix_invert(double out[16], const double m[16]);
/** out = M p. */
void matrix_transform(double out[4], const double m[16], const double p[4]);
/** The place of a point, divided by w. */
void matrix_point(double out[3], const double m[16], const double p[3]);
double matrix_dot3(const double a[3], const double b[3]);
/** @return 1; 0: v is 0, and stays so */
int matrix_normalize3(double v[3]);
/** Of the upper left 3 x 3. */
double matrix_determinant3(const double m[16]);

/**
 * The unit vector that a matrix takes nearest to zero (the least of M^T M, by Jacobi).
 * @param left  1: of v M instead of M v
 * @return how near: |M v| over what it makes of the vector that it stretches most
 */
double matrix_null(double out[4], const double m[16], int left);

/** Length of the longest column of the upper left 3 x 3: how large it makes things. */
double matrix_scale(const double m[16]);
