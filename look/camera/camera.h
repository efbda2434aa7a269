/*
 * A camera for a recorded frame: relume render --camera FILE. Everything, lights included, stays where it is; HUDs are
 * left out. All keys are optional. An unknown key is an error, reported with its line.
 *
 * KEYS
 *     kind: pinhole               # default: the program's own projection. Others: orthographic; panorama (360 by
 *                                 # 180 degrees, by equal angles); cube (left, front, right, and below them down,
 *                                 # back, up); stereo (two eyes side by side). The last three, and aperture, need
 *                                 # mode whitted or path
 *     space: eye                  # the space of the positions and directions below. eye: the recorded camera's, which
 *                                 # is at 0 0 0 and looks along -z, y up. world: the space that the list `world` of
 *                                 # a look file describes ('relume help look-file'). Default eye
 *     place: [0, 0, 0]            # the camera's position; default: the recorded camera's
 *     look_at: [0, 0, -1]         # the point it looks at; default: as the recorded camera
 *     up: [0, 1, 0]               # the up direction; default: y
 *     field_of_view: 45           # for kinds pinhole and stereo: degrees from top to bottom; stereo: default 60
 *     height: 10                  # for kind orthographic: units from top to bottom
 *     aperture: 0.1               # for kind pinhole: its radius, in units; blurs things out of focus (--samples 64)
 *     focus: 10                   # with aperture: the distance in focus
 *     eyes: 0.06                  # for kind stereo: the distance between the eyes, in units. For kind panorama: makes
 *                                 # two pictures, the left eye's above the right eye's; default 0: one eye
 *     converge: 10                # for kind stereo: the distance of the screen, where both eyes show the same.
 *                                 # Default 10
 *     near: 0.1                   # nearest distance drawn along the line of sight, in units. Default for near and
 *                                 # far: the range that the program drew, extended by the distance to the new place
 *     far: 100                    # farthest distance drawn
 *     size: [640, 480]            # the picture's size in pixels; default: the window's
 *     turntable:                  # makes many pictures of one frame: the camera goes from its place around a point,
 *                                 # looking at it, about the axis `up`
 *       about: [0, 0, -5]         # the point; default: the middle of the visible scene
 *       degrees: 360              # the angle; above 0: counterclockwise, seen from above. Default 360
 *       frames: 48                # the number of pictures, numbered from 0. Default 48
 *
 * Without kind, field_of_view and height, the program's own projection stays. With another kind but neither of the
 * other two, the target of look_at (by default, the middle of the visible scene) keeps its size.
 *
 * Channels P and N of a rendered frame give the position of a thing, and the direction that is up.
 *
 * EXAMPLES
 *     # turn.yaml: once around the middle of the visible scene, with the floor's normal as the up direction
 *     up: [0, 0.9, 0.44]
 *     turntable: { frames: 4 }
 *
 *     relume render game.trace -f 3 --camera turn.yaml -o turn.####.png
 *
 *     # plan.yaml: from above, without perspective
 *     kind: orthographic
 *     place: [0, 20, -5]
 *     look_at: [0, 0, -5]
 *     up: [0, 0, -1]
 *     height: 12
 *
 *     relume render game.trace -f 3 --camera plan.yaml -o plan.png
 *
 *     # around.yaml: all around the recorded camera, for a viewer of panoramas
 *     kind: panorama
 *     size: [2048, 1024]
 *
 *     relume render game.trace -f 3 --look auto --camera around.yaml -o around.png
 */
#pragma once

#include <stdint.h>

/* Pointers are NULL for missing keys. */
struct camera_turntable {
	const float *about, *degrees;
	const uint32_t *frames;
};

struct camera {
	const char *path; /* the file's name, for messages; borrowed */
	struct camera_keys {
		const char *kind, *space;
		const float *place, *look_at, *up, *field_of_view, *height, *near, *far, *aperture, *focus, *eyes, *converge;
		const uint32_t *size;
		struct camera_turntable *turntable;
	} *keys;
};

enum { CAMERA_MOST_SIZE = 16384, CAMERA_MOST_PICTURES = 100000 };

/** @param path  kept until camera_free. @return 0; ERR_INPUT (reported, with what and where), ERR_SYSTEM (reported) */
int camera_load(const char *path, struct camera **out);
void camera_free(struct camera **camera);

/**
 * The number of pictures of a turntable; 0: there is none, and each recorded frame gives one picture. @param camera
 * NULL: none
 */
uint32_t camera_pictures(const struct camera *camera);

/** 1 if a file specifies this kind. */
int camera_is_kind(const struct camera_keys *keys, const char *kind);

/** 1 if positions are in world space. */
int camera_is_in_world(const struct camera *camera);
