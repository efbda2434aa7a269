/* SPDX-License-Identifier: MIT */
/*
 * Rays and distances for other programs: against a frame of a recording, or your own triangles, on any OpenCL device.
 *
 *     struct relume_rays *rays;
 *     if (relume_rays_open_frame("game.trace", 120, NULL, &rays) == 0) {
 *         relume_rays_nearest(rays, my_rays, n, my_hits);
 *         relume_rays_close(&rays);
 *     }
 *
 * Link with -lrelume-rays. Functions return 0, or the exit code of the command `relume`: 2 wrong usage, 3 a recording
 * that cannot be read, 5 the device or the system failed; a line on standard error gives the reason. Structs are plain
 * and will not change.
 *
 * The scene of a frame holds the triangles that rays of a rendered frame see: depth-tested, in eye space (right-handed,
 * the viewer at the origin looks along -z), in the program's units. If a frame has several eye spaces, the scene holds
 * the one with the most triangles. Triangles are numbered from 0. One thread at a time may use a scene; several scenes
 * may be open.
 *
 * A query with an infinite number or a NaN finds nothing. Among equal answers, the triangle with the lowest number
 * wins.
 *
 * Answers are single precision. On a sliver, a triangle much longer than wide, t is less exact in proportion to length
 * over width: for one 0.5 long and 0.0001 wide, at a distance of 3, by 0.001.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RELUME_RAYS_NONE 0xffffffffu

struct relume_rays;

/* The origin of a triangle. Corners: in the scene's space. */
struct relume_rays_triangle {
	float corner[3][3];
	uint32_t draw;      /* its draw's number in the frame, from 1, as in the channel `id`; 0: your own */
	uint32_t primitive; /* its number in its mesh */
};

/* A ray counts from t = nearest to t = farthest, in lengths of its direction. */
struct relume_rays_ray {
	float origin[3], nearest;
	float direction[3], farthest;
};

/* b1, b2 weigh the triangle's second and third corner. */
struct relume_rays_hit {
	float t, b1, b2;
	uint32_t triangle; /* RELUME_RAYS_NONE: no hit; the other members are undefined */
};

/* A point, and the distance to search (may be very large, as 1e18). */
struct relume_rays_point {
	float position[3], farthest;
};

struct relume_rays_distance {
	float distance;    /* infinite: nothing is near enough */
	float nearest[3];  /* the nearest point of a triangle */
	uint32_t triangle; /* RELUME_RAYS_NONE: nothing */
};

/* A box along the axes, or a sphere, that moves on a straight line. */
struct relume_rays_body {
	float centre[3]; /* its start */
	float size[3];   /* half the box's edges; the sphere's radius three times */
	float move[3];   /* from there to its goal; 0: only tests for contact */
};

struct relume_rays_contact {
	float t; /* share of its way to the first contact, [0,1]; 0: it touches something where it starts; infinite: it
	            is free */
	uint32_t triangle; /* the one that it meets; RELUME_RAYS_NONE: it is free */
};

/**
 * Open a frame of a recording.
 * @param device  as `relume render --device`: a number, a type, part of a name, "reference"; NULL: the fastest
 * @param out     owned by the caller, relume_rays_close
 */
int relume_rays_open_frame(const char *trace, uint64_t frame, const char *device, struct relume_rays **out);

/**
 * Open a scene of your own triangles, which are copied.
 * @param position  [n_vertices], finite
 * @param index     [n_triangles], each less than n_vertices
 */
int relume_rays_open_triangles(const float (*position)[3], size_t n_vertices, const uint32_t (*index)[3],
                               size_t n_triangles, const char *device, struct relume_rays **out);

/** *rays becomes NULL; it may be NULL. */
void relume_rays_close(struct relume_rays **rays);

size_t relume_rays_triangles(const struct relume_rays *rays);

/** @param triangle  less than relume_rays_triangles */
void relume_rays_describe(const struct relume_rays *rays, uint32_t triangle, struct relume_rays_triangle *out);

/** The nearest hit of each ray. @param hits  [n] */
int relume_rays_nearest(struct relume_rays *rays, const struct relume_rays_ray *ray, size_t n,
                        struct relume_rays_hit *hits);

/** Does each ray hit anything? @param any  [n], receives 1 or 0 */
int relume_rays_any(struct relume_rays *rays, const struct relume_rays_ray *ray, size_t n, uint32_t *any);

/**
 * All hits of each ray.
 * @param most    hits to keep for a ray, the nearest ones; at least 1
 * @param hits    [n][most], by distance
 * @param counts  [n]: number of triangles that the ray hits, which may exceed `most`
 */
int relume_rays_all(struct relume_rays *rays, const struct relume_rays_ray *ray, size_t n, uint32_t most,
                    struct relume_rays_hit *hits, uint32_t *counts);

/** The distance from each point to the nearest triangle. @param out  [n] */
int relume_rays_distance(struct relume_rays *rays, const struct relume_rays_point *points, size_t n,
                         struct relume_rays_distance *out);

/** The first contact of each moving body. Surfaces only: inside a closed mesh, a body touches nothing. @param out 
 * [n] */
int relume_rays_move_box(struct relume_rays *rays, const struct relume_rays_body *bodies, size_t n,
                         struct relume_rays_contact *out);
int relume_rays_move_sphere(struct relume_rays *rays, const struct relume_rays_body *bodies, size_t n,
                            struct relume_rays_contact *out);

#ifdef __cplusplus
}
#endif
