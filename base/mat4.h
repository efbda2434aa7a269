/*
 * 4x4 matrices: float[16], column-major, column vectors, p' = M p. All arithmetic is in float and in Mesa's order, so
 * products agree with Mesa's to the last bit where possible: with its 64-bit libraries, or through mat4_sums with its
 * 32-bit ones.
 */
#pragma once

extern const float mat4_identity[16];

/** out = a b; out may be a or b. */
void mat4_mul(float out[16], const float a[16], const float b[16]);

/**
 * Angle in degrees; the axis need not be normalised (GL 2.1 sec. 2.11.2). A zero axis gives the identity. A rotation
 * about x, y or z has exact zeros and ones.
 */
void mat4_rotation(float out[16], float angle_deg, float x, float y, float z);
/** m = m T. */
void mat4_translate(float m[16], float tx, float ty, float tz);
void mat4_frustum(float out[16], float left, float right, float bottom, float top, float near, float far);
void mat4_ortho(float out[16], float left, float right, float bottom, float top, float near, float far);
void mat4_transpose(float out[16], const float m[16]);

/** @return 1; 0 if m has no inverse: out is then the identity */
int mat4_invert(float out[16], const float m[16]);

/** out = M v. */
void mat4_transform(float out[4], const float m[16], const float v[4]);

/** Transform a direction: out = M (v, 0), without w. out may be v. */
void mat4_turn(float out[3], const float m[16], const float v[3]);

/** out = v M. With the inverse matrix, this transforms a plane equation (sec. 2.12). */
void mat4_transform_plane(float out[4], const float plane[4], const float inverse[16]);

/** The functions above, with the precision that the C code of a GL library sums in. */
struct mat4_sums {
	void (*mul)(float out[16], const float a[16], const float b[16]);
	void (*transform)(float out[4], const float m[16], const float v[4]);
	void (*transform_plane)(float out[4], const float plane[4], const float inverse[16]);
	void (*rotation)(float out[16], float angle_deg, float x, float y, float z);
	void (*translate)(float m[16], float tx, float ty, float tz);
	void (*frustum)(float out[16], float left, float right, float bottom, float top, float near, float far);
	void (*ortho)(float out[16], float left, float right, float bottom, float top, float near, float far);
};

/** [0]: every operation is rounded to float. [1]: x87 registers, rounded when a number is stored: 32-bit libraries. */
extern const struct mat4_sums mat4_sums[2];
