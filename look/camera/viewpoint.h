/* Where a camera (look/camera/camera.h) stands in a scene, and what it projects how. */
#pragma once

#include "scene/scene.h"

struct camera;
struct look;

/* Eye space is the recorded scene's; the camera's own has it at the origin, looking along -z. Turns and shifts only:
 * lengths stay. */
struct viewpoint {
	const struct camera_keys *keys;
	uint32_t main_view;         /* through which the recorded camera shows most */
	float eye_from_recorded[16]; /* the recorded camera's own space; the identity but for programs with a camera in
	                                the projection */
	float camera_from_eye[16], eye_from_camera[16];
	float sky_from_eye[16];     /* of what is drawn around the viewer */
	int was_parallel, is_parallel;
	int is_moved;               /* 0: it stands where the recorded camera stood */
	float distance;             /* to what is looked at */
	float aspect;               /* of the picture's part that is drawn to: width over height */
};

/**
 * @param look    its world counts; NULL: none
 * @param number  of a turntable's picture
 * @return 0; ERR_INPUT (reported): the file cannot be meant for this scene. main_view is SCENE_NONE where the scene
 * shows nothing in space
 */
int viewpoint_find(const struct camera *camera, const struct look *look, const struct scene *scene, uint32_t number,
                   struct viewpoint *out);

/** The camera's projection in place of a recorded view's. */
void viewpoint_project(const struct viewpoint *v, const struct scene *scene, const struct scene_view *view,
                       float out[16]);
