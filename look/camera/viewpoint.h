/* The position and projection of a camera (look/camera/camera.h) in a scene. */
#pragma once

#include "scene/scene.h"

struct camera;
struct look;

/* Eye space is the recorded scene's. In the camera's own space, the camera is at the origin and looks along -z. The
 * transforms rotate and translate only, so lengths do not change. */
struct viewpoint {
	const struct camera_keys *keys;
	uint32_t main_view;         /* the recorded camera's most important view */
	float eye_from_recorded[16]; /* the recorded camera's own space; the identity unless the program's projection
	                                contains a camera */
	float camera_from_eye[16], eye_from_camera[16];
	float sky_from_eye[16];     /* for things drawn around the viewer */
	int was_parallel, is_parallel;
	int is_moved;               /* 0: it is where the recorded camera was */
	float distance;             /* distance to the target */
	float aspect;               /* width over height of the part of the picture that is drawn to */
};

/**
 * @param look    the source of the world's place; NULL: none
 * @param number  of a turntable's picture
 * @return 0; ERR_INPUT (reported): the file cannot be meant for this scene. main_view is SCENE_NONE if the scene
 * shows nothing in space
 */
int viewpoint_find(const struct camera *camera, const struct look *look, const struct scene *scene, uint32_t number,
                   struct viewpoint *out);

/** The camera's projection, to replace that of a recorded view. */
void viewpoint_project(const struct viewpoint *v, const struct scene *scene, const struct scene_view *view,
                       float out[16]);
