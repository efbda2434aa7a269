/*
 * One ray traversing trees of any type: into an instance's object space and back. OpenCL C only; included by the
 * kernels that trace one ray per work item.
 */
#pragma once

#include "scene/scene.h"
#include "kernels/shared.h"
#include "kernels/rays/rays.h"

/* A ray in the space of the tree that it walks; boxes are tested as in kernels/rays/packet.h. */
struct walk {
	float ox, oy, oz, dx, dy, dz;
	float ix, iy, iz, far_ix, far_iy, far_iz, near_x, near_y, near_z, far_x, far_y, far_z;
	uint row_x, row_y, row_z; /* offsets in floats in a node8 of the rows of near planes */
	float t_min;
	struct hit hit; /* hit.t: end of the ray so far */
	uint asks;      /* any-hit queries: 1 after a hit that has to be sampled (kernels/rays/opacity.h) */
	float after;    /* t of the hit, in eye space, that the ray continues behind; -infinity: none */
	float shift;    /* added to t, gives t in eye space */
	uint tie;       /* the least primitive that counts at that t, of the instance being walked (walk_tie) */
};

/*
 * Boxes are tested up to here, slightly beyond the nearest hit so far, since rounding can put a triangle's t in front
 * of its box. Without that slack, the tree would decide between two nearly equal hits.
 */
static inline float walk_end(const struct walk *w)
{
	return fma(fabs(w->hit.t), RAYS_END_SLACK, w->hit.t);
}

/* A subtree to visit. */
struct entry {
	float enter;
	uint child, count;
};

static inline float largest(float x, float y, float z)
{
	return fmax(fmax(fabs(x), fabs(y)), fabs(z));
}

static inline float invert(float d)
{
	return 1.0f / (fabs(d) > 1e-20f ? d : copysign(1e-20f, d));
}

static inline void find_rows(struct walk *w)
{
	w->row_x = w->ix < 0 ? 24 : 0, w->row_y = w->iy < 0 ? 32 : 8, w->row_z = w->iz < 0 ? 40 : 16;
}

static inline void prepare(struct walk *w)
{
	float b;

	w->ix = invert(w->dx), w->iy = invert(w->dy), w->iz = invert(w->dz);
	b = -w->ox * w->ix, w->near_x = b - fabs(b) * 3e-7f, w->far_x = b + fabs(b) * 1.5e-6f;
	b = -w->oy * w->iy, w->near_y = b - fabs(b) * 3e-7f, w->far_y = b + fabs(b) * 1.5e-6f;
	b = -w->oz * w->iz, w->near_z = b - fabs(b) * 3e-7f, w->far_z = b + fabs(b) * 1.5e-6f;
	w->far_ix = w->ix * (1 + 6e-7f), w->far_iy = w->iy * (1 + 6e-7f), w->far_iz = w->iz * (1 + 6e-7f);
	find_rows(w);
}

/* Test whether boxes can be distinguished by their distances along the ray. */
static inline int in_range(const struct walk *w)
{
	return fabs(w->ox * w->ix) < RAYS_RANGE && fabs(w->oy * w->iy) < RAYS_RANGE && fabs(w->oz * w->iz) < RAYS_RANGE;
}

/* 1 if a triangle's hit comes after the one that the ray continues behind (kernels/rays/rays.h). */
static inline int walk_is_after(const struct walk *w, float t, uint primitive)
{
	return t + w->shift > w->after || (t + w->shift == w->after && primitive >= w->tie);
}

/* The least primitive of an instance that comes after a hit at the same t. */
static inline uint walk_tie(__global const struct hit *last, uint instance)
{
	return instance > last->instance ? 0 : instance == last->instance ? last->primitive + 1 : SCENE_NONE;
}

/* Start of a ray that continues behind a hit: rounding can put a surface at the same t in front of its box. */
static inline float walk_begin(float t)
{
	return fma(fabs(t), -RAYS_END_SLACK, t);
}

