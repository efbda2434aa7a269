/*
 * What a draw saw: state copied into the scene under construction, equal things once. Indices are those of the scene's
 * arrays, and mean nothing where memory was short (gls_fail).
 */
#pragma once

#include <stdint.h>

#include "base/table.h"
#include "replay/build/frame.h"
#include "replay/build/known.h"

/* The events of a surface so far; for frame.c and material.c. */
struct gls_frame {
	struct scene *out; /* NULL between frames */
	struct {
		uint32_t instances, materials, units, lights, currents, views, clears, stipples, meshes, textures,
			draws, rectangles, programs;
	} room;
	struct table materials, units, lights, currents, views, stipples, programs, spaces; /* hash -> index + 1 */
	uint32_t material, view; /* of the last draw, while its context's state is not dirty */
	int is_programmed;       /* that of the view */
	const struct gls_state *last;
	uint32_t next_draw, next_primitive;
	uint32_t colored; /* 1: some event may change colours */
	uint32_t depth_bits; /* for draws put into a surface without depth, whose own test none */
	uint32_t put_end; /* instances up to this one left no depth or stencil values: the last was put there */
	uint32_t looked;  /* buffers that some draw looked at where they were not known, bits as in scene_clear */
	struct gls_known known; /* by clears so far */
	uint64_t serial;  /* of the scene: what meshes and images remember their slots by */
	struct gls_picture *snapshot; /* a reference: what the first snapshot_events events make, or NULL */
	uint64_t snapshot_events;
	int snapshot_in_part;         /* 1: it holds only where it is known */
};

/** 1 where a program may place what is drawn. */
int gls_frame_is_programmed(const struct gls_state *st, const struct gls_event *e);
/** Projection, viewport and scissor, and whose eye space it is. */
uint32_t gls_frame_view(struct gls_exec *x, const struct gls_surface *surface, const struct gls_state *st,
                        const struct gls_event *e);
/** Everything else that the fragments of a draw depend on, with units and lights. */
uint32_t gls_frame_material(struct gls_exec *x, const struct gls_target *target, struct gls_state *st,
                            const struct gls_event *e);
/** The place of a mesh in the scene, and of an image. */
uint32_t gls_frame_mesh(struct gls_exec *x, struct gls_frame *f, struct gls_mesh *mesh);
uint32_t gls_frame_texture(struct gls_exec *x, struct gls_frame *f, struct gls_texture_image *image);

/** The part of a surface that the scissor leaves: x, y, width, height. */
void gls_scissor_of(const struct gls_surface *d, const struct gls_scissor *scissor, int32_t out[4]);
/** A colour of the state, clamped to [0,1] unless the drawable can hold others (ARB_color_buffer_float). */
void gls_color_of(float out[4], const float color[4], uint32_t unclamped);
