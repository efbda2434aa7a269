/*
 * Drawing tricks that imitate light, recognized by the matrices and vertices of their draws: shadows flattened onto a
 * plane, worlds drawn again behind a mirror, shadow volumes in the stencil buffer. Their matrices give the light and
 * the plane exactly.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "look/study/motion/motion.h"
#include "scene/scene.h"

enum trick { TRICK_PLANAR_SHADOW, TRICK_MIRROR, TRICK_VOLUME_Z_PASS, TRICK_VOLUME_Z_FAIL, N_TRICKS };
enum { TRICKS_MAX = 32 };

/* A light or a plane that the tricks of some frames agree on. */
struct trick_found {
	enum trick kind;
	double light[4]; /* the light's position in the world; w 0: the direction towards it */
	double plane[4]; /* for a shadow or a mirror: p . (x y z 1) = 0; its normal is a unit vector towards the
	                    visible side */
	unsigned votes;  /* draws that agree */
	uint64_t last;   /* the last frame that agreed, counted from 1 */
	unsigned frames;
	int has_opengl_light; /* there is a light of OpenGL's, and it lights most of the surfaces below the shadows */
	int stencil; /* mirrors: the reflected meshes were drawn through the stencil buffer; planar shadows: they
	                were drawn into it alone */
	int surface_stencil; /* mirrors: the surface in front was drawn through the stencil buffer */
	double shows; /* mirrors: the share of the reflected picture that the surface in front lets through; 0: there
	                 is no such surface */
};

struct tricks {
	struct trick_found found[TRICKS_MAX];
	unsigned n;
	unsigned unmatched; /* flat draws without an upright draw of the same mesh in the frame */
	unsigned darkenings; /* draws that darken through the stencil buffer, in frames with shadow volumes */
};

/**
 * Add a finding, or merge it with an equal one; a mirror also equals one seen from the other side.
 * @return NULL: there are too many
 */
struct trick_found *tricks_note(struct tricks *t, const struct trick_found *said, uint64_t frame);

/**
 * 1 for a shadow with few votes beside another of the same plane. If a mesh is drawn in several places, its shadow is
 * paired with each of them, and all but one pairing give false lights.
 */
int tricks_is_outvoted(const struct tricks *t, unsigned i);
