/* Shared by the files of this folder: a scene while rules are applied to it. */
#pragma once

#include <stdint.h>
#include <string.h>

#include "look/rules/rules.h"
#include "look/spare/spare.h"
#include "scene/scene.h"

/* Bits for the light that rules change. */
enum {
	LIGHTS_ON_UNLIT = 1,     /* light on surfaces that OpenGL does not light */
	LIGHTS_ON_LIT = 2,       /* light on surfaces that OpenGL lights */
	LIGHTS_SHADOW_UNITS = 4, /* a texture unit holds a shadow */
	LIGHTS_CREASES = 8,      /* flat faces look round */
};

struct applying {
	const struct look *look;
	const struct rules *rules; /* those of the look */
	const struct spare *spare; /* NULL: nothing is spared */
	const struct scene *scene;
	struct scene *out;
	float eye_from_world[16], world_from_eye[16]; /* transforms for lights and planes in the world */
	int knows_world;
	int has_mirror;           /* draws reflected in mirrors may be left out */
	uint8_t *in_plane;        /* [instances][surfaces]: is it in the rule's plane? 0: not tested yet, 1: no, 2: yes */
	uint32_t *matched;        /* [surfaces]: number of draws that each rule matched */
	int lights_change;        /* bits of LIGHTS_* */
};

/** Copy the numbers of a rule if it has them. @param from  [n], or NULL */
static inline void applying_number(float *to, const float *from, int n)
{
	if (from)
		memcpy(to, from, (size_t)n * sizeof(*to));
}
