/*
 * Draws of one kind: of one mesh, one texture, or one state of OpenGL's, and how often frames say what they are. A role
 * is given to a kind that has it nearly always: by its texture where all of that shows it, else by its mesh, or by its
 * state where meshes are in one frame each.
 */
#pragma once

#include <stdint.h>

#include "base/table.h"
#include "look/findings.h"
#include "scene/scene.h"

enum kind_role { KIND_WORLD, KIND_SKY, KIND_DECAL, KIND_SHADOW, KIND_LIT_SHADOW, N_KIND_ROLES };

/* One kind. */
struct kind {
	uint64_t hash[2]; /* of a mesh or a texture; of a state its bits */
	uint32_t by;      /* a mesh, a texture, or a state (kinds.c) */
	uint32_t frames, draws[N_KIND_ROLES];
	uint64_t last;    /* number of the frame that drew it last, counted from 1, */
	uint32_t asked;   /* and how many of its draws were looked at there for what they lie on */
	size_t texture, state; /* of a mesh: index + 1; 0: none */
};

/* All zero: empty. */
struct kinds {
	struct kind *list;
	size_t n, room;
	struct table by_key; /* -> index + 1 */
	uint64_t frames;
	uint8_t *layers; /* [n_instances] of the last frame: enum layer */
	size_t room_layers;
};

/** Study one more frame. @return 0 or ERR_SYSTEM (reported) */
int kinds_add(struct kinds *k, const struct scene *scene);
void kinds_free(struct kinds *k);

/** 1 if a mesh is part of the sky, by the rules of kinds_find. */
int kinds_has_sky(const struct kinds *k, const uint64_t mesh[2]);

/** Rules for surfaces. @param is_relit  1: surfaces that OpenGL does not light get other lights, which cast shadows */
void kinds_find(const struct kinds *k, int is_relit, struct findings *out);
