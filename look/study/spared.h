/*
 * What is spared as a blocker of light (look/spare.h), once for a recording: what most of its frames say. Each frame
 * alone would decide by what it shows, and shadows would come and go as something moves.
 *
 * Frames vote by mesh and by texture, lit draws and others apart. A mesh that is drawn more than once in a frame is
 * spared there only where all of them are: what stands in the lit world counts. Meshes that are in one frame only
 * (their points move) go by their texture, what has none by most of its kind.
 */
#pragma once

#include <stdint.h>

#include "base/table.h"
#include "look/findings.h"
#include "scene/scene.h"

enum { SPARED_BITS = 2 };

/* How frames decide about a mesh, or a texture. */
struct spared_entry {
	uint64_t hash[2];
	uint32_t is_texture, lit;
	uint32_t frames, votes[SPARED_BITS]; /* of these, for each bit of spared.c's list */
	uint32_t last, bits;                 /* number of the last frame, counted from 1, and what it says so far */
	size_t texture;                      /* index + 1 of the entry of a mesh's texture; 0: none */
};

/* All zero: nothing was seen. */
struct spared {
	struct spared_entry *entries;
	size_t n, room;
	struct table by_key; /* -> index + 1 */
	uint32_t frames;     /* with something that OpenGL lights */
	uint32_t any;        /* bits that any frame gives anything */
};

/** Study one more frame. @return 0 or ERR_SYSTEM (reported) */
int spared_add(struct spared *s, const struct scene *scene);
void spared_free(struct spared *s);

/**
 * Rules for surfaces, general ones first; none if no frame spares anything. They must precede the rules for surfaces
 * that never block light.
 */
void spared_find(const struct spared *s, struct findings *out);
