/* A scene on its way under the rules: what the files of this room share. */
#pragma once

#include <stdint.h>
#include <string.h>

#include "look/rules.h"
#include "look/spare.h"
#include "scene/scene.h"

struct applying {
	const struct look *look;
	const struct rules *rules; /* the look's */
	const struct spare *spare; /* NULL: nothing is spared */
	const struct scene *scene;
	struct scene *out;
	float eye_from_world[16], world_from_eye[16]; /* where lights and planes of the world are */
	int knows_world;
	int has_mirror;           /* pictures in mirrors may be left out */
	uint8_t *in_plane; /* [instances][surfaces]: whether a rule's plane holds an instance, 1 no, 2 yes; 0: not asked
	                      yet */
	uint32_t *matched;        /* [surfaces]: draws that each rule matched */
	int lights_change; /* bits: 1 of what OpenGL does not light, 2 of what it lights, 4 where a unit holds a shadow,
	                      8 where faces look round */
};

/** A number of a rule, where it gives one. from: [n], or NULL */
static inline void applying_number(float *to, const float *from, int n)
{
	if (from)
		memcpy(to, from, (size_t)n * sizeof(*to));
}
