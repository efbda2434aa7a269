#include "tests/bench/brute.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define MOMENTS 24

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

static double size_of(const float v[3])
{
	return fmax(fmax(fabs((double)v[0]), fabs((double)v[1])), fabs((double)v[2]));
}

static void corners(const struct brute *b, uint32_t i, double out[3][3])
{
	for (int k = 0; k < 3; k++)
		for (int a = 0; a < 3; a++)
			out[k][a] = b->position[b->index[i][k]][a];
}

static double band_of(const struct brute *b, double far)
{
	return BRUTE_ROUNDING * ldexp(1, -24) * (b->extent + far);
}

/* --- Distances: the nearest of a triangle's corners, edges and face ---------------------------------------------- */

static double to_segment(const double p[3], const double a[3], const double b[3])
{
	double e[3], f[3], length2, s, d[3];

	for (int i = 0; i < 3; i++) {
		e[i] = b[i] - a[i];
		f[i] = p[i] - a[i];
	}
	length2 = dot(e, e);
	s = length2 > 0 ? fmin(fmax(dot(e, f) / length2, 0), 1) : 0;
	for (int i = 0; i < 3; i++)
		d[i] = f[i] - s * e[i];
	return sqrt(dot(d, d));
}

/* Distance by the three half-spaces of the triangle's edges: to its face if a point is inside all of them. */
static double to_triangle(double v[3][3], const double p[3])
{
	double e[3][3], n[3], inward[3], from[3], least;
	int inside = 1;

	for (int k = 0; k < 3; k++)
		for (int i = 0; i < 3; i++)
			e[k][i] = v[(k + 1) % 3][i] - v[k][i];
	cross(e[0], e[1], n);
	for (int k = 0; k < 3; k++) {
		cross(n, e[k], inward);
		for (int i = 0; i < 3; i++)
			from[i] = p[i] - v[k][i];
		inside &= dot(inward, from) >= 0;
	}
	least = fmin(fmin(to_segment(p, v[0], v[1]), to_segment(p, v[1], v[2])), to_segment(p, v[2], v[0]));
	return inside && dot(n, n) > 0 ? fmin(least, fabs(dot(n, from)) / sqrt(dot(n, n))) : least;
}

int brute_distance(const struct brute *b, const struct relume_rays_point *point,
                   const struct relume_rays_distance *answer)
{
	const double p[3] = { point->position[0], point->position[1], point->position[2] };
	const double band = band_of(b, size_of(point->position));
	double least = INFINITY, q[3], away[3], v[3][3];

	for (uint32_t i = 0; i < b->n; i++) {
		corners(b, i, v);
		least = fmin(least, to_triangle(v, p));
	}
	if (answer->triangle == RELUME_RAYS_NONE)
		return least >= point->farthest - band;
	for (int i = 0; i < 3; i++) {
		q[i] = answer->nearest[i];
		away[i] = q[i] - p[i];
	}
	corners(b, answer->triangle, v);
	return fabs(answer->distance - least) <= band && answer->distance <= point->farthest && to_triangle(v, q) <= band &&
	       fabs(sqrt(dot(away, away)) - least) <= band;
}

/* --- Rays: in the plane perpendicular to the ray ----------------------------------------------------------------- */

enum verdict { MISS, EDGE, HIT };

/* A triangle relative to a ray: vertices from the ray's origin (s), and the ray's direction (d). */
struct seen {
	double v[3][3], e1[3], e2[3], n[3], s[3], d[3];
};

static void look_at(const struct brute *b, const struct relume_rays_ray *ray, uint32_t i, struct seen *seen)
{
	corners(b, i, seen->v);
	for (int a = 0; a < 3; a++) {
		seen->e1[a] = seen->v[1][a] - seen->v[0][a];
		seen->e2[a] = seen->v[2][a] - seen->v[0][a];
		seen->s[a] = ray->origin[a] - seen->v[0][a];
		seen->d[a] = ray->direction[a];
	}
	cross(seen->e1, seen->e2, seen->n);
}

