/*
 * A fixed scene of about 250,000 triangles and rays to measure it with: camera rays of one picture, shadow rays from
 * their hits to one point light, and short rays in all directions, as for ambient occlusion. `relume bench` and the
 * comparison with other tracers in tests/bench/ use it.
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/accel.h"
#include "tracer/device/device.h"

/* Triangles in eye space: indices into positions. */
struct bench_mesh {
	float (*position)[4];
	uint32_t (*index)[3];
	uint32_t n_vertices, n_triangles;
	char source[64]; /* its source */
};

/**
 * Make the mesh: three bunnies, two cows, two spots and three teapots on a floor, read from OBJ files. If any file
 * cannot be read, bumpy spheres replace them all.
 * @param models  folder of the OBJ files, or NULL
 * @return 0 or ERR_SYSTEM (reported)
 */
int bench_mesh_create(const char *models, struct bench_mesh *out);
void bench_mesh_free(struct bench_mesh *mesh);

enum bench_ray_kind { BENCH_SHADOW, BENCH_AMBIENT, N_BENCH_RAY_KINDS };

struct bench {
	struct device *dev;
	struct bench_mesh mesh;
	uint32_t width, height;
	struct view view; /* view of the camera rays; pixels are numbered from the bottom row */
	struct ray *rays[N_BENCH_RAY_KINDS]; /* eight consecutive rays belong to neighbouring pixels */
	uint32_t n_rays[N_BENCH_RAY_KINDS];
	double build_s; /* time to build the acceleration structure */

	struct bench_state *state; /* private */
};

/**
 * Build the scene on a device, trace it once, and derive the other rays from the hits.
 * @param dev     borrowed until bench_destroy
 * @return 0 or ERR_SYSTEM (reported)
 */
int bench_create(struct device *dev, const char *models, uint32_t width, uint32_t height, struct bench **out);
/** As bench_create, for the caller's mesh, in eye space. The bench takes ownership, also after an error. */
int bench_create_of(struct device *dev, struct bench_mesh *mesh, uint32_t width, uint32_t height, struct bench **out);
void bench_destroy(struct bench **bench);

/**
 * One picture's camera rays: everything a frame with a new camera costs (vertices, top level, upload, kernel).
 * @param kernel   KERNEL_camera_packet, KERNEL_camera_wide or KERNEL_camera_compressed
 * @param seconds  how long it took
 * @return 0 or ERR_SYSTEM (reported)
 */
int bench_camera(struct bench *bench, enum kernel kernel, double *seconds);

/** Send the rays of one kind through an occlude or intersect kernel. Rays and trees are on the device already. */
int bench_rays(struct bench *bench, enum kernel kernel, enum bench_ray_kind kind, double *seconds);

/** How many pixels or rays hit something in the last run. @return 0 or ERR_SYSTEM (reported) */
int bench_count_camera_hits(struct bench *bench, uint32_t *n);
int bench_count_ray_hits(struct bench *bench, enum kernel kernel, enum bench_ray_kind kind, uint32_t *n);

/* A tree of the bench's mesh. */
struct bench_tree {
	double build_s, build_cpu_s, cost; /* build_cpu_s: summed over all processors; cost: bvh_cost */
	size_t n_items;       /* in all leaves */
	size_t bytes;         /* size of the tree that the device's kernels traverse */
};

/** Build a tree of another kind and trace through it from now on. @return 0 or ERR_SYSTEM (reported) */
int bench_rebuild(struct bench *bench, enum accel_kind kind, struct bench_tree *out);

/** The median of n figures; sorts them. */
double bench_median(double *values, size_t n);
