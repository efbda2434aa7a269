/*
 * Light from all around (scene_dome): one fragment of the list a work item. On what GL lights a share of it counts.
 *
 * Pixels of a block share a set of directions, each has its part of them (A. Keller and W. Heidrich, "Interleaved Sampling", 2001). A
 * fragment takes the mean over the block around it, of neighbours on the same surface. So few rays make no noise.
 *
 * How far a ray looks differs from ray to ray, evenly in the logarithm: what is near dims the light more than what is far, whatever
 * the scene's scale (after S. Zhukov, A. Iones and G. Kronin, "An ambient light illumination model", 1998).
 */
#pragma once

#include "kernels/camera/camera.h"
#include "kernels/frame/shadow.h"

/* Blocks of pixels, across and down. */
#define DOME_BLOCK 4u
/* The nearest that a ray looks, as a share of the dome's reach: e to the power of minus this. */
#define DOME_SPAN 4.158883f
/* What is left of a colour where no light arrives. */
#define DOME_LEFT 0.15f

/* dome_find: where a fragment takes the dome's light. */
static inline void dome_find_item(const struct dome_find_arguments *a, uint32_t item)
{
	struct fragment f = a->fragments[item];
	GLOBAL struct dome_place *place = &a->places[item];
	struct vec3 from, normal;
	struct point_plane plane;
	struct point p;

	v3_store(place->from, v3(0.0f, 0.0f, 0.0f));
	v3_store(place->normal, v3(0.0f, 0.0f, 0.0f));
	place->strength = 0.0f;
	if (!(a->shaded[item].flags & SHADED_THERE))
		return;
	p = point_from_fragment(&a->tables, a->windows, &f);
	if (!(p.material->surface.hidden & SCENE_DOME_LIT) || p.geometry->flags & GEOMETRY_EXPANDED)
		return;
	from = stage_view_direction(&a->views[p.geometry->view], a->pixels[item] % a->width, a->pixels[item] / a->width);
	plane = point_plane_of(&p);
	normal = v3_dot(plane.normal, from) > 0.0f ? v3_scale(plane.normal, -1.0f) : plane.normal;
	if (!(v3_dot(normal, normal) > 0.0f))
		return;
	v3_store(place->from, point_ray_origin(p.weight, &plane, normal, from));
	v3_store(place->normal, normal);
	place->strength = (p.material->fog ? point_fog(&p) : 1.0f) * (p.material->lighting ? a->dome.lit : 1.0f);
}

/* Which part of its block's directions a pixel has. */
static inline uint32_t dome_part(uint32_t number, uint32_t width)
{
	return number / width % DOME_BLOCK * DOME_BLOCK + number % width % DOME_BLOCK;
}

/* dome_ray: each pixel's own direction, turned to the surface. */
static inline void dome_ray_item(const struct dome_ray_arguments *a, uint32_t item)
{
	GLOBAL const struct dome_place *place = &a->places[item];
	GLOBAL const float *direction = a->directions + dome_part(a->pixels[item], a->width) * 4u;
	GLOBAL struct ray *ray = &a->rays[item];
	struct vec3 n = v3_load(place->normal), across, along;

	stage_no_ray(ray);
	if (!(place->strength > 0.0f))
		return;
	sample_basis(n, &across, &along);
	v3_store(ray->o, v3_load(place->from));
	v3_store(ray->d, v3_add(v3_add(v3_scale(across, direction[0]), v3_scale(along, direction[1])), v3_scale(n, direction[2])));
	ray->t_min = 0.0f;
	ray->t_max = direction[3];
}

/* The direction of a part of a block, and how far to look. sample: which of the pixel's rays, over all passes */
static inline void dome_direction(const struct scene_dome *dome, uint32_t part, uint32_t sample, float *out)
{
	const uint32_t index = sample * DOME_BLOCK * DOME_BLOCK + part;
	struct vec3 d;
	float u, v;

	sample_square(SAMPLE_DOME, index, &u, &v);
	d = sample_disk(v3(0.0f, 0.0f, 1.0f), u, v);
	out[0] = d.x;
	out[1] = d.y;
	out[2] = M_SQRT(1.0f - u);
	out[3] = dome->reach * M_EXP(-DOME_SPAN * sample_unit(index * 2654435769u));
}

/* The share of the sky's colour, not of the ground's, in a direction. */
static inline float dome_height(const struct scene_dome *dome, struct vec3 d)
{
	const struct vec3 up = v3(dome->up_eye[0], dome->up_eye[1], dome->up_eye[2]);

	return v3_dot(up, up) > 0.0f ? 0.5f + 0.5f * v3_dot(up, d) : 1.0f;
}

/* dome_sum: the light that a look around saw. */
static inline void dome_sum_item(const struct dome_sum_arguments *a, uint32_t item)
{
	GLOBAL const struct ray *ray = &a->rays[item];
	const int sent = ray->t_max > ray->t_min;
	const float height = dome_height(&a->dome, v3_load(ray->d));
	GLOBAL float *sum = a->sums + item * 4u;

	for (uint32_t c = 0u; c < 3u; c++) {
		float light = a->dome.ground[c] + (a->dome.light[c] - a->dome.ground[c]) * height;

		sum[c] = (a->is_first ? 0.0f : sum[c]) + (sent ? light * a->visibility[item * 3u + c] : 0.0f);
	}
	sum[3] = (a->is_first ? 0.0f : sum[3]) + (sent ? 1.0f : 0.0f);
}

