/*
 * The report's page of roles and lights: the findings of the rules for a frame rendered with rules. The renderer stores
 * them in attributes relume:rule.0 and so on (look/apply/tell.h, look_tell).
 */
#pragma once

#include <stdint.h>
#include <stdio.h>

#include "diff/report/pictures.h"

struct role {
	int is_light;
	char role[64], confidence[16], why[256];
	char what[128]; /* draw numbers of a surface; a light's place in eye space, or empty */
};

/** Read finding number i. @return 1; 0: there are fewer */
int roles_read(const struct picture_frame *frame, unsigned i, struct role *out);

/**
 * Make a finding's picture: the frame with all other draws dark, or how much each pixel faces the light.
 * @param rgb  receives a buffer of the frame's size, freed by the caller; NULL if there is nothing to show
 * @return 0 or ERR_SYSTEM (reported)
 */
int roles_paint(const struct picture_frame *frame, const struct role *role, uint8_t **rgb);
