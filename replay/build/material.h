/*
 * State that a draw reads, copied into the scene under construction; equal values are stored once. Functions return
 * indices into the scene's arrays, which are meaningless if memory ran out (gls_fail).
 */
#pragma once

#include <stdint.h>

#include "base/table.h"
#include "replay/build/frame.h"
#include "replay/build/known.h"

/* The events of a surface so far; used by frame.c and material.c. */
struct gls_frame {
	struct scene *out; /* NULL between frames */
	struct {
		uint32_t instances, materials, units, lights, currents, views, clears, stipples, meshes, textures,
			draws, rectangles, programs;
	} room;
	struct table materials, units, lights, currents, views, stipples, programs, spaces; /* hash -> index + 1 */
	uint32_t material, view; /* the last draw's, valid while its context's state is not dirty */
	int is_programmed;       /* the view's gls_frame_is_programmed */
	const struct gls_state *last;
	uint32_t next_draw, next_primitive;
	uint32_t colored; /* 1: some event may change colours */
	uint32_t depth_bits; /* for draws copied into a surface without depth, whose own depth test is off */
	uint32_t put_end; /* instances before this one left no depth or stencil values: the last of them was copied there */
	uint32_t looked;  /* buffers that some draw read where they were unknown, bits as in scene_clear */
	struct gls_known known; /* areas known through clears so far */
	uint64_t serial;  /* the scene's: meshes and images use it to remember their slots */
	struct gls_picture *snapshot; /* a reference: picture of the first snapshot_events events, or NULL */
	uint64_t snapshot_events;
	int snapshot_in_part;         /* 1: it is valid only where `known` says so */
};

/** 1 if a program may position the vertices. */
int gls_frame_is_programmed(const struct gls_state *st, const struct gls_event *e);
/** Store the projection, viewport, scissor and eye space. @return index of the view */
uint32_t gls_frame_view(struct gls_exec *x, const struct gls_surface *surface, const struct gls_state *st,
                        const struct gls_event *e);
/**
 * Store everything else that the fragments of a draw depend on, with units and lights. @return index of the material
 */
uint32_t gls_frame_material(struct gls_exec *x, const struct gls_target *target, struct gls_state *st,
                            const struct gls_event *e);
/** Store a mesh, or an image, in the scene. @return its index */
uint32_t gls_frame_mesh(struct gls_exec *x, struct gls_frame *f, struct gls_mesh *mesh);
uint32_t gls_frame_texture(struct gls_exec *x, struct gls_frame *f, struct gls_texture_image *image);

/** The part of a surface inside the scissor rectangle: x, y, width, height. */
void gls_scissor_of(const struct gls_surface *d, const struct gls_scissor *scissor, int32_t out[4]);
/** A colour of the state, clamped to [0,1] unless the drawable can hold values outside it (ARB_color_buffer_float). */
void gls_color_of(float out[4], const float color[4], uint32_t unclamped);
