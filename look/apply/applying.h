/* Shared by the files of this folder: a scene while rules are applied to it. */
#pragma once

#include <stdint.h>
#include <string.h>

#include "look/rules/rules.h"
#include "look/spare/spare.h"
#include "scene/scene.h"

struct applying {
	const struct look *look;
	const struct rules *rules; /* those of the look */
	const struct spare *spare; /* NULL: nothing is spared */
	const struct scene *scene;
	struct scene *out;
	float eye_from_world[16], world_from_eye[16]; /* transforms for lights and planes in the world */
	int knows_world;
	int has_mirror;           /* draws reflected in mirrors may be left out */
	uint8_t *in_plane; /* [instances][surfaces] whether an instance lies in a rule's plane: 1 no, 2 yes; 0: not
	                      tested yet */
	uint32_t *matched;        /* [surfaces]: number of draws that each rule matched */
	int lights_change; /* bits: 1 for surfaces that OpenGL does not light, 2 for those that it lights, 4 if a
	                      unit holds a shadow, 8 if faces look round */
};

/** Copy the numbers of a rule if it has them. @param from  [n], or NULL */
static inline void applying_number(float *to, const float *from, int n)
{
	if (from)
		memcpy(to, from, (size_t)n * sizeof(*to));
}
