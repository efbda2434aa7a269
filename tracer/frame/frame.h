/*
 * What the files of this room share: the tracer with its buffers on the device, and a frame on its way through it.
 *
 * Every function that uses the device may return ERR_MEMORY (tracer/device/device.h). trace.c then asks for less, or
 * reports it.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "tracer/accel/accel.h"
#include "tracer/frame/picture_kept.h"
#include "tracer/frame/pool.h"
#include "tracer/frame/prepare.h"
#include "tracer/frame/trace.h"
#include "tracer/frame/traverse.h"

/* X(element, name): the buffers of a frame that are neither pools nor trees. */
#define FRAME_BUFFERS(X) FRAME_WHOLE_BUFFERS(X) FRAME_BAND_BUFFERS(X)

/* Those that a frame keeps from band to band, and those of a band. */
#define FRAME_WHOLE_BUFFERS(X) \
	X(geometry, geometries) X(scene_material, materials) X(scene_light, lights) X(scene_unit, units) \
	X(scene_current, currents) \
	X(uint, stipples) X(uint, programs) X(texture_image, textures) X(view, views) \
	X(uint, owners) X(shaded_vertex, vertices) X(float, texcoords) X(window_vertex, windows) X(float, clips) \
	X(float, sums) X(emitter, emitters) X(float, parameters) X(hook_object, objects)
#define FRAME_BAND_BUFFERS(X) \
	X(uint, after) X(fragment, sparse) X(uint, counts) X(uint, first) \
	X(fragment, fragments) X(uint, pixels) X(shaded, shaded) \
	X(ray, rays) X(uint, occluded) X(float, visibility) X(uint, wanted) X(float, background) X(uint, places) \
	X(uint, scan) \
	X(path, paths) X(ray, path_rays) X(hit, path_hits) X(path, next_paths) X(ray, next_path_rays) X(uint, next_counts) \
	X(ray, sky_rays) X(hit, sky_hits) X(float, radiance) \
	X(photon, photons) X(path, shadow_paths) X(ray, shadow_rays) X(hit, shadow_hits) X(path, next_shadow_paths) \
	X(ray, next_shadow_rays) \
	X(frame_pixel, cleared) X(uint, drawn) X(dome_place, dome_places) X(float, dome_sums) X(float, dome_directions) \
	X(ray, dome_rays) X(float, dome_factors) X(uint, blocks) \
	X(fragment, alone_fragments) X(uint, alone_pixels) X(shaded, alone_shaded) X(uint, leaving) \
	X(uint, leaving_first) X(float, kept_visibility) X(float, kept_pixels) X(float, next_pixels) \
	X(layer_clear, layer_clears) X(uint, colors) X(uint, depths) X(uint, unknown) X(half, halves) X(float, floats) \
	X(hook_answer, answers)

struct frame_buffers {
#define FRAME_FIELD(element, name) union buffer_##element name;
	FRAME_BUFFERS(FRAME_FIELD)
	union buffer_frame_pixel frame, samples[SCENE_SAMPLES]; /* samples: where pixels have several, each one's own */
};

/* What trace.h hides. */
struct tracer {
	struct device *dev;
	struct accel *accel;
	size_t tree_room[N_BLAS_PARTS]; /* of the buffers of meshes' trees, items */
	struct pool attributes, indices, texels;
	struct traverse_trees trees;
	struct frame_buffers buffers;
	uint32_t *counts, *first; /* [pixels], host copies */
	size_t n_counted;
	uint32_t most_rows; /* of a band, as the device had too little memory for more; 0: no limit */
	struct tracer_undrawn undrawn;
	struct tracer_added added;
	struct picture_kept drawn; /* the picture that was drawn last */
};

struct expanded;

/* One frame on its way. */
struct job {
	struct tracer *tr;
	const struct scene *scene;
	const struct tracer_options *options;
	struct prepared prepared;
	struct expanded *expanded;       /* [n_instances]: lines and points as quads; empty for others */
	const struct scene_mesh **extra; /* [n_instances]: their meshes, or NULL */
	const struct accel_space *spaces;
	uint32_t n_spaces;
	struct emission_list { /* surfaces that shine: those of a space in the list of all */
		uint32_t first, n;
		float emitted; /* as in kernels.h */
	} *emissions; /* [n_spaces] in mode path, else NULL */
	const struct segment *hooked; /* the first of the eye space that rays of hooks are in; NULL: none is */
	struct job_objects { /* what a hook's intersection stands for: hook_objects.h */
		struct hook_object *list;
		uint32_t n, space;     /* the eye space that they are in */
		uint32_t room;         /* rays of one kind that may hit them */
		uint32_t vertex_first, texcoord_first; /* where room for the triangles is that stand for hits */
		uint32_t *index;       /* of these triangles */
		struct scene_mesh mesh;
	} objects;
	uint32_t width, height;
	uint32_t row_first, n_rows; /* the band that is drawn; buffers of pixels hold its pixels, bottom row first */
	uint32_t n_pixels;          /* of the band */
	uint32_t bits; /* of the frame buffer, and the sample that is drawn: see pixel_depth_bits */
	uint32_t n_samples; /* of a pixel in this pass: 1 or SCENE_SAMPLES */
	union buffer_frame_pixel *frame; /* the sample's that is drawn */
	float background[4];
	uint32_t pass, n_passes; /* samples of a pixel; pass 0 is its centre, and the last to be traced */
	uint32_t is_first;       /* of the passes that are summed up: there are no sums yet */
	uint32_t is_placed; /* state, vertices and trees of the pass before are on the device: only the picture is to be
	                       moved */
	uint32_t turn;           /* which pixels take part in the other passes (sample_takes_part) */
	struct tracer_added added;      /* of the picture's bands so far */
	uint64_t unknown; /* pixels so far that show or tested what was there before the scene and is not known */
	struct image *image;            /* receive the bands of the last pass: one of the two, the other is NULL */
	struct scene_picture *picture;
};

/* Reserve `count` elements of one of the tracer's buffers, by its name; fill it with as many. */
#define frame_reserve(tr, name, count) launch_reserve((tr)->dev, (tr)->buffers.name, count)
#define frame_upload(tr, name, data, count) launch_upload((tr)->dev, (tr)->buffers.name, data, count)

/** What every shading kernel takes. */
struct tables_launch frame_tables(const struct tracer *tr);

/** The number of the band's first pixel in the frame. */
uint32_t frame_first_pixel(const struct job *job);

/** Whether kernels take packets of rays and of fragments; else one a work item. */
int frame_in_packets(const struct job *job);

/** The buffer of one of the pixels' samples; where they have but one, the frame itself. */
union buffer_frame_pixel *frame_sample(const struct job *job, uint32_t sample);

/** Make room for a word a pixel of the band in tracer.counts and tracer.first. @return 0 or ERR_SYSTEM (reported) */
int frame_reserve_counts(struct job *job);
