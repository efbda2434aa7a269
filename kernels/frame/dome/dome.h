/*
 * Light from all around (scene_dome): one listed fragment per work item. Surfaces that GL lights take a given share of
 * it.
 *
 * Pixels of a block share a set of directions, and each traces its own part (A. Keller and W. Heidrich, "Interleaved
 * Sampling", 2001). A fragment receives the mean over the block around it: of neighbours on the same surface or, if
 * these are few, of all neighbours that face the same way. This keeps noise away with few rays. If a block still has
 * too few rays, its light counts in proportion.
 *
 * The distance that a ray looks varies from ray to ray, evenly in its logarithm, so near surfaces dim the light more
 * than far ones, whatever the scene's scale (after S. Zhukov, A. Iones and G. Kronin, "An ambient light illumination
 * model", 1998).
 */
#pragma once

#include "kernels/camera/camera.h"
#include "kernels/frame/plain/plain.h"

/* Width and height of a block of pixels. */
#define DOME_BLOCK 4u
/* Columns in a tile of dome_light_packet. */
#define DOME_WIDTH 16u
/* Shares of a block's rays. With DOME_OWN or fewer on the same surface, all that face the same way count; with fewer
 * than the second, the mean counts in proportion. */
#define DOME_OWN 0.5f
#define DOME_ENOUGH 0.25f
/* Shortest distance that a ray looks, as a share of the dome's reach: e to the power of minus this. */
#define DOME_SPAN 4.158883f
/* Share of a colour that remains where no light arrives. */
#define DOME_LEFT 0.15f

/* The part of its block's directions that a pixel traces. */
static inline uint32_t dome_part(uint32_t number, uint32_t width)
{
	return number / width % DOME_BLOCK * DOME_BLOCK + number % width % DOME_BLOCK;
}

/* A direction of the pixel's part, rotated to the surface. across, along: sample_basis of the normal */
static inline struct vec3 dome_turned(GLOBAL const float *direction, struct vec3 n, struct vec3 across,
                                      struct vec3 along)
{
	return v3_add(v3_add(v3_scale(across, direction[0]), v3_scale(along, direction[1])), v3_scale(n, direction[2]));
}

/* Mark a fragment as receiving no light from the dome. */
static inline void dome_find_none(const struct dome_find_arguments *a, uint32_t item)
{
	GLOBAL struct dome_place *place = &a->places[item];

	v3_store(place->from, v3(0.0f, 0.0f, 0.0f));
	v3_store(place->normal, v3(0.0f, 0.0f, 0.0f));
	place->strength = 0.0f;
	for (uint32_t i = 0u; i < a->samples; i++)
		stage_no_ray(&a->rays[i * a->n + item]);
}

/* dome_find: where a fragment receives the dome's light, and its dome rays. */
static inline void dome_find_item(const struct dome_find_arguments *a, uint32_t item)
{
	struct fragment f = a->fragments[item];
	GLOBAL struct dome_place *place = &a->places[item];
	GLOBAL const float *directions = a->directions + dome_part(a->pixels[item], a->width) * 4u;
	struct vec3 from, normal, origin, across, along;
	struct point_plane plane;
	struct point p;

	dome_find_none(a, item);
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
	origin = point_ray_origin(p.weight, &plane, normal, from);
	v3_store(place->from, origin);
	v3_store(place->normal, normal);
	place->strength = (p.material->fog ? point_fog(&p) : 1.0f) * (p.material->lighting ? a->dome.lit : 1.0f);
	if (!(place->strength > 0.0f))
		return;
	sample_basis(normal, &across, &along);
	for (uint32_t i = 0u; i < a->samples; i++, directions += DOME_BLOCK * DOME_BLOCK * 4u) {
		GLOBAL struct ray *ray = &a->rays[i * a->n + item];

		v3_store(ray->o, origin);
		v3_store(ray->d, dome_turned(directions, normal, across, along));
		ray->t_min = 0.0f;
		ray->t_max = directions[3];
	}
}

/* The direction and length of a ray of a part of a block. sample: which of the pixel's rays, over all passes */
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

/* Weight of the sky's colour, as opposed to the ground's, in a direction. */
static inline float dome_height(const struct scene_dome *dome, struct vec3 d)
{
	const struct vec3 up = v3(dome->up_eye[0], dome->up_eye[1], dome->up_eye[2]);

	return v3_dot(up, up) > 0.0f ? 0.5f + 0.5f * v3_dot(up, d) : 1.0f;
}