/* The six products of a . (b x c), summed in absolute value. */
static double products(const double a[3], const double b[3], const double c[3])
{
	double sum = 0;

	for (int i = 0; i < 3; i++) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;

		sum += fabs(a[i]) * (fabs(b[j] * c[k]) + fabs(b[k] * c[j]));
	}
	return sum;
}

/*
 * How far single precision may be off on a narrow triangle. Moeller and Trumbore divide triple products: t = e2.(s x
 * e1) / e1.(d x e2), and two weights alike. The cross product rounds each of its products at most twice and the sum of
 * three at most three times; s, e1 and e2 are rounded differences. So a triple product errs by at most 8 units of 2^-24
 * of its six products, even if they cancel, as they nearly do for a sliver. t: receives the resulting error of t.
 * @return the error of the position in the triangle
 */
static double narrowness(const struct seen *a, double *t)
{
	const double unit = 8 * ldexp(1, -24), length1 = sqrt(dot(a->e1, a->e1)), length2 = sqrt(dot(a->e2, a->e2));
	const double all = products(a->e1, a->d, a->e2), rest = fabs(dot(a->n, a->d)) - unit * all;
	const double of_t = products(a->e2, a->s, a->e1), of_u = products(a->s, a->d, a->e2),
		     of_v = products(a->d, a->s, a->e1);

	if (!(rest > 0))
		return *t = INFINITY;
	*t = unit * (of_t + fabs(*t) * all) / rest;
	return unit * ((of_u + all) * length1 + (of_v + all) * length2) / rest;
}

/* Position of the ray relative to the triangle's outline, seen along the ray, and the t at its plane. */
static enum verdict meet(const struct brute *b, const struct relume_rays_ray *ray, uint32_t i, double *t, double *slack)
{
	const double band = band_of(b, size_of(ray->origin));
	struct seen a;
	double at[3], cosine, length, off, place;

	look_at(b, ray, i, &a);
	length = sqrt(dot(a.d, a.d));
	cosine = fabs(dot(a.n, a.d)) / (sqrt(dot(a.n, a.n)) * length);
	*t = 0;
	*slack = INFINITY;
	if (!(dot(a.n, a.n) > 0) || cosine < 1e-5)
		return EDGE; /* edge-on, or without area: either answer is right */
	*t = off = -dot(a.n, a.s) / dot(a.n, a.d);
	place = fmax(band / cosine, narrowness(&a, &off));
	*slack = fmax(band / cosine / length, off);
	for (int k = 0; k < 3; k++)
		at[k] = ray->origin[k] + *t * a.d[k];
	/* A hit's weights may leave [0,1] by 1e-6 (kernels/rays/rays.h), which for edges is less than the band. */
	if (to_triangle(a.v, at) > place)
		return MISS;
	return fmin(fmin(to_segment(at, a.v[0], a.v[1]), to_segment(at, a.v[1], a.v[2])),
	            to_segment(at, a.v[2], a.v[0])) > place ?
	               HIT :
	               EDGE;
}

/* Whether t is in the ray's span: 1 surely, 0 surely not, -1 within rounding. */
static int in_span(const struct relume_rays_ray *ray, double t, double slack)
{
	if (t > ray->nearest + slack && t < ray->farthest - slack)
		return 1;
	return t < ray->nearest - slack || t > ray->farthest + slack ? 0 : -1;
}

int brute_nearest(const struct brute *b, const struct relume_rays_ray *ray, const struct relume_rays_hit *hit)
{
	const int none = hit->triangle == RELUME_RAYS_NONE;

	for (uint32_t i = 0; i < b->n; i++) {
		double t, slack;
		const enum verdict verdict = meet(b, ray, i, &t, &slack);

		if (i == hit->triangle && (verdict == MISS || fabs(hit->t - t) > slack || !in_span(ray, hit->t, slack)))
			return 0;
		if (verdict == HIT && in_span(ray, t, slack) == 1 && (none || t < hit->t - slack))
			return 0;
	}
	return 1;
}

