/*
 * Inside of the wavefront (trace.c, upload.c, geometry.c, secondary.c): the tracer, a frame on its way through it, and how kernels
 * are launched. Functions return 0 or ERR_SYSTEM (reported).
 */
#ifndef TRACER_FRAME_FRAME_H
#define TRACER_FRAME_FRAME_H

#include <stddef.h>
#include <stdint.h>

#include "tracer/accel/accel.h"
#include "tracer/frame/expand.h"
#include "tracer/frame/pool.h"
#include "tracer/frame/prepare.h"
#include "tracer/frame/trace.h"
#include "tracer/frame/traverse.h"

/* X(element, name): the buffers of a frame that are neither pools nor trees. */
#define FRAME_BUFFERS(X) \
	X(geometry, geometries) X(scene_material, materials) X(scene_light, lights) X(scene_unit, units) X(scene_current, currents) \
	X(uint, stipples) X(texture_image, textures) X(view, views) \
	X(uint, owners) X(shaded_vertex, vertices) X(float, texcoords) X(window_vertex, windows) X(float, clips) \
	X(uint, after) X(fragment, sparse) X(uint, counts) X(uint, first) \
	X(fragment, fragments) X(uint, pixels) X(shaded, shaded) \
	X(ray, rays) X(uint, occluded) X(float, visibility) X(uint, wanted) X(float, background) X(uint, places) X(uint, scan) \
	X(path, paths) X(ray, path_rays) X(hit, path_hits) X(path, next_paths) X(ray, next_path_rays) X(uint, next_counts) \
	X(ray, sky_rays) X(hit, sky_hits) X(float, radiance) \
	X(path, shadow_paths) X(ray, shadow_rays) X(hit, shadow_hits) X(path, next_shadow_paths) X(ray, next_shadow_rays) \
	X(float, sums) X(half, halves) X(float, floats)

struct frame_buffers {
#define FRAME_FIELD(element, name) union buffer_##element name;
	FRAME_BUFFERS(FRAME_FIELD)
	union buffer_frame_pixel frame, samples[SCENE_SAMPLES]; /* samples: where pixels have several, each one's own */
};

struct tracer {
	struct device *dev;
	struct accel *accel;
	size_t tree_room[N_BLAS_PARTS]; /* of the buffers of meshes' trees, items */
	struct pool attributes, indices, texels;
	struct traverse_trees trees;
	struct frame_buffers buffers;
	uint32_t *counts, *first; /* [pixels], host copies */
	size_t n_counted;
	struct tracer_undrawn undrawn;
	uint64_t drawn_serial, drawn_events; /* scene whose pixels buffers.frame holds: serial, and how many events it had */
};

/* One frame on its way. */
struct job {
	struct tracer *tr;
	const struct scene *scene;
	const struct tracer_options *options;
	struct prepared prepared;
	struct expanded *expanded;       /* [n_instances]: what became of lines and points; empty for others */
	const struct scene_mesh **extra; /* [n_instances]: their meshes, or NULL */
	const struct accel_space *spaces;
	uint32_t n_spaces;
	uint32_t width, height, n_pixels;
	uint32_t bits; /* of the frame buffer, and the sample that is drawn: see pixel_depth_bits */
	uint32_t n_samples; /* of a pixel in this pass: 1 or SCENE_SAMPLES */
	union buffer_frame_pixel *frame; /* the sample's that is drawn */
	float background[4];
	uint32_t pass, n_passes; /* samples of a pixel; 0 is its centre, and the last to be traced */
	uint32_t turn;           /* of other passes: which pixels take part (sample_turn) */
};

/* --- upload.c: what of a scene the device needs ------------------------------------------------------------------- */

/** Attributes and indices of the frame's meshes into the pools, and their places into the geometries. */
int place_attributes(struct job *job);
int place_indices(struct job *job);

/** Materials, lights, texture units and textures, current values, stipples. */
int upload_state(struct job *job);

/** What accel_build_frame made and the device's kernels walk; the trees of meshes only where they changed. */
int upload_trees(struct job *job);

/* --- geometry.c: vertices and trees --------------------------------------------------------------------------------- */

/** Run the vertex stage, make triangles of lines and points, build the frame's trees; all of it on the device. Needs upload_state. */
int place_geometry(struct job *job);

/* --- secondary.c: rays from the fragments in the list -------------------------------------------------------------- */

/** What rays from a view's fragments may hit: its surfaces, or its skies; NULL: nothing. */
const struct accel_space *space_of_view(const struct job *job, uint32_t view, int sky);

/** How points are lit and where their rays go: TRANSPORT_*. */
uint32_t transport_of(const struct tracer_options *options);

/** Ask all lights from all n fragments of the list: buffers.visibility[slot][fragment], three shares each. */
int trace_shadows(struct job *job, const struct accel_space *space, uint32_t n);

/** How open the surroundings of all n fragments are, in place of their colours or over them. */
int trace_openness(struct job *job, const struct accel_space *space, uint32_t n);

/** Follow the mirrored, bent and scattered rays of all n fragments, bounce by bounce, into their parts. */
int trace_paths(struct job *job, const struct accel_space *space, const struct accel_space *sky, uint32_t n);

/* --- Small change ------------------------------------------------------------------------------------------------- */

/* Room for `count` elements in one of the tracer's buffers, by its name; and their content. */
#define frame_reserve(tr, name, count) launch_reserve((tr)->dev, (tr)->buffers.name, count)
#define frame_upload(tr, name, data, count) launch_upload((tr)->dev, (tr)->buffers.name, data, count)

/** What every shading kernel takes. */
struct tables_launch frame_tables(const struct tracer *tr);

#endif
