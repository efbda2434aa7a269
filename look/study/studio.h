/*
 * Lights of a scene that stands in the dark, as a studio has them. A program that shows things before an empty window
 * often lights them without care: by one light that stands where the viewer does, and shows no shadow, or by light that
 * is as strong far off as near. Lamps in a studio stand near and aside.
 */
#pragma once

#include <stdint.h>
#include <stdio.h>

#include "scene/scene.h"

/* All zero: nothing was seen. */
struct studio {
	unsigned frames, skies; /* with something that OpenGL lights; with a sky, or a window that is cleared to a colour */
	unsigned around;        /* frames with something solid behind the viewer */
	double lit, solid;      /* draws: of these, such as OpenGL lights */
	double middle[3], size; /* sums over frames: of the box around what is lit, in eye space, and its diagonal */
	struct studio_light {
		unsigned frames;
		int differs;            /* has a spot, an attenuation, or other values from draw to draw */
		int moves;              /* from frame to frame, in eye space */
		float position[4], diffuse[3], specular[3];
		double distance;        /* sum over frames: to the middle */
	} lights[SCENE_MAX_LIGHTS];
};

/**
 * Study one more frame.
 * @param layers  which instances are of a sky (layer.h)
 */
void studio_add(struct studio *s, const struct scene *scene, const uint8_t *layers);

/** How many rules for lights there are. out: the entries of the list `lights`; NULL: they are only counted */
unsigned studio_write(const struct studio *s, FILE *out);