/* dome_sum: sums the light that the dome rays found. */
static inline void dome_sum_item(const struct dome_sum_arguments *a, uint32_t item)
{
	const struct scene_dome *dome = &a->dome;
	const int same = dome_height(dome, v3(0.0f, 0.0f, 0.0f)) == 1.0f; /* 1: the same colour in all directions */
	GLOBAL float *sums = a->sums + item * 4u;
	float sum[4] = { 0.0f, 0.0f, 0.0f, 0.0f };

	if (!(a->places[item].strength > 0.0f))
		return;
	for (uint32_t k = 0u; k < 4u && !a->is_first; k++)
		sum[k] = sums[k];
	for (uint32_t i = item; i < a->samples * a->n; i += a->n) {
		const float height = same ? 1.0f : dome_height(dome, v3_load(a->rays[i].d));

		for (uint32_t c = 0u; c < 3u; c++)
			sum[c] += (dome->ground[c] + (dome->light[c] - dome->ground[c]) * height) * a->visibility[i * 3u + c];
		sum[3] += 1.0f;
	}
	for (uint32_t k = 0u; k < 4u; k++)
		sums[k] = sum[k];
}

/** Number of tile columns of dome_light_packet. */
static inline uint32_t dome_columns(uint32_t width)
{
	return (width + DOME_WIDTH - 1u) / DOME_WIDTH;
}

