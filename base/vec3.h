/* Vectors of three numbers: vec3_ of doubles, vec3f_ of floats. */
#pragma once

static inline double vec3_dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** out = a x b; out is neither. */
static inline void vec3_cross(const double a[3], const double b[3], double out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline float vec3f_dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** out = a - b; out may be either. */
static inline void vec3f_subtract(const float a[3], const float b[3], float out[3])
{
	for (int k = 0; k < 3; k++)
		out[k] = a[k] - b[k];
}

/** out = a x b; out is neither. */
static inline void vec3f_cross(const float a[3], const float b[3], float out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}
