/* Points and vectors of three doubles, planes, and boxes. */
#pragma once

#include <math.h>

struct vec {
	double x, y, z;
};

static inline struct vec vec(double x, double y, double z)
{
	return (struct vec){ x, y, z };
}

static inline struct vec vec_add(struct vec a, struct vec b)
{
	return vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline struct vec vec_sub(struct vec a, struct vec b)
{
	return vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline struct vec vec_scale(struct vec a, double s)
{
	return vec(a.x * s, a.y * s, a.z * s);
}

/** a + s b */
static inline struct vec vec_mad(struct vec a, struct vec b, double s)
{
	return vec_add(a, vec_scale(b, s));
}

static inline double vec_dot(struct vec a, struct vec b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct vec vec_cross(struct vec a, struct vec b)
{
	return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double vec_length(struct vec a)
{
	return sqrt(vec_dot(a, a));
}

static inline struct vec vec_unit(struct vec a)
{
	return vec_scale(a, 1 / vec_length(a));
}

/** Coordinate 0, 1 or 2. */
static inline double vec_at(struct vec a, int axis)
{
	return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/** Two unit vectors perpendicular to a unit vector and to each other, u x v = n. */
static inline void vec_frame(struct vec n, struct vec *u, struct vec *v)
{
	*u = vec_unit(fabs(n.y) < 0.7 ? vec(n.z, 0, -n.x) : vec(0, -n.z, n.y));
	*v = vec_cross(n, *u);
}

/* n . p = d; n is a unit vector and points to the front. */
struct plane {
	struct vec n;
	double d;
};

static inline double plane_distance(struct plane plane, struct vec p)
{
	return vec_dot(plane.n, p) - plane.d;
}

static inline struct plane plane_flip(struct plane plane)
{
	return (struct plane){ vec_scale(plane.n, -1), -plane.d };
}

struct box {
	struct vec min, max;
};

static inline struct box box_empty(void)
{
	return (struct box){ vec(HUGE_VAL, HUGE_VAL, HUGE_VAL), vec(-HUGE_VAL, -HUGE_VAL, -HUGE_VAL) };
}

static inline void box_add(struct box *box, struct vec p)
{
	box->min = vec(fmin(box->min.x, p.x), fmin(box->min.y, p.y), fmin(box->min.z, p.z));
	box->max = vec(fmax(box->max.x, p.x), fmax(box->max.y, p.y), fmax(box->max.z, p.z));
}

/** 1 if two boxes share a point, or come within `slack`. */
static inline int box_meets(struct box a, struct box b, double slack)
{
	return a.min.x <= b.max.x + slack && b.min.x <= a.max.x + slack && a.min.y <= b.max.y + slack &&
	       b.min.y <= a.max.y + slack && a.min.z <= b.max.z + slack && b.min.z <= a.max.z + slack;
}
