/*
 * Types shared by the rooms of tracer/frame: the tracer with its buffers on the device, and a frame in progress.
 *
 * Every function that uses the device may return ERR_MEMORY (tracer/device/device.h). trace.c then asks for less memory
 * or reports the error.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "tracer/accel/accel.h"
#include "tracer/device/device.h"
#include "tracer/frame/common/options.h"
#include "tracer/frame/common/picture_kept.h"
#include "tracer/frame/common/pool.h"
#include "tracer/frame/common/traverse.h"
#include "tracer/frame/prepare/prepare.h"

/* X(element, name): the state and geometry of a frame on the device. */
#define PLACED_BUFFERS(X) \
	X(geometry, geometries) X(scene_material, materials) X(scene_light, lights) X(scene_unit, units) \
	X(scene_current, currents) X(uint, stipples) X(uint, programs) X(texture_image, textures) X(view, views) \
	X(uint, owners) X(shaded_vertex, vertices) X(float, texcoords) X(window_vertex, windows) X(float, clips)

#define FRAME_FIELD(element, name) union buffer_##element name;

/* Filled by place/, read by all rooms. */
struct placed_buffers {
	PLACED_BUFFERS(FRAME_FIELD)
};

/* Pixels of a band. samples: if pixels have several */
struct pixel_buffers {
	union buffer_frame_pixel frame, samples[SCENE_SAMPLES];
};

/* Lists that rooms hand each other. Their buffers belong to one room, which may replace them when a list grows. */

/* Fragments, the numbers of their pixels, and their colours. */
struct fragment_list {
	union buffer_fragment fragments;
	union buffer_uint pixels;
	union buffer_shaded shaded;
	uint32_t n;
};

/* Rays, and room for the share of light that passes along each: [3][n], in red, green and blue. */
struct light_rays {
	union buffer_ray rays;
	union buffer_float visibility;
	uint32_t n, to_lights; /* to_lights: 0 for rays into the surroundings */
};

/* Paths with their rays and hits, and room for those that follow from them. */
struct path_list {
	union buffer_path paths, next_paths;
	union buffer_ray rays, next_rays;
	union buffer_hit hits;
	union buffer_uint counts; /* number of those that follow from each */
	uint32_t n;
};

/* The definition of struct tracer, which trace.h hides. */
struct tracer {
	struct device *dev;
	struct accel *accel;
	size_t tree_room[N_BLAS_PARTS]; /* room of the buffers of mesh trees, in items */
	struct pool attributes, indices, texels, opacity;
	struct opacity_met { /* surfaces of the last frame that asked for words of opacity: sorted hashes */
		uint64_t *names;
		size_t n;
		int is_used; /* 1: there was such a frame */
	} opacity_met;
	struct traverse_trees trees;
	struct placed_buffers placed;
	struct pixel_buffers pixels;
	struct hook_buffers *hook; /* the rooms' own buffers */
	struct light_buffers *light;
	struct dome_buffers *dome;
	struct picture_buffers *picture;
	struct band_buffers *band;
	uint32_t most_rows; /* most rows in a band, after the device ran out of memory for more; 0: no limit */
	struct tracer_undrawn undrawn;
	struct tracer_added added;
	struct picture_kept drawn; /* the last picture drawn */
};

struct expanded;

/* A scene on its way to a picture: what stays the same in all passes until it is placed again. */
struct frame {
	struct tracer *tr;
	const struct scene *scene;
	const struct tracer_options *options;
	uint32_t width, height;
	uint32_t bits;      /* bits of the frame buffer: see pixel_depth_bits */
	uint32_t is_placed; /* 1: state, vertices and trees of the previous pass are on the device; only the picture has
	                     * to be moved */
	struct prepared prepared;
	struct expanded *expanded;       /* [n_instances]: lines and points as quads; empty for others */
	const struct scene_mesh **extra; /* [n_instances]: meshes of the expanded instances, or NULL */
	const struct accel_space *spaces;
	uint32_t n_spaces;
	struct emission_list { /* emissive surfaces of a space: a range of the list of all */
		uint32_t first, n;
		float emitted; /* total emission, as in kernels.h */
	} *emissions; /* [n_spaces] in mode path, else NULL */
	const struct segment *hooked; /* first segment of the eye space that hooks' rays are in; NULL: none */
	struct frame_objects { /* objects that a hook's intersection replaces: hook_objects.h */
		struct hook_object *list;
		uint32_t n, space;     /* space: the eye space of the objects */
		uint32_t room;         /* most rays of one kind that may hit objects */
		uint32_t vertex_first, texcoord_first; /* start of the room for triangles that represent hits */
		uint32_t *index;       /* indices of these triangles */
		struct scene_mesh mesh;
	} objects;
};

/* Counts from drawing a scene. */
struct drawn {
	uint64_t unknown;               /* pixels that show or tested unknown contents from before the scene */
	struct tracer_added added;      /* counts of the picture's bands */
	struct tracer_undrawn undrawn;
};

/* One sample of all pixels. */
struct pass {
	const struct frame *frame;
	uint32_t number, count; /* pass 0 is the pixel centre and is traced last */
	uint32_t turn;          /* selects the pixels that take part in the other passes (sample_takes_part) */
	uint32_t is_first;      /* 1: first of the passes to be summed; there are no sums yet */
	uint32_t n_samples;     /* samples of a pixel in this pass: 1 or SCENE_SAMPLES */
	struct image *image;    /* image or picture receives the bands of the last pass; the other is NULL */
	struct scene_picture *picture;
	struct drawn *drawn;
};

/* Rows of a frame that are drawn at once. Buffers of pixels hold its pixels, bottom row first. */
struct band {
	const struct frame *frame;
	const struct pass *pass;
	uint32_t row_first, n_rows, n_pixels;
	float background[4]; /* the last colour that pixels were cleared to */
};

/** Tables passed to every shading kernel. */
struct tables_launch frame_tables(const struct tracer *tr);

/** Index of the band's first pixel in the frame. */
uint32_t frame_first_pixel(const struct band *band);

/** 1 if kernels process packets of rays and fragments; 0: one per work item. */
int frame_in_packets(const struct frame *frame);

/** The buffer of one sample of the pixels; the frame itself if they have only one. */
union buffer_frame_pixel *frame_sample(const struct pass *pass, uint32_t sample);
