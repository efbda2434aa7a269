/*
 * Draws grouped by mesh, by texture and by OpenGL state, and how often frames assign each role to a group. A role is
 * given to a group that nearly always has it: to a texture if possible, else to a mesh, or to a state if each mesh
 * occurs in one frame only.
 */
#pragma once

#include <stdint.h>

#include "base/table.h"
#include "look/rules/findings.h"
#include "scene/scene.h"

enum kind_role { KIND_WORLD, KIND_SKY, KIND_DECAL, KIND_SHADOW, KIND_LIT_SHADOW, N_KIND_ROLES };

/* A group of draws. */
struct kind {
	uint64_t hash[2]; /* mesh or texture: its hash; state: its bits */
	uint32_t by;      /* mesh, texture or state (kinds.c) */
	uint32_t frames, draws[N_KIND_ROLES];
	uint64_t last;    /* the last frame that drew it, counted from 1 */
	uint32_t asked;   /* how many of its draws were tested in that frame for what they lie on */
	size_t texture, state; /* for a mesh: index + 1; 0: none */
};

/* All zero: empty. */
struct kinds {
	struct kind *list;
	size_t n, room;
	struct table by_key; /* -> index + 1 */
	uint64_t frames;
	uint8_t *layers; /* [n_instances]: enum layer, for the last frame */
	size_t room_layers;
};

/** Study one more frame. @return 0 or ERR_SYSTEM (reported) */
int kinds_add(struct kinds *k, const struct scene *scene);
void kinds_free(struct kinds *k);

/** 1 if a mesh belongs to the sky by the rules of kinds_find. */
int kinds_has_sky(const struct kinds *k, const uint64_t mesh[2]);

/** Rules for surfaces. @param is_relit  1: surfaces that OpenGL does not light get other lights, which cast shadows */
void kinds_find(const struct kinds *k, int is_relit, struct findings *out);