int brute_any(const struct brute *b, const struct relume_rays_ray *ray, uint32_t any)
{
	int may = 0;

	for (uint32_t i = 0; i < b->n; i++) {
		double t, slack;
		const enum verdict verdict = meet(b, ray, i, &t, &slack);

		if (verdict == HIT && in_span(ray, t, slack) == 1)
			return any == 1;
		may |= verdict != MISS && in_span(ray, t, slack);
	}
	return any == 0 || may;
}

int brute_all(const struct brute *b, const struct relume_rays_ray *ray, const struct relume_rays_hit *hits,
              uint32_t kept, uint32_t count)
{
	uint32_t sure = 0, may = 0;

	for (uint32_t k = 1; k < kept; k++)
		if (hits[k].t < hits[k - 1].t || hits[k].triangle == hits[k - 1].triangle)
			return 0;
	for (uint32_t i = 0; i < b->n; i++) {
		double t, slack;
		const enum verdict verdict = meet(b, ray, i, &t, &slack);
		int given = 0;

		for (uint32_t k = 0; k < kept; k++)
			if (hits[k].triangle == i) {
				given++;
				if (verdict == MISS || fabs(hits[k].t - t) > slack || !in_span(ray, hits[k].t, slack))
					return 0;
			}
		if (verdict == HIT && in_span(ray, t, slack) == 1) {
			sure++;
			/* It may be missing only if nearer ones fill the list. */
			if (!given && (kept == count || t < hits[kept - 1].t - slack))
				return 0;
		}
		may += verdict != MISS && in_span(ray, t, slack) != 0;
		if (given > 1)
			return 0;
	}
	return count >= sure && count <= may;
}

/* --- Spheres: the distance along the path is convex, so its minimum is found by ternary search -------------------- */

static void moved(const struct relume_rays_body *body, double t, double out[3])
{
	for (int a = 0; a < 3; a++)
		out[a] = body->centre[a] + t * body->move[a];
}

static double distance_at(double v[3][3], const struct relume_rays_body *body, double t)
{
	double p[3];

	moved(body, t, p);
	return to_triangle(v, p);
}

static double least_distance(double v[3][3], const struct relume_rays_body *body, double end)
{
	double lo = 0, hi = end;

	for (int i = 0; i < 60; i++) {
		const double a = lo + (hi - lo) / 3, c = hi - (hi - lo) / 3;

		if (distance_at(v, body, a) < distance_at(v, body, c))
			hi = c;
		else
			lo = a;
	}
	return fmin(distance_at(v, body, lo), fmin(distance_at(v, body, 0), distance_at(v, body, end)));
}

/* Whether a triangle's bounds are surely beyond everything that a body reaches on its way to t. */
static int is_beyond(double v[3][3], const struct relume_rays_body *body, double t, double band)
{
	for (int a = 0; a < 3; a++) {
		const double lo = body->centre[a] + fmin(0, t * body->move[a]) - body->size[a] - band;
		const double hi = body->centre[a] + fmax(0, t * body->move[a]) + body->size[a] + band;

		if (fmin(fmin(v[0][a], v[1][a]), v[2][a]) > hi || fmax(fmax(v[0][a], v[1][a]), v[2][a]) < lo)
			return 1;
	}
	return 0;
}

static double body_band(const struct brute *b, const struct relume_rays_body *body)
{
	return band_of(b, size_of(body->centre) + size_of(body->size) + size_of(body->move));
}

int brute_sphere(const struct brute *b, const struct relume_rays_body *body, const struct relume_rays_contact *contact)
{
	const double band = body_band(b, body), end = contact->triangle == RELUME_RAYS_NONE ? 1 : contact->t;
	double v[3][3];

	if (contact->triangle != RELUME_RAYS_NONE) {
		corners(b, contact->triangle, v);
		if (!(end >= 0 && end <= 1) || distance_at(v, body, end) > body->size[0] + band)
			return 0;
	}
	for (uint32_t i = 0; i < b->n; i++) {
		corners(b, i, v);
		if (!is_beyond(v, body, end, band) && least_distance(v, body, end) < body->size[0] - band && end > 0)
			return 0;
	}
	return 1;
}