static inline uint32_t dome_least(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

static inline uint32_t dome_most(uint32_t a, uint32_t b)
{
	return a > b ? a : b;
}

/* First of the DOME_BLOCK rows or columns around one, limited to low .. high. */
static inline uint32_t dome_first(uint32_t at, uint32_t low, uint32_t high)
{
	const uint32_t first = at > low + DOME_BLOCK / 2u ? at - DOME_BLOCK / 2u : low;

	return first + DOME_BLOCK <= high ? first : high > low + DOME_BLOCK ? high - DOME_BLOCK : low;
}

/* 1 if two places face roughly the same way. */
static inline int dome_is_alike(GLOBAL const struct dome_place *a, GLOBAL const struct dome_place *b)
{
	return b->strength > 0.0f && v3_dot(v3_load(a->normal), v3_load(b->normal)) > 0.9f;
}

/* 1 if two places that face the same way are roughly on one plane. */
static inline int dome_is_level(GLOBAL const struct dome_place *a, GLOBAL const struct dome_place *b)
{
	const struct vec3 apart = v3_sub(v3_load(b->from), v3_load(a->from));
	const float off = v3_dot(v3_load(a->normal), apart);

	return off * off <= 0.1f * v3_dot(apart, apart);
}

/* Number of rays of a block whose pixels are all on one surface. own: rays per pixel */
static inline float dome_rays(float own)
{
	return (float)(DOME_BLOCK * DOME_BLOCK) * own;
}

/* The light of an unobstructed dome. A surface between vertical and horizontal keeps its colour where nothing dims the
 * light. */
static inline float dome_open(const struct scene_dome *dome)
{
	const float height = dome_height(dome, v3(0.0f, 0.0f, 0.0f)) < 1.0f ? 0.6666667f : 1.0f;
	float open = 0.0f;

	for (uint32_t c = 0u; c < 3u; c++)
		open += (dome->ground[c] + (dome->light[c] - dome->ground[c]) * height) / 3.0f;
	return open;
}

/* Factor for GL's colour under the mean light of a block. own: rays per pixel */
static inline struct vec3 dome_factor(const struct scene_dome *dome, const float *sum, float own, float strength)
{
	const float whole = sum[3] * dome_open(dome), enough = DOME_ENOUGH * dome_rays(own);
	float f[3];

	strength = sum[3] < enough ? strength * (sum[3] / enough) : strength;
	for (uint32_t c = 0u; c < 3u; c++)
		f[c] = M_SQRT(DOME_LEFT + (1.0f - DOME_LEFT) * sum[c] / whole) * strength + (1.0f - strength);
	return v3(f[0], f[1], f[2]);
}

/* Multiply a fragment's colours by a factor. */
static inline void dome_apply(GLOBAL struct shaded *s, struct vec3 factor)
{
	const struct vec3 direct = v3_load(s->direct);
	const float was = v3_most(direct), brightest = v3_most(v3_mul(direct, factor));
	struct vec3 more;

	if (brightest > 1.0f) /* not brighter than white */
		factor = v3_scale(factor, M_MAX(was, 1.0f) / brightest);
	more = v3_mul(direct, v3_sub(factor, v3(1.0f, 1.0f, 1.0f)));
	v3_store(s->shadowed,
	         v3_mul(v3_load(s->shadowed), v3(M_MIN(factor.x, 1.0f), M_MIN(factor.y, 1.0f), M_MIN(factor.z, 1.0f))));
	v3_store(s->direct, v3_add(direct, more));
	v3_store(s->mirrored, v3_add(v3_load(s->mirrored), more));
	v3_store(s->beauty, v3_add(v3_load(s->beauty), more));
}

/* First and last row, within the rectangle, of the tile that a row of the band belongs to. Bands and blocks end at tile
 * borders. */
static inline void dome_rows(const struct dome_light_arguments *a, uint32_t y, uint32_t *bottom, uint32_t *top)
{
	const uint32_t low = y / CAMERA_TILE * CAMERA_TILE;

	*top = dome_least((uint32_t)a->rectangle.y1, low + CAMERA_TILE);
	*bottom = dome_most((uint32_t)a->rectangle.y0, low);
}

/* The number of fragments of a pixel of the band. @return the first of them */
static inline uint32_t dome_items(const struct dome_light_arguments *a, uint32_t x, uint32_t y, uint32_t *count)
{
	uint32_t base;

	if (!a->in_blocks) {
		*count = a->counts[y * a->width + x];
		return a->first[y * a->width + x];
	}
	base = plain_base(plain_place(a->blocks, a->width, x, y), y);
	*count = base != SCENE_NONE;
	return base + x % PLAIN_WIDTH;
}

/* Add the light of the block around a fragment to sum[4], column by column. x, y: its pixel in the band */
static inline void dome_add_block(const struct dome_light_arguments *a, uint32_t item, uint32_t x, uint32_t y,
                                  float *sum)
{
	float alike[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
	const uint32_t x0 = dome_first(x, (uint32_t)a->rectangle.x0, (uint32_t)a->rectangle.x1);
	uint32_t bottom, top, y0;

	dome_rows(a, y, &bottom, &top);
	y0 = dome_first(y, bottom, top);
	for (uint32_t bx = x0; bx < x0 + DOME_BLOCK && bx < (uint32_t)a->rectangle.x1; bx++) {
		float column[4] = { 0.0f, 0.0f, 0.0f, 0.0f }, others[4] = { 0.0f, 0.0f, 0.0f, 0.0f };

		for (uint32_t by = y0; by < y0 + DOME_BLOCK && by < top; by++) {
			uint32_t count;
			const uint32_t begin = dome_items(a, bx, by, &count);

			for (uint32_t other = begin; other < begin + count; other++) {
				if (other != item && !dome_is_alike(&a->places[item], &a->places[other]))
					continue;
				for (uint32_t k = 0u; k < 4u; k++) {
					others[k] += a->sums[other * 4u + k];
					if (other == item || dome_is_level(&a->places[item], &a->places[other]))
						column[k] += a->sums[other * 4u + k];
				}
			}
		}
		for (uint32_t k = 0u; k < 4u; k++) {
			sum[k] += column[k];
			alike[k] += others[k];
		}
	}
	if (sum[3] <= DOME_OWN * dome_rays(a->sums[item * 4u + 3u]))
		for (uint32_t k = 0u; k < 4u; k++)
			sum[k] = alike[k];
}

/*
 * Apply a fragment's light, in the frame or to a->factors. Colours are GL's numbers, which are roughly square roots of
 * light.
 */
static inline void dome_light_at(const struct dome_light_arguments *a, uint32_t item, uint32_t x, uint32_t y)
{
	const float strength = a->places[item].strength;
	float sum[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
	struct vec3 factor = v3(1.0f, 1.0f, 1.0f);

	if (strength > 0.0f) {
		dome_add_block(a, item, x, y, sum);
		if (sum[3] > 0.0f)
			factor = dome_factor(&a->dome, sum, a->sums[item * 4u + 3u], strength);
	}
	if (a->in_blocks) {
		a->factors[item] = factor.x;
		a->factors[a->n + item] = factor.y;
		a->factors[2u * a->n + item] = factor.z;
	} else if (sum[3] > 0.0f) {
		dome_apply(&a->shaded[item], factor);
	}
}

static inline void dome_light_item(const struct dome_light_arguments *a, uint32_t item)
{
	const uint32_t pixel = a->pixels[item] - a->first_pixel;

	dome_light_at(a, item, pixel % a->width, pixel / a->width);
}
