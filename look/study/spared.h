/*
 * Decisions about which surfaces block no light (look/spare/spare.h), made once for the whole recording by a majority
 * of its frames. If each frame decided alone, shadows would come and go as things move.
 *
 * Frames vote on meshes and on textures, separately for lit and unlit draws. A mesh drawn several times in a frame is
 * spared there only if all its draws are, because one of them may be in the lit world. Meshes that occur in one frame
 * only (their points move) follow their texture, and those without a texture follow the majority of their kind.
 */
#pragma once

#include <stdint.h>

#include "base/table.h"
#include "look/rules/findings.h"
#include "scene/scene.h"

enum { SPARED_BITS = 2 };

/* Votes on a mesh or a texture. */
struct spared_entry {
	uint64_t hash[2];
	uint32_t is_texture, lit;
	uint32_t frames, votes[SPARED_BITS]; /* votes: how many of the frames voted for each bit of spared.c's list */
	uint32_t last, bits;                 /* the last frame, counted from 1, and its decision so far */
	size_t texture;                      /* for a mesh: index + 1 of its texture's entry; 0: none */
};

/* All zero: nothing was seen. */
struct spared {
	struct spared_entry *entries;
	size_t n, room;
	struct table by_key; /* -> index + 1 */
	uint32_t frames;     /* frames with something that OpenGL lights */
	uint32_t any;        /* bits that any frame gives to anything */
};

/** Study one more frame. @return 0 or ERR_SYSTEM (reported) */
int spared_add(struct spared *s, const struct scene *scene);
void spared_free(struct spared *s);

/**
 * Rules for surfaces, general ones first; none if no frame spares anything. They must precede the rules for surfaces
 * that never block light.
 */
void spared_find(const struct spared *s, struct findings *out);