/* --- Boxes: a triangle is clipped by the box's six planes; any rest touches it ------------------------------------ */

static int touches(double v[3][3], const struct relume_rays_body *body, double t, double grow)
{
	double polygon[2][16][3], centre[3];
	int n = 3, from = 0;

	moved(body, t, centre);
	memcpy(polygon[0], v, 9 * sizeof(double));
	for (int plane = 0; plane < 6 && n; plane++) {
		const int a = plane / 2, left = n;
		const double sign = plane % 2 ? 1 : -1, reach = body->size[a] + grow;

		if (reach < 0)
			return 0;
		n = 0;
		for (int k = 0; k < left; k++) {
			const double *p = polygon[from][k], *q = polygon[from][(k + 1) % left];
			const double dp = reach - sign * (p[a] - centre[a]), dq = reach - sign * (q[a] - centre[a]);

			if (dp >= 0)
				memcpy(polygon[1 - from][n++], p, 3 * sizeof(double));
			if ((dp < 0) != (dq < 0)) {
				for (int i = 0; i < 3; i++)
					polygon[1 - from][n][i] = p[i] + (q[i] - p[i]) * (dp / (dp - dq));
				n++;
			}
		}
		from = 1 - from;
	}
	return n > 0;
}

/* Whether a box shrunk by the band overlaps the triangle before t, by projection onto thirteen axes. */
static int overlaps_before(double v[3][3], const struct relume_rays_body *body, double end, double band)
{
	double e[3][3], axes[13][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, enter = 0, leave = end, move[3];

	for (int a = 0; a < 3; a++) {
		move[a] = body->move[a];
		for (int k = 0; k < 3; k++)
			e[k][a] = v[(k + 1) % 3][a] - v[k][a];
	}
	cross(e[0], e[1], axes[3]);
	for (int k = 0; k < 3; k++)
		for (int a = 0; a < 3; a++)
			cross(e[k], axes[a], axes[4 + 3 * k + a]);
	for (int x = 0; x < 13; x++) {
		const double length = sqrt(dot(axes[x], axes[x])), speed = dot(move, axes[x]);
		double lo = INFINITY, hi = -INFINITY, reach = 0;

		if (length < 1e-12)
			continue;
		for (int a = 0; a < 3; a++) {
			if (body->size[a] < band)
				return 0;
			reach += (body->size[a] - band) * fabs(axes[x][a]);
		}
		for (int k = 0; k < 3; k++) {
			const double at[3] = { v[k][0] - body->centre[0], v[k][1] - body->centre[1], v[k][2] - body->centre[2] };

			lo = fmin(lo, dot(at, axes[x]));
			hi = fmax(hi, dot(at, axes[x]));
		}
		lo -= reach;
		hi += reach;
		if (speed == 0) {
			if (lo > 0 || hi < 0)
				return 0;
			continue;
		}
		enter = fmax(enter, (speed > 0 ? lo : hi) / speed);
		leave = fmin(leave, (speed > 0 ? hi : lo) / speed);
	}
	return enter < leave;
}

int brute_box(const struct brute *b, const struct relume_rays_body *body, const struct relume_rays_contact *contact,
              int sampled)
{
	const double band = body_band(b, body), end = contact->triangle == RELUME_RAYS_NONE ? 1 : contact->t;
	double v[3][3];

	if (contact->triangle != RELUME_RAYS_NONE) {
		corners(b, contact->triangle, v);
		if (!(end >= 0 && end <= 1) || !touches(v, body, end, band))
			return 0;
	}
	for (uint32_t i = 0; i < b->n; i++) {
		corners(b, i, v);
		if (is_beyond(v, body, end, band))
			continue;
		if (end > 0 && overlaps_before(v, body, end, band))
			return 0;
		for (int k = 0; k < MOMENTS && sampled && end > 0; k++)
			if (touches(v, body, end * k / MOMENTS, -band))
				return 0;
	}
	return 1;
}
