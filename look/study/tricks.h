/*
 * What stands for light in a recording, told by the matrices and vertices it was drawn with: shadows flattened onto a
 * plane, worlds drawn again behind a mirror, shadow volumes in the stencil buffer. Their matrices hold the light and
 * the plane exactly.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "look/study/motion.h"
#include "scene/scene.h"

enum trick { TRICK_PLANAR_SHADOW, TRICK_MIRROR, TRICK_VOLUME_Z_PASS, TRICK_VOLUME_Z_FAIL, N_TRICKS };
enum { TRICKS_MAX = 32 };

/* A light or a plane that some frames' tricks agree on. */
struct trick_found {
	enum trick kind;
	double light[4]; /* where the light is, in the world; w 0: a direction towards it */
	double plane[4]; /* of a shadow or a mirror: p . (x y z 1) = 0, its normal a unit vector towards what is seen */
	unsigned votes;  /* draws that say so */
	uint64_t last;   /* number of the frame that said so last, counted from 1 */
	unsigned frames;
	int has_opengl_light; /* a light of OpenGL's is there, and lights most of what the shadows fall on */
	int stencil; /* of a mirror: its picture was drawn through the stencil buffer; of a planar shadow: it was drawn
	                there alone */
	int surface_stencil; /* of a mirror: the surface over its picture was drawn through the stencil buffer */
	double shows; /* of a mirror: the share of its picture that the surface drawn over it let through; 0: none was
	                 found */
};

struct tricks {
	struct trick_found found[TRICKS_MAX];
	unsigned n;
	unsigned unmatched; /* flat draws whose mesh was not drawn upright in the same frame */
	unsigned darkenings; /* draws that darken where the stencil buffer says so, in frames with shadow volumes */
};

/** A finding to be noted, or added to what it equals: a mirror also to one of the turned plane. @return NULL: there are
 * too many */
struct trick_found *tricks_note(struct tricks *t, const struct trick_found *said, uint64_t frame);

/**
 * 1 for a shadow that few say beside another of the same plane: a mesh that stands in many places is flattened from one
 * of them, and the others say false lights.
 */
int tricks_is_outvoted(const struct tricks *t, unsigned i);
