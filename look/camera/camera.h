/*
 * A recorded frame from elsewhere: `relume render --camera FILE`.
 *
 *     kind: pinhole              # or orthographic; default: as the program looked
 *     space: eye                 # of places and directions here. eye: the recorded camera's, which stands at 0 0 0 and looks along -z, with y up.
 *                                # world: as the list `world` of a look file says (look/rules.h). Default eye
 *     place: [0, 0, 0]           # default: where the recorded camera stands
 *     look_at: [0, 0, -1]        # default: straight on, as the recorded camera looks
 *     up: [0, 1, 0]              # default: y
 *     field_of_view: 45          # of a pinhole: degrees from top to bottom
 *     height: 10                 # of an orthographic view: units from top to bottom
 *     near: 0.1                  # what of the line of sight is drawn, in units; by default what the program drew of it, and as much
 *     far: 100                   # more as the way to the place needs
 *     size: [640, 480]           # of the picture, pixels; default: the window's
 *     turntable:                 # one recorded frame becomes many pictures: the camera goes around a point from its place on, looks at it, and `up`
 *       about: [0, 0, -5]        # is the axis. Default: the middle of what the frame shows
 *       degrees: 360             # in all; above 0: against the clock, seen from above. Default 360
 *       frames: 48               # pictures, counted from 0. Default 48
 *
 * Where the file gives neither kind nor field of view nor height, the program's own projection stays; where it gives another kind without
 * these, what is looked at (else the middle of what the frame shows) keeps its size.
 */
#pragma once

#include <stdint.h>

/* Pointers are NULL for keys that the file does not have. */
struct camera_turntable {
	const float *about, *degrees;
	const uint32_t *frames;
};

struct camera {
	const char *path; /* of the file, for messages; borrowed */
	struct camera_keys {
		const char *kind, *space;
		const float *place, *look_at, *up, *field_of_view, *height, *near, *far;
		const uint32_t *size;
		struct camera_turntable *turntable;
	} *keys;
};

enum { CAMERA_MOST_SIZE = 16384, CAMERA_MOST_PICTURES = 100000 };

/** @param path  kept until camera_free. @return 0; ERR_INPUT (reported, with what and where), ERR_SYSTEM (reported) */
int camera_load(const char *path, struct camera **out);
void camera_free(struct camera **camera);

/** Pictures of a turntable; 0: there is none, and each recorded frame becomes one. @param camera  NULL: none */
uint32_t camera_pictures(const struct camera *camera);

/** 1 where places are those of the world. */
int camera_is_in_world(const struct camera *camera);
