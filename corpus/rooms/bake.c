/* Computes lightmaps. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>

/* Metres between texels, if MAX_SIZE texels then cover the wall. */
#define TEXEL 0.375
enum { MAX_SIZE = 64 };

static unsigned size_of(double length)
{
	unsigned size = 4;

	while (size < MAX_SIZE && (size - 1) * TEXEL < length)
		size *= 2;
	return size;
}

/* The outermost texels are on the wall's rim: their centres span the wall from end to end. */
static void lay_out(struct lightmap *map, const struct mesh *mesh, const struct face *face)
{
	double low[2] = { HUGE_VAL, HUGE_VAL }, high[2] = { -HUGE_VAL, -HUGE_VAL };

	vec_frame(face->plane.n, &map->u, &map->v);
	for (unsigned i = 0; i < face->n; i++) {
		double at[2] = { vec_dot(map->u, mesh->points[face->v[i]]), vec_dot(map->v, mesh->points[face->v[i]]) };

		for (int k = 0; k < 2; k++) {
			low[k] = fmin(low[k], at[k]);
			high[k] = fmax(high[k], at[k]);
		}
	}
	map->width = size_of(high[0] - low[0]);
	map->height = size_of(high[1] - low[1]);
	map->du = (high[0] - low[0]) * map->width / (map->width - 1);
	map->dv = (high[1] - low[1]) * map->height / (map->height - 1);
	map->u0 = low[0] - 0.5 * map->du / map->width;
	map->v0 = low[1] - 0.5 * map->dv / map->height;
}

/* The light at a place. A texel behind a neighbouring wall takes the light of the nearest place in front of it. */
static void light_at(const struct level *level, const struct bsp *bsp, struct vec p, struct vec n, unsigned char out[3])
{
	double sum[3] = { BAKE_AMBIENT, BAKE_AMBIENT, BAKE_AMBIENT };

	for (size_t i = 0; i < level->n_lights; i++) {
		struct vec to = vec_sub(level->lights[i].at, p);
		double square = vec_dot(to, to), cosine = vec_dot(to, n) / sqrt(square);

		if (cosine <= 0 || !bsp_sees(bsp, level->lights[i].at, p))
			continue;
		for (int k = 0; k < 3; k++)
			sum[k] += level->lights[i].color[k] * cosine / square;
	}
	for (int k = 0; k < 3; k++)
		out[k] = (unsigned char)(255 * fmin(1, sum[k]) + 0.5);
}

/* Move a place in the wall's plane to the nearest one on the wall, slightly inwards. */
static struct vec move_inside(const struct mesh *mesh, const struct face *face, struct vec p)
{
	const double inwards = 0.01;

	for (int round = 0; round < 4; round++)
		for (unsigned i = 0; i < face->n; i++) {
			struct vec a = mesh->points[face->v[i]], b = mesh->points[face->v[(i + 1) % face->n]];
			struct vec in = vec_unit(vec_cross(face->plane.n, vec_sub(b, a)));
			double depth = vec_dot(in, vec_sub(p, a));

			if (depth < inwards)
				p = vec_mad(p, in, inwards - depth);
		}
	return p;
}

void bake_point(const struct level *level, const struct mesh *mesh, const struct bsp *bsp, const struct face *face,
                struct vec p, unsigned char out[3])
{
	light_at(level, bsp, vec_mad(move_inside(mesh, face, p), face->plane.n, 0.002), face->plane.n, out);
}

void bake_face(struct lightmap *map, const struct level *level, const struct mesh *mesh, const struct bsp *bsp,
               const struct face *face)
{
	struct vec origin = vec_scale(face->plane.n, face->plane.d + 0.002);

	lay_out(map, mesh, face);
	map->texels = malloc((size_t)map->width * map->height * 3);
	if (!map->texels)
		exit(1);
	for (unsigned y = 0; y < map->height; y++)
		for (unsigned x = 0; x < map->width; x++) {
			struct vec p = vec_mad(vec_mad(origin, map->u, map->u0 + (x + 0.5) * map->du / map->width), map->v,
			                       map->v0 + (y + 0.5) * map->dv / map->height);

			light_at(level, bsp, move_inside(mesh, face, p), face->plane.n, &map->texels[3 * ((size_t)y * map->width + x)]);
		}
}

void bake_coordinates(const struct lightmap *map, struct vec p, float st[2])
{
	st[0] = (float)((vec_dot(map->u, p) - map->u0) / map->du);
	st[1] = (float)((vec_dot(map->v, p) - map->v0) / map->dv);
}