static inline uint32_t dome_least(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

static inline uint32_t dome_most(uint32_t a, uint32_t b)
{
	return a > b ? a : b;
}

/* The first of DOME_BLOCK rows or columns about one, all from `low` up to `high`. */
static inline uint32_t dome_first(uint32_t at, uint32_t low, uint32_t high)
{
	const uint32_t first = at > low + DOME_BLOCK / 2u ? at - DOME_BLOCK / 2u : low;

	return first + DOME_BLOCK <= high ? first : high > low + DOME_BLOCK ? high - DOME_BLOCK : low;
}

/* 1 where two places lie on about one plane. */
static inline int dome_is_same(GLOBAL const struct dome_place *a, GLOBAL const struct dome_place *b)
{
	const struct vec3 n = v3_load(a->normal), apart = v3_sub(v3_load(b->from), v3_load(a->from));
	const float off = v3_dot(n, apart);

	return b->strength > 0.0f && v3_dot(n, v3_load(b->normal)) > 0.9f && off * off <= 0.1f * v3_dot(apart, apart);
}

/* What GL's colour becomes in the mean light of a block. A surface between upright and level keeps it where nothing dims the light. */
static inline struct vec3 dome_factor(const struct scene_dome *dome, const float *sum)
{
	float most = 0.0f, f[3];

	for (uint32_t c = 0u; c < 3u; c++)
		most += (dome->ground[c] + (dome->light[c] - dome->ground[c]) * (dome_height(dome, v3(0.0f, 0.0f, 0.0f)) < 1.0f ? 0.6666667f : 1.0f)) / 3.0f;
	for (uint32_t c = 0u; c < 3u; c++)
		f[c] = M_SQRT(DOME_LEFT + (1.0f - DOME_LEFT) * sum[c] / (sum[3] * most));
	return v3(f[0], f[1], f[2]);
}

/* The light of the block about a fragment, into sum[4]. Bands end where tiles do, and so does the block. */
static inline void dome_add_block(const struct dome_light_arguments *a, uint32_t item, float *sum)
{
	const uint32_t pixel = a->pixels[item] - a->first_pixel, y = pixel / a->width, low = y / CAMERA_TILE * CAMERA_TILE;
	const uint32_t top = dome_least((uint32_t)a->rectangle.y1, low + CAMERA_TILE), bottom = dome_most((uint32_t)a->rectangle.y0, low);
	const uint32_t x0 = dome_first(pixel % a->width, (uint32_t)a->rectangle.x0, (uint32_t)a->rectangle.x1), y0 = dome_first(y, bottom, top);

	for (uint32_t by = y0; by < y0 + DOME_BLOCK && by < top; by++)
		for (uint32_t bx = x0; bx < x0 + DOME_BLOCK && bx < (uint32_t)a->rectangle.x1; bx++) {
			const uint32_t begin = a->first[by * a->width + bx], end = begin + a->counts[by * a->width + bx];

			for (uint32_t other = begin; other < end; other++)
				if (other == item || dome_is_same(&a->places[item], &a->places[other]))
					for (uint32_t k = 0u; k < 4u; k++)
						sum[k] += a->sums[other * 4u + k];
		}
}

/* dome_light: colours are GL's numbers, which are about the roots of light. */
static inline void dome_light_item(const struct dome_light_arguments *a, uint32_t item)
{
	GLOBAL struct shaded *s = &a->shaded[item];
	const float strength = a->places[item].strength;
	float sum[4] = { 0.0f, 0.0f, 0.0f, 0.0f }, brightest, was;
	struct vec3 factor, more;

	if (!(strength > 0.0f))
		return;
	dome_add_block(a, item, sum);
	if (!(sum[3] > 0.0f))
		return;
	factor = v3_add(v3_scale(dome_factor(&a->dome, sum), strength), v3_scale(v3(1.0f, 1.0f, 1.0f), 1.0f - strength));
	was = v3_most(v3_load(s->direct));
	brightest = v3_most(v3_mul(v3_load(s->direct), factor));
	if (brightest > 1.0f) /* no more than white */
		factor = v3_scale(factor, M_MAX(was, 1.0f) / brightest);
	more = v3_mul(v3_load(s->direct), v3_sub(factor, v3(1.0f, 1.0f, 1.0f)));
	v3_store(s->shadowed, v3_mul(v3_load(s->shadowed), v3(M_MIN(factor.x, 1.0f), M_MIN(factor.y, 1.0f), M_MIN(factor.z, 1.0f))));
	v3_store(s->direct, v3_add(v3_load(s->direct), more));
	v3_store(s->mirrored, v3_add(v3_load(s->mirrored), more));
	v3_store(s->beauty, v3_add(v3_load(s->beauty), more));
}
