/*
 * The report's page of roles and lights: what the rules said of a frame that was rendered under some. The renderer
 * tells in attributes relume:rule.0 and so on (look/apply/tell.h, look_tell).
 */
#pragma once

#include <stdint.h>
#include <stdio.h>

#include "diff/report/pictures.h"

struct role {
	int is_light;
	char role[64], confidence[16], why[256];
	char what[128]; /* draw numbers of a surface; of a light its place in eye space, or nothing */
};

/** What was told i-th. @return 1; 0: there are not so many */
int roles_read(const struct picture_frame *frame, unsigned i, struct role *out);

/**
 * Its picture: the frame with all other draws dark, or what faces the light.
 * @param rgb  receives a buffer of the frame's size; free. NULL where there is nothing to show
 * @return 0 or ERR_SYSTEM (reported)
 */
int roles_paint(const struct picture_frame *frame, const struct role *role, uint8_t **rgb);