/* A ray in eye space without a hit. after: 1: it continues behind one. @return 0 if it hits nothing by definition */
static inline int walk_start(struct walk *w, __global const struct ray *ray, uint after)
{
	w->ox = ray->o[0], w->oy = ray->o[1], w->oz = ray->o[2];
	w->dx = ray->d[0], w->dy = ray->d[1], w->dz = ray->d[2];
	w->t_min = after ? walk_begin(ray->t_min) : ray->t_min;
	w->after = after ? ray->t_min : -INFINITY;
	w->hit.t = ray->t_max;
	w->asks = 0;
	w->hit.b1 = w->hit.b2 = 0;
	w->hit.instance = w->hit.primitive = SCENE_NONE;
	if (!(w->t_min <= w->hit.t) || !isfinite(w->ox) || !isfinite(w->oy) || !isfinite(w->oz) || !isfinite(w->dx) ||
	    !isfinite(w->dy) || !isfinite(w->dz))
		return 0;
	prepare(w);
	return in_range(w);
}

/* Distance along the ray where its walk through an instance starts. */
static inline float walk_shift(__global const struct instance *instance, const struct walk *w)
{
	const float cx = instance->centre[0] - w->ox, cy = instance->centre[1] - w->oy, cz = instance->centre[2] - w->oz;
	const float length = largest(w->dx, w->dy, w->dz);
	const float shift = fma(cz, w->dz, fma(cy, w->dy, cx * w->dx)) / fma(w->dz, w->dz, fma(w->dy, w->dy, w->dx * w->dx)) -
	                    instance->radius / length;

	return shift * length > RAYS_FAR * instance->radius && isfinite(shift) ? shift : 0;
}

/* The ray in an instance's object space. tie: walk_tie. @return how far it was moved along its direction */
static inline float walk_enter(struct walk *w, const struct walk *eye, __global const struct instance *instance,
                               uint tie)
{
	__global const float *m = instance->obj_from_eye;
	float shift;

	w->ox = fma(m[2], eye->oz, fma(m[1], eye->oy, fma(m[0], eye->ox, m[3])));
	w->oy = fma(m[6], eye->oz, fma(m[5], eye->oy, fma(m[4], eye->ox, m[7])));
	w->oz = fma(m[10], eye->oz, fma(m[9], eye->oy, fma(m[8], eye->ox, m[11])));
	w->dx = fma(m[2], eye->dz, fma(m[1], eye->dy, m[0] * eye->dx));
	w->dy = fma(m[6], eye->dz, fma(m[5], eye->dy, m[4] * eye->dx));
	w->dz = fma(m[10], eye->dz, fma(m[9], eye->dy, m[8] * eye->dx));
	shift = walk_shift(instance, w);
	w->ox = fma(shift, w->dx, w->ox), w->oy = fma(shift, w->dy, w->oy), w->oz = fma(shift, w->dz, w->oz);
	w->t_min = eye->t_min - shift;
	w->after = eye->after;
	w->shift = shift;
	w->tie = tie;
	w->hit.t = eye->hit.t - shift;
	if (shift > 0 && eye->hit.instance != SCENE_NONE)
		w->hit.t += 3e-7f * eye->hit.t; /* t + shift decides */
	w->asks = 0;
	w->hit.b1 = w->hit.b2 = 0;
	w->hit.instance = w->hit.primitive = SCENE_NONE;
	prepare(w);
	if (!in_range(w))
		w->hit.t = -INFINITY;
	return shift;
}

/* Return to eye space with an instance's hit if it is nearer, or as near and of a lower instance. */
static inline void walk_leave(struct walk *eye, struct walk *w, float shift)
{
	eye->asks |= w->asks;
	w->hit.t += shift;
	if (w->hit.instance != SCENE_NONE &&
	    (eye->hit.instance == SCENE_NONE || w->hit.t < eye->hit.t ||
	     (w->hit.t == eye->hit.t && w->hit.instance < eye->hit.instance)))
		eye->hit = w->hit;
}
