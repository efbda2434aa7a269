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

/* The buffers of a frame that are not pools. */
enum buffer {
	BUFFER_GEOMETRIES, BUFFER_MATERIALS, BUFFER_LIGHTS, BUFFER_UNITS, BUFFER_CURRENTS, BUFFER_STIPPLES,
	BUFFER_TEXTURES, BUFFER_VIEWS, BUFFER_INSTANCES,
	BUFFER_OWNER, BUFFER_VERTICES, BUFFER_TEXCOORDS, BUFFER_WINDOWS, BUFFER_CLIPS,
	BUFFER_NODES2, BUFFER_NODES8, BUFFER_NODES8C, BUFFER_TRIANGLES, BUFFER_TRIANGLES8, BUFFER_TRIANGLES8C, BUFFER_FACES8,
	BUFFER_TOP2, BUFFER_TOP8, BUFFER_INSTANCE_LIST,
	BUFFER_AFTER, BUFFER_SPARSE, BUFFER_COUNTS, BUFFER_FIRST,
	BUFFER_FRAGMENTS, BUFFER_PIXELS, BUFFER_SHADED,
	BUFFER_RAYS, BUFFER_STOPPED, BUFFER_ARRIVING, BUFFER_WANTED, BUFFER_BACKGROUND, BUFFER_PLACES, BUFFER_SCAN,
	BUFFER_PATHS, BUFFER_PATH_RAYS, BUFFER_PATH_HITS, BUFFER_NEXT_PATHS, BUFFER_NEXT_RAYS, BUFFER_NEXT_COUNTS,
	BUFFER_SKY_RAYS, BUFFER_SKY_HITS, BUFFER_GIVEN,
	BUFFER_WALKERS, BUFFER_WALK_RAYS, BUFFER_WALK_HITS, BUFFER_NEXT_WALKERS, BUFFER_NEXT_WALK_RAYS,
	BUFFER_FRAME, /* where pixels have several samples, each one's own: */ BUFFER_SAMPLE1, BUFFER_SAMPLE2, BUFFER_SAMPLE3, BUFFER_SAMPLE4,
	BUFFER_SUMS, BUFFER_HALVES, BUFFER_FLOATS,
	N_BUFFERS
};

struct tracer {
	struct device *dev;
	struct accel *accel;
	size_t tree_room[N_BLAS_PARTS]; /* of the buffers of meshes' trees, items */
	struct pool attributes, indices, texels;
	struct device_buffer *buffers[N_BUFFERS];
	uint32_t *counts, *first; /* [pixels], host copies */
	size_t n_counted;
	struct tracer_undrawn undrawn;
	uint64_t drawn_serial, drawn_events; /* scene whose pixels BUFFER_FRAME holds: serial, and how many events it had */
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
	enum buffer frame;  /* the sample's that is drawn */
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

/** Ask all lights from all n fragments of the list: BUFFER_ARRIVING[slot][fragment], three shares each. */
int trace_shadows(struct job *job, const struct accel_space *space, uint32_t n);

/** How open the surroundings of all n fragments are, in place of their colours or over them. */
int trace_openness(struct job *job, const struct accel_space *space, uint32_t n);

/** Follow the mirrored, bent and scattered rays of all n fragments, bounce by bounce, into their parts. */
int trace_paths(struct job *job, const struct accel_space *space, const struct accel_space *sky, uint32_t n);

/* --- Small change ------------------------------------------------------------------------------------------------- */

static inline int reserve(struct tracer *tr, enum buffer buffer, size_t count, size_t size)
{
	return device_reserve(tr->dev, &tr->buffers[buffer], count * size);
}

static inline int upload(struct tracer *tr, enum buffer buffer, const void *data, size_t count, size_t size)
{
	int err = reserve(tr, buffer, count, size);

	return err || count == 0 ? err : device_write(tr->dev, tr->buffers[buffer], 0, data, count * size);
}

/* Arguments of a launch, counted as they are added. */
struct launch {
	struct device_arg args[32];
	size_t n;
};

static inline void add_buffer(struct launch *l, const struct device_buffer *buffer)
{
	l->args[l->n++] = ARG_BUFFER(buffer);
}

static inline void add(struct launch *l, const struct tracer *tr, enum buffer buffer)
{
	add_buffer(l, tr->buffers[buffer]);
}

static inline void add_bytes(struct launch *l, const void *value, size_t bytes)
{
	l->args[l->n++] = (struct device_arg){ .value = value, .bytes = bytes };
}

static inline void add_uint(struct launch *l, const uint32_t *value)
{
	add_bytes(l, value, sizeof(*value));
}

/* The tables that every shading kernel takes first (kernels/gl/tables.h). */
static inline struct launch launch_with_tables(const struct tracer *tr)
{
	struct launch l = { .n = 0 };

	add(&l, tr, BUFFER_GEOMETRIES);
	add(&l, tr, BUFFER_MATERIALS);
	add(&l, tr, BUFFER_LIGHTS);
	add(&l, tr, BUFFER_UNITS);
	add(&l, tr, BUFFER_CURRENTS);
	add_buffer(&l, tr->attributes.buffer);
	add_buffer(&l, tr->indices.buffer);
	add(&l, tr, BUFFER_VERTICES);
	add(&l, tr, BUFFER_TEXCOORDS);
	add(&l, tr, BUFFER_TEXTURES);
	add_buffer(&l, tr->texels.buffer);
	add(&l, tr, BUFFER_STIPPLES);
	return l;
}

static inline int run(struct tracer *tr, enum device_kernel kernel, size_t n, const struct launch *l)
{
	return device_run(tr->dev, kernel, n, l->args, l->n);
}

#endif
